// The search for the best cut of a strip: dynamic programming over pairs of one corner of each chain. A first pass
// finds the smallest largest angle, a second one the least sum among the cuts with that angle.
#include "layers/cells/strip.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/predicates.hpp"

namespace lamina::layers {

namespace {

/// Cosines closer than this count as equal. In cells as thin as 1e-9 of their coordinates, rounding is no smaller.
constexpr double cosine_rounding = 1e-6;

/// Returns the cosine of the largest angle; -2, below all cosines, unless the triangle is counter-clockwise (exact).
double largest_angle_cosine(Point a, Point b, Point c) {
    if (!(core::inline_orient2d(a, b, c) > 0)) return -2;
    const Point ab = b - a, bc = c - b, ca = a - c;
    const double l = length(ab), m = length(bc), n = length(ca);
    return std::max(-1.0, -std::max({dot(ab, bc) / (l * m), dot(bc, ca) / (m * n), dot(ca, ab) / (n * l)}));
}

/// Returns what a triangle with this cosine of its largest angle adds to the sum that cuts are compared by: 1 for a
/// right angle, always finite.
double burden(double cosine) { return 1 / (1 + cosine + cosine_rounding); }

}  // namespace

bool StripCutter::cut(std::span<const VertexId> lower, std::span<const VertexId> upper, bool first_leads,
                      std::vector<Triangle>& triangles) {
    assert(!lower.empty() && !upper.empty() && lower.size() + upper.size() >= 3);
    lower_ = lower;
    upper_ = upper;
    const double min_cosine = find_min_cosine();
    if (min_cosine < -1) return false;
    min_cosine_ = min_cosine - cosine_rounding;
    find_burdens();
    for (std::size_t i = 0, j = 0; i + 1 < lower.size() || j + 1 < upper.size();) {
        const double via_upper = burden_via_upper(i, j), via_lower = burden_via_lower(i, j);
        const double slack = cosine_rounding * std::min(via_upper, via_lower);
        if (first_leads ? via_upper <= via_lower + slack : via_upper + slack < via_lower) {
            // Cosines of triangles that are not counter-clockwise are below all others.
            assert(j + 1 < upper.size() && state(i, j).upper_cosine >= -1);
            triangles.push_back({{lower[i], upper[j], upper[j + 1]}});
            ++j;
        } else {
            assert(i + 1 < lower.size() && state(i, j).lower_cosine >= -1);
            triangles.push_back({{lower[i], upper[j], lower[i + 1]}});
            ++i;
        }
    }
    return true;
}

/// Sets the cosines of all states. Returns the smallest cosine of the best cut; -2 where every cut has a triangle that
/// is not positive.
double StripCutter::find_min_cosine() {
    const std::size_t rows = lower_.size(), columns = upper_.size();
    const auto at = [&](VertexId v) { return points_[v.index()]; };
    states_.assign(rows * columns, {});
    state(0, 0).min_cosine = 1;
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            CutState& here = state(i, j);
            if (j + 1 < columns) {
                here.upper_cosine = largest_angle_cosine(at(lower_[i]), at(upper_[j]), at(upper_[j + 1]));
                double& next = state(i, j + 1).min_cosine;
                next = std::max(next, std::min(here.min_cosine, here.upper_cosine));
            }
            if (i + 1 < rows) {
                here.lower_cosine = largest_angle_cosine(at(lower_[i]), at(upper_[j]), at(lower_[i + 1]));
                double& next = state(i + 1, j).min_cosine;
                next = std::max(next, std::min(here.min_cosine, here.lower_cosine));
            }
        }
    }
    return state(rows - 1, columns - 1).min_cosine;
}

/// Sets the burdens of all states, from the last side to the first.
void StripCutter::find_burdens() {
    const std::size_t columns = upper_.size();
    states_.back().burden = 0;
    for (std::size_t k = states_.size() - 1; k-- > 0;)
        states_[k].burden =
            std::min(burden_via_upper(k / columns, k % columns), burden_via_lower(k / columns, k % columns));
}

/// Returns the least burden from a state on if the next triangle stands on the upper chain; infinite where that is no
/// part of a best cut.
double StripCutter::burden_via_upper(std::size_t i, std::size_t j) const {
    if (j + 1 == upper_.size() || !(state(i, j).upper_cosine >= min_cosine_)) return HUGE_VAL;
    return burden(state(i, j).upper_cosine) + state(i, j + 1).burden;
}

/// Returns the least burden from a state on if the next triangle stands on the lower chain; infinite where that is no
/// part of a best cut.
double StripCutter::burden_via_lower(std::size_t i, std::size_t j) const {
    if (i + 1 == lower_.size() || !(state(i, j).lower_cosine >= min_cosine_)) return HUGE_VAL;
    return burden(state(i, j).lower_cosine) + state(i + 1, j).burden;
}

}  // namespace lamina::layers
