// Sharp concave corners of walls, which have no rays of their own.
#pragma once

#include <vector>

#include "layers/wake_outline.hpp"

namespace lamina::layers {

/// Takes those vertices out of an outline that are concave corners of 60 degrees or less between nearly straight walls,
/// with the vertices beside them between which no first layer of this height fits, and gives them to the vertex before
/// (RayVertex::corner_after). Corners stay where edges on both sides are too different, or corners too near to each
/// other, and so does the first vertex of the outline.
void leave_out_sharp_corners(double first_height, std::vector<RayVertex>& outline);

}  // namespace lamina::layers
