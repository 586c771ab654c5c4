// Boxes round points.
#pragma once

#include <algorithm>
#include <span>

#include <lamina/point.hpp>

namespace lamina::core {

/// Returns the box round two points.
inline Box bounding_box(Point a, Point b) {
    Box box;
    box.include(a);
    box.include(b);
    return box;
}

/// Returns the box round points, which is empty where there are none.
inline Box bounding_box(std::span<const Point> points) {
    Box box;
    for (const Point p : points) box.include(p);
    return box;
}

/// Returns the longer side of a box. Precondition: the box is not empty.
inline double longer_side(const Box& box) { return std::max(box.width(), box.height()); }

}  // namespace lamina::core
