// Rays with the layers on them: their points, and the steps by which layers are found when rays change.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "layers/stages.hpp"

namespace lamina::layers {

/// A view of rays, the heights of their layers, and the number of layers on each.
struct LayeredRays {
    const RaySet& set;
    const LayerHeights& heights;
    std::span<const std::uint32_t> counts;

    /// Returns the point at the top of a layer; the ray's origin for layer 0.
    Point point(std::size_t ray, std::uint32_t layer) const {
        const RayLine& line = set.lines[ray];
        return layer == 0 ? line.origin : line.origin + (heights.of(ray)[layer] * line.direction + line.shift);
    }
    /// Returns the height of the last layer on a ray; 0 where it has none.
    double last_spacing(std::size_t ray) const {
        const std::uint32_t n = counts[ray];
        return n > 0 ? heights.of(ray)[n] - heights.of(ray)[n - 1] : 0;
    }
    /// Returns the end of a ray.
    Point tip(std::size_t ray) const { return point(ray, counts[ray]); }
};

/// Returns the rays with their columns.
LayeredRays layered_rays(const Rays& rays);

/// Finds anew what is asked for on each ray, what is in its way, and the front.
void measure_room(Rays& rays);

/// Replaces the rays by a set with fewer and finds their front anew. Returns false, and changes nothing, where the set has as
/// many.
bool replace_rays(RaySet changed, Rays& rays);

/// Returns the front: the largest heights along the rays, at most those asked for and the limits, that rise along it by no
/// more than a slope. No ray loses its first layer for its neighbours.
std::vector<double> front_heights(const Rays& rays);

/// Makes the columns up to the front, and lowers the numbers of layers where they would overlap.
void fit_and_count_layers(Rays& rays);

}  // namespace lamina::layers
