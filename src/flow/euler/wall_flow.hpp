// The flow along walls: sides, pressures, shocks.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/compressible_flow.hpp>

#include "flow/euler/euler.hpp"

namespace lamina::flow::euler {

/// The flow at one vertex of a wall.
struct WallState {
    Point at, velocity;
    double pressure;
};

/// Returns the place in an outline at which its sides begin: where the flow along it parts, or where the pressure is
/// largest if it parts nowhere. The outline begins at the trailing edge, and its sides end at the place `sides_end`.
std::size_t find_stagnation(std::span<const WallState> outline, std::size_t sides_end);

/// Returns the sides of all walls, with their shocks and without names. A side begins at the
/// stagnation point.
std::vector<CompressibleElement> wall_flows(const EulerMesh& mesh, const EulerSolution& solution,
                                            const EulerOptions& options);

/// Returns the shocks along a side: where the Mach number of the wall falls through 1, in units of `extent` not at its
/// end, behind a region that is clearly supersonic, and by a jump. `from` and `extent` are those of the element in x.
std::vector<WallShock> find_shocks(const std::vector<CompressibleWallPoint>& side, double from, double extent);

/// Returns the drag coefficient of all layers, from the momentum that is missing at the ends of the wakes.
/// Source: H. B. Squire, A. D. Young, ARC R&M 1838 (1937).
double viscous_drag(const EulerSolution& solution);

}  // namespace lamina::flow::euler
