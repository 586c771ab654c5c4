// The order in which a leaf's points are inserted.
#pragma once

#include <vector>

#include "delaunay/pieces/subdomain.hpp"

namespace lamina::delaunay::pieces {

/// All points of the leaf in random rounds that grow by a factor of four, each a snake through upright strips: what
/// kernel::insertion_order() does, for points that are sorted already; linear.
std::vector<Index> leaf_order(const SortedPoints& sorted, const Subdomain& leaf);

}  // namespace lamina::delaunay::pieces
