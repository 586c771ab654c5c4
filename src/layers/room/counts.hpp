// The number of layers on each ray.
#pragma once

#include <cstdint>
#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns these numbers of layers on each ray, at most those of its column, lowered until neighbours differ by at most
/// one, every cell between neighbouring rays is positively oriented, and the fronts are simple, disjoint from each
/// other and, except at rays without layers, from the walls. Numbers of which this holds stay.
std::vector<std::uint32_t> layer_counts(const RaySet& set, const LayerHeights& heights,
                                        std::vector<std::uint32_t> counts);

}  // namespace lamina::layers
