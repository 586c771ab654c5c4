// Which cells are probably those of the boundary layer, in meshes that do not say it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

#include "core/cell_shape.hpp"
#include "core/disjoint_sets.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::mesh {

namespace {

/// What the shape of a cell says about it.
enum class Look {
    thin,  ///< a cell of the layer if it hangs together with a wall
    row,   ///< about half of a rectangle, as in rows of a layer where cells are as high as wide; elsewhere one of few
    other
};

Look look_of(const MeshView& mesh, std::size_t cell) {
    constexpr double max_slant_deg = 4;  // rows whose height changes along the wall lean
    if (cell >= mesh.triangles.size()) return Look::thin;
    const auto& v = mesh.triangles[cell].v;
    const core::CellShape shape =
        core::measure_triangle(mesh.points[v[0].index()], mesh.points[v[1].index()], mesh.points[v[2].index()]);
    if (shape.min_angle_deg < proved_min_angle_deg) return Look::thin;
    return std::abs(shape.max_angle_deg - 90) < max_slant_deg ? Look::row : Look::other;
}

/// Adds to the layer those of the cells that one other cell parts from it at most.
void add_thin_cells_near_layer(const MeshView& mesh, std::span<const std::uint32_t> thin,
                               std::vector<Region>& regions) {
    if (thin.empty()) return;
    const CellEdges cells(mesh);
    std::vector<char> in_layer(mesh.points.size(), 0), near(mesh.points.size(), 0);  // per vertex
    const auto has = [&](const std::vector<char>& marks, std::size_t cell) {
        for (std::size_t i = 0; i < cells.corners(cell); ++i)
            if (marks[cells.corner(cell, i).index()]) return true;
        return false;
    };
    const auto mark = [&](std::vector<char>& marks, std::size_t cell) {
        for (std::size_t i = 0; i < cells.corners(cell); ++i) marks[cells.corner(cell, i).index()] = 1;
    };
    for (std::size_t cell = 0; cell < cells.cells(); ++cell)
        if (regions[cell] == Region::layer) mark(in_layer, cell);
    for (std::size_t cell = 0; cell < cells.cells(); ++cell)
        if (has(in_layer, cell)) mark(near, cell);
    for (const std::uint32_t cell : thin)
        if (has(near, cell)) regions[cell] = Region::layer;
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

using namespace mesh;

std::vector<Region> estimate_regions(const MeshView& mesh) {
    const CellEdges cells(mesh);
    core::DisjointSets sets(mesh.points.size());
    std::vector<std::uint32_t> thin;
    for (std::size_t cell = 0; cell < cells.cells(); ++cell) {
        const Look look = look_of(mesh, cell);
        if (look == Look::other) continue;
        if (look == Look::thin) thin.push_back(static_cast<std::uint32_t>(cell));
        for (std::size_t i = 1; i < cells.corners(cell); ++i)
            sets.join(cells.corner(cell, 0).value, cells.corner(cell, i).value);
    }
    std::vector<bool> at_wall(mesh.points.size(), false);  // per set, at its first vertex
    for (const Marker& marker : mesh.markers) {
        if (!may_be_wall(marker.kind)) continue;
        for (const Segment& edge : marker.edges)
            at_wall[sets.find(edge.a.value)] = at_wall[sets.find(edge.b.value)] = true;
    }
    const auto first_apart = std::partition(
        thin.begin(), thin.end(), [&](std::uint32_t cell) { return at_wall[sets.find(cells.corner(cell, 0).value)]; });
    std::vector<Region> regions;
    if (first_apart == thin.begin()) return regions;
    regions.assign(cells.cells(), Region::isotropic);
    std::for_each(thin.begin(), first_apart, [&](std::uint32_t cell) { regions[cell] = Region::layer; });
    const auto apart = static_cast<std::size_t>(thin.end() - first_apart);
    add_thin_cells_near_layer(mesh, std::span(thin).last(apart), regions);
    return regions;
}

}  // namespace lamina
