// Questions to a triangulation: where points lie in it, which vertex is nearest, and values between the vertices.
//
// Guarantees:
//  1. Locations and nearest vertices are exact. Where several answers are right, the smallest index counts.
//  2. Any number of threads may ask at once. Functions with several queries use all threads, with the same results.
//  3. The index holds all it needs: neither points nor triangles have to live on. Copies share their data.
// Limits:
//  1. Making an index takes O(n log n) and 130 bytes a vertex. The region may have holes and several parts.
//  2. Nearest vertices and Sibson's weights are a UsageError unless is_delaunay().
// Example:
//     const std::vector<Point> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
//     const TriangulationIndex index(points, triangulate(points).triangles);
//     assert(index.locate(Point{1.5, 0.2}).place == PointPlace::inside);
//     assert(index.nearest_vertex({9, 9}) == VertexId{2u});
//     assert(index.interpolate_linear(std::vector<double>{0, 2, 2, 0}, Point{1, 0.5}) == 1);  // the values are x
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// The parts of a triangle that a point may lie on.
enum class PointPlace : std::uint8_t {
    inside,     ///< strictly inside the triangle
    on_edge,    ///< on an edge, but on no vertex
    on_vertex,  ///< on a vertex
    outside,    ///< in no triangle
};

/// The place of a point in a triangulation.
struct PointLocation {
    TriangleId triangle{};                   ///< the triangle that holds the point; not valid outside
    PointPlace place = PointPlace::outside;  ///< what of the triangle the point lies on
    std::uint8_t corner = 0;  ///< the corner that it lies on, or that is opposite the edge that it lies on; else 0

    /// Returns whether two locations are the same.
    friend constexpr bool operator==(const PointLocation&, const PointLocation&) = default;
};

/// The natural neighbours of a point, and Sibson's weights. The weights are not negative and add up to 1.
struct NaturalNeighbours {
    std::vector<VertexId> vertices;  ///< counter-clockwise round the point; empty outside
    std::vector<double> weights;     ///< one for each vertex
};

/// A triangulation that was prepared for queries.
class LAMINA_EXPORT TriangulationIndex {
public:
    /// Prepares a triangulation; points in no triangle are ignored. Precondition: the triangles neither overlap nor
    /// leave gaps between edges that face each other. Throws InputError for coordinates outside the exact range,
    /// indices out of range, triangles that are not counter-clockwise, and edges with several triangles on one side.
    TriangulationIndex(std::span<const Point> points, std::span<const Triangle> triangles);

    /// Returns where p lies; NaN lies outside. It takes O(log n) and a few steps. Source: E. P. Muecke, I. Saias, B.
    /// Zhu, Comput. Geom. 12 (1999); O. Devillers, S. Pion, M. Teillaud, Int. J. Found. Comput. Sci. 13 (2002).
    PointLocation locate(Point p) const;
    /// Returns the same by a walk from the triangle `hint`, if it is valid. Throws InputError for a hint out of range.
    PointLocation locate(Point p, TriangleId hint) const;
    std::vector<PointLocation> locate(std::span<const Point> queries) const;  ///< where each query lies

    /// Returns whether the triangles are a Delaunay triangulation of their vertices, with the convex hull as boundary.
    bool is_delaunay() const;
    /// Returns the vertex nearest to any point p. Throws InputError for coordinates outside the exact range.
    VertexId nearest_vertex(Point p) const;
    std::vector<VertexId> nearest_vertices(std::span<const Point> queries) const;  ///< the nearest of each query
    /// Returns the natural neighbours of p: the vertices from whose Voronoi cells p would take a share; on the hull the
    /// ends of the edge. Where they lie on a line up to rounding, so that weights would miss p by 1e-9 of the
    /// distances, those of linear interpolation stand in. Source: R. Sibson, Math. Proc. Camb. Phil. Soc. 87 (1980).
    NaturalNeighbours natural_neighbours(Point p) const;
    /// Returns the values at the queries that are linear in each triangle and have `values` at the points; NaN outside.
    /// All three throw InputError unless there is one value for each point.
    std::vector<double> interpolate_linear(std::span<const double> values, std::span<const Point> queries) const;
    double interpolate_linear(std::span<const double> values, Point p) const;  ///< the value at one point
    /// Returns the values by Sibson's weights, which are smooth but at the vertices and reproduce linear functions.
    std::vector<double> interpolate_sibson(std::span<const double> values, std::span<const Point> queries) const;

private:
    struct Data;
    std::shared_ptr<const Data> data_;
};

}  // namespace lamina
