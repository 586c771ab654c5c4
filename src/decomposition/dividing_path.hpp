// Paths of Delaunay edges that divide a set of points.
#pragma once

#include <vector>

#include "decomposition/subdomain.hpp"

namespace lamina::decomposition {

/// The path of edges of the points' Delaunay triangulation (by the one tie rule) between the triangles whose centres
/// lie on the two sides of the cut; along the cut, low points on its left. A point that is not on the path lies on the
/// side of the path that it has by the cut. From the lowest to the highest coordinate along the cut.
std::vector<Index> dividing_path(const SortedPoints& sorted, const Subdomain& points, Cut cut);

}  // namespace lamina::decomposition
