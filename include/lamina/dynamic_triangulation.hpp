// A triangulation that points and segments are inserted into and removed from.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A constrained Delaunay triangulation of a convex hull that changes. After each change it is the one that
/// triangulate() makes of the points and segments it has then, exactly, by the tie rule: its history leaves no trace but
/// the numbers of points. Points keep their numbers, and those of removed ones are not used again. Segments are held as
/// the edges that they are cut into by points on them.
///
/// An object may be read on several threads, but not while it changes. Functions that throw leave it as it was.
/// Insertion and removal take O(log n) and O(d log d) on average for points in batches, d being the number of neighbours;
/// a single point is found in O(n^(1/3)) steps. As long as all points lie on one line each change takes O(n log n).
class LAMINA_EXPORT DynamicTriangulation {
public:
    /// Makes a triangulation without points.
    DynamicTriangulation();
    /// Makes that of points and segments between them. The points have the numbers 0, 1, 2, ...; of equal ones all but
    /// one count as removed (contains()). Throws as the functions that insert them do, with place().segments.
    explicit DynamicTriangulation(std::span<const Point> points, std::span<const Segment> segments = {});
    /// Copies all data.
    DynamicTriangulation(const DynamicTriangulation& other);
    /// Moves; `other` may only be assigned to or destroyed afterwards.
    DynamicTriangulation(DynamicTriangulation&& other) noexcept;
    /// Takes over the other triangulation.
    DynamicTriangulation& operator=(DynamicTriangulation other) noexcept;
    /// Frees all data.
    ~DynamicTriangulation();

    /// Inserts a point and returns its number, or that of the point which lies there already. A segment that the point
    /// lies on is cut there. Throws InputError for coordinates outside the exact range.
    VertexId insert(Point p);
    /// Inserts points, in an order that makes it quick, and returns their numbers. Each takes up a number, in the order
    /// of the points; those of points where there is one already count as removed.
    std::vector<VertexId> insert(std::span<const Point> points);

    /// Removes a point. Where those left all lie on one line, segments on it are dropped: there are no edges. Throws InputError for a number that is not contained, and for an end of a segment's edge, which
    /// has to be removed before (place().points).
    void remove(VertexId point);
    /// Removes points, in an order that makes it quick. Throws as the function for one does, before it removes any;
    /// repeated numbers count as not contained.
    void remove(std::span<const VertexId> points);

    /// Inserts a segment and returns the edges that it consists of, from its a to its b: points on it cut it. A segment
    /// from a point to itself has none. Throws InputError for ends that are not contained, for a segment that crosses
    /// one that was inserted before (place().points holds the ends of both), and where all points lie on one line.
    std::vector<Segment> insert(Segment segment);

    /// Removes all edges of segments on the straight way between two points; the points stay. Overlapping segments are
    /// not counted: the edges are removed for all of them. Throws InputError unless the whole way consists of such edges.
    void remove(Segment segment);

    /// Returns the points by their numbers, removed ones included.
    std::span<const Point> points() const;
    /// Returns whether this is the number of a point that was not removed.
    bool contains(VertexId point) const;
    /// Returns the number of points that were not removed.
    std::size_t size() const;
    /// Returns the number of the point at p, if there is one.
    std::optional<VertexId> find(Point p) const;
    /// Returns the triangles, counter-clockwise, in no particular order. None where all points lie on one line.
    std::vector<Triangle> triangles() const;
    /// Returns the edges of segments, each once with the smaller number first, sorted.
    std::vector<Segment> segments() const;

private:
    class Data;
    std::unique_ptr<Data> data_;
};

}  // namespace lamina
