// The trailing edge of an outline.
#pragma once

#include <span>
#include <vector>

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Returns the exterior angle at every vertex of a closed outline, in radians, positive where the outline turns left.
std::vector<double> turning_angles(std::span<const Point> outline);

/// Finds the base and the trailing edge of a closed counter-clockwise outline and sets them in its features.
///
/// A base is a straight rear end: two convex corners of 45 to 135 degrees with nothing but straight edges between them,
/// shorter than half of the body and in its rear half. Of several bases the rearmost counts.
void find_trailing_edge(std::span<const Point> outline, OutlineFeatures& features);

}  // namespace lamina::geometry
