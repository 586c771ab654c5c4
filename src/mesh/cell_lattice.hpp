// The places of the nodes of cells of higher order on the reference cell, in the order of Gmsh.
// Source: Gmsh reference manual, "Node ordering", high-order elements.
#pragma once

#include <span>

#include <lamina/curved_mesh.hpp>
#include <lamina/export.hpp>

namespace lamina::mesh {

/// A node at (i / p, j / p) of the reference cell of order p, or at the place of a NodeDistribution that stands for it:
/// the triangle (0, 0), (1, 0), (0, 1), or the unit square.
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

/// Returns x_i of a distribution. Source: G. E. Karniadakis, S. J. Sherwin, Spectral/hp Element Methods for CFD (2005),
/// appendix B.
LAMINA_EXPORT double place_on_edge(unsigned order, unsigned i, NodeDistribution distribution);

/// Returns step k of 2 p from one end of an edge to the other: each second one is a node, and the others are halfway
/// between two.
LAMINA_EXPORT double half_step_on_edge(unsigned order, unsigned k, NodeDistribution distribution);

/// A place on the reference cell.
struct NodePlace {
    double s, t;
};

/// Returns the places of the nodes of a cell, in the order of lattice_of_cell().
LAMINA_EXPORT std::span<const NodePlace> places_of_nodes(unsigned corners, unsigned order,
                                                         NodeDistribution distribution);

}  // namespace lamina::mesh
