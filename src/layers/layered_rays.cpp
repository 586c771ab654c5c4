// Fronts, columns and numbers of layers found anew for a set of rays.
#include "layers/layered_rays.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "layers/counts.hpp"
#include "layers/end_spacings.hpp"
#include "layers/heights.hpp"
#include "layers/neighbours.hpp"
#include "layers/stages.hpp"
#include "layers/truncation.hpp"

namespace lamina::layers {

namespace {

/// Returns the largest heights along the rays, at most those asked for and the limits, that rise by no more than a slope.
std::vector<double> bounded_heights(const Rays& rays) {
    std::vector<double> heights(rays.asked);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = std::min(heights[i], rays.limits[i]);
    // A requested number of layers is kept on every ray where nothing is in the way of any.
    if (!rays.growth.layers || heights != rays.asked) bound_slopes(rays.set, heights);
    return heights;
}

}  // namespace

LayeredRays layered_rays(const Rays& rays) { return {rays.set, rays.heights, rays.counts}; }

void measure_room(Rays& rays) {
    set_slants(rays.set);
    rays.asked = asked_heights(rays.set, rays.growth);
    rays.limits = height_limits(rays.set, rays.asked);
    rays.front = bounded_heights(rays);
}

bool replace_rays(RaySet changed, Rays& rays) {
    if (changed.lines.size() == rays.set.lines.size()) return false;
    rays.set = std::move(changed);
    measure_room(rays);
    return true;
}

std::vector<double> front_heights(const Rays& rays) {
    std::vector<double> front = bounded_heights(rays);
    // Lowered limits take no first layer away from rays beside.
    const std::vector<double> first = first_heights_along(rays.set, rays.growth);
    for (std::size_t i = 0; i < front.size(); ++i)
        front[i] = std::min(std::max(front[i], std::min(first[i], rays.limits[i])), rays.asked[i]);
    return front;
}

void fit_and_count_layers(Rays& rays) {
    rays.front = front_heights(rays);
    rays.heights = columns_up_to(rays.set, rays.growth, rays.asked, rays.front);
    rays.counts = layer_counts(rays.set, rays.heights);
    fit_end_spacings(rays);
}

}  // namespace lamina::layers
