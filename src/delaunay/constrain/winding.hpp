// Selection of triangles by how often segments wind round them.
#pragma once

#include <span>
#include <vector>

#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"

namespace lamina::delaunay {

/// Which numbers of turns select a triangle.
enum class WindingRule { even_odd, non_zero };

/// Throws InputError unless the segments form closed loops: as many end at each point as start there or, for the
/// even-odd rule, an even number meets there.
void check_closed_loops(std::span<const Segment> segments, std::size_t point_count, WindingRule rule);

/// Selects triangles, but no ghosts, by the turns of the pieces round them. Precondition: the segments that the pieces
/// are parts of form closed loops.
TriangleSelection select_by_winding(const std::vector<SegmentPiece>& pieces, const Tris& tris, std::size_t point_count,
                                    WindingRule rule);

}  // namespace lamina::delaunay
