// The trailing edge of an outline.
#pragma once

#include <optional>
#include <span>

#include <lamina/geometry.hpp>

namespace lamina::surface {

/// Finds a straight base at the downstream end of a closed counter-clockwise outline: two convex corners of 45 to 135
/// degrees with nothing but straight edges between them, shorter than half of the body and in its rear half. Of several
/// bases the rearmost counts. `turnings` are the exterior angles of the outline in radians.
std::optional<Base> find_base(std::span<const Point> outline, std::span<const double> turnings);

/// Finds base and trailing edge of an outline and sets them in its features.
void find_trailing_edge(std::span<const Point> outline, OutlineFeatures& features);

}  // namespace lamina::surface
