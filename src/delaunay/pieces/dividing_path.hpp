// Paths of Delaunay edges that divide a set of points.
#pragma once

#include <vector>

#include "delaunay/pieces/cut_line.hpp"
#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// Returns the dividing path of a cut: the path of edges of the points' Delaunay triangulation (by the one tie rule)
/// between the triangles whose centres lie on the two sides of the cut line. The line runs through the point that
/// stands at `place` in the piece's order by `axis`. The path goes from the lowest to the highest coordinate along the
/// line, with low points on its left. A point that is not on the path lies on the same side of the path as of the line.
/// O(points), of which O(sqrt(points)) are sorted.
std::vector<Index> dividing_path(const SortedPoints& sorted, const Piece& piece, Axis axis, std::size_t place);

}  // namespace lamina::delaunay::pieces
