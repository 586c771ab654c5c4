// Fan spreading: rays beside fans lean towards them, so that narrow columns widen with the height.
#pragma once

#include <span>
#include <vector>

#include "layers/normal_smoothing.hpp"
#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Adds to the tilts of the vertices beside fans, and of the fans. At `heights`, one per vertex, columns become as wide
/// as the rays of the fan are apart, or as even as a bounded tilt can make them. `max_ray_angle` is that between the
/// rays of a fan, in radians. Then rays between corners lean apart where columns are narrow still. Outlines with a wake
/// remain as they are.
void spread_fans(std::span<const RayVertex> outline, std::span<const double> heights, double max_ray_angle,
                 std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
