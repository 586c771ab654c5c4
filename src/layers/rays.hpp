// Where rays start and which way they go.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Lowers values along each element until none is more than most(neighbour, ray), which allows the ray at least what
/// the neighbour has: twice round in both directions.
template <class T, class Most>
void lower_to_neighbours(const RaySet& set, std::vector<T>& values, Most most) {
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = set.begin[e], n = set.begin[e + 1] - first;
        const auto pass_on = [&](std::size_t from, std::size_t to) {
            values[first + to % n] = std::min<T>(values[first + to % n], most(first + from % n, first + to % n));
        };
        for (std::size_t k = 0; k < 2 * n; ++k) pass_on(k, k + 1);
        for (std::size_t k = 2 * n; k-- > 0;) pass_on(k + 1, k);
    }
}

/// Lowers counts until those of neighbouring rays differ by at most one.
inline void limit_steps(const RaySet& set, std::vector<std::uint32_t>& counts) {
    lower_to_neighbours(set, counts, [&](std::size_t from, std::size_t) { return counts[from] + 1; });
}

/// Returns the rays of one counter-clockwise outline in the order of the wall: the bisector at each vertex, or a fan at
/// a sharp corner, and refining rays on the edges between, so that neighbours differ by at most
/// options.max_ray_angle_deg. The vertices of the outline are origins exactly; the rays of a fan have one origin.
/// Source: thesis 3 and 3.1.
std::vector<RayLine> make_rays(std::span<const Point> outline, const LayerOptions& options, const LayerGrowth& growth);

/// Rays with further ones between them.
struct DividedRays {
    RaySet set;
    /// Of each ray, BorderDivision::factors for the edge of the front from its tip to the following one; empty: none.
    std::vector<double> factors;
};

/// Returns the rays with further ones on the edges between origins. shares: of each ray, how far along the edge to the
/// origin of the following one they start, ascending, in (0, 1); directions turn evenly. None are added where both have
/// one origin, nor where an edge is too short to be divided. factors: of each ray and of the new ones behind it, where
/// there are new ones.
DividedRays insert_rays(const RaySet& set, const std::vector<std::vector<double>>& shares,
                        const std::vector<std::vector<double>>& factors = {});

/// Returns the rays and, on edges between rays that may carry layers up to their limits which differ in number by more
/// than one, a ray for each step. Neighbours' numbers differ by at most one, so without these rays coarse walls would
/// have few layers far from where there is no room.
RaySet add_rays_at_steps(const RaySet& set, const LayerHeights& heights, std::span<const double> limits);

}  // namespace lamina::layers
