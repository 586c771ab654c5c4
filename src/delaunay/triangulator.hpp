// Plain and constrained triangulation on the kernel's own triangles; the public calls of delaunay.hpp and refinement
// are built on these.
#pragma once

#include <span>
#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/export.hpp>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// The Delaunay triangulation of distinct points, closed by ghost triangles; empty where all points are on one line.
/// Throws InputError for duplicates and coordinates outside the exact range.
LAMINA_EXPORT Tris triangulate_points(std::span<const Point> points);

/// A triangulation whose vertices are numbered in the order of their insertion, from 1 on.
struct OrderedTriangulation {
    std::vector<Point> vertices;   ///< none at 0
    Tris tris;                     ///< closed by ghosts; empty where all points are on one line
    std::vector<Index> at_vertex;  ///< a triangle at each vertex
};
/// The same for those points that `order` names, in this order: as insertion_order() would have them. Where the first
/// three are on one line the third and another one change places. Vertex i + 1 is points[order[i]].
/// Precondition: coordinates in the exact range, no more points than a triangulation numbers.
OrderedTriangulation triangulate_in_order(std::span<const Point> points, std::vector<Index>& order);

/// Throws InputError for segments that do not join two of the points, and for any where there are no triangles.
void check_segments(std::span<const Point> points, std::span<const Segment> segments, const Tris& tris);

/// What became of a segment: an edge of the triangulation, directed as the segment is.
struct SegmentPiece {
    Segment segment;
    Index parent;  ///< index of the segment
};

/// Makes every segment a chain of fixed edges, split where it runs through vertices, keeping the constrained Delaunay
/// property (with the tie rule). The pieces come in the order of the segments, each chain from a to b; overlapping
/// segments give equal pieces. Throws InputError where segments cross, naming both.
std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris);

/// The same, with a triangle at each vertex handed in and kept up to date.
std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris, std::vector<Index>& at_vertex);

/// The same for segments that run through no vertex; throws InputError where one does.
LAMINA_EXPORT void insert_segments(std::span<const Point> points, std::span<const Segment> segments, Tris& tris);

/// A triangle at each vertex (any one), no_index for vertices without.
std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count);

/// The link of directed edge a -> b seen from its left triangle, found by turning round a; border() if there is none.
/// Returned as (triangle on the left, its edge).
Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b);

/// Marks of triangles: 1 = kept. Ghosts are never kept.
using Marks = std::vector<char>;

/// What can be reached from the left of a segment without crossing a fixed edge. Precondition: segments are edges.
Marks mark_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count);
/// What cannot be reached from the outside of the hull without crossing a fixed edge.
Marks mark_inside_segments(const Tris& tris);
Marks mark_all(const Tris& tris);
/// Unmarks what can be reached from each seed without crossing a fixed edge; seeds outside the hull have no effect.
/// Throws InputError for seeds on vertices or fixed edges.
void carve_holes(std::span<const Point> points, std::span<const Point> seeds, const Tris& tris, Marks& marks);
/// The marked triangles in ascending order of the old indices; links across their rim become borders.
Tris keep_marked(const Tris& tris, const Marks& marks);
/// Inserts the segments, as insert_and_split_segments() does, and marks the region on their left, which they bound all
/// round; vertices of the triangulation by their numbers.
Marks mark_region(OrderedTriangulation& triangulation, std::span<const Segment> border);
LAMINA_EXPORT Tris keep_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count);

/// Everything but the ghosts.
Triangulation without_ghosts(const Tris& tris);

}  // namespace lamina::delaunay
