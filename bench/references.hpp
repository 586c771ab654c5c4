// Other programs doing the same work in the same run. Each Work returns the number of triangles made; input is brought
// to the program's own form when the Work is made, so that only the program itself is timed.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::bench {

using Work = std::function<std::size_t()>;

/// CGAL: Delaunay_triangulation_2 with exact predicates and inexact constructions, points inserted as a range, which it
/// sorts along a Hilbert curve.
Work cgal_delaunay(std::span<const Point> points);
/// CGAL: Constrained_Delaunay_triangulation_2, points and segments as ranges.
Work cgal_constrained(std::span<const Point> points, std::span<const Segment> segments);

/// Triangle: divide and conquer.
Work triangle_delaunay(std::span<const Point> points);
Work triangle_constrained(std::span<const Point> points, std::span<const Segment> segments);

/// Triangle at its best: the area bound lowered in passes (x4096, x256, x16, x1), each refining the mesh of the one
/// before; called once with the final bound it is 4 to 15 times slower. The border is frozen. The area of a triangle is
/// bounded by sqrt(3)/4 h^2, h being the mean over its vertices of h(x) = size + gradation x.
Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, double size, double gradation,
                     double min_angle_deg);

/// The same with the size field at the middle of each triangle, in the region round one hole.
Work triangle_refine(std::span<const Point> points, std::span<const Segment> segments, Point hole,
                     const SizeField& field, double min_angle_deg);

}  // namespace lamina::bench
