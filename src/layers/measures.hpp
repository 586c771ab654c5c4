// Coverage: how many of the requested layers were made.
#pragma once

#include <vector>

#include <lamina/layers.hpp>

#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the coverage of each element.
std::vector<ElementCoverage> layer_coverage(const Rays& rays);

}  // namespace lamina::layers
