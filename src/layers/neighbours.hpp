// Neighbouring rays: which they are, and how values on them are kept from differing too much.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "layers/stages.hpp"

namespace lamina::layers {

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

/// Lowers values along each element until none exceeds bound(neighbour, ray). Goes twice round each element in both
/// directions. Precondition: the bound is never below the neighbour's own value.
template <class T, class Bound>
void lower_to_neighbours(const RaySet& set, std::vector<T>& values, Bound bound) {
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = set.begin[e], n = set.begin[e + 1] - first;
        const auto pass_on = [&](std::size_t from, std::size_t to) {
            values[first + to % n] = std::min<T>(values[first + to % n], bound(first + from % n, first + to % n));
        };
        for (std::size_t k = 0; k < 2 * n; ++k) pass_on(k, k + 1);
        for (std::size_t k = 2 * n; k-- > 0;) pass_on(k + 1, k);
    }
}

/// Largest rise of the front per unit of distance along it. Two such slopes in a corner of 90 degrees leave 65 degrees to
/// the outer region.
inline constexpr double max_front_slope = 0.22;

/// Lowers heights along rays until none rises above its neighbour's by more than a slope, per unit of distance between their
/// points: they become the largest heights below those given with that slope, an inf-convolution.
/// Source: L. C. Evans, Partial Differential Equations (2010), section 3.3.2 (the Hopf-Lax formula).
void bound_slopes(const RaySet& set, std::vector<double>& heights);

/// Gives the rays inside each fan values between those of its first and last ray.
void fill_fans(const RaySet& set, std::vector<double>& values);

/// Lowers numbers of layers until those of neighbouring rays differ by at most one.
void limit_count_differences(const RaySet& set, std::vector<std::uint32_t>& counts);

}  // namespace lamina::layers
