// The border of a subdomain, and what a dividing path does to it.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "delaunay/pieces/subdomain.hpp"

namespace lamina::delaunay::pieces {

/// The borders of the two parts of a region that a path divides, and which vertices of the path belong to each.
struct DividedBorder {
    std::vector<Edge> low, high;
    std::vector<char> low_has, high_has;  ///< for each vertex of the path
};

/// Trims the path to the region: what runs outside of it or along its border divides nothing, and path vertices that
/// only such pieces join belong to a part only if they are on its border (thesis 6.7). Nothing where an edge of the
/// border crosses the path or runs through one of its vertices.
/// Precondition: every point of the subdomain lies inside its border or on it.
std::optional<DividedBorder> divide_border(const SortedPoints& sorted, std::span<const Edge> border,
                                           std::span<const Index> path, Cut cut);

/// The convex hull of the points, counter-clockwise; points on its edges are vertices, too. Nothing where all points
/// lie on one line.
std::vector<Edge> convex_hull(const SortedPoints& sorted);

}  // namespace lamina::delaunay::pieces
