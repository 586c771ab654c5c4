// Checks of refinements that tests share.
#pragma once

#include <cmath>

#include <lamina/delaunay.hpp>

namespace lamina::test {

/// Returns whether a triangle exceeds the size bounds of refine(), h being the mean size at its vertices.
inline bool is_oversized(Point a, Point b, Point c, double h, double max_area_ratio) {
    constexpr double rounding = 1 + 1e-6;
    const double area = 0.5 * cross(b - a, c - a);
    const double circumradius = distance(a, b) * distance(b, c) * distance(c, a) / (4 * area);
    return area > rounding * max_area_ratio * equilateral_area * h * h ||
           std::sqrt(3.0) * circumradius > rounding * max_circle_ratio * h;
}

}  // namespace lamina::test
