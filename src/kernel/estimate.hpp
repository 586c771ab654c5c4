// How many triangles refinement will make, before it runs.
#pragma once

#include <span>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

#include "kernel/triangles.hpp"

namespace lamina::kernel {

/// From an area and the mean of 1 / h^2 over it.
double estimated_triangles(double area, double mean_inverse_square_size);

/// From a triangulation of the region.
double estimate_triangles(std::span<const Point> points, const Tris& tris, const SizeField& size);

/// The same for the region left of `segments`.
double estimate_triangles(std::span<const Point> points, std::span<const Segment> segments, const SizeField& size);

}  // namespace lamina::kernel
