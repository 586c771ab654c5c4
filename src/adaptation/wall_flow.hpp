// The friction, the boundary layer and the cells of the layer along the walls of a solution.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

namespace lamina::adaptation {

/// The flow at the middle of an edge of a wall.
struct WallFlowEdge {
    Segment ends{};           ///< in the order of the chain
    Point at;                 ///< the middle
    double length = 0;        ///< of the edge
    std::uint32_t cell = 0;   ///< the cell on it
    bool at_corner = false;   ///< whether the wall turns at one of its ends too sharply for differences along it
    double friction = 0;      ///< velocity gradient at the wall over the free stream's speed, positive along the wall
    double wall_unit = 0;     ///< height above the wall at which y+ is 1
    double thickness = 0;     ///< of the boundary layer; 0 where its end is not seen
    double layer_height = 0;  ///< of the cells of the layer above the edge
    double layers = 0;        ///< number of those cells; two triangles count as one quadrilateral
    std::vector<std::uint32_t> column;  ///< those cells, from the wall on
    std::vector<double> tops;           ///< per cell of the column: the distance from the wall where it ends

    /// Returns the distance from the wall of the middle of a cell of the column.
    double middle(std::size_t row) const { return 0.5 * (tops[row] + (row > 0 ? tops[row - 1] : 0)); }
};

/// The edges of one wall, in their order; a closed chain, counter-clockwise round a body.
using WallFlow = std::vector<WallFlowEdge>;

/// Returns the flow along all walls.
///
/// Friction is the velocity in the cell on the wall over its distance: such cells are to lie within the viscous
/// sublayer. The boundary layer ends where the vorticity w at the distance n from the wall no longer changes the
/// velocity u that it has induced so far: where n w < 0.02 u, with u the integral of w from the wall on, which unlike
/// the speed tends to a constant outside of the layer whatever the pressure does there. Thicknesses are running medians
/// along the wall. Source: P. R. Spalart, J. H. Watmuff, J. Fluid Mech. 249 (1993), section 2.
///
/// The mean velocity over the far field is the free stream's. Throws OptionError where the components are no fields of
/// the solution, and where the mesh has no walls or no far field.
std::vector<WallFlow> find_wall_flow(const Solution& solution, const WallFlowOptions& options);

}  // namespace lamina::adaptation
