// The search for the best triangulation of a polygon: dynamic programming over pairs of its corners.
#include "layers/cells/polygon_cutter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Sums that differ by less than this share count as equal. In cells as thin as 1e-9 of their coordinates, rounding is
/// no smaller.
constexpr double burden_rounding = 1e-6;

/// Returns what a triangle adds to the sum that triangulations are compared by; infinite unless the triangle is
/// counter-clockwise (exact).
double burden_of(Point a, Point b, Point c) {
    if (!(core::inline_orient2d(a, b, c) > 0)) return HUGE_VAL;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    const double largest = std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)});
    const double burden = 1 / (1 - std::min(largest, 1.0) + burden_rounding);
    return burden * burden * burden * burden;
}

}  // namespace

bool PolygonCutter::cut_strip(std::span<const VertexId> corners, std::size_t side, bool first_leads,
                              std::vector<Triangle>& triangles) {
    assert(corners.size() >= 3);
    corners_ = corners;
    const std::size_t n = corners.size();
    best_.assign(n * n, {});
    for (std::size_t i = n - 1; i-- > 0;) {
        best(i, i + 1).burden = 0;
        // With a side, the base joins both: a larger j if i is on the first one, and none if it is on the second one.
        if (side > 0 && i >= side) continue;
        for (std::size_t j = std::max(i + 2, side); j < n; ++j) best(i, j) = find_best(i, j, first_leads, side > 0);
    }
    if (std::isinf(best(0, n - 1).burden)) return false;
    add_triangles(0, n - 1, triangles);
    return true;
}

/// Returns the best triangulation of the polygon of the base i-j from those of smaller ones.
PolygonCutter::Best PolygonCutter::find_best(std::size_t i, std::size_t j, bool first_leads, bool is_strip) {
    const auto at = [&](std::size_t corner) { return points_[corners_[corner].index()]; };
    Best found;
    const std::size_t step = is_strip ? std::max<std::size_t>(j - i - 2, 1) : 1;  // from i + 1 to j - 1
    for (std::size_t n = i + 1; n < j; n += step) {
        const std::size_t k = first_leads ? i + j - n : n;
        const double beside = best(i, k).burden + best(k, j).burden;
        if (!(beside < found.burden)) continue;
        const double burden = beside + burden_of(at(i), at(k), at(j));
        if (burden < (1 - burden_rounding) * found.burden) found = {burden, k};
    }
    return found;
}

/// Adds the triangles of the best triangulation of the polygon of the base i-j.
void PolygonCutter::add_triangles(std::size_t i, std::size_t j, std::vector<Triangle>& triangles) {
    if (j == i + 1) return;
    const std::size_t k = best(i, j).apex;
    triangles.push_back({{corners_[i], corners_[k], corners_[j]}});
    add_triangles(i, k, triangles);
    add_triangles(k, j, triangles);
}

}  // namespace lamina::layers
