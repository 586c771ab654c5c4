// The nodes of one curved cell.
#pragma once

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

/// Returns the point of an edge of order p at the parameter t, by Lagrange's polynomials of its p + 1 evenly spaced
/// nodes.
inline Point point_of_edge(std::span<const Point> nodes, double t) {
    const auto p = static_cast<double>(nodes.size() - 1);
    Point sum{0, 0};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        double factor = 1;
        for (std::size_t k = 0; k < nodes.size(); ++k)
            if (k != i) factor *= (p * t - static_cast<double>(k)) / (static_cast<double>(i) - static_cast<double>(k));
        sum = sum + factor * nodes[i];
    }
    return sum;
}

}  // namespace lamina::mesh
