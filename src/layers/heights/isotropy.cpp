// The distance between rays decides where a layer is as high as wide. It is measured where the layer lies, as rays
// spread round convex walls:
//
//      \   s(H)  |  s(H)  /
//       o--------o-------o        the layer at height H
//        \       |      /
//         o------o-----o          the wall
//            s(0)   s(0)
//
// Rays of a fan have no distance at the wall; their values lead over from one side of the corner to the other. The
// values of all rays are then smoothed along the wall, so that the front becomes no saw.
#include "layers/heights/isotropy.hpp"

#include <algorithm>
#include <cmath>

#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Distances between neighbouring rays.
class RayDistances {
public:
    explicit RayDistances(const RaySet& set) : set_(set), neighbours_(set) {}

    std::size_t next(std::size_t ray) const { return neighbours_.next[ray]; }
    std::size_t previous(std::size_t ray) const { return neighbours_.previous[ray]; }
    /// Returns whether the two are rays of one fan.
    bool same_origin(std::size_t a, std::size_t b) const { return set_.lines[a].origin == set_.lines[b].origin; }
    bool inside_fan(std::size_t ray) const { return same_origin(previous(ray), ray) && same_origin(ray, next(ray)); }

    /// Returns the distance of a ray's point at this height from those of the neighbours: the geometric mean of both
    /// sides, or of one side alone where the other is a fan.
    double to_neighbours(std::size_t ray, double height) const {
        const bool left = !same_origin(previous(ray), ray), right = !same_origin(ray, next(ray));
        const double before = left ? bounded_distance(previous(ray), ray, height) : 0;
        const double after = right ? bounded_distance(ray, next(ray), height) : 0;
        return left && right ? std::sqrt(before * after) : before + after;
    }

    /// Returns the distance of the points of two rays at this height.
    double between(std::size_t a, std::size_t b, double height) const {
        const RayLine &left = set_.lines[a], &right = set_.lines[b];
        return length(right.origin - left.origin + height * (right.direction - left.direction));
    }

private:
    const RaySet& set_;
    RayNeighbours neighbours_;

    /// Returns the distance of the points of two rays, at most max_spread times that at the wall; 0 beyond the point
    /// where the two rays cross.
    double bounded_distance(std::size_t a, std::size_t b, double height) const {
        const RayLine &left = set_.lines[a], &right = set_.lines[b];
        const Point gap_at_wall = right.origin - left.origin;
        const Point gap_at_height = gap_at_wall + height * (right.direction - left.direction);
        if (dot(gap_at_height, gap_at_wall) <= 0) return 0;
        return std::min(length(gap_at_height), max_spread * length(gap_at_wall));
    }
};

/// Raises the front to the needed heights, and beside them so that it falls with this slope.
void raise_to(std::vector<double> needed, double slope, const RaySet& set, const RayDistances& rays,
              std::vector<double>& front) {
    fill_fans(set, needed);
    for (double& height : needed) height = -height;  // lowering them raises the front
    lower_to_neighbours(set, needed, [&](std::size_t from, std::size_t to) {
        return needed[from] + slope * rays.between(from, to, -needed[from]);
    });
    for (std::size_t i = 0; i < front.size(); ++i) front[i] = std::max(front[i], -needed[i]);
}

/// Returns the heights at which the front's edges over fans are nearly as long as those beside, and 0 elsewhere. A
/// front whose edges were shorter over the fan would ask for a finer wall there, which would lower it further.
std::vector<double> heights_over_fans(const RayDistances& rays, std::size_t count) {
    std::vector<double> needed(count);
    const auto raise = [&](std::size_t outside, std::size_t end, std::size_t inside) {
        needed[end] = rays.between(outside, end, 0) / rays.between(end, inside, 1);
    };
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t before = rays.previous(i), after = rays.next(i);
        const bool fan_before = rays.same_origin(before, i), fan_after = rays.same_origin(i, after);
        if (fan_after && !fan_before) raise(before, i, after);
        if (fan_before && !fan_after) raise(after, i, before);
    }
    return needed;
}

/// Rounds the kinks of the front but at fans.
void round_kinks(const RayDistances& rays, std::vector<double>& front) {
    constexpr int rounds = 8;
    for (int round = 0; round < rounds; ++round) {
        const std::vector<double> before = front;
        for (std::size_t i = 0; i < front.size(); ++i) {
            const std::size_t p = rays.previous(i), n = rays.next(i);
            if (!rays.same_origin(p, i) && !rays.same_origin(i, n))
                front[i] = 0.5 * before[i] + 0.25 * (before[p] + before[n]);
        }
    }
}

