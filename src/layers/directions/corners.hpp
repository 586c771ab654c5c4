// Sharp concave corners of walls, which have no rays of their own.
#pragma once

#include <vector>

#include "layers/growth.hpp"
#include "layers/stages.hpp"
#include "layers/wake/wake_outline.hpp"

namespace lamina::layers {

/// Takes those vertices out of an outline that are concave corners of 60 degrees or less, with the vertices beside them
/// between which no first layer of this height fits, and gives them to the vertex before (RayVertex::corner_after).
/// Corners stay where they are too near to each other, and so does the first vertex of the outline.
void leave_out_sharp_corners(double first_height, std::vector<RayVertex>& outline);

// Rays that lean out of corners keep the first height above both edges.

/// Sets the shifts of rays at corners (RayLine::shift), where there is room: those of the one ray of a vertex whose
/// first layer would be higher above one of the edges there than above the other, or higher above both than it may be
/// (max_slant).
void shift_rays_of_corners(const LayerGrowth& growth, RaySet& set);

/// Returns the largest lean of the one ray of a vertex, in radians, at which its first layer needs no shift or has
/// room for it. `turning` is that of the vertex, in radians; shorter_edge: length of the shorter one of its
/// edges.
double max_lean_between_edges(double turning, double first_height, double shorter_edge);

}  // namespace lamina::layers
