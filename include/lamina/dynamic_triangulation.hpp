// A triangulation that points and segments are inserted into and removed from.
//
// Guarantees:
//  1. After each change the triangles are exactly those that triangulate() makes of the points and segments then.
//  2. Points keep their numbers, and those of removed ones are not used again.
//  3. Functions that throw leave the object as it was.
// Limits:
//  1. The region is the convex hull. Segments are held as the edges that they are cut into by points on them.
//  2. An object may be read on several threads, but not while it changes.
//  3. A point of a batch takes O(log n) to insert and O(d log d) to remove on average, with d neighbours; a single one
//     is found in O(n^(1/3)) steps. While all points lie on one line each change takes O(n log n).
// Example:
//     DynamicTriangulation changing(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}});
//     const VertexId added = changing.insert(Point{1, 1});
//     assert(changing.triangles().size() == 2);
//     changing.remove(added);
//     assert(changing.triangles().size() == 1 && !changing.contains(added));
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A constrained Delaunay triangulation of a convex hull that changes.
class LAMINA_EXPORT DynamicTriangulation {
public:
    /// Makes a triangulation without points.
    DynamicTriangulation();
    /// Makes that of points and segments between them. The points have the numbers 0, 1, 2, ...; of equal ones all but
    /// one count as removed (contains()). Throws as the functions that insert them do, with place().segments.
    explicit DynamicTriangulation(std::span<const Point> points, std::span<const Segment> segments = {});
    DynamicTriangulation(const DynamicTriangulation& other);               ///< copies all data
    DynamicTriangulation(DynamicTriangulation&& other) noexcept;           ///< leaves nothing but assignment to `other`
    DynamicTriangulation& operator=(DynamicTriangulation other) noexcept;  ///< takes over the other triangulation
    ~DynamicTriangulation();

    /// Inserts a point and returns its number, or that of the point which lies there already. A segment that the point
    /// lies on is cut there. Throws InputError for coordinates outside the exact range.
    VertexId insert(Point p);
    /// Inserts points in a quick order, and returns their numbers. Each takes up a number, in the order of the points;
    /// those of points where there is one already count as removed.
    std::vector<VertexId> insert(std::span<const Point> points);
    /// Inserts a segment and returns the edges that it consists of, from its a to its b: points on it cut it. A segment
    /// from a point to itself has none. Throws InputError for ends that are not contained, for a segment that crosses
    /// one that was inserted before (place().points holds the ends of both), and where all points lie on one line.
    std::vector<Segment> insert(Segment segment);

    /// Removes a point. Where those left all lie on one line, segments on it are dropped: there are no edges. Throws
    /// InputError for a number that is not contained, and for an end of a segment's edge (place().points).
    void remove(VertexId point);
    /// Removes points in a quick order. Throws as the function for one does; repeated numbers count as not contained.
    void remove(std::span<const VertexId> points);
    /// Removes all edges of segments on the straight way between two points, for all segments that overlap there.
    /// Throws InputError unless the whole way consists of such edges.
    void remove(Segment segment);

    std::span<const Point> points() const;        ///< the points by their numbers, removed ones included
    bool contains(VertexId point) const;          ///< whether this is the number of a point that was not removed
    std::size_t size() const;                     ///< the number of points that were not removed
    std::optional<VertexId> find(Point p) const;  ///< the number of the point at p, if there is one
    /// Returns the triangles, counter-clockwise, in no particular order. None where all points lie on one line.
    std::vector<Triangle> triangles() const;
    std::vector<Segment> segments() const;  ///< the edges of segments, once each, the smaller number first, sorted

private:
    class Data;
    std::unique_ptr<Data> data_;
};

}  // namespace lamina
