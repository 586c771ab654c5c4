// The order in which points enter a plain Delaunay triangulation.
#pragma once

#include <span>
#include <vector>

#include "kernel/triangles.hpp"

namespace lamina::kernel {

/// Biased randomised insertion order: rounds that grow by a factor of four, each sorted along a Hilbert curve.
/// A permutation of the indices of `points`, whose box is given; depends on the points alone.
std::vector<Index> insertion_order(std::span<const Point> points, const Box& box);

}  // namespace lamina::kernel
