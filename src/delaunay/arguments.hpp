// Checks of the arguments of triangulation and refinement.
#pragma once

#include <span>

#include <lamina/triangulation.hpp>

namespace lamina::delaunay {

/// Throws InputError for more points than one triangulation can number, and for coordinates outside the exact range.
void check_points(std::span<const Point> points);

/// Throws InputError as check_points() does, and for segments whose ends are not both among the points.
void check_points_and_segments(std::span<const Point> points, std::span<const Segment> segments);

/// Throws InputError for triangles that are not counter-clockwise. Precondition: their corners are among the points.
void require_counter_clockwise(std::span<const Point> points, std::span<const Triangle> triangles);

}  // namespace lamina::delaunay
