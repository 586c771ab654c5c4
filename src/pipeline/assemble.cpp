// Stage "assemble": the layer and the refined subdomains become one mesh.
#include <algorithm>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include <lamina/pipeline.hpp>

#include "core/parallel.hpp"
#include "pipeline/assemble.hpp"

namespace lamina::pipeline {

namespace {

/// Takes the edges of the base out of the edges of an element's wall, and returns them. Edge i of the wall joins the
/// vertices i and i + 1 of the counter-clockwise outline, and runs from the latter to the former.
std::vector<Segment> take_base(const Element& element, std::span<const Point> points, std::vector<Segment>& wall) {
    const auto edge_at = [&](std::size_t corner) {
        const auto found = std::find_if(wall.begin(), wall.end(), [&](const Segment& edge) {
            return points[edge.b.index()] == element.points[corner];
        });
        return static_cast<std::size_t>(found - wall.begin());
    };
    const std::size_t n = wall.size(), first = edge_at(element.features.base->first);
    const std::size_t length = (edge_at(element.features.base->last) + n - first) % n;
    std::vector<Segment> base, rest;
    for (std::size_t k = 0; k < length; ++k) base.push_back(wall[(first + k) % n]);
    for (std::size_t i = 0; i < n; ++i)
        if ((i + n - first) % n >= length) rest.push_back(wall[i]);
    wall = std::move(rest);
    return base;
}

/// The positions in the arrays of the mesh at which the vertices and triangles of each refinement begin, followed by
/// the sizes of the arrays.
struct MeshOffsets {
    std::vector<std::size_t> point, triangle;
};

/// Returns the offsets behind this many points and triangles.
MeshOffsets mesh_offsets(std::span<const Refinement> refinements, std::size_t points, std::size_t triangles) {
    MeshOffsets offsets{{points}, {triangles}};
    for (const Refinement& refinement : refinements) {
        offsets.point.push_back(offsets.point.back() + refinement.steiner_points.size());
        offsets.triangle.push_back(offsets.triangle.back() + refinement.triangles.size());
    }
    if (offsets.point.back() >= VertexId{}.value)
        throw MeshError(fmt::format("the mesh would have {} vertices, more than 32-bit numbers can tell apart",
                                    offsets.point.back()));
    return offsets;
}

/// Makes the arrays of the mesh long enough for all cells, and fills in the cells of the layer.
void make_arrays(LayerCells cells, const MeshOffsets& offsets, Mesh& mesh) {
    const std::size_t layer_triangles = cells.triangles.size(), quads = cells.quads.size();
    const std::size_t triangles = offsets.triangle.back(), all = triangles + quads;
    mesh.triangles = std::move(cells.triangles);
    mesh.quads = std::move(cells.quads);
    mesh.layer = std::move(cells.triangle_layer);
    // The system hands out memory page by page when it is first written. Several threads share the wait for it.
    const std::function<void()> arrays[] = {
        [&] { mesh.triangles.resize(triangles); },
        [&] { mesh.points.resize(offsets.point.back()); },
        [&] { mesh.piece.resize(all); },
        [&] {
            mesh.layer.reserve(all);
            mesh.layer.resize(triangles, 0);
            mesh.layer.insert(mesh.layer.end(), cells.quad_layer.begin(), cells.quad_layer.end());
        },
        [&] {
            mesh.region.reserve(all);
            mesh.region.resize(layer_triangles, Region::layer);
            mesh.region.resize(triangles, Region::isotropic);
            mesh.region.resize(all, Region::layer);
        },
    };
    core::parallel_for(std::size(arrays), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) arrays[i]();
    });
    for (std::size_t i = 0; i < cells.pieces(); ++i)
        std::fill(mesh.piece.begin() + std::ptrdiff_t(cells.first_triangle[i]),
                  mesh.piece.begin() + std::ptrdiff_t(cells.first_triangle[i + 1]), std::uint32_t(i));
}

/// Copies one refinement into the mesh. `border` are the ids of its border vertices in the mesh.
void copy_refinement(const Refinement& refinement, std::span<const VertexId> border, std::size_t first_point,
                     std::size_t first_triangle, Mesh& mesh) {
    std::copy(refinement.steiner_points.begin(), refinement.steiner_points.end(),
              mesh.points.begin() + std::ptrdiff_t(first_point));
    const std::size_t shift = first_point - border.size();
    for (std::size_t t = 0; t < refinement.triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) {
            const std::size_t v = refinement.triangles[t].v[k].index();
            mesh.triangles[first_triangle + t].v[k] = v < border.size() ? border[v] : VertexId{v + shift};
        }
}

}  // namespace

std::vector<Marker> make_markers(const Geometry& geometry, const Layer& layer, std::vector<Segment> far_field,
                                 const AssembleOptions& options) {
    std::vector<Marker> markers;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        const Element& element = geometry.elements[e];
        std::vector<Segment> wall = layer.edges.walls[e], base;
        if (options.base_marker && element.features.base) base = take_base(element, layer.points, wall);
        markers.push_back({element.name, MarkerKind::wall, std::move(wall)});
        if (!base.empty()) markers.push_back({element.name + "_base", MarkerKind::wall, std::move(base)});
    }
    markers.push_back({"farfield", MarkerKind::far_field, std::move(far_field)});
    return markers;
}

Mesh layer_mesh(const Layer& layer, const LayerCells& cells) {
    Mesh mesh;
    mesh.points = layer.points;
    mesh.triangles = cells.triangles;
    mesh.quads = cells.quads;
    mesh.layer = cells.triangle_layer;
    mesh.layer.insert(mesh.layer.end(), cells.quad_layer.begin(), cells.quad_layer.end());
    mesh.region.assign(mesh.triangles.size() + mesh.quads.size(), Region::layer);
    return mesh;
}

Mesh assemble(std::vector<Marker> markers, const Layer& layer, LayerCells cells, Decoupling decoupling,
              std::vector<Refinement> refinements) {
    const MeshOffsets offsets = mesh_offsets(refinements, decoupling.points.size(), cells.triangles.size());
    const std::size_t layer_pieces = cells.pieces();
    Mesh mesh;
    mesh.markers = std::move(markers);
    mesh.constraints = layer.edges.interfaces;
    mesh.points = std::move(decoupling.points);
    make_arrays(std::move(cells), offsets, mesh);
    core::parallel_for(refinements.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Refinement refinement = std::move(refinements[i]);  // is freed once it is copied
            copy_refinement(refinement, decoupling.subdomains[i].global, offsets.point[i], offsets.triangle[i], mesh);
            std::fill_n(mesh.piece.begin() + std::ptrdiff_t(offsets.triangle[i]), refinement.triangles.size(),
                        static_cast<std::uint32_t>(layer_pieces + i));
        }
    });
    return mesh;
}

}  // namespace lamina::pipeline

namespace lamina {

Mesh assemble(const Geometry& geometry, const Layer& layer, LayerCells cells, Decoupling decoupling,
              std::vector<Refinement> refinements, const AssembleOptions& options) {
    std::vector<Marker> markers = pipeline::make_markers(geometry, layer, std::move(decoupling.far_field), options);
    return pipeline::assemble(std::move(markers), layer, std::move(cells), std::move(decoupling),
                              std::move(refinements));
}

}  // namespace lamina
