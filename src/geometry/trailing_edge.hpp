// The trailing edge of an outline.
#pragma once

#include <cstddef>
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

/// The vertices of a counter-clockwise outline at its trailing edge: where its upper side starts, and where its lower
/// one ends. They are one where the trailing edge is no base.
struct TailCorners {
    std::size_t upper, lower;
};

/// Returns the corners of the trailing edge of an outline with these features, which may have a base that it is not.
TailCorners tail_corners(std::span<const Point> outline, const OutlineFeatures& features);

/// Returns the vertex of an outline that is farthest from a point.
std::size_t farthest_vertex(std::span<const Point> outline, Point p);

}  // namespace lamina::geometry
