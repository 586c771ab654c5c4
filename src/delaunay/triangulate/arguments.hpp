// Checks of the arguments of triangulation and refinement.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/triangulation.hpp>

namespace lamina::delaunay {

/// Throws InputError for more points than one triangulation can number, and for coordinates outside the exact range.
void check_points(std::span<const Point> points);

/// Throws InputError as check_points() does, and for segments whose ends are not both among the points.
void check_points_and_segments(std::span<const Point> points, std::span<const Segment> segments);

/// Throws InputError for triangles that are not counter-clockwise. Precondition: their corners are among the points.
void require_counter_clockwise(std::span<const Point> points, std::span<const Triangle> triangles);

/// Returns the segments between the points that stand for their ends.
std::vector<Segment> segments_between(std::span<const std::uint32_t> stand_in, std::span<const Segment> segments);

}  // namespace lamina::delaunay
