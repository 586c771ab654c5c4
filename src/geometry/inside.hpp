// Whether a point is inside an outline.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/point.hpp>
#include <lamina/predicates.hpp>

namespace lamina::geometry {

/// Returns whether p lies inside an outline, by the parity of its crossings with the ray from p towards +x. Exact.
/// Precondition: p is not on the outline.
inline bool contains(std::span<const Point> outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0, n = outline.size(); i < n; ++i) {
        const Point a = outline[i], b = outline[(i + 1) % n];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if ((orient2d(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

}  // namespace lamina::geometry
