// Isotropy: where the cells of the layer become as high as wide.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns, for each ray, the height at which the spacing of the layers reaches the distance of the rays there, or the
/// height of all layers where none does; the height of one layer at least. It varies smoothly along the walls.
/// heights[n] is the height of layer n; heights[0] = 0. `least` holds one height per ray; the heights
/// returned are no lower, but for the rounding of kinks.
std::vector<double> heights_of_isotropy(const RaySet& set, std::span<const double> heights,
                                        std::span<const double> least);

/// Returns, for each ray, the largest height of a layer on the way to the front: some widths of a cell, but no less
/// than the first height along it.
std::vector<double> largest_spacings(const RaySet& set, std::span<const double> front,
                                     std::span<const double> first_heights, double fineness = 1);

/// Returns, for each ray, the ratio of geometric growth with which the last of `layers` spacings equals the distance of
/// the rays there, from min_adaptive_ratio to max_adaptive_ratio. It varies along the wall so slowly that heights of
/// neighbours differ by less than 30 %.
/// Source: R. V. Garimella, M. S. Shephard, Int. J. Numer. Meth. Engng 49 (2000), "adaptive" growth.
std::vector<double> ratios_to_isotropy(const RaySet& set, double first_height, std::uint32_t layers);

}  // namespace lamina::layers
