// Rays against rays and walls. Source: J. K. Pardue, thesis (2015), section 3.2.
//
// The thesis walks along concavities, as convex bodies have no crossing rays. Here every ray is tested against all
// others and all walls; the walk survives as the shortcut for one convex body. Two rays that cross at heights a < b:
// the one that arrives later, at b, ends at a fraction of b. In a corner between two walls this makes the layer thin
// towards the corner in proportion to the distance from it.
//
// Rays that are long against the spacing of the walls would make the search quadratic. It goes by scales: what is met
// at heights in (h, 2 h] is sought with rays at distances of h / 5 only; the rays between get what lies between their
// answers.
#include <algorithm>
#include <cmath>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "layers/rays.hpp"
#include "layers/truncation.hpp"

namespace lamina::layers {
namespace {

/// Share of the way to a wall that a ray may go: opposing fronts leave a quarter of the gap free.
constexpr double wall_fraction = 0.375;
/// Share of the height at which it crosses another ray; neighbours keep more than half of their distance.
constexpr double ray_fraction = 0.45;
/// Rise of the limit per unit of distance between neighbouring rays; two such slopes in a corner of 90 degrees leave
/// 60 degrees to the outer region.
constexpr double limit_slope = 0.25;
/// Below this number of rays one scale does for all.
constexpr std::size_t single_scale_rays = 600;
/// Distance of the rays that stand for all others, in heights.
constexpr double thinning = 0.1;

Point at_height(const RayLine& ray, double height) { return ray.origin + height * ray.direction; }

bool is_one_convex_body(const RaySet& set) {
    if (set.elements() != 1) return false;
    const std::size_t n = set.lines.size();
    for (std::size_t i = 0; i < n; ++i) {
        const RayLine &a = set.lines[i], &b = set.lines[(i + 1) % n];
        if (cross(a.direction, b.direction) < 0) return false;
    }
    return true;
}

double mean_spacing(const RaySet& set) {
    double perimeter = 0;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        for (std::size_t i = set.begin[e], last = set.begin[e + 1] - 1; i < set.begin[e + 1]; last = i++)
            perimeter += distance(set.lines[last].origin, set.lines[i].origin);
    }
    return perimeter / static_cast<double>(set.lines.size());
}

/// The rays looked at on one scale, and the wall drawn through their origins.
struct Sample {
    std::vector<std::size_t> rays;
    std::vector<std::size_t> begin{0};                      ///< per body, into rays
    std::vector<std::pair<std::size_t, std::size_t>> wall;  ///< edges between the origins of two rays
};

Sample thin_out(const RaySet& set, double height, double spacing) {
    Sample sample;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = sample.rays.size();
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i) {
            if (sample.rays.size() > first) {
                const RayLine &kept = set.lines[sample.rays.back()], &ray = set.lines[i];
                if (distance(kept.origin, ray.origin) < spacing &&
                    distance(at_height(kept, height), at_height(ray, height)) < spacing)
                    continue;
            }
            sample.rays.push_back(i);
        }
        for (std::size_t k = first, last = sample.rays.size() - 1; k < sample.rays.size(); last = k++) {
            if (set.lines[sample.rays[last]].origin != set.lines[sample.rays[k]].origin)
                sample.wall.emplace_back(sample.rays[last], sample.rays[k]);
        }
        sample.begin.push_back(sample.rays.size());
    }
    return sample;
}

/// Heights at which two lines cross, along each of them.
struct Crossing {
    bool exists;
    double first, second;
};

Crossing cross_lines(Point p, Point d, Point q, Point e) {
    const double denominator = cross(d, e);
    if (denominator == 0) return {false, 0, 0};
    return {true, cross(q - p, e) / denominator, cross(q - p, d) / denominator};
}

