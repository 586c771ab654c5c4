#include "pipeline/sharing/parts.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include <fmt/format.h>

#include <lamina/error.hpp>

namespace lamina::pipeline {

namespace {

/// Formatting on several threads at once pays for parts of this size.
constexpr std::size_t part_cells = 1 << 16;

/// Calls f(begin, end) for successive parts of [first, last).
template <class F>
void for_parts(std::size_t first, std::size_t last, F&& f) {
    for (std::size_t begin = first; begin < last; begin += part_cells) f(begin, std::min(last, begin + part_cells));
}

}  // namespace

std::vector<MeshPart> parts_of_points(std::span<const Point> points) {
    std::vector<MeshPart> parts;
    for_parts(0, points.size(), [&](std::size_t begin, std::size_t end) {
        parts.push_back({.first_vertex = begin, .points = points.subspan(begin, end - begin)});
    });
    return parts;
}

std::vector<MeshPart> parts_of_layer(std::span<const Point> points, const layers::LayerCells& cells) {
    std::vector<MeshPart> parts;
    for (std::size_t piece = 0; piece < cells.pieces(); ++piece)
        for_parts(cells.first_triangle[piece], cells.first_triangle[piece + 1],
                  [&](std::size_t begin, std::size_t end) {
                      parts.push_back({.first_cell = begin,
                                       .triangles = std::span(cells.triangles).subspan(begin, end - begin),
                                       .shared = points,
                                       .region = Region::layer,
                                       .piece = static_cast<std::uint32_t>(piece),
                                       .layers = std::span(cells.triangle_layer).subspan(begin, end - begin)});
                  });
    return parts;
}

std::vector<MeshPart> parts_behind_pieces(std::span<const Point> points, const layers::LayerCells& cells,
                                          std::size_t triangles) {
    std::vector<MeshPart> parts;
    for_parts(0, cells.quads.size(), [&](std::size_t begin, std::size_t end) {
        parts.push_back({.first_cell = triangles + begin,
                         .shared = points,
                         .region = Region::layer,
                         .layers = std::span(cells.quad_layer).subspan(begin, end - begin),
                         .quads = std::span(cells.quads).subspan(begin, end - begin)});
    });
    return parts;
}

void number_in_mesh(const decoupling::Subdomain& subdomain, std::size_t first_vertex, Refinement& refinement) {
    assert(subdomain.global.size() == subdomain.points.size());
    const std::size_t shift = first_vertex - subdomain.global.size();
    for (Triangle& t : refinement.triangles)
        for (VertexId& v : t.v)
            v = v.index() < subdomain.global.size() ? subdomain.global[v.index()] : VertexId{v.index() + shift};
}

MeshPart part_of_piece(std::span<const Point> points, std::size_t layer_pieces, std::size_t piece,
                       std::size_t first_vertex, std::size_t first_triangle, const Refinement& refinement) {
    return {.first_vertex = first_vertex,
            .points = refinement.steiner_points,
            .first_cell = first_triangle,
            .triangles = refinement.triangles,
            .shared = points,
            .piece = static_cast<std::uint32_t>(layer_pieces + piece)};
}

mesh::HashOfParts hash_of_piece(const decoupling::Subdomain& subdomain, const Refinement& refinement) {
    mesh::HashOfParts hash;
    std::vector<Point> points = subdomain.points;
    points.insert(points.end(), refinement.steiner_points.begin(), refinement.steiner_points.end());
    hash.add(points, refinement.triangles);
    return hash;
}

void require_numbered(std::size_t vertices) {
    if (vertices >= VertexId{}.value)
        throw MeshError(
            fmt::format("the mesh has more vertices than 32-bit numbers can tell apart: {} so far", vertices));
}

}  // namespace lamina::pipeline
