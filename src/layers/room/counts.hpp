// The number of layers on each ray.
#pragma once

#include <cstdint>
#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the number of layers on each ray: those of its column, lowered until neighbours differ by at most one, every
/// cell between neighbouring rays is positively oriented, and the fronts are simple, disjoint from each other and, except
/// at rays without layers, from the walls.
std::vector<std::uint32_t> layer_counts(const RaySet& set, const LayerHeights& heights);
/// Returns these numbers, which are at most those of the columns, lowered in the same way.
std::vector<std::uint32_t> layer_counts(const RaySet& set, const LayerHeights& heights,
                                        std::vector<std::uint32_t> counts);

}  // namespace lamina::layers
