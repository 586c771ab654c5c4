#include "pipeline/assemble.hpp"

#include <algorithm>
#include <functional>
#include <iterator>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"

namespace lamina {

namespace {

std::vector<Marker> make_markers(const Pslg& pslg, const LayerEdges& edges, std::vector<Segment> far_field) {
    std::vector<Marker> markers;
    for (std::size_t i = 0; i < pslg.elements.size(); ++i)
        markers.push_back({pslg.elements[i].name, MarkerKind::wall, edges.walls[i]});
    markers.push_back({"farfield", MarkerKind::far_field, std::move(far_field)});
    return markers;
}

}  // namespace

Mesh assemble(const Pslg& pslg, const LayerEdges& edges, LayerFill layer_fill, Decoupling decoupling,
              std::vector<Refinement> pieces) {
    LayerCells& layer_cells = layer_fill.cells;
    const std::size_t layer_pieces = layer_fill.pieces();
    const std::size_t layer_count = layer_cells.triangles.size(), quads = layer_cells.quads.size();
    std::vector<std::size_t> first_point(pieces.size() + 1, decoupling.points.size());
    std::vector<std::size_t> first_triangle(pieces.size() + 1, layer_count);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        first_point[i + 1] = first_point[i] + pieces[i].added.size();
        first_triangle[i + 1] = first_triangle[i] + pieces[i].triangles.size();
    }
    if (first_point.back() >= VertexId{}.value)
        throw MeshError(fmt::format("the mesh would have {} vertices, more than 32-bit numbers can tell apart",
                                    first_point.back()));

    Mesh mesh;
    mesh.markers = make_markers(pslg, edges, std::move(decoupling.far_field));
    mesh.constraints = edges.interfaces;
    mesh.points = std::move(decoupling.points);
    mesh.triangles = std::move(layer_cells.triangles);
    mesh.quads = std::move(layer_cells.quads);
    mesh.layer = std::move(layer_cells.triangle_layer);
    const std::size_t triangles = first_triangle.back(), cells = triangles + quads;
    // The system hands out pages as they are first written: one thread alone would wait for all of them.
    const std::function<void()> arrays[] = {
        [&] { mesh.triangles.resize(triangles); },
        [&] { mesh.points.resize(first_point.back()); },
        [&] { mesh.piece.resize(cells); },
        [&] {
            mesh.layer.reserve(cells);
            mesh.layer.resize(triangles, 0);
            mesh.layer.insert(mesh.layer.end(), layer_cells.quad_layer.begin(), layer_cells.quad_layer.end());
        },
        [&] {
            mesh.region.reserve(cells);
            mesh.region.resize(layer_count, Region::layer);
            mesh.region.resize(triangles, Region::isotropic);
            mesh.region.resize(cells, Region::layer);
        },
    };
    parallel_for(std::size(arrays), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) arrays[i]();
    });
    for (std::size_t i = 0; i < layer_pieces; ++i)
        std::fill(mesh.piece.begin() + std::ptrdiff_t(layer_fill.first_triangle[i]),
                  mesh.piece.begin() + std::ptrdiff_t(layer_fill.first_triangle[i + 1]), std::uint32_t(i));
    parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Refinement piece = std::move(pieces[i]);
            const std::vector<VertexId>& border = decoupling.subdomains[i].global;
            std::copy(piece.added.begin(), piece.added.end(), mesh.points.begin() + std::ptrdiff_t(first_point[i]));
            const std::size_t shift = first_point[i] - border.size();
            for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
                Triangle& target = mesh.triangles[first_triangle[i] + t];
                for (int k = 0; k < 3; ++k) {
                    const std::size_t v = piece.triangles[t].v[k].index();
                    target.v[k] = v < border.size() ? border[v] : VertexId{v + shift};
                }
                mesh.piece[first_triangle[i] + t] = static_cast<std::uint32_t>(layer_pieces + i);
            }
        }
    });
    return mesh;
}

}  // namespace lamina
