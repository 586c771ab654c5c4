// Straight lines cut into segments that follow the size field.
#pragma once

#include <span>
#include <vector>

#include <lamina/decoupling.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina::decoupling {

/// What lines between pieces are divided by.
struct Separation {
    const SizeField& size;
    SeparatorRule rule;
};

/// Interior points of the line from u to v, in that order; at least `fewest` - 1 of them.
///
/// equidistributed: every segment gets the same share of the integral of ds / h, at most frozen_share: segments have
/// the length of the edges that refinement makes on either side, and grow as the field does.
/// k_rule: thesis ch. 5: with k = 1/2 sqrt(A / sqrt 2), from the finer end u the farthest v with an integer number of
/// equal segments in [|uv| / (2 k_u), sqrt 3 |uv| / (2 k_v)], then on from v.
/// Both directions of a line give the same points.
std::vector<Point> separate(Point u, Point v, const Separation& separation, std::size_t fewest = 1);

/// Vertices of a closed circle, counter-clockwise, equidistributed in the same way; at least `fewest` of them.
std::vector<Point> divide_circle(Point center, double radius, const SizeField& size, std::size_t fewest);

}  // namespace lamina::decoupling
