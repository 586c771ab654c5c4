// Selection of the triangles of a constrained triangulation that are kept.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

/// One flag for each triangle: 1 if it is selected, 0 if not.
using TriangleSelection = std::vector<char>;

/// Selects all triangles but the ghosts.
TriangleSelection select_all(const Tris& tris);

/// Selects the triangles that cannot be reached from outside the hull without crossing a constrained edge.
TriangleSelection select_inside_segments(const Tris& tris);

/// Selects the triangles, but no ghosts, that can be reached from the left side of a segment without crossing a
/// constrained edge. Precondition: all segments are edges of the triangulation.
TriangleSelection select_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count);

/// Inserts the segments of a border, as insert_and_split_segments() does, and selects the region on their left. The
/// border bounds the region all round. Its vertices have the numbers of the ordered triangulation.
TriangleSelection select_region(OrderedTriangulation& triangulation, std::span<const Segment> border);

/// Takes the triangles out of the selection that can be reached from a seed without crossing a constrained edge.
/// Returns the indices of the seeds that take none: those outside of the hull or in a triangle that is not selected.
/// Throws InputError for seeds on vertices or constrained edges.
std::vector<std::size_t> deselect_holes(std::span<const Point> points, std::span<const Point> seeds, const Tris& tris,
                                        TriangleSelection& selection);

/// Takes flat triangles at the hull out of the selection (ConstrainedOptions::drop_flat). Returns their number.
std::size_t deselect_flat(std::span<const Point> points, double drop_flat, const Tris& tris,
                          TriangleSelection& selection);

/// A triangle from which spread_values() starts, and its value.
struct ValueSeed {
    Index triangle;
    std::uint32_t value;
};

/// Gives each seed's value to all triangles, but no ghosts, that can be reached from it without crossing a constrained
/// edge. The first of several seeds counts. Returns the value of each triangle; no_index for those not reached.
std::vector<std::uint32_t> spread_values(const Tris& tris, std::span<const ValueSeed> seeds);

/// Returns the selected triangles in ascending order of their old indices. Links to triangles that are not selected
/// become borders.
Tris keep_selected(const Tris& tris, const TriangleSelection& selection);

/// Returns the triangles that select_left_of_segments() selects, as keep_selected() does.
LAMINA_EXPORT Tris keep_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count);

}  // namespace lamina::delaunay
