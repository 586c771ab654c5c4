// Truncation: how far each ray may go before it meets something.
#pragma once

#include <span>
#include <vector>

#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the limit of each ray: the height up to which it is free, infinite where nothing is in its way up to the
/// asked height of its layers. A limit is a fraction of the way to what the ray would meet, small enough that opposing
/// fronts leave space between them.
/// Source: thesis 3.2, generalised to all rays against all rays and walls.
std::vector<double> height_limits(const RaySet& set, std::span<const double> asked);

/// Returns the limit of each ray by walls alone, infinite where it meets none up to the asked height over
/// wall_fraction. The search takes time in proportion to the asked heights over the spacing of the walls.
std::vector<double> wall_limits(const RaySet& set, std::span<const double> asked);

}  // namespace lamina::layers
