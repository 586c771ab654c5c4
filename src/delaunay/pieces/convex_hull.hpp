// The convex hull of sorted points.
#pragma once

#include <vector>

#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// Returns the convex hull of the points, counter-clockwise. Points on its edges are vertices, too. Returns nothing
/// where all points lie on one line. O(points), on all threads.
std::vector<BorderEdge> convex_hull(const SortedPoints& sorted);

}  // namespace lamina::delaunay::pieces
