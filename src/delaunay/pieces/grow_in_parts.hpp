// Insertion of points on all threads, without cuts.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::delaunay::pieces {

/// Returns the triangles that triangulate_points() makes, but for the ghosts, in an order that depends on the points
/// and not on threads. For points on few lines or circles, which no cut divides well. Throws as triangulate_points().
std::vector<Triangle> triangulate_in_parts(std::span<const Point> points);

}  // namespace lamina::delaunay::pieces
