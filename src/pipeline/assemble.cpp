#include "pipeline/assemble.hpp"

#include <algorithm>

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
    mesh.points.resize(first_point.back());
    mesh.triangles = std::move(layer_cells.triangles);
    mesh.triangles.resize(first_triangle.back());
    mesh.quads = std::move(layer_cells.quads);
    const auto of_cells = [&](auto of_layer, auto of_pieces) {
        std::vector<decltype(of_layer)> values(layer_count, of_layer);
        values.resize(first_triangle.back(), of_pieces);
        values.resize(first_triangle.back() + quads, of_layer);
        return values;
    };
    mesh.region = of_cells(Region::layer, Region::isotropic);
    mesh.piece = of_cells(std::uint32_t{0}, std::uint32_t{0});
    for (std::size_t i = 0; i < layer_pieces; ++i)
        std::fill(mesh.piece.begin() + std::ptrdiff_t(layer_fill.first_triangle[i]),
                  mesh.piece.begin() + std::ptrdiff_t(layer_fill.first_triangle[i + 1]), std::uint32_t(i));
    mesh.layer = std::move(layer_cells.triangle_layer);
    mesh.layer.resize(first_triangle.back(), 0);
    mesh.layer.insert(mesh.layer.end(), layer_cells.quad_layer.begin(), layer_cells.quad_layer.end());
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
