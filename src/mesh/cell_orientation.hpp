// The orientation of quadrilaterals, exactly.
#pragma once

#include <algorithm>

#include <lamina/point.hpp>

#include "core/predicates.hpp"

namespace lamina::mesh {

/// Returns a number that is > 0 for a counter-clockwise quad and 0 for a flat one. A quad is simple and
/// counter-clockwise if one of its diagonals splits it in two counter-clockwise triangles.
inline double quad_orientation(const Point* p) {
    using core::inline_orient2d;
    return std::max(std::min(inline_orient2d(p[0], p[1], p[2]), inline_orient2d(p[0], p[2], p[3])),
                    std::min(inline_orient2d(p[0], p[1], p[3]), inline_orient2d(p[1], p[2], p[3])));
}

}  // namespace lamina::mesh
