// A search for vertices within rounding of constrained edges.
#pragma once

#include <span>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/constrain/constrained_pieces.hpp"

namespace lamina::delaunay {

/// Returns whether a piece of a segment passes a vertex within rounding, so that planarize() would lead it through that
/// vertex. May be true where rounding decides, but is not false where planarize() finds such a vertex. Takes O(n) where
/// few triangles are needles, and is the same for any number of threads. Precondition: the pieces are those of these
/// segments, and constrained edges of the triangulation, which has these points.
bool may_pass_beside_vertex(std::span<const Point> points, std::span<const Segment> segments,
                            const TriangulatedPieces& triangulated);

}  // namespace lamina::delaunay
