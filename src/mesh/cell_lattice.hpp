// The places of the nodes of cells of higher order on the reference cell, in the order of Gmsh.
// Source: Gmsh reference manual, "Node ordering", high-order elements.
#pragma once

#include <span>

#include <lamina/curved_mesh.hpp>
#include <lamina/export.hpp>

namespace lamina::mesh {

/// A node at (i / p, j / p) of the reference cell of order p: the triangle (0, 0), (1, 0), (0, 1), or the unit square.
struct LatticePlace {
    unsigned i, j;
};

/// Returns the number of nodes of a cell with so many corners, 2 for a line: all of it, corners included.
constexpr unsigned nodes_of_cell(unsigned corners, unsigned order) {
    if (corners == 2) return order + 1;
    return corners == 3 ? (order + 1) * (order + 2) / 2 : (order + 1) * (order + 1);
}

/// Returns the places of the nodes of a cell with 3 or 4 corners, counter-clockwise along its border from the first
/// corner on: the corners, then those within each edge from one corner to the next, then those inside, ordered
/// likewise. Precondition: 1 <= order <= max_cell_order.
LAMINA_EXPORT std::span<const LatticePlace> lattice_of_cell(unsigned corners, unsigned order);

}  // namespace lamina::mesh
