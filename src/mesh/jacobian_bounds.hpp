// Whether a cell of higher order is valid: the determinant of its Jacobian is positive everywhere in it. Proved by the
// coefficients of the determinant in Bernstein's polynomials, between which all its values lie, on parts of the cell
// that are halved until each is decided.
// Source: A. Johnen, J.-F. Remacle, C. Geuzaine, Geometrical validity of curvilinear finite elements, J. Comput. Phys.
// 233 (2013), sections 3 and 4.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <lamina/curved_mesh.hpp>
#include <lamina/export.hpp>
#include <lamina/point.hpp>

#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

enum class CellVerdict {
    valid,    ///< the determinant is positive in the whole closed cell
    invalid,  ///< it is negative somewhere
    unproved  ///< twelve halvings in each direction, or the precision of numbers, do not tell
};

/// What is proved of the determinant of a cell, by the coordinates of the reference cell of cell_lattice.hpp.
struct JacobianBounds {
    CellVerdict verdict = CellVerdict::unproved;
    double lower = 0;  ///< no value of a valid cell is below this
    double upper = 0;  ///< no value is above this; infinite where coordinates are too large

    /// Returns a lower bound of the smallest value over the largest one; not positive unless the cell is valid.
    double scaled() const { return verdict == CellVerdict::valid ? lower / upper : 0; }
};

/// Bounds the determinant of a cell with 3 or 4 corners, whose nodes are in the order of lattice_of_cell(). Coordinates
/// are taken as they are; a bound of all rounding errors is taken off. Precondition: as many nodes as nodes_of_cell()
/// says, with finite coordinates.
LAMINA_EXPORT JacobianBounds bound_jacobian(unsigned corners, unsigned order, std::span<const Point> nodes,
                                            NodeDistribution distribution = NodeDistribution::equidistant);

/// The nodes of several cells of one shape and order.
struct JacobianBatch {
    static constexpr std::size_t capacity = 4;
    using Lanes [[gnu::vector_size(capacity * sizeof(double))]] = double;  ///< one number per cell

    std::array<Lanes, nodes_of_cell(4, max_cell_order)> x, y;  ///< coordinates, node by node
    std::size_t size = 0;                                      ///< number of cells

    /// Puts a node of the cell that add_cell() adds. Lanes of no cell are copies of the first one. Precondition: size <
    /// capacity.
    void put(std::size_t node, Point p) {
        if (size == 0) {
            x[node] = p.x - Lanes{};
            y[node] = p.y - Lanes{};
        } else {
            x[node][size] = p.x;
            y[node][size] = p.y;
        }
    }
    /// Adds the cell all of whose nodes have been put.
    void add_cell() { ++size; }
};

/// Does what bound_jacobian() does for each cell of a batch, all with 3 or 4 corners.
LAMINA_EXPORT std::array<JacobianBounds, JacobianBatch::capacity> bound_jacobians(
    unsigned corners, unsigned order, const JacobianBatch& batch,
    NodeDistribution distribution = NodeDistribution::equidistant);

}  // namespace lamina::mesh
