// The shapes of runs of points: closed loops, single surfaces, pairs of surfaces. All criteria are ratios of lengths,
// so that they hold for rotated and scaled sections, too.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// Returns whether the ends of a run lie so near to each other that closing it makes a body. A surface from the leading
/// to the trailing edge is none.
bool is_loop(PointSpan points);

/// Returns whether one edge runs along the whole closing edge from the last point back to the first, the other way: the
/// other long side of a plate, whose file begins and ends at two of its corners.
bool is_side_of_plate(std::span<const SourcePoint> points);

/// Returns whether two runs have both ends in common, at least about, and run the same way, as the upper and the lower
/// surface do.
bool are_two_surfaces(PointSpan a, PointSpan b);

/// Returns the same where the larger extent of the two runs is known.
bool are_two_surfaces(PointSpan a, PointSpan b, double size);

/// Returns one run over the upper surface from its end to its start, then over the lower surface. A first point that
/// both have in common appears once.
std::vector<SourcePoint> join_surfaces(PointSpan upper, PointSpan lower);

/// Returns where the second surface begins in a run of two surfaces one behind the other; empty for other runs.
std::optional<std::size_t> find_second_surface(PointSpan points);

}  // namespace lamina::geometry
