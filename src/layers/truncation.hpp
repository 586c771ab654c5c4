// How far each ray may go before it meets something.
#pragma once

#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Returns the height up to which each ray is free; infinite where nothing is in the way up to the height of all its
/// layers. Rays end at a fraction of the way to what they would meet, early enough that opposing fronts leave room
/// between them, and limits vary smoothly along the walls.
/// Source: thesis 3.2, generalised to all rays against all rays and walls (design 2).
std::vector<double> height_limits(const RaySet& set, const LayerHeights& heights);

}  // namespace lamina::layers
