#include "pipeline/area_jumps.hpp"

#include <algorithm>
#include <cstddef>

#include "mesh/adjacency.hpp"
#include "mesh/check_cells.hpp"

namespace lamina::pipeline {

namespace {

/// Returns a view of the cells of the layer alone.
MeshView layer_of(const Mesh& mesh) {
    MeshView layer = mesh;
    std::size_t triangles = 0;
    while (triangles < mesh.triangles.size() && mesh.region[triangles] == Region::layer) ++triangles;
    layer.triangles = layer.triangles.first(triangles);
    layer.region = {};
    layer.piece = {};
    layer.layer = {};
    return layer;
}

/// Returns for each column whether both of its rays begin at one vertex.
std::vector<char> find_fans(std::span<const VertexId> column_origins) {
    std::vector<char> is_fan(column_origins.size());
    for (std::size_t c = 0; c + 1 < column_origins.size(); ++c) is_fan[c] = column_origins[c] == column_origins[c + 1];
    return is_fan;
}

void raise(AreaJump& jump, double ratio, Point at) {
    if (ratio < jump.ratio || (ratio == jump.ratio && !lexicographically_less(at, jump.at))) return;
    jump = {ratio, at};
}

}  // namespace

AreaJumps find_area_jumps(const Mesh& mesh, std::span<const std::uint32_t> columns,
                          std::span<const VertexId> column_origins) {
    const MeshView layer = layer_of(mesh);
    const mesh::CellEdges edges(layer);
    const mesh::Adjacency adjacency = mesh::find_adjacency(layer);
    const std::vector<char> is_fan = find_fans(column_origins);
    std::vector<double> areas(edges.cells());
    std::vector<char> in_fan(edges.cells(), 0);
    for (std::size_t cell = 0; cell < areas.size(); ++cell) {
        areas[cell] = mesh::area_of(layer, edges, cell);
        // Cells behind bases have no column.
        if (columns.size() == areas.size() && columns[cell] < is_fan.size()) in_fan[cell] = is_fan[columns[cell]];
    }
    AreaJumps jumps;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::uint32_t twin = adjacency.twin[e];
        if (twin == mesh::no_edge || twin < e) continue;
        const std::size_t cell = edges.cell_of(e), other = edges.cell_of(twin);
        const double ratio = std::max(areas[cell], areas[other]) / std::min(areas[cell], areas[other]);
        const Point middle = midpoint(layer.points[edges.origin(e).index()], layer.points[edges.target(e).index()]);
        raise(in_fan[cell] == in_fan[other] ? jumps.elsewhere : jumps.beside_fans, ratio, middle);
    }
    return jumps;
}

}  // namespace lamina::pipeline