/// Limits of the sampled rays for what they meet at heights in (low, high].
std::vector<double> limits_on_scale(const RaySet& set, const LayerHeights& heights, const Sample& sample, double low,
                                    double high, std::span<const double> before) {
    // A ray that has ended is in nobody's way beyond its end.
    const auto way = [&](std::size_t i) {
        return std::min(before[i] / ray_fraction, heights.full_height(i) / wall_fraction);
    };
    std::vector<Box> ray_boxes, wall_boxes;
    for (std::size_t i : sample.rays) {
        const double reach = std::min(high, way(i));
        ray_boxes.push_back(core::bounding_box(set.lines[i].origin, at_height(set.lines[i], reach)));
    }
    for (auto [a, b] : sample.wall) wall_boxes.push_back(core::bounding_box(set.lines[a].origin, set.lines[b].origin));
    const core::BoxTree ray_tree(ray_boxes), wall_tree(std::move(wall_boxes));

    std::vector<double> limits(sample.rays.size(), HUGE_VAL);
    core::parallel_for(sample.rays.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k) {
            const std::size_t i = sample.rays[k];
            const RayLine& ray = set.lines[i];
            if (before[i] <= wall_fraction * low) continue;
            ray_tree.overlaps(ray_boxes[k], [&](std::size_t item) {
                const std::size_t j = sample.rays[item];
                const RayLine& other = set.lines[j];
                if (other.origin == ray.origin) return;
                const Crossing at = cross_lines(ray.origin, ray.direction, other.origin, other.direction);
                if (!at.exists || at.first <= low || at.first > high) return;
                if (at.second < 0 || at.second > at.first * (1 + 1e-9) || at.second > way(j)) return;
                limits[k] = std::min(limits[k], ray_fraction * at.first);
            });
            wall_tree.overlaps(ray_boxes[k], [&](std::size_t item) {
                const Point a = set.lines[sample.wall[item].first].origin,
                            b = set.lines[sample.wall[item].second].origin;
                if (a == ray.origin || b == ray.origin) return;
                const Crossing at = cross_lines(ray.origin, ray.direction, a, b - a);
                if (!at.exists || at.first <= low || at.first > high || at.second < 0 || at.second > 1) return;
                limits[k] = std::min(limits[k], wall_fraction * at.first);
            });
        }
    });
    return limits;
}

/// Lowers the limits to those of the sample: on rays between two of the sample that both found something, to what lies
/// between their limits, by distance along the wall.
void carry_over(const RaySet& set, const Sample& sample, std::span<const double> found, std::vector<double>& limits) {
    const std::vector<std::size_t> next = set.following();
    for (std::size_t k = 0; k < sample.rays.size(); ++k)
        limits[sample.rays[k]] = std::min(limits[sample.rays[k]], found[k]);
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = sample.begin[e], last = sample.begin[e + 1];
        for (std::size_t k = first; k < last; ++k) {
            const std::size_t after = k + 1 < last ? k + 1 : first;
            const std::size_t from = sample.rays[k], to = sample.rays[after];
            if (next[from] == to || std::isinf(found[k]) || std::isinf(found[after])) continue;
            double length = 0;
            for (std::size_t i = from; i != to; i = next[i])
                length += distance(set.lines[i].origin, set.lines[next[i]].origin);
            if (length == 0) continue;
            double done = 0;
            for (std::size_t i = from; next[i] != to; i = next[i]) {
                done += distance(set.lines[i].origin, set.lines[next[i]].origin);
                const double between = ((length - done) * found[k] + done * found[after]) / length;
                limits[next[i]] = std::min(limits[next[i]], between);
            }
        }
    }
}

/// Bounds the slope of the limits along each wall.
void smooth_limits(const RaySet& set, const LayerHeights& heights, std::vector<double>& limits) {
    lower_to_neighbours(set, limits, [&](std::size_t from, std::size_t to) {
        const double height = std::min(limits[from], heights.full_height(from));
        return limits[from] +
               limit_slope * distance(at_height(set.lines[from], height), at_height(set.lines[to], height));
    });
}

}  // namespace

std::vector<double> height_limits(const RaySet& set, const LayerHeights& heights) {
    std::vector<double> limits(set.lines.size(), HUGE_VAL);
    if (is_one_convex_body(set)) return limits;
    const double reach = heights.max_height() / wall_fraction;
    double low = 0;
    double high = set.lines.size() <= single_scale_rays ? reach : std::min(reach, 4 * mean_spacing(set));
    for (;;) {
        const Sample sample = thin_out(set, high, low > 0 ? thinning * high : 0.0);
        carry_over(set, sample, limits_on_scale(set, heights, sample, low, high, limits), limits);
        if (high >= reach) break;
        low = high;
        high = std::min(2 * high, reach);
    }
    if (std::all_of(limits.begin(), limits.end(), [](double limit) { return limit == HUGE_VAL; })) return limits;
    smooth_limits(set, heights, limits);
    return limits;
}

}  // namespace lamina::layers
