// Checks of what callers of the library hand in: numbers and indices.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::core {

/// Throws InputError, with the place, unless all coordinates are in the range of exact predicates. `kind` names one of
/// the points in the message: "hole".
void require_exact_range(std::span<const Point> points, const std::string& kind);

/// Throws InputError, with place().segments, unless both ends of all segments are among this many points.
void require_indices_below(std::size_t points, std::span<const Segment> segments);

/// Throws InputError unless the corners of all triangles are among this many points.
void require_indices_below(std::size_t points, std::span<const Triangle> triangles);

/// Throws InputError unless there are as many of one thing as expected: "3 markers for 4 points".
void require_count(std::size_t count, const std::string& things, std::size_t expected, const std::string& others);

/// Returns how messages name a segment: "segment 3 (7-8)".
std::string segment_name(std::span<const Segment> segments, std::size_t i);

}  // namespace lamina::core
