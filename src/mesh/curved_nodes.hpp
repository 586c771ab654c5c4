// The nodes of one curved cell.
#pragma once

#include <array>
#include <span>

#include <lamina/curved_mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

/// Returns the numbers of the nodes of a cell beside its corners.
inline std::span<const VertexId> inner_nodes(const MeshView& mesh, const CurvedNodes& nodes, std::size_t cell) {
    const std::size_t triangles = mesh.triangles.size(), corners = cell < triangles ? 3 : 4;
    const std::size_t count = nodes_of_cell(static_cast<unsigned>(corners), nodes.order) - corners;
    return cell < triangles ? std::span(nodes.triangle_nodes).subspan(cell * count, count)
                            : std::span(nodes.quad_nodes).subspan((cell - triangles) * count, count);
}

/// Calls f(i, place) for the nodes of a cell, in the order of CurvedNodes. Precondition: their numbers are in range.
template <class F>
void for_each_node(const MeshView& mesh, const CurvedNodes& nodes, std::size_t cell, F&& f) {
    const CellEdges cells(mesh);
    std::size_t n = 0;
    for (std::size_t i = 0; i < cells.corners(cell); ++i) f(n++, mesh.points[cells.corner(cell, i).index()]);
    for (const VertexId v : inner_nodes(mesh, nodes, cell)) f(n++, nodes.points[v.index() - mesh.points.size()]);
}

/// Returns Lagrange's polynomials of the nodes of an edge of order p at the parameter t, which weigh its p + 1 nodes
/// there.
inline std::array<double, max_cell_order + 1> weights_on_edge(unsigned p, double t, NodeDistribution distribution) {
    std::array<double, max_cell_order + 1> x{}, weights{};
    // Whole numbers in place of i / p, where they may be: they do not round.
    const bool is_even = distribution == NodeDistribution::equidistant;
    for (unsigned i = 0; i <= p; ++i) x[i] = is_even ? i : place_on_edge(p, i, distribution);
    const double at = is_even ? p * t : t;
    for (unsigned i = 0; i <= p; ++i) {
        weights[i] = 1;
        for (unsigned k = 0; k <= p; ++k)
            if (k != i) weights[i] *= (at - x[k]) / (x[i] - x[k]);
    }
    return weights;
}

/// Returns the point of an edge at the parameter t, by Lagrange's polynomials of its nodes.
inline Point point_of_edge(std::span<const Point> nodes, double t, NodeDistribution distribution) {
    const auto weights = weights_on_edge(static_cast<unsigned>(nodes.size() - 1), t, distribution);
    Point sum{0, 0};
    for (std::size_t i = 0; i < nodes.size(); ++i) sum = sum + weights[i] * nodes[i];
    return sum;
}

}  // namespace lamina::mesh
