// Insertion of segments as constrained edges into a triangulation.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangulate/reach.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Throws InputError for a segment whose ends are not both among the points, and for a segment between two different
/// ones if there are no triangles.
void check_segments(std::span<const Point> points, std::span<const Segment> segments, const Tris& tris);

/// A part of a segment that is one edge of the triangulation, directed as the segment is.
struct SegmentPiece {
    Segment segment;
    Index parent;          ///< index of the whole segment
    bool repeats = false;  ///< whether the edge was constrained before, as a part of an earlier segment
};

/// Makes every segment a chain of constrained edges, split where it runs through vertices, and keeps the constrained
/// Delaunay property by the tie rule. Returns the pieces in the order of the segments, each chain from a to b;
/// overlapping segments give equal pieces, and segments from a point to itself none. Throws InputError where segments
/// cross; the message names both. Precondition: `tris` is closed by ghosts.
std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris);

/// Does the same without a search of all triangles: `at_vertex` holds a triangle at each vertex, as
/// triangle_at_vertex() returns them, and is kept up to date.
std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris, std::vector<Index>& at_vertex);

/// Segments that could be inserted, and those that could not.
struct UncrossedSegments {
    std::vector<SegmentPiece> pieces;  ///< of those that cross no constrained edge
    std::vector<Index> crossing;       ///< the indices of the others, whose pieces before and behind have been inserted
    std::vector<Index> beyond;         ///< the same of those that leave the reach
};

/// Does the same, but goes on with the next segment where one crosses a constrained edge. Inserts the segments with the
/// indices in `which`, and stays within reach: several calls may change parts of one triangulation at the same time
/// (reach.hpp). Precondition: segments are as check_segments() wants them.
UncrossedSegments insert_uncrossed_segments(std::span<const Point> points, std::span<const Segment> segments,
                                            std::span<const Index> which, const Reach& reach, Tris& tris,
                                            std::vector<Index>& at_vertex);

/// Does the same with all segments, anywhere, and checks them before.
UncrossedSegments insert_uncrossed_segments(std::span<const Point> points, std::span<const Segment> segments,
                                            Tris& tris, std::vector<Index>& at_vertex);

/// The ends of a constrained edge that a segment crosses.
struct CrossedEdge {
    Index c, d;
};

/// Inserts one segment into a triangulation whose vertex at infinity has the number `ghost`, and appends its pieces.
/// Returns the first constrained edge that the segment crosses, if any; the pieces before and behind it are then in
/// place.
std::optional<CrossedEdge> insert_segment(std::span<const Point> points, Segment segment, Tris& tris,
                                          std::vector<Index>& at_vertex, Index ghost,
                                          std::vector<SegmentPiece>& pieces);

/// Makes every segment a constrained edge. Throws InputError as insert_and_split_segments() does, and where a segment
/// runs through a vertex.
LAMINA_EXPORT void insert_segments(std::span<const Point> points, std::span<const Segment> segments, Tris& tris);

}  // namespace lamina::delaunay
