// Rays with the layers on them: their points, and the steps by which layers are found when rays change.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// Neighbouring rays: which they are, and how values on them are kept from differing too much.

/// The neighbours of each ray on its element.
struct RayNeighbours {
    std::vector<std::size_t> next, previous;  ///< indices of rays; next is counter-clockwise

    explicit RayNeighbours(const RaySet& set);
};

/// The vertices of the wall beside the origin of a ray, or the origin itself where a neighbour starts there, too.
struct WallNeighbours {
    Point before, after;
};

/// Returns the wall's vertices beside a ray between these two others.
WallNeighbours wall_neighbours(const RayLine& before, const RayLine& ray, const RayLine& after);

/// Lowers values round a closed chain until none exceeds bound(neighbour, place). Goes twice round it in both
/// directions. Precondition: the bound is never below the neighbour's own value.
template <class T, class Bound>
void lower_round(std::span<T> values, Bound bound) {
    const std::size_t n = values.size();
    const auto pass_on = [&](std::size_t from, std::size_t to) {
        values[to % n] = std::min<T>(values[to % n], bound(from % n, to % n));
    };
    for (std::size_t k = 0; k < 2 * n; ++k) pass_on(k, k + 1);
    for (std::size_t k = 2 * n; k-- > 0;) pass_on(k + 1, k);
}

/// Lowers values along each element until none exceeds bound(neighbour, ray), as lower_round() does.
template <class T, class Bound>
void lower_to_neighbours(const RaySet& set, std::vector<T>& values, Bound bound) {
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = set.begin[e];
        lower_round(std::span(values).subspan(first, set.begin[e + 1] - first),
                    [&](std::size_t from, std::size_t to) { return bound(first + from, first + to); });
    }
}

/// Lowers heights along rays until none rises above its neighbour's by more than a slope, per unit of distance between
/// their points: they become the largest heights below those given with that slope, an inf-convolution.
/// Source: L. C. Evans, Partial Differential Equations (2010), section 3.3.2 (the Hopf-Lax formula).
void bound_slopes(const RaySet& set, std::vector<double>& heights);

/// Gives the rays inside each fan values between those of its first and last ray.
void fill_fans(const RaySet& set, std::vector<double>& values);

/// Lowers numbers of layers until those of neighbouring rays differ by at most one.
void limit_count_differences(const RaySet& set, std::vector<std::uint32_t>& counts);

/// A view of rays, the heights of their layers, and the number of layers on each.
struct LayeredRays {
    const RaySet& set;
    const LayerHeights& heights;
    std::span<const std::uint32_t> counts;

    /// Returns the point at the top of a layer; the ray's origin for layer 0.
    Point point(std::size_t ray, std::uint32_t layer) const {
        const RayLine& line = set.lines[ray];
        return layer == 0 ? line.origin : line.at(heights.of(ray)[layer]);
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

/// Finds anew what is asked for on each ray, what is in its way, and the front. Rays that begin where obstacles touch
/// the walls have no room unless they run along them.
void measure_room(Rays& rays, const Obstacles& obstacles);

/// Returns the front: the largest heights along the rays, at most those asked for and the limits, that rise along it by
/// no more than a slope. No ray loses its first layer for its neighbours.
std::vector<double> front_heights(const Rays& rays);

/// Makes the columns up to the front, and lowers the numbers of layers where they would overlap.
void fit_and_count_layers(Rays& rays);

}  // namespace lamina::layers
