// The rays of all bodies together with the number of layers on each; internal to the layer stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layers/rays.hpp"

namespace lamina {

/// Rays of all bodies one after the other; body e owns [begin[e], begin[e + 1]), closed in itself.
struct RaySet {
    std::vector<RayLine> rays;
    std::vector<std::size_t> begin{0};

    std::size_t bodies() const { return begin.size() - 1; }
};

/// Height up to which each ray is free, infinite where nothing is in the way up to full_height. Rays end at a fraction
/// of the way to what they would meet, early enough that opposing fronts leave room between them, and limits vary
/// smoothly along the walls.
/// Source: thesis 3.2, generalised to all rays against all rays and walls (design 2).
std::vector<double> height_limits(const RaySet& set, double full_height);

/// Number of layers on each ray: as many as fit below its limit, lowered until neighbours differ by at most one, every
/// cell between neighbouring rays is positively oriented, and the outer borders are simple, disjoint from each other
/// and from the walls (but for rays without layers). heights[n] is the height of layer n, heights[0] = 0.
std::vector<std::uint32_t> layer_counts(const RaySet& set, std::span<const double> limits,
                                        std::span<const double> heights);

}  // namespace lamina
