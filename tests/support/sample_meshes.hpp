// Small meshes for tests. Together they have every feature that a mesh can have.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::test {

/// Options of annulus().
struct AnnulusOptions {
    std::size_t around = 24;      ///< number of points on each circle
    std::size_t rings = 5;        ///< number of rings of cells
    std::size_t layer_rings = 2;  ///< number of rings of the layer, from the wall
    bool quads_in_layer = false;
};

/// Returns an annulus of inner radius 1 round the origin. It has the markers 'wall' and 'farfield', regions, one piece
/// per ring, one layer per ring of the layer, and the layer's outer border as constraints. Points are numbered ring by
/// ring from the wall.
inline Mesh annulus(const AnnulusOptions& options = {}) {
    Mesh mesh;
    const std::size_t n = options.around;
    const auto vertex = [n](std::size_t ring, std::size_t i) { return VertexId(ring * n + i % n); };
    for (std::size_t ring = 0; ring <= options.rings; ++ring)
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
            const double radius = std::pow(1.2, static_cast<double>(ring));
            mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        }
    struct CellAttributes {
        Region region;
        std::uint32_t piece;
        std::uint16_t layer;
    };
    std::vector<CellAttributes> triangle_attributes, quad_attributes;
    for (std::size_t ring = 0; ring < options.rings; ++ring) {
        const bool layer = ring < options.layer_rings;
        const CellAttributes attributes{layer ? Region::layer : Region::isotropic, static_cast<std::uint32_t>(ring),
                                        static_cast<std::uint16_t>(layer ? ring + 1 : 0)};
        for (std::size_t i = 0; i < n; ++i) {
            const VertexId a = vertex(ring, i), b = vertex(ring + 1, i), c = vertex(ring + 1, i + 1),
                           d = vertex(ring, i + 1);
            if (layer && options.quads_in_layer) {
                mesh.quads.push_back({{a, b, c, d}});
                quad_attributes.push_back(attributes);
            } else {
                mesh.triangles.push_back({{a, b, c}});
                mesh.triangles.push_back({{a, c, d}});
                triangle_attributes.insert(triangle_attributes.end(), 2, attributes);
            }
        }
    }
    triangle_attributes.insert(triangle_attributes.end(), quad_attributes.begin(), quad_attributes.end());
    for (const CellAttributes& attributes : triangle_attributes) {
        mesh.region.push_back(attributes.region);
        mesh.piece.push_back(attributes.piece);
        mesh.layer.push_back(attributes.layer);
    }
    mesh.markers = {{"wall", MarkerKind::wall, {}}, {"farfield", MarkerKind::far_field, {}}};
    for (std::size_t i = 0; i < n; ++i) {
        mesh.markers[0].edges.push_back({vertex(0, i + 1), vertex(0, i)});
        mesh.markers[1].edges.push_back({vertex(options.rings, i), vertex(options.rings, i + 1)});
        const VertexId a = vertex(options.layer_rings, i), b = vertex(options.layer_rings, i + 1);
        if (options.layer_rings < options.rings) mesh.constraints.push_back({std::min(a, b), std::max(a, b)});
    }
    std::sort(mesh.constraints.begin(), mesh.constraints.end());
    return mesh;
}

/// Returns the square [0, n] x [0, n] of unit squares that are split in two, without the middle one. All coordinates
/// are integers; there are no regions; the markers are 'hole' and 'box'. Precondition: n is odd.
inline Mesh box_with_hole(std::size_t n = 5) {
    Mesh mesh;
    const auto vertex = [n](std::size_t i, std::size_t j) { return VertexId(j * (n + 1) + i); };
    for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i) mesh.points.push_back({static_cast<double>(i), static_cast<double>(j)});
    const std::size_t m = n / 2;
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            if (i == m && j == m) continue;
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
        }
    const VertexId hole[4] = {vertex(m, m), vertex(m, m + 1), vertex(m + 1, m + 1), vertex(m + 1, m)};
    mesh.markers = {{"hole", MarkerKind::wall, {}}, {"box", MarkerKind::far_field, {}}};
    for (int i = 0; i < 4; ++i) mesh.markers[0].edges.push_back({hole[i], hole[(i + 1) % 4]});
    for (std::size_t i = 0; i < n; ++i) {
        mesh.markers[1].edges.push_back({vertex(i, 0), vertex(i + 1, 0)});
        mesh.markers[1].edges.push_back({vertex(n, i), vertex(n, i + 1)});
        mesh.markers[1].edges.push_back({vertex(i + 1, n), vertex(i, n)});
        mesh.markers[1].edges.push_back({vertex(0, i + 1), vertex(0, i)});
    }
    return mesh;
}

