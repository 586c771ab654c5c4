// Points in the two orders that a decomposition cuts.
#pragma once

#include <optional>
#include <span>

#include <lamina/point.hpp>

#include "core/busy_times.hpp"
#include "core/uninitialized.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay::pieces {

/// Kinds of work that core::BusyTimes tells apart.
enum PieceWork : std::size_t { cutting, triangulating };

/// Points sorted by x, then by y. The decomposition knows every point by its number, the place in this order: the
/// smaller number belongs to the lexicographically smaller point, and ties go to the smallest (docs/decisions/0001).
struct SortedPoints {
    core::UninitializedArray<Point> points;
    core::UninitializedArray<Index> original;  ///< for each point its index in the input
    core::UninitializedArray<Index> by_y;      ///< the numbers of all points sorted by y, then by x
    core::UninitializedArray<Index> y_rank;    ///< for each point its place in by_y
};

/// Sorts the points on all threads. Returns nothing where two points coincide or one lies outside the exact range.
/// O(n log n), linear for points that are spread evenly.
std::optional<SortedPoints> sort_points(std::span<const Point> points, core::BusyTimes* times = nullptr);

}  // namespace lamina::delaunay::pieces
