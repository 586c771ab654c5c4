// Where the cells of the layer become as high as wide; internal to the layer stage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Bounds of the adaptive law's ratio.
inline constexpr double min_adaptive_ratio = 1.05, max_adaptive_ratio = 1.5;

/// Number of layers on each ray up to the first that is as high as the rays stand apart there, or as many as the table
/// has. heights[n] is the height of layer n, heights[0] = 0. Neighbours differ by at most one.
std::vector<std::uint32_t> layers_up_to_isotropy(const RaySet& set, std::span<const double> heights);

/// The ratio of geometric growth, 1.05 to 1.5, with which the last of `layers` layers on each ray is as high as the
/// rays stand apart there. Varies along the wall so slowly that heights of neighbours differ by less than 30 %.
/// Source: R. V. Garimella, M. S. Shephard, Int. J. Numer. Meth. Engng 49 (2000), "adaptive" growth.
std::vector<double> ratios_to_isotropy(const RaySet& set, double first_height, std::uint32_t layers);

}  // namespace lamina::layers
