// Which cells are probably those of the boundary layer, in meshes that do not say it.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

#include "core/cell_shape.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::mesh {

namespace {

/// Sets of vertices that hang together.
class VertexSets {
public:
    explicit VertexSets(std::size_t vertices) : parent_(vertices) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }
    std::uint32_t find(std::uint32_t v) {
        while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
        return v;
    }
    void join(VertexId a, VertexId b) {
        const auto [low, high] = std::minmax({find(a.value), find(b.value)});
        parent_[high] = low;
    }

private:
    std::vector<std::uint32_t> parent_;
};

/// What the shape of a cell says about it.
enum class Look {
    thin,  ///< a cell of the layer if it hangs together with a wall
    row,   ///< half of a rectangle, as in rows of a layer where cells are as high as wide; elsewhere one of 20 cells
    other
};

Look look_of(const Mesh& mesh, std::size_t cell) {
    if (cell >= mesh.triangles.size()) return Look::thin;
    const auto& v = mesh.triangles[cell].v;
    const core::CellShape shape =
        core::measure_triangle(mesh.points[v[0].index()], mesh.points[v[1].index()], mesh.points[v[2].index()]);
    if (shape.min_angle_deg < proved_min_angle_deg) return Look::thin;
    return std::abs(shape.max_angle_deg - 90) < 1 ? Look::row : Look::other;
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

using namespace mesh;

std::vector<Region> estimate_regions(const Mesh& mesh) {
    const CellEdges cells(mesh);
    VertexSets sets(mesh.points.size());
    std::vector<std::uint32_t> thin;
    for (std::size_t cell = 0; cell < cells.cells(); ++cell) {
        const Look look = look_of(mesh, cell);
        if (look == Look::other) continue;
        if (look == Look::thin) thin.push_back(static_cast<std::uint32_t>(cell));
        for (std::size_t i = 1; i < cells.corners(cell); ++i) sets.join(cells.corner(cell, 0), cells.corner(cell, i));
    }
    std::vector<bool> at_wall(mesh.points.size(), false);  // per set, at its first vertex
    for (const Marker& marker : mesh.markers) {
        if (!may_be_wall(marker.kind)) continue;
        for (const Segment& edge : marker.edges)
            at_wall[sets.find(edge.a.value)] = at_wall[sets.find(edge.b.value)] = true;
    }
    std::erase_if(thin, [&](std::uint32_t cell) { return !at_wall[sets.find(cells.corner(cell, 0).value)]; });
    std::vector<Region> regions;
    if (thin.empty()) return regions;
    regions.assign(cells.cells(), Region::isotropic);
    for (const std::uint32_t cell : thin) regions[cell] = Region::layer;
    return regions;
}

}  // namespace lamina
