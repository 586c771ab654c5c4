// How the triangles of a triangulation hang together, as plain arrays: half-edges, neighbours, the triangles round each
// vertex, and the boundary.
//
//                v[2]               Half-edge 3 t + i of triangle t runs from its corner v[i] to its corner v[i + 1]
//                /  \.              (indices modulo 3) and has the triangle on its left, as in delaunator.
//     3 t + 2   /    \  3 t + 1
//              /      \.
//           v[0] ---- v[1]
//               3 t + 0
//
// Guarantees:
//  1. Each function takes O(n) on all threads, and its result is the same on any number of them.
// Limits:
//  1. Edges have at most one triangle on each side; others, and indices out of range, are an InputError that names
//     them.
// Example:
//     const std::vector<Point> points{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
//     const std::vector<Triangle> triangles = triangulate(points).triangles;
//     const std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
//     assert(std::count(twins.begin(), twins.end(), no_half_edge) == 4 && boundary_loops(twins).size() == 1);
#pragma once

#include <array>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>

namespace lamina {

/// Stands where there is no half-edge: across the boundary.
inline constexpr std::uint32_t no_half_edge = 0xffffffffu;
/// Returns the half-edge that follows h round its triangle.
constexpr std::uint32_t next_half_edge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
/// Returns the half-edge that comes before h round its triangle.
constexpr std::uint32_t previous_half_edge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
/// Returns the vertex that a half-edge starts at.
inline VertexId origin(std::span<const Triangle> triangles, std::uint32_t h) { return triangles[h / 3].v[h % 3]; }

/// Lists of different lengths in one array (compressed sparse rows).
struct IndexLists {
    std::vector<std::uint32_t> starts{0};  ///< list i begins at items[starts[i]] and ends before items[starts[i + 1]]
    std::vector<std::uint32_t> items{};    ///< the lists, one behind the other

    std::size_t size() const { return starts.size() - 1; }  ///< the number of lists
    /// Returns list i.
    std::span<const std::uint32_t> operator[](std::size_t i) const {
        return std::span(items).subspan(starts[i], starts[i + 1] - starts[i]);
    }
};

/// Returns for each half-edge the opposite one, which runs the other way between the same vertices; no_half_edge on the
/// boundary. `points` is the number of points that the triangles index.
LAMINA_EXPORT std::vector<std::uint32_t> half_edges(std::size_t points, std::span<const Triangle> triangles);
/// Returns for each triangle its neighbours: number e is the one across the edge opposite corner e, as in Triangle and
/// CGAL. Ids across the boundary are not valid. `twins` is what half_edges() returns.
LAMINA_EXPORT std::vector<std::array<TriangleId, 3>> neighbours(std::span<const std::uint32_t> twins);
/// Returns for each point the half-edges that start there, one in each triangle at it (h / 3), counter-clockwise. On
/// the boundary the list begins with the half-edge on the boundary, so that it leaves out the gap; elsewhere with the
/// smallest. Where the boundary touches itself, the list has one part after the other.
LAMINA_EXPORT IndexLists half_edges_at_points(std::size_t points, std::span<const Triangle> triangles,
                                              std::span<const std::uint32_t> twins);
/// Returns the loops of the boundary, as half-edges with the triangles on their left: counter-clockwise round the
/// triangles, clockwise round holes. The first half-edge of a loop is its smallest, and loops are sorted by it.
LAMINA_EXPORT IndexLists boundary_loops(std::span<const std::uint32_t> twins);

}  // namespace lamina
