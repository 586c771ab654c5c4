// Points in the two orders that a decomposition cuts in.
#pragma once

#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "kernel/triangles.hpp"

namespace lamina::decomposition {

using kernel::Index;
using kernel::no_index;

/// Points by x, then y. Everything in the decomposition knows a point by its place in this order: a smaller number is a
/// lexicographically smaller point, and ties go to the smallest (docs/decisions/0001).
struct SortedPoints {
    std::vector<Point> points;
    std::vector<Index> original;  ///< for each its index in the input
    std::vector<Index> by_y;      ///< all of them by y, then x
    std::vector<Index> y_rank;    ///< for each its place in by_y
};

/// O(n log n), linear for points that are spread evenly; on all threads. Precondition: coordinates are finite.
SortedPoints sort_points(std::span<const Point> points);

/// Do two of the points coincide?
bool has_duplicates(const SortedPoints& sorted);

}  // namespace lamina::decomposition
