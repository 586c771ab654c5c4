// Truncation: how far each ray may go before it meets something.
#pragma once

#include <span>
#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

/// A ray may go up to this share of the way to a wall, so that opposing fronts leave a quarter of the gap free.
inline constexpr double wall_fraction = 0.375;

/// A ray may go up to this share of the height at which it crosses another ray, so that neighbours keep more than half
/// of their distance.
inline constexpr double ray_fraction = 0.45;
/// First layers may go beyond the limit by this factor, up to 0.75 of that height, so that walls in clefts are not bare.
/// Neighbours keep a quarter of their distance.
inline constexpr double first_layer_room = 0.75 / ray_fraction;

/// Returns the limit of each ray: the height up to which it is free, infinite where nothing is in its way up to the
/// asked height of its layers. A limit is a fraction of the way to what the ray would meet, small enough that opposing
/// fronts leave space between them.
/// Source: thesis 3.2, generalised to all rays against all rays and walls.
std::vector<double> height_limits(const RaySet& set, std::span<const double> asked);

}  // namespace lamina::layers
