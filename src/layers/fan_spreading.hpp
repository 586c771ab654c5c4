// Fan spreading: rays beside fans lean towards them, so that narrow columns widen with the height.
#pragma once

#include <span>
#include <vector>

#include "layers/normal_smoothing.hpp"
#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Adds to the tilts of the vertices beside fans, and of the fans. At `heights`, one per vertex, columns become as wide
/// as the rays of the fan are apart, or as even as a bounded tilt can make them. `max_ray_angle` is that between the
/// rays of a fan, in radians.
void spread_fans(std::span<const RayVertex> outline, std::span<const double> heights, double max_ray_angle,
                 std::vector<WallVertex>& vertices);

/// Adds to the tilts of the vertices between fans and other corners, so that columns are less narrow at `heights`, one per
/// vertex: rays lean apart where they are narrow, at the expense of wider columns between the same corners.
void widen_narrow_columns(std::span<const RayVertex> outline, std::span<const double> heights,
                          std::vector<WallVertex>& vertices);

}  // namespace lamina::layers
