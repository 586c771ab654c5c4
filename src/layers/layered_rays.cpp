// Heights, limits and numbers of layers found anew for a set of rays.
#include "layers/layered_rays.hpp"

#include <utility>

#include "layers/counts.hpp"
#include "layers/fit_heights.hpp"
#include "layers/heights.hpp"
#include "layers/truncation.hpp"

namespace lamina::layers {

LayeredRays layered_rays(const Rays& rays) { return {rays.set, rays.fitted, rays.counts}; }

bool replace_rays(RaySet larger, Rays& rays) {
    if (larger.lines.size() == rays.set.lines.size()) return false;
    rays.set = std::move(larger);
    rays.heights = make_heights(rays.set, rays.growth);
    rays.limits = height_limits(rays.set, rays.heights);
    return true;
}

void fit_and_count_layers(Rays& rays) {
    rays.fitted = fit_heights(rays.set, rays.heights, rays.limits);
    rays.counts = layer_counts(rays.set, rays.limits, rays.fitted);
}

}  // namespace lamina::layers
