// What became of the layers asked for; internal to the layer stage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Per element, given the number of layers on each ray.
std::vector<ElementCoverage> layer_coverage(const RaySet& set, const LayerHeights& heights,
                                            std::span<const std::uint32_t> counts);

}  // namespace lamina::layers
