// Heights that columns reach at least.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns, for each ray, the height at its origin, linear along the chain of its element: that of the nearest point of
/// the chain; 0 on elements without one. Returns nothing for no heights.
std::vector<double> least_heights(const RaySet& set, std::span<const WallHeight> heights);

/// Lowers the spacings of a column to at most max_spacing. heights[0] = 0 is the wall.
void limit_spacings(double max_spacing, std::span<double> heights);

}  // namespace lamina::layers
