// The order in which the points of a leaf are inserted.
#pragma once

#include <vector>

#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// Returns all points of a piece in biased randomised insertion order: random rounds that grow by a factor of four,
/// each of which runs up and down through upright strips. It does for sorted points what brio_order() (brio.hpp) does
/// for points in any order, in linear time. Where paths are long, points are on lines or circles: there strips would
/// run to and fro between these, and brio_order() makes the order.
std::vector<Index> leaf_brio(const SortedPoints& sorted, const Piece& leaf);

}  // namespace lamina::delaunay::pieces
