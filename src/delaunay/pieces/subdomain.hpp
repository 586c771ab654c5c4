// A part of a triangulation, and the line it is cut along.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/uninitialized.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// Points in one of the two orders: every entry is written once by the cut that makes it.
using Order = core::UninitializedArray<Index>;

/// Directed.
struct Edge {
    Index a, b;
};

/// A region bounded by edges of the triangulation to be, with all points inside it and on its border.
struct Subdomain {
    Order by_x, by_y;
    std::vector<Edge> border;  ///< the region on their left
    unsigned depth = 0;        ///< how many cuts made it

    std::size_t size() const { return by_x.size(); }
};

/// The coordinate that is the same all along a line.
enum class Axis { x, y };

/// Turns the plane so that a cut's line stands upright: x becomes the coordinate across it, y the one along it. Low
/// points, those before the cut in the order across, lie on its left.
struct Frame {
    Axis axis = Axis::x;
    Point operator()(Point p) const { return axis == Axis::x ? p : Point{p.y, -p.x}; }
};

/// The line through a point.
struct Cut {
    Axis axis = Axis::x;
    Index at = no_index;
};

}  // namespace lamina::delaunay::pieces
