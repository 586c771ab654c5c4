// Questions to a triangulation: where points lie in it, which vertex is nearest, and values between the vertices.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A point lies on one of these parts of a triangle.
enum class PointPlace : std::uint8_t {
    inside,     ///< strictly inside the triangle
    on_edge,    ///< on an edge, but on no vertex
    on_vertex,  ///< on a vertex
    outside,    ///< in no triangle
};

/// This says where a point lies in a triangulation.
struct PointLocation {
    /// The triangle that holds the point; where several do, the one with the smallest index. Not valid outside.
    TriangleId triangle{};
    PointPlace place = PointPlace::outside;  ///< what of the triangle the point lies on
    /// The corner that it lies on, or the corner opposite the edge that it lies on; else 0.
    std::uint8_t corner = 0;

    /// Returns whether two locations are the same.
    friend constexpr bool operator==(const PointLocation&, const PointLocation&) = default;
};

/// The natural neighbours of a point, and Sibson's weights. The weights are not negative and add up to 1.
struct NaturalNeighbours {
    std::vector<VertexId> vertices;  ///< counter-clockwise round the point; empty outside
    std::vector<double> weights;     ///< one for each vertex
};

/// A triangulation that was prepared for queries. It holds all it needs: neither points nor triangles have to live on.
/// Queries are exact, except for the values they compute, and never change it, so any number of threads may ask at once.
/// The functions with several queries use all threads; their results are those of the single queries, in the same order.
/// The region may have holes and several parts. Copies share their data. 130 bytes a vertex; O(n log n) to make.
class LAMINA_EXPORT TriangulationIndex {
public:
    /// Prepares a triangulation. The vertices of triangles are indices into `points`; further points are ignored.
    /// Precondition: the triangles neither overlap nor leave gaps between edges that face each other, as those of every
    /// function of the library. Throws InputError for coordinates outside the exact range, indices out of range,
    /// triangles that are not counter-clockwise, and edges with several triangles on one side.
    TriangulationIndex(std::span<const Point> points, std::span<const Triangle> triangles);

    /// Returns where p lies. Jumps to a vertex near p and walks from there: O(log n) and a few steps on average. For
    /// points that are no numbers the answer is `outside`.
    /// Source: E. P. Muecke, I. Saias, B. Zhu, Comput. Geom. 12 (1999); O. Devillers, S. Pion, M. Teillaud, Int. J.
    /// Found. Comput. Sci. 13 (2002).
    PointLocation locate(Point p) const;

    /// Returns the same, but walks from the triangle `hint`: quicker for a few steps, slower for many. A hint that is
    /// not valid counts as none. Throws InputError for a hint out of range.
    PointLocation locate(Point p, TriangleId hint) const;

    /// Returns where each query lies.
    std::vector<PointLocation> locate(std::span<const Point> queries) const;

    /// Returns whether the triangles are the Delaunay triangulation of their vertices, with the convex hull as boundary
    /// (any one of several that cocircular points may have).
    bool is_delaunay() const;

    /// Returns the vertex nearest to p, which may lie anywhere; the one with the smallest index of several that are
    /// equally near. Exact. Throws UsageError unless is_delaunay(), and InputError for coordinates outside the exact
    /// range.
    VertexId nearest_vertex(Point p) const;
    /// Returns the nearest vertex of each query.
    std::vector<VertexId> nearest_vertices(std::span<const Point> queries) const;

    /// Returns the natural neighbours of p: the vertices from whose Voronoi cells p would take a share if it were a
    /// vertex. On the hull these are the ends of the edge. Where neighbours lie on a line up to rounding, so that weights
    /// would miss p by 1e-9 of the distances, those of linear interpolation stand in. Throws UsageError unless
    /// is_delaunay().
    /// Source: R. Sibson, Math. Proc. Camb. Phil. Soc. 87 (1980).
    NaturalNeighbours natural_neighbours(Point p) const;

    /// Returns the values at the queries that are linear in each triangle and have `values` at the points; NaN outside.
    /// Precondition: one value for each point, or InputError.
    std::vector<double> interpolate_linear(std::span<const double> values, std::span<const Point> queries) const;

    /// Returns the value at one point.
    double interpolate_linear(std::span<const double> values, Point p) const;

    /// Returns the values at the queries by Sibson's weights; NaN outside. They are smooth but at the vertices, and
    /// reproduce linear functions. Throws UsageError unless is_delaunay(), and InputError unless there is one value for
    /// each point.
    std::vector<double> interpolate_sibson(std::span<const double> values, std::span<const Point> queries) const;

private:
    struct Data;
    std::shared_ptr<const Data> data_;
};

}  // namespace lamina
