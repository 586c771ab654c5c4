// Heights, limits and numbers of layers found anew for a set of rays.
#include "layers/layered_rays.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "layers/counts.hpp"
#include "layers/fit_heights.hpp"
#include "layers/heights.hpp"
#include "layers/mechanisms.hpp"
#include "layers/taper.hpp"
#include "layers/truncation.hpp"

namespace lamina::layers {

namespace {

/// Lowers the limits of rays that have lost layers, because fronts met there, to the height that is left. Where rays
/// stand close together, numbers that differ by one from ray to ray make a cliff, whose sides are short edges of the
/// border beside very high cells. Returns whether there were any.
bool lower_limits_of_lowered_rays(Rays& rays) {
    // One layer less may be due to a neighbour alone.
    constexpr std::uint32_t least_loss = 2;
    const std::vector<double> before = rays.limits;
    bool changed = false;
    for (std::size_t i = 0; i < rays.limits.size(); ++i) {
        const std::span<const double> heights = rays.fitted.of(i);
        const auto first_above = std::upper_bound(heights.begin(), heights.end(), rays.limits[i]);
        const auto fitting = static_cast<std::uint32_t>(first_above - heights.begin()) - 1;
        if (rays.counts[i] == 0 || rays.counts[i] + least_loss > fitting) continue;
        rays.limits[i] = heights[rays.counts[i]];
        changed = true;
    }
    if (!changed) return false;
    lead_limits_over(before, rays);
    return true;
}

}  // namespace

LayeredRays layered_rays(const Rays& rays) { return {rays.set, rays.fitted, rays.counts}; }

bool replace_rays(RaySet changed, Rays& rays) {
    if (changed.lines.size() == rays.set.lines.size()) return false;
    rays.set = std::move(changed);
    rays.heights = make_heights(rays.set, rays.growth);
    rays.limits = height_limits(rays.set, rays.heights);
    return true;
}

void lead_limits_over(std::span<const double> before, Rays& rays) {
    smooth_limits(rays.set, rays.heights, rays.limits);
    for (std::size_t i = 0; i < rays.limits.size(); ++i)
        if (const std::span<const double> heights = rays.heights.of(i); heights.size() > 1)
            rays.limits[i] = std::max(rays.limits[i], std::min(before[i], heights[1]));
}

void fit_and_count_layers(Rays& rays) {
    constexpr int max_rounds = 3;
    for (int round = 0;; ++round) {
        rays.fitted = fit_heights(rays.set, rays.heights, rays.limits);
        // A whole column that was stretched for one layer less has no room for that layer any more.
        for (std::size_t i = 0; i < rays.limits.size(); ++i)
            if (rays.fitted.column(i).stretch.factor != 1)
                rays.limits[i] = std::min(rays.limits[i], rays.heights.full_height(i));
        rays.counts = layer_counts(rays.set, rays.limits, rays.fitted);
        if (round == max_rounds || !uses("limits_of_lowered") || !lower_limits_of_lowered_rays(rays)) break;
    }
    taper_columns(rays);
}

}  // namespace lamina::layers
