// Resolution of crossing segments: new points at the crossings make them planar.
#pragma once

#include <span>
#include <vector>

#include "delaunay/insert_segments.hpp"

namespace lamina::delaunay {

/// Segments split into pieces that meet in end points only, or are equal.
struct PlanarSegments {
    std::vector<Point> steiner_points;  ///< the crossings, numbered behind the points of the input
    std::vector<SegmentPiece> pieces;   ///< in the order of the segments, each chain from a to b; pieces may repeat
};

/// Splits segments at the points on them and at their crossings. A crossing is rounded to doubles, or is the vertex
/// that stands there. Rounding bends the pieces, which may then cross anew, so this is repeated until none do. The
/// Steiner points depend on neither the order nor the direction of the segments. Throws InputError if crossings remain
/// after many rounds. Precondition: each segment joins two different points.
PlanarSegments planarize(std::span<const Point> points, std::span<const Segment> segments);

}  // namespace lamina::delaunay
