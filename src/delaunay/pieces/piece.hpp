// A piece of a decomposition: points in two orders, and the border round them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/random.hpp"
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

/// Returns whether as many edges of a border begin as end at each vertex, by a sum of hashes. For assertions.
inline bool is_closed(std::span<const BorderEdge> border) {
    std::uint64_t sum = 0;
    for (const BorderEdge& e : border) sum += core::splitmix64(e.a) - core::splitmix64(e.b);
    return sum == 0;
}

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
