// Plain and constrained triangulation on the kernel's own triangles; the public calls of delaunay.hpp and refinement
// are built on these.
#pragma once

#include <span>
#include <vector>

#include <lamina/delaunay.hpp>

#include "kernel/triangles.hpp"

namespace lamina::kernel {

/// The Delaunay triangulation of distinct points, closed by ghost triangles; empty where all points are on one line.
/// Throws InputError for duplicates and coordinates outside the exact range.
Tris triangulate_points(std::span<const Point> points);

/// Makes every segment a fixed edge, keeping the constrained Delaunay property (with the tie rule).
/// Throws InputError where segments cross each other or pass through vertices.
void insert_segments(std::span<const Point> points, std::span<const Segment> segments, Tris& tris);

/// Keeps what can be reached from the left of a segment without crossing a fixed edge, in ascending order of the old
/// indices; the links across segments that remain on the rim become borders.
Tris keep_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count);

/// A triangle at each vertex (any one), no_index for vertices without.
std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count);

/// The link of directed edge a -> b seen from its left triangle, found by turning round a; border() if there is none.
/// Returned as (triangle on the left, its edge).
Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b);

/// Everything but the ghosts.
Triangulation without_ghosts(const Tris& tris);

}  // namespace lamina::kernel
