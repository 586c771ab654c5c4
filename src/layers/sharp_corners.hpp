// Sharp concave corners of walls, which have no rays of their own.
#pragma once

#include <vector>

#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Takes those vertices out of an outline that are concave corners of 60 degrees or less between nearly straight walls, and gives
/// each to the vertex before it (RayVertex::corner_after). Corners stay where edges are too short or too different for a
/// first layer of this height, and so does the first vertex of the outline.
void leave_out_sharp_corners(double first_height, std::vector<RayVertex>& outline);

}  // namespace lamina::layers
