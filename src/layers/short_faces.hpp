// Short faces: stretches of wall between a concave corner and a fan, such as the riser of a step.
#pragma once

#include <span>
#include <vector>

#include "layers/normal_smoothing.hpp"

namespace lamina::layers {

/// Returns, for each edge of an outline, the angle in radians by which the rays at its ends are to diverge: more than 0 on
/// faces that are shorter than their least heights, where columns would be too narrow; 0 elsewhere.
std::vector<double> openings_on_short_faces(std::span<const RayVertex> outline, std::span<const WallVertex> vertices);

}  // namespace lamina::layers