/// Returns the height at which the spacing would equal the distance of the rays. It lies between the last layer that is
/// lower than wide and the first that is not; where all are lower it is the height of the last one.
double isotropic_height(const RayDistances& rays, std::size_t ray, std::span<const double> heights, double opening) {
    double lacking_below = 0;  // distance of the rays minus spacing, in the layer below
    for (std::size_t n = 1; n < heights.size(); ++n) {
        const double below = opening * heights[n - 1], height = opening * heights[n], spacing = height - below;
        const double lacking = rays.to_neighbours(ray, height) - spacing;
        if (lacking <= 0) return n == 1 ? height : below + spacing * (lacking_below / (lacking_below - lacking));
        lacking_below = lacking;
    }
    return opening * heights.back();
}

/// Returns base^exponent, by squaring.
double whole_power(double base, std::uint32_t exponent) {
    double power = 1;
    for (; exponent > 0; exponent >>= 1, base *= base)
        if (exponent & 1) power *= base;
    return power;
}

/// Returns the largest number for which `below` holds among those that 50 halvings of [low, high] visit.
template <class Below>
double bisect(double low, double high, Below below) {
    if (below(high)) return high;
    for (int halving = 0; halving < 50; ++halving) {
        const double middle = 0.5 * (low + high);
        (below(middle) ? low : high) = middle;
    }
    return low;
}

}  // namespace

std::vector<double> heights_of_isotropy(const RaySet& set, std::span<const double> heights,
                                        std::span<const double> least) {
    const RayDistances rays(set);
    std::vector<double> front(set.lines.size());  // height of the front on each ray
    const auto opening = [&](std::size_t i) { return set.lines[i].opening; };
    const auto end_wakes = [&] {
        for (std::size_t i = 0; i < front.size(); ++i)
            if (set.lines[i].place == RayPlace::wake_end) front[i] = 0;
    };
    for (std::size_t i = 0; i < front.size(); ++i)
        if (!rays.inside_fan(i)) front[i] = isotropic_height(rays, i, heights, opening(i));
    fill_fans(set, front);
    if (uses("raise_over_fans")) raise_to(heights_over_fans(rays, front.size()), slope_beside_fans, set, rays, front);
    raise_to({least.begin(), least.end()}, max_front_slope, set, rays, front);
    end_wakes();
    if (uses("round_kinks")) round_kinks(rays, front);
    for (std::size_t i = 0; i < front.size(); ++i)
        front[i] = std::clamp(front[i], opening(i) * heights[1], opening(i) * heights.back());
    end_wakes();
    return front;
}

std::vector<double> largest_spacings(const RaySet& set, std::span<const double> front,
                                     std::span<const double> first_heights, double fineness) {
    const RayDistances rays(set);
    std::vector<double> spacings(set.lines.size());
    for (std::size_t i = 0; i < spacings.size(); ++i)
        if (!rays.inside_fan(i))
            spacings[i] = max_tallness * std::min(rays.to_neighbours(i, 0), rays.to_neighbours(i, front[i]));
    fill_fans(set, spacings);
    for (std::size_t i = 0; i < spacings.size(); ++i)
        for (const std::size_t j : {rays.previous(i), rays.next(i)})
            if (rays.same_origin(i, j))
                spacings[i] = std::min(spacings[i], max_tallness * rays.between(i, j, front[i]));
    for (std::size_t i = 0; i < spacings.size(); ++i)
        spacings[i] = std::max({spacings[i], front[i] / (fineness * max_layers_beyond_isotropy), first_heights[i]});
    return spacings;
}

std::vector<double> ratios_to_isotropy(const RaySet& set, double first_height, std::uint32_t layers) {
    if (layers < 2) return std::vector<double>(set.lines.size(), min_adaptive_ratio);
    const RayDistances rays(set);
    std::vector<double> ratios(set.lines.size());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
        if (rays.inside_fan(i)) continue;
        ratios[i] = bisect(min_adaptive_ratio, max_adaptive_ratio, [&](double ratio) {
            const double last = first_height * whole_power(ratio, layers - 1);
            const double height = (last * ratio - first_height) / (ratio - 1);
            return last <= rays.to_neighbours(i, height);
        });
    }
    fill_fans(set, ratios);
    // The heights are (r s - h) / (r - 1), where s = h r^(N - 1) is the last spacing. So where the last spacings of
    // neighbours are in a ratio q > 1, their heights are in a smaller one.
    const double max_step = bisect(1, max_neighbour_ratio,
                                   [&](double ratio) { return whole_power(ratio, layers - 1) <= max_neighbour_ratio; });
    lower_to_neighbours(set, ratios, [&](std::size_t from, std::size_t) { return max_step * ratios[from]; });
    return ratios;
}

}  // namespace lamina::layers
