#include "page/growth.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/adjacency.hpp"

namespace lamina::page {

namespace {

/// Returns the height of a cell over an edge, times the length of the edge: all cells on an edge have that in common.
double height_measure(const Mesh& mesh, const mesh::CellEdges& edges, std::size_t cell) {
    const auto corner = [&](std::size_t i) { return mesh.points[edges.corner(cell, i).index()]; };
    // Twice the area of a triangle, the area of a quadrilateral.
    if (edges.corners(cell) == 3) return std::abs(cross(corner(1) - corner(0), corner(2) - corner(0)));
    return 0.5 * std::abs(cross(corner(2) - corner(0), corner(3) - corner(1)));
}

}  // namespace

std::vector<std::uint32_t> growth_histogram(const Mesh& mesh) {
    const mesh::CellEdges edges(mesh);
    if (mesh.layer.size() < edges.cells() || edges.cells() == 0) return {};
    const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
    std::vector<std::uint32_t> histogram(growth_bins, 0);
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        const std::uint32_t twin = adjacency.twin[edge];
        if (twin == mesh::no_edge) continue;
        const std::size_t below = edges.cell_of(edge), above = edges.cell_of(twin);
        if (mesh.layer[below] == 0 || mesh.layer[above] != mesh.layer[below] + 1) continue;
        const double growth = height_measure(mesh, edges, above) / height_measure(mesh, edges, below);
        if (!std::isfinite(growth)) continue;
        const double bin = std::clamp((growth - least_growth) / growth_step, 0.0, growth_bins - 1.0);
        ++histogram[static_cast<std::size_t>(bin)];
    }
    return histogram;
}

}  // namespace lamina::page
