// Where rays start and which way they go; internal to the layer stage.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/point.hpp>

namespace lamina {

/// A ray before it has points.
struct RayLine {
    Point origin;
    Point direction;  ///< unit vector
};

/// Rays of all bodies one after the other; body e owns [begin[e], begin[e + 1]), closed in itself.
struct RaySet {
    std::vector<RayLine> rays;
    std::vector<std::size_t> begin{0};
    /// GradingOptions::asks of the border's edge from each ray's tip to the following one. Empty: none.
    std::vector<double> border_asks;

    std::size_t bodies() const { return begin.size() - 1; }
    /// Of each ray, the one that follows counter-clockwise round its body.
    std::vector<std::size_t> following() const;
};

/// Lowers values along each body until none is more than most(neighbour, ray), which allows the ray at least what the
/// neighbour has: twice round in both directions.
template <class T, class Most>
void lower_to_neighbours(const RaySet& set, std::vector<T>& values, Most most) {
    for (std::size_t e = 0; e < set.bodies(); ++e) {
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

/// Convex vertices that turn by more than this are corners: the same angle as ElementSummary::sharp_corners.
inline constexpr double sharp_corner_deg = 60;

/// Rays of one counter-clockwise body in wall order: the bisector at each vertex, or a fan at a sharp corner, and
/// refining rays on the edges between, so that neighbours differ by at most options.max_ray_angle_deg. Vertices of the
/// body are origins exactly; the rays of a fan have one origin.
/// Source: thesis 3 and 3.1.
std::vector<RayLine> make_rays(std::span<const Point> body, const LayerOptions& options);

/// Further rays on the edges between origins. shares: of each ray, how far along the edge to the origin of the
/// following one they start, ascending, in (0, 1); directions turn evenly. None where both have one origin, nor where
/// an edge is too short to be divided. border_asks: of each ray and the new ones behind it, where there are new ones.
RaySet insert_rays(const RaySet& set, const std::vector<std::vector<double>>& shares,
                   const std::vector<std::vector<double>>& border_asks = {});

}  // namespace lamina
