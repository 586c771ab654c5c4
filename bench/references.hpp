// Other programs that do the same work in the same run. Input is brought to the form of the other program when a Work
// is made, so that only the program itself is timed.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::bench {

/// A piece of work; returns how many things it made, here triangles.
using Work = std::function<std::size_t()>;

/// Calls CGAL's Delaunay_triangulation_2 with exact predicates and inexact constructions. The points are inserted as a
/// range, which CGAL sorts along a Hilbert curve.
Work cgal_delaunay(std::span<const Point> points);
/// Calls CGAL's Constrained_Delaunay_triangulation_2 with points and segments as ranges.
Work cgal_constrained(std::span<const Point> points, std::span<const Segment> segments);

/// Calls Triangle's divide-and-conquer algorithm.
Work triangle_delaunay(std::span<const Point> points);
/// Calls Triangle for a constrained triangulation.
Work triangle_constrained(std::span<const Point> points, std::span<const Segment> segments);

/// Calls CDT with points and segments, of which there may be none, in the order that it chooses itself.
Work cdt_constrained(std::span<const Point> points, std::span<const Segment> segments);

/// Calls delaunator-cpp.
Work delaunator_delaunay(std::span<const Point> points);

/// Refines with Triangle at its best: the area bound is lowered in passes (x4096, x256, x16, x1), each of which refines
/// the mesh of the one before. Called once with the final bound Triangle is 4 to 15 times slower. The border is frozen.
/// The area of a triangle is bounded by sqrt(3)/4 h^2, where h is the mean of size + gradation x over its vertices.
Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, double size, double gradation,
                     double min_angle_deg);

/// Refines the region round one hole in the same way, with the size field at the middle of each triangle.
Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, Point hole,
                     const SizeField& field, double min_angle_deg);

}  // namespace lamina::bench