/// Returns the square [0, 1] x [0, 1] of n x n squares that are split in two. There are no regions; the marker is
/// 'box'.
inline Mesh cut_square(std::size_t n) {
    Mesh mesh;
    const auto vertex = [n](std::size_t i, std::size_t j) { return VertexId(j * (n + 1) + i); };
    const auto place = [n](std::size_t i) { return static_cast<double>(i) / static_cast<double>(n); };
    mesh.markers = {{"box", MarkerKind::far_field, {}}};
    for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i) mesh.points.push_back({place(i), place(j)});
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
        }
        mesh.markers[0].edges.push_back({vertex(j, 0), vertex(j + 1, 0)});
        mesh.markers[0].edges.push_back({vertex(n, j), vertex(n, j + 1)});
        mesh.markers[0].edges.push_back({vertex(j + 1, n), vertex(j, n)});
        mesh.markers[0].edges.push_back({vertex(0, j + 1), vertex(0, j)});
    }
    return mesh;
}

/// Returns a mesh of a triangle and a quadrilateral.
inline Mesh tiny() {
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {0.1, 1e-5}, {-0.0, 1}, {-1, 1.0 / 3}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}};
    mesh.quads = {{{VertexId(0), VertexId(2), VertexId(3), VertexId(4)}}};
    mesh.markers = {{"wall", MarkerKind::wall, {{VertexId(0), VertexId(1)}, {VertexId(1), VertexId(2)}}},
                    {"farfield",
                     MarkerKind::far_field,
                     {{VertexId(2), VertexId(3)}, {VertexId(3), VertexId(4)}, {VertexId(4), VertexId(0)}}}};
    return mesh;
}

/// Returns the mesh with points and cells in another order, and with cells that start at other corners.
inline Mesh shuffled(const Mesh& mesh, unsigned seed) {
    std::mt19937 random(seed);
    const auto permutation = [&](std::size_t n) {
        std::vector<std::size_t> order(n);
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random() % i]);
        return order;
    };
    Mesh result = mesh;
    const std::vector<std::size_t> new_index = permutation(mesh.points.size());
    for (std::size_t i = 0; i < new_index.size(); ++i) result.points[new_index[i]] = mesh.points[i];
    const auto moved = [&](VertexId v) { return VertexId(new_index[v.index()]); };
    const auto move_cells = [&](auto& to, const auto& from, std::size_t first) {
        const std::vector<std::size_t> order = permutation(from.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            const std::size_t corners = std::size(from[i].v), turn = random() % corners;
            for (std::size_t k = 0; k < corners; ++k) to[order[i]].v[k] = moved(from[i].v[(k + turn) % corners]);
            if (!mesh.region.empty()) result.region[first + order[i]] = mesh.region[first + i];
            if (!mesh.piece.empty()) result.piece[first + order[i]] = mesh.piece[first + i];
            if (!mesh.layer.empty()) result.layer[first + order[i]] = mesh.layer[first + i];
        }
    };
    move_cells(result.triangles, mesh.triangles, 0);
    move_cells(result.quads, mesh.quads, mesh.triangles.size());
    const auto move_edges = [&](std::vector<Segment>& edges) {
        for (Segment& edge : edges) edge = {moved(edge.a), moved(edge.b)};
    };
    for (Marker& marker : result.markers) {
        move_edges(marker.edges);
        std::reverse(marker.edges.begin(), marker.edges.end());
    }
    std::reverse(result.markers.begin(), result.markers.end());
    move_edges(result.constraints);
    for (Segment& edge : result.constraints) edge = {std::min(edge.a, edge.b), std::max(edge.a, edge.b)};
    std::sort(result.constraints.begin(), result.constraints.end());
    return result;
}

/// Returns the marker of this name; null where there is none.
inline const Marker* marker_of(const Mesh& mesh, const std::string& name) {
    for (const Marker& marker : mesh.markers)
        if (marker.name == name) return &marker;
    return nullptr;
}

}  // namespace lamina::test
