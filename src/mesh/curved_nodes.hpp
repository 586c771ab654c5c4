// The nodes of one curved cell.
#pragma once

#include <array>
#include <span>

#include <lamina/curved_mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/cell_lattice.hpp"

namespace lamina::mesh {

using CellNodes = std::array<Point, nodes_of_cell(4, max_cell_order)>;

/// Returns the numbers of the nodes of a cell beside its corners.
inline std::span<const VertexId> inner_nodes(const MeshView& mesh, const CurvedNodes& nodes, std::size_t cell) {
    const std::size_t triangles = mesh.triangles.size(), corners = cell < triangles ? 3 : 4;
    const std::size_t count = nodes_of_cell(static_cast<unsigned>(corners), nodes.order) - corners;
    return cell < triangles ? std::span(nodes.triangle_nodes).subspan(cell * count, count)
                            : std::span(nodes.quad_nodes).subspan((cell - triangles) * count, count);
}

/// Puts the nodes of a cell into `places`, in the order of CurvedNodes, and returns them. Precondition: their numbers are in
/// range.
inline std::span<const Point> gather_nodes(const MeshView& mesh, const CurvedNodes& nodes, std::size_t cell,
                                           CellNodes& places) {
    const CellEdges cells(mesh);
    std::size_t n = 0;
    for (std::size_t i = 0; i < cells.corners(cell); ++i) places[n++] = mesh.points[cells.corner(cell, i).index()];
    for (const VertexId v : inner_nodes(mesh, nodes, cell)) places[n++] = nodes.points[v.index() - mesh.points.size()];
    return std::span(places).first(n);
}

/// Returns the point of an edge of order p at the parameter t, by Lagrange's polynomials of its p + 1 evenly spaced nodes.
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
