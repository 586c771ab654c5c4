// Coverage: how many of the requested layers were made.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns the coverage of each element. heights: of the requested layers; counts: number of layers made on each ray.
std::vector<ElementCoverage> layer_coverage(const RaySet& set, const LayerHeights& heights,
                                            std::span<const std::uint32_t> counts);

}  // namespace lamina::layers
