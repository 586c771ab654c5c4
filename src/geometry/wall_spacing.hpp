// Spacings that stages after reading ask of the walls.
#pragma once

#include <cstddef>

#include <lamina/point.hpp>

namespace lamina::geometry {

/// A stretch of the wall of an element, with the largest spacing of its vertices there.
struct WallSpacing {
    std::size_t element;  ///< index in Geometry::elements
    Point a;              ///< one end of the stretch, on the wall or near to it
    Point b;              ///< the other end
    double spacing;       ///< in units of the input
};

}  // namespace lamina::geometry
