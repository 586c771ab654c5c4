// Sizes along wakes beside the ends of layers.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/sizing.hpp>

#include "layers/stages.hpp"

namespace lamina::pipeline {

/// Raises the sizes of sources along the wake of an element, so that where it leaves the layer none asks for triangles
/// far smaller than the last cells, by dividing the tops of cells that are as high as wide or higher. The layers of
/// other elements, which the wake may pass by, stay as fine as it asks. `gradation` is that of the layer's border
/// (BorderOptions).
void fit_wake_to_layer(const layers::Rays& rays, std::size_t element, double gradation, std::span<SizeSource> sources);

}  // namespace lamina::pipeline
