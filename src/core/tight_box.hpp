// The box of least area round points, in any direction.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/predicates.hpp>

namespace lamina::core {

/// Returns the corners of the convex hull of points, counter-clockwise from the lexicographically smallest one. Points
/// on its sides are left out; of points on one line the two ends remain.
/// Source: A. M. Andrew, Another efficient algorithm for convex hulls in two dimensions, Inf. Process. Lett. 9 (1979).
inline std::vector<Point> convex_hull(std::span<const Point> points) {
    std::vector<Point> sorted(points.begin(), points.end());
    std::sort(sorted.begin(), sorted.end(), lexicographically_less);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    if (sorted.size() < 3) return sorted;
    std::vector<Point> hull;
    const auto append = [&](Point p, std::size_t least) {
        while (hull.size() > least && orient2d(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const Point p : sorted) append(p, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = sorted.size() - 1; i-- > 0;) append(sorted[i], lower);
    hull.pop_back();
    return hull;
}

/// Returns the longer side of the box of least area round the points, whose sides may have any direction. It turns with
/// the points, and is that of the box along the axes for boxes along these, and nearly for slender bodies. Of boxes of
/// equal area, as round a triangle, the one with the longest side counts. 0 where there are no points.
/// Source: H. Freeman, R. Shapira, Determining the minimum-area encasing rectangle for an arbitrary closed curve,
/// Commun. ACM 18 (1975): the box has a side in common with the hull.
inline double longer_side_of_tight_box(std::span<const Point> points) {
    const std::vector<Point> hull = convex_hull(points);
    const std::size_t n = hull.size();
    if (n < 3) return n < 2 ? 0 : distance(hull[0], hull[1]);
    struct Sides {
        double width, height;
    };
    std::vector<Sides> boxes;
    double least_area = HUGE_VAL;
    // The corners that are farthest ahead, to the left and behind, as the sides are passed, go round the hull once.
    std::size_t ahead = 1, left = 1, behind = 1;
    for (std::size_t i = 0; i < n; ++i) {
        const Point along = unit(hull[(i + 1) % n] - hull[i]), across = perpendicular(along);
        const auto advance = [&](std::size_t& k, std::size_t least, Point direction) {
            k = std::max(k, least);
            while (k < i + n && dot(hull[(k + 1) % n] - hull[k % n], direction) > 0) ++k;
        };
        advance(ahead, i + 1, along);
        advance(left, ahead, across);
        advance(behind, left, -along);
        boxes.push_back({dot(hull[ahead % n] - hull[behind % n], along), dot(hull[left % n] - hull[i], across)});
        least_area = std::min(least_area, boxes.back().width * boxes.back().height);
    }
    constexpr double rounding = 1e-9;
    double longest = 0;
    for (const auto [width, height] : boxes)
        if (width * height <= (1 + rounding) * least_area) longest = std::max({longest, width, height});
    return longest;
}

}  // namespace lamina::core
