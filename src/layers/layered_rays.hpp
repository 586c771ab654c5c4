// Steps that rays go through again when further rays are added.
#pragma once

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Replaces the rays by more of them and finds heights and limits anew. Returns false, and changes nothing, where there
/// are no more rays than before.
bool take_rays(RaySet more, Rays& rays);

/// Fits the heights to the limits and counts the layers on each ray.
void count_layers(Rays& rays);

}  // namespace lamina::layers
