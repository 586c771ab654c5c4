// The search for the best cut of a strip: dynamic programming over pairs of one corner of each chain.
#include "layers/cells/strip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Sums that differ by less than this share count as equal. In cells as thin as 1e-9 of their coordinates, rounding is
/// no smaller.
constexpr double burden_rounding = 1e-6;

/// Returns what a triangle adds to the sum that cuts are compared by; infinite unless the triangle is counter-clockwise
/// (exact).
double burden_of(Point a, Point b, Point c) {
    if (!(core::inline_orient2d(a, b, c) > 0)) return HUGE_VAL;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    const double largest = std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)});
    const double burden = 1 / (1 - std::min(largest, 1.0) + burden_rounding);
    return burden * burden * burden * burden;
}

}  // namespace

bool StripCutter::cut(std::span<const VertexId> lower, std::span<const VertexId> upper, bool first_leads,
                      std::vector<Triangle>& triangles) {
    assert(!lower.empty() && !upper.empty() && lower.size() + upper.size() >= 3);
    lower_ = lower;
    upper_ = upper;
    find_burdens();
    if (std::isinf(states_.front().burden)) return false;
    for (std::size_t i = 0, j = 0; i + 1 < lower.size() || j + 1 < upper.size();) {
        const CutState& here = state(i, j);
        const double slack = burden_rounding * here.burden;
        if (first_leads ? here.via_upper <= here.via_lower + slack : here.via_upper + slack < here.via_lower) {
            triangles.push_back({{lower[i], upper[j], upper[j + 1]}});
            ++j;
        } else {
            triangles.push_back({{lower[i], upper[j], lower[i + 1]}});
            ++i;
        }
    }
    return true;
}

/// Sets the burdens of all states, from the last side to the first.
void StripCutter::find_burdens() {
    const std::size_t rows = lower_.size(), columns = upper_.size();
    const auto at = [&](VertexId v) { return points_[v.index()]; };
    states_.assign(rows * columns, {});
    for (std::size_t i = rows; i-- > 0;)
        for (std::size_t j = columns; j-- > 0;) {
            CutState& here = state(i, j);
            if (j + 1 < columns)
                here.via_upper = burden_of(at(lower_[i]), at(upper_[j]), at(upper_[j + 1])) + state(i, j + 1).burden;
            if (i + 1 < rows)
                here.via_lower = burden_of(at(lower_[i]), at(upper_[j]), at(lower_[i + 1])) + state(i + 1, j).burden;
            here.burden = std::min(here.via_upper, here.via_lower);
            if (i + 1 == rows && j + 1 == columns) here.burden = 0;
        }
}

}  // namespace lamina::layers
