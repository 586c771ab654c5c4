// Places the points of the layer.
#pragma once

#include <vector>

#include "layers/border/close_border.hpp"
#include "layers/border/divide_borders.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the layer of these rays: the points of walls, rays and borders, in this order, and the rays. Leaves
/// coverage, growth and edges empty. `corners` and `division` belong to the same fronts.
Layer build_layer(const Rays& rays, const std::vector<std::vector<FrontCorner>>& corners,
                  const BorderDivision& division);

}  // namespace lamina::layers
