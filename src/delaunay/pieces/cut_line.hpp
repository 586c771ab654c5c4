// The straight line of a cut, and coordinates in which it stands upright.
#pragma once

#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// The coordinate that is constant along a cut line.
enum class Axis { x, y };

/// The line through the point `at` along which the coordinate `axis` is constant.
struct CutLine {
    Axis axis = Axis::x;
    Index at = no_index;
};

/// Turns the plane so that the cut line stands upright: x becomes the coordinate across the line, y the coordinate
/// along it. Low points, which come before the cut in the order across, lie on the left of the line.
struct CutFrame {
    Axis axis = Axis::x;

    Point operator()(Point p) const { return axis == Axis::x ? p : Point{p.y, -p.x}; }
};

}  // namespace lamina::delaunay::pieces
