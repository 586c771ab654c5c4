// Lines between subdomains, divided into segments that follow the size field.
#pragma once

#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::decoupling {

/// The size field and the rule that decide the lengths of the segments of separators.
struct SeparatorSpacing {
    const SizeField& size;
    SeparatorRule rule;
};

/// Divides the line from u to v into at least `min_segments` segments, and returns the points between them, in the
/// order from u to v. Both directions of a line give the same points.
///
/// equidistributed: every segment has the same share of the integral of ds / h, at most frozen_share. Segments then
/// have the length of the edges that refinement makes on either side, and grow as the field does.
///
/// k_rule (thesis, chapter 5): with k = 1/2 sqrt(A / sqrt 2), the line is divided from the finer end u to the farthest
/// v for which some whole number of equal segments lies in [|uv| / (2 k_u), sqrt 3 |uv| / (2 k_v)], then on from v.
std::vector<Point> divide_separator(Point u, Point v, const SeparatorSpacing& spacing, std::size_t min_segments = 1);

/// Divides a circle into at least `min_segments` segments with equal shares of the integral of ds / h, as a separator
/// is divided, and returns the vertices counter-clockwise.
std::vector<Point> divide_circle(Point center, double radius, const SizeField& size, std::size_t min_segments);

}  // namespace lamina::decoupling
