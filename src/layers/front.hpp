// How far the layers go on each ray; internal to the layer stage.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layers/heights.hpp"
#include "layers/rays.hpp"

namespace lamina {

/// Height up to which each ray is free, infinite where nothing is in the way up to the height of all its layers. Rays
/// end at a fraction of the way to what they would meet, early enough that opposing fronts leave room between them, and
/// limits vary smoothly along the walls.
/// Source: thesis 3.2, generalised to all rays against all rays and walls (design 2).
std::vector<double> height_limits(const RaySet& set, const Heights& heights);

/// The same rays and, on edges between rays that may carry layers up to their limits which differ in number by more
/// than one, a ray for each step: counts of neighbours differ by one at most, and coarse walls would have few layers
/// far from where there is no room.
RaySet add_rays_at_steps(const RaySet& set, const Heights& heights, std::span<const double> limits);

/// Number of layers on each ray: as many as fit below its limit, lowered until neighbours differ by at most one, every
/// cell between neighbouring rays is positively oriented, and the outer borders are simple, disjoint from each other
/// and from the walls (but for rays without layers).
std::vector<std::uint32_t> layer_counts(const RaySet& set, std::span<const double> limits, const Heights& heights);

}  // namespace lamina
