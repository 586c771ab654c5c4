// A piece of a decomposition: points in two orders, and the border round them.
#pragma once

#include <cstddef>
#include <vector>

#include "core/uninitialized.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// The points of a piece in the order by x or by y, as numbers into SortedPoints. The array starts uninitialised
/// because the cut that makes it writes every entry once.
using PointOrder = core::UninitializedArray<Index>;

/// An edge of a border, directed from a to b: the piece lies on its left.
struct BorderEdge {
    Index a, b;
};

/// A region with all points inside it and on its border. Its border edges are edges of the triangulation of the whole,
/// so the region is triangulated without a look at anything outside.
struct Piece {
    PointOrder by_x, by_y;
    std::vector<BorderEdge> border;
    unsigned depth = 0;       ///< number of cuts that made the piece
    bool long_paths = false;  ///< whether it was not cut because of long paths

    /// Returns the number of points.
    std::size_t size() const { return by_x.size(); }
};

}  // namespace lamina::delaunay::pieces
