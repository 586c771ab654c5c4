// Every decomposition begins with the piece that holds all points.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/triangulation.hpp>

#include "core/busy_times.hpp"
#include "delaunay/pieces/piece.hpp"
#include "delaunay/pieces/sorted_points.hpp"

namespace lamina::delaunay::pieces {

/// Returns the points in both orders. Returns nothing where all points are to be triangulated at once: because they are
/// few, or because that triangulation names the defects of the input.
std::optional<SortedPoints> sort_for_cuts(std::span<const Point> points, const DecompositionOptions& options,
                                          core::BusyTimes* times = nullptr);

/// Returns whether a sample of the points says that no cut of their hull would be good: where points lie on few lines
/// or circles, many are on the hull, or paths run from point to point along them. To find this out with all points
/// would take half as long as to triangulate them.
bool is_beyond_cuts(std::span<const Point> points, const DecompositionOptions& options);

/// Returns the piece of all points inside a border. Takes sorted.by_y.
Piece whole_region(SortedPoints& sorted, std::vector<BorderEdge> border);

/// Returns the decomposition that triangulate() chooses for this number of points: small sets stay in one piece.
DecompositionOptions default_decomposition(std::size_t points);

/// Adds the numbers of one part of a decomposition to those of another.
void add(DecompositionStats& sum, const DecompositionStats& stats);

}  // namespace lamina::delaunay::pieces
