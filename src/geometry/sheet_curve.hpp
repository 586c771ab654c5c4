// Open curves beside each other.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <lamina/point.hpp>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"

namespace lamina::geometry {

/// Returns a tree over the edges of a curve; those of a closed one include that from its last point to the first.
inline core::BoxTree tree_of_curve(std::span<const Point> curve, bool closed) {
    std::vector<Box> boxes;
    const std::size_t n = curve.size();
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i)
        boxes.push_back(core::bounding_box(curve[i], curve[(i + 1) % n]));
    return core::BoxTree(std::move(boxes));
}

inline double curve_length(std::span<const Point> curve) {
    double total = 0;
    for (std::size_t i = 0; i + 1 < curve.size(); ++i) total += distance(curve[i], curve[i + 1]);
    return total;
}

/// Returns the left unit normal of a curve at a point, lengthened where the curve turns so that it leads to the curve
/// beside this one at distance 1. Precondition: the curve turns by less than 180 degrees.
inline Point left_of_curve(std::span<const Point> curve, std::size_t i) {
    const std::size_t last = curve.size() - 1;
    const Point before = perpendicular(unit(curve[i > 0 ? i : 1] - curve[i > 0 ? i - 1 : 0]));
    const Point after = perpendicular(unit(curve[i < last ? i + 1 : last] - curve[i < last ? i : last - 1]));
    return (1 / (1 + dot(before, after))) * (before + after);
}

/// Returns the points of the curve at this distance on the left of another one.
inline std::vector<Point> beside_curve(std::span<const Point> curve, double apart) {
    std::vector<Point> points;
    points.reserve(curve.size());
    for (std::size_t i = 0; i < curve.size(); ++i) points.push_back(curve[i] + apart * left_of_curve(curve, i));
    return points;
}

}  // namespace lamina::geometry
