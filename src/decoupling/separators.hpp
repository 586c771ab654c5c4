// Lines between subdomains, divided into segments that follow the size field.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::decoupling {

/// Divides the line from u to v into at least `min_segments` segments, and returns the points between them, in the
/// order from u to v. Every segment has the same share of the integral of ds / h, at most frozen_share. Segments then
/// have the length of the edges that refinement makes on either side, and grow as the field does. Both directions of a
/// line give the same points.
std::vector<Point> divide_separator(Point u, Point v, const SizeField& size, std::size_t min_segments = 1);

/// Divides a curve, given by points near to each other, as a separator is divided, by the smaller size of both at a
/// point and at its copy that is moved by `to_copy`. Returns the points between its ends.
std::vector<Point> divide_curve(std::span<const Point> curve, const SizeField& size, Point to_copy,
                                std::size_t min_segments);

/// The least number of segments of a side of the far field.
inline constexpr std::size_t min_segments_of_side = 3;

/// Divides a circle into at least `min_segments` segments with equal shares of the integral of ds / h, as a separator
/// is divided, and returns the vertices counter-clockwise.
std::vector<Point> divide_circle(Point center, double radius, const SizeField& size, std::size_t min_segments);

}  // namespace lamina::decoupling
