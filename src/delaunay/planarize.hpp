// Segments that cross, made planar by points at the crossings.
#pragma once

#include <span>
#include <vector>

#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

struct PlanarSegments {
    std::vector<Point> steiner_points;  ///< numbered behind the points handed in
    std::vector<SegmentPiece> pieces;   ///< each chain from a to b, in the order of the segments; may repeat
};

/// Pieces that meet in end points only, or are equal. A crossing is rounded to doubles, or is the vertex that stands
/// there; pieces bent by rounding may cross anew, so this is repeated until none do. The points added do not depend on
/// the order or direction of the segments. Precondition: segments join two different points.
PlanarSegments planarize(std::span<const Point> points, std::span<const Segment> segments);

}  // namespace lamina::delaunay
