// Resolution of crossing segments: new points at the crossings make them planar.
#pragma once

#include <span>
#include <vector>

#include "delaunay/constrain/insert_segments.hpp"

namespace lamina::delaunay {

/// Segments split into pieces that meet in end points only, or are equal.
struct PlanarSegments {
    std::vector<Point> steiner_points;  ///< the crossings, numbered behind the points of the input
    std::vector<SegmentPiece> pieces;   ///< in the order of the segments, each chain from a to b; pieces may repeat
};

/// Splits segments at the points on them and at their crossings. A crossing is rounded to doubles, or is a vertex that
/// stands so near that both segments may run through it. Segments are also led through vertices that they pass within
/// rounding (passing_distances()), so that no slivers stand between. Rounding bends the pieces, which may then cross
/// anew, so this is repeated until none do. It always ends, and the pieces of a segment stay within max_bend() of it.
/// The Steiner points depend on neither the order nor the direction of the segments. Segments from a point to itself
/// have no pieces. Throws InputError, with two segments, where rounding would bend a segment further; in trials only
/// one of a thousand inputs whose coordinates spread over a hundred decades did. Segments are also led through vertices
/// at most `snap` away, where these stand apart from the ends of what is led through them; pieces then stay within four
/// times this distance of their segment, if that is more than max_bend().
PlanarSegments planarize(std::span<const Point> points, std::span<const Segment> segments, double snap = 0);

/// Returns how far pieces may stand from the segment a-b that they are parts of: 16 units in the last place of its
/// largest coordinate, or 4e-60 if that is more, since coordinates below 1e-60 are rounded to 0 or 1e-60.
double max_bend(Point a, Point b);

/// A piece of a segment passes a vertex within rounding where the vertex stands nearer to it than `from_edge`, and its
/// foot on the piece further from both ends than `from_ends`.
struct PassingDistances {
    double from_edge, from_ends;
};

/// Returns these distances for the segment a-b: 4 and 16 units in the last place of its largest coordinate.
PassingDistances passing_distances(Point a, Point b);

}  // namespace lamina::delaunay
