// Insertion of long segments on all threads.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// The pieces of segments, in lists each of which has all pieces of its segments.
struct InsertedInParts {
    std::vector<std::vector<SegmentPiece>> pieces;
    bool crossed = false;  ///< whether a segment crosses a constrained edge; then some were not inserted
};

/// Inserts the segments with these indices, which ascend, as insert_uncrossed_segments() does. Where they cross many
/// triangles and lines between them divide them evenly, the parts of the plane are worked on at the same time; the
/// order of triangles depends on the parts and not on threads. Preconditions: `tris` is closed by ghosts, and the ends
/// of segments are among the points.
InsertedInParts insert_in_parts(std::span<const Point> points, std::span<const Segment> segments,
                                std::span<const Index> which, Tris& tris, std::vector<Index>& at_vertex);

}  // namespace lamina::delaunay::pieces
