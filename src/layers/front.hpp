// The front: the polygon through the tips of an element's rays, which becomes the outer border of its layer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// A corner of the front.
struct FrontCorner {
    std::size_t ray;       ///< whose tip it is; the last of a fan without layers
    std::uint32_t layers;  ///< number of layers on that ray; 0: the corner is the ray's origin
};

/// Rays with their layers: what a front depends on.
struct LayeredRays {
    const RaySet& set;
    const LayerHeights& heights;  ///< fitted
    std::span<const std::uint32_t> counts;

    Point tip(std::size_t ray) const {
        const RayLine& line = set.lines[ray];
        return counts[ray] == 0 ? line.origin : line.origin + heights.of(ray)[counts[ray]] * line.direction;
    }
};

/// Returns the corners of each element's front. The rays of a fan that have no layers share one corner.
std::vector<std::vector<FrontCorner>> front_corners(const LayeredRays& rays);

}  // namespace lamina::layers
