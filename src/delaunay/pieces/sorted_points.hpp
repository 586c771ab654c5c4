// Points in the two orders that a decomposition cuts in.
#pragma once

#include <optional>
#include <span>

#include <lamina/point.hpp>

#include "core/busy_times.hpp"
#include "core/uninitialized.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay::pieces {

using delaunay::Index;
using delaunay::no_index;

/// Kinds of work that core::BusyTimes tells apart.
enum Work : std::size_t { cutting, triangulating };

/// Points by x, then y. Everything in the decomposition knows a point by its place in this order: a smaller number is a
/// lexicographically smaller point, and ties go to the smallest (docs/decisions/0001).
struct SortedPoints {
    core::UninitializedArray<Point> points;
    core::UninitializedArray<Index> original;  ///< for each its index in the input
    core::UninitializedArray<Index> by_y;      ///< all of them by y, then x
    core::UninitializedArray<Index> y_rank;    ///< for each its place in by_y
};

/// Nothing where two points coincide or one lies outside the exact range. O(n log n), linear for points that are spread
/// evenly; on all threads.
std::optional<SortedPoints> sort_points(std::span<const Point> points, core::BusyTimes* times = nullptr);

}  // namespace lamina::delaunay::pieces
