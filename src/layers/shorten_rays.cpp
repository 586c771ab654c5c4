// Rays shortened where the layer leaves no room for good triangles beyond it.
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include <lamina/layers.hpp>

#include "core/box_tree.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

std::vector<std::size_t> shorten_rays(std::span<const Circle> places, Rays& rays) {
    constexpr double kept_share = 0.6;  // of the height
    std::vector<Box> boxes;
    boxes.reserve(places.size());
    for (const Circle& place : places) {
        const Point reach{place.radius, place.radius};
        boxes.push_back({place.middle - reach, place.middle + reach});
    }
    const core::BoxTree tree(std::move(boxes));
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::size_t> ends(places.size(), 0), shortened;
    for (std::size_t i = 0; i < rays.set.lines.size(); ++i) {
        if (rays.counts[i] == 0) continue;
        const Point tip = layered.tip(i);
        Box at_tip;
        at_tip.include(tip);
        bool near = false;
        tree.overlaps(at_tip, [&](std::size_t k) {
            if (distance(places[k].middle, tip) > places[k].radius) return;
            near = true;
            ++ends[k];
        });
        if (near) shortened.push_back(i);
    }
    if (shortened.empty()) return ends;
    for (const std::size_t i : shortened)
        rays.limits[i] = std::min(rays.limits[i], kept_share * rays.heights.of(i)[rays.counts[i]]);
    // A wake without layers on either side would be no part of the layer.
    for (std::size_t i = 0; i < rays.limits.size(); ++i)
        if (rays.set.lines[i].place == RayPlace::wake) rays.limits[i] = std::max(rays.limits[i], rays.heights.of(i)[1]);
    fit_and_count_layers(rays);
    return ends;
}

}  // namespace lamina::layers
