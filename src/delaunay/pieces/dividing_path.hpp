// Paths of Delaunay edges that divide a set of points.
#pragma once

#include <vector>

#include "delaunay/pieces/subdomain.hpp"

namespace lamina::delaunay::pieces {

/// The path of edges of the points' Delaunay triangulation (by the one tie rule) between the triangles whose centres
/// lie on the two sides of a cut, low points on its left; from the lowest to the highest coordinate along the cut. The
/// cut holds the coordinate `axis` of the point at this place in that coordinate's order. A point that is not on the
/// path lies on the side of the path that it has by the cut. O(points), and O(sqrt(points) log(points)).
std::vector<Index> dividing_path(const SortedPoints& sorted, const Subdomain& points, Axis axis, std::size_t place);

}  // namespace lamina::delaunay::pieces
