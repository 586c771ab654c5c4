// The data behind TriangulationIndex: linked triangles in an order in which neighbours are close in memory. What lies
// between the boundary of the region and its convex hull is filled with triangles, too, and ghosts close the hull, so
// that a walk gets from anywhere to anywhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <lamina/delaunay_queries.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/hilbert.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::queries {

/// Bits of positions along the curve, per axis.
inline constexpr unsigned curve_bits = 28;

/// Vertices sorted along a curve, to find one near a point.
struct VerticesAlongCurve {
    Box box;
    HilbertCurve<curve_bits> curve{Box{{0, 0}, {1, 1}}};
    unsigned key_shift = 0;            ///< the shortest difference of positions that keys tell apart
    std::vector<std::uint64_t> keys;   ///< the position of each vertex, ascending
    unsigned bucket_shift = 0;         ///< key >> bucket_shift is its bucket
    std::vector<Index> bucket_starts;  ///< for each bucket the first key in it or behind it, and one more

    /// Returns the position of any point, of the nearest one in the box where it lies outside.
    std::uint64_t key(Point p) const;
    /// Returns the number of the first key that is not less, at most keys.size().
    std::size_t lower_bound(std::uint64_t key) const;
};

/// See the top of the file. Vertices are numbered from 1 along the curve; vertex 0 is the one at infinity.
struct QueryIndex {
    std::size_t point_count = 0;      ///< number of points handed in
    std::vector<Point> vertices;      ///< those of triangles
    std::vector<Index> point_ids;     ///< for each vertex the index of its point
    Tris tris;                        ///< those of the region, those between it and its hull, and ghosts
    std::vector<Index> triangle_ids;  ///< for each of tris the index of the triangle handed in; no_index outside
    std::vector<Index> places;        ///< for each triangle handed in its index in tris
    std::vector<Index> at_vertex;     ///< for each vertex the triangle of the region there with the smallest id
    VerticesAlongCurve along_curve;   ///< key i is that of vertex i + 1
    bool is_delaunay = false;

    bool is_inside(Index t) const { return triangle_ids[t] != no_index; }
};

/// Makes the data of TriangulationIndex, which says what it throws.
QueryIndex make_query_index(std::span<const Point> points, std::span<const Triangle> triangles);

/// Returns a vertex near p. Precondition: there is one.
Index vertex_near(const QueryIndex& index, Point p);

/// Returns a triangle or ghost that holds p, found by a walk from `start`, which is no ghost. A point on an edge or
/// vertex may be found in any of the triangles there. Precondition: p is in the exact range.
Index walk_to(const QueryIndex& index, Index start, Point p);

/// Returns the location of p, which the triangle or ghost `found` holds.
PointLocation classify(const QueryIndex& index, Index found, Point p);

/// Returns the point nearest to p, which the triangle or ghost `found` holds.
VertexId nearest_point(const QueryIndex& index, Index found, Point p);

/// Returns the natural neighbours of p, which the triangle or ghost `found` holds.
NaturalNeighbours natural_neighbours_at(const QueryIndex& index, Index found, Point p);

/// Calls answer(i, found) for each query, on all threads, where `found` holds queries[i]; no_index for points outside
/// the exact range, and where there are no triangles. The order is that of the curve.
void for_each_found(const QueryIndex& index, std::span<const Point> queries,
                    const std::function<void(std::size_t, Index)>& answer);

/// Returns the weights of the corners of t whose mean is p, which lies in or on t. They add up to 1, and are right but
/// for rounding also where the corners lie on a line up to rounding.
std::array<double, 3> linear_weights(const Point* vertices, const Tri& t, Point p);

}  // namespace lamina::delaunay::queries
