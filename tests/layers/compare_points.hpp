// Sets of points compared without regard to their order.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::test {

/// Returns the points in lexicographical order.
inline std::vector<Point> sorted(std::vector<Point> points) {
    std::sort(points.begin(), points.end(), lexicographically_less);
    return points;
}

/// Returns the points mirrored in the x axis, in lexicographical order.
inline std::vector<Point> sorted_mirror(std::vector<Point> points) {
    for (Point& p : points) p.y = -p.y;
    return sorted(std::move(points));
}

/// Returns the largest distance from a point of the first set to the nearest of the second; infinite where that is not
/// within 1e-9 in x. The second set is sorted.
inline double set_distance(const std::vector<Point>& points, const std::vector<Point>& others) {
    double max_distance = 0;
    for (Point p : points) {
        auto at = std::lower_bound(others.begin(), others.end(), Point{p.x - 1e-9, -HUGE_VAL}, lexicographically_less);
        double nearest = HUGE_VAL;
        for (; at != others.end() && at->x <= p.x + 1e-9; ++at) nearest = std::min(nearest, distance(p, *at));
        max_distance = std::max(max_distance, nearest);
    }
    return max_distance;
}

}  // namespace lamina::test
