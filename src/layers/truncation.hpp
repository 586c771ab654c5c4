// Truncation: how far each ray may go before it meets something.
#pragma once

#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// A ray may go up to this share of the way to a wall, so that opposing fronts leave a quarter of the gap free.
inline constexpr double wall_fraction = 0.375;

/// Returns the limit of each ray: the height up to which it is free, infinite where nothing is in its way up to the
/// height of all its layers. A limit is a fraction of the way to what the ray would meet, small enough that opposing
/// fronts leave space between them; limits vary smoothly along the walls.
/// Source: thesis 3.2, generalised to all rays against all rays and walls.
std::vector<double> height_limits(const RaySet& set, const LayerHeights& heights);

/// Bounds the slope of the limits along each wall.
void smooth_limits(const RaySet& set, const LayerHeights& heights, std::vector<double>& limits);

}  // namespace lamina::layers
