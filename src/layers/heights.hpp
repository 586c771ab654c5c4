// The heights of the requested layers on each ray.
#pragma once

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns the height of all requested layers over a wall whose vertices lie `spacing` apart. It is an estimate where
/// the number of layers or the growth depends on the spacing.
double expected_height(const LayerGrowth& growth, double spacing);

/// Returns the heights of the requested layers on each ray. Throws OptionError where more than 1000 layers would be
/// needed up to isotropy.
LayerHeights make_heights(const RaySet& set, const LayerGrowth& growth);

}  // namespace lamina::layers
