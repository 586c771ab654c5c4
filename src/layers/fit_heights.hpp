// Columns of heights fitted to the space on their rays.
#pragma once

#include <span>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Multiplies the n-th spacing, n >= 0, by stretch^n. heights[0] = 0 is the wall.
void stretch_heights(double stretch, std::span<double> heights);

/// Returns the heights, where the columns of rays that are cut short are stretched. A ray is cut short if its limit is
/// below the height of all its layers. Its stretch makes a layer end at the limit, or, where that would take more than
/// max_stretch, brings the last layer below the limit next to it. limits: one height per ray.
LayerHeights fit_heights(const LayerHeights& heights, std::span<const double> limits);

}  // namespace lamina::layers
