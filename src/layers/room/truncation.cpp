// Rays against rays and walls. Source: J. K. Pardue, thesis (2015), section 3.2.
//
// The thesis walks along concavities, as convex bodies have no crossing rays. Here every ray is tested against all
// others and all walls; of the walk, only the shortcut for a single convex body is left. Of two rays that cross at
// heights a < b, the one that arrives later, at b, ends at a fraction of b. In a corner between two walls this makes
// the layer thin towards the corner in proportion to the distance from it.
//
// Rays that are long against the spacing of the walls would make the search quadratic. So the search goes by scales:
// what rays meet at heights in (h, 2 h] is sought with a sample of rays h / 5 apart only; rays between those of the
// sample get limits between theirs.
#include "layers/room/truncation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/box_tree.hpp"
#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

namespace {

/// Up to this number of rays, one scale does for all heights.
constexpr std::size_t max_single_scale_rays = 600;

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

/// Returns the mean distance between the origins of neighbouring rays.
double mean_spacing(const RaySet& set) {
    double perimeter = 0;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        for (std::size_t i = set.begin[e], last = set.begin[e + 1] - 1; i < set.begin[e + 1]; last = i++)
            perimeter += distance(set.lines[last].origin, set.lines[i].origin);
    }
    return perimeter / static_cast<double>(set.lines.size());
}

/// The rays that are tested on one scale, and the wall drawn through their origins.
struct RaySample {
    std::vector<std::size_t> rays;
    std::vector<std::size_t> begin{0};                      ///< for each element, its first ray in `rays`; then the end
    std::vector<std::pair<std::size_t, std::size_t>> wall;  ///< edges between the origins of two rays
};

/// Returns a sample without the rays that are, at the wall and at `height`, less than `spacing` from the one before.
RaySample sample_rays(const RaySet& set, double height, double spacing) {
    RaySample sample;
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

/// The point where two lines cross: its coordinate along each of them.
struct LineCrossing {
    bool exists;
    double first, second;
};

LineCrossing cross_lines(Point p, Point d, Point q, Point e) {
    const double denominator = cross(d, e);
    if (denominator == 0) return {false, 0, 0};
    return {true, cross(q - p, e) / denominator, cross(q - p, d) / denominator};
}

/// The search for what the rays of a sample meet at heights in (low, high].
class ScaleSearch {
public:
    /// known: the limits found on lower scales.
    ScaleSearch(const RaySet& set, std::span<const double> asked, std::span<const double> known,
                const RaySample& sample, double low, double high)
        : set_(set), asked_(asked), known_(known), sample_(sample), low_(low), high_(high) {
        ray_boxes_.reserve(sample.rays.size());
        for (std::size_t i : sample.rays) {
            const double height = std::min(high, reach(i));
            ray_boxes_.push_back(core::bounding_box(set.lines[i].origin, at_height(set.lines[i], height)));
        }
        std::vector<Box> wall_boxes;
        wall_boxes.reserve(sample.wall.size());
        for (auto [a, b] : sample.wall)
            wall_boxes.push_back(core::bounding_box(set.lines[a].origin, set.lines[b].origin));
        ray_tree_ = core::BoxTree(ray_boxes_);
        wall_tree_ = core::BoxTree(std::move(wall_boxes));
    }

    /// Returns the limits on this scale, one per ray of the sample.
    std::vector<double> limits() const {
        std::vector<double> limits(sample_.rays.size(), HUGE_VAL);
        core::parallel_for(sample_.rays.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) {
                if (known_[sample_.rays[k]] <= wall_fraction * low_) continue;
                limits[k] = std::min(limit_by_rays(k), limit_by_walls(k));
            }
        });
        return limits;
    }

    /// Returns the limits by walls alone, one per ray of the sample.
    std::vector<double> wall_limits() const {
        std::vector<double> limits(sample_.rays.size());
        core::parallel_for(limits.size(), 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k) limits[k] = limit_by_walls(k);
        });
        return limits;
    }

private:
    const RaySet& set_;
    std::span<const double> asked_;
    std::span<const double> known_;
    const RaySample& sample_;
    double low_, high_;
    std::vector<Box> ray_boxes_;  ///< one per ray of the sample
    core::BoxTree ray_tree_{{}}, wall_tree_{{}};

    /// Returns the height up to which a ray is in the way of others; beyond its end it is not.
    double reach(std::size_t ray) const { return std::min(known_[ray] / ray_fraction, asked_[ray] / wall_fraction); }

    double limit_by_rays(std::size_t k) const {
        const RayLine& ray = set_.lines[sample_.rays[k]];
        double limit = HUGE_VAL;
        ray_tree_.overlaps(ray_boxes_[k], [&](std::size_t item) {
            const std::size_t j = sample_.rays[item];
            const RayLine& other = set_.lines[j];
            if (other.origin == ray.origin) return;
            const LineCrossing crossing = cross_lines(ray.origin, ray.direction, other.origin, other.direction);
            if (!crossing.exists || crossing.first <= low_ || crossing.first > high_) return;
            if (crossing.second < 0 || crossing.second > crossing.first * (1 + 1e-9) || crossing.second > reach(j))
                return;
            limit = std::min(limit, ray_fraction * crossing.first);
        });
        return limit;
    }

    double limit_by_walls(std::size_t k) const {
        const RayLine& ray = set_.lines[sample_.rays[k]];
        double limit = HUGE_VAL;
        wall_tree_.overlaps(ray_boxes_[k], [&](std::size_t item) {
            const Point a = set_.lines[sample_.wall[item].first].origin,
                        b = set_.lines[sample_.wall[item].second].origin;
            if (a == ray.origin || b == ray.origin) return;
            const LineCrossing crossing = cross_lines(ray.origin, ray.direction, a, b - a);
            if (!crossing.exists || crossing.first <= low_ || crossing.first > high_ || crossing.second < 0 ||
                crossing.second > 1)
                return;
            limit = std::min(limit, wall_fraction * crossing.first);
        });
        return limit;
    }
};

/// Lowers the limits of the rays between two neighbours in the sample, linearly in the distance along the wall.
void lower_between(const RaySet& set, const std::vector<std::size_t>& next, std::pair<std::size_t, std::size_t> rays,
                   std::pair<double, double> found, std::vector<double>& limits) {
    const auto [from, to] = rays;
    double length = 0;
    for (std::size_t i = from; i != to; i = next[i]) length += distance(set.lines[i].origin, set.lines[next[i]].origin);
    if (length == 0) return;
    double done = 0;
    for (std::size_t i = from; next[i] != to; i = next[i]) {
        done += distance(set.lines[i].origin, set.lines[next[i]].origin);
        const double between = ((length - done) * found.first + done * found.second) / length;
        limits[next[i]] = std::min(limits[next[i]], between);
    }
}

/// Lowers the limits of all rays to those found for the sample. Rays between two of the sample that both found
/// something get limits between theirs.
void lower_to_sample(const RaySet& set, const RaySample& sample, std::span<const double> found,
                     std::vector<double>& limits) {
    const std::vector<std::size_t> next = set.following();
    for (std::size_t k = 0; k < sample.rays.size(); ++k)
        limits[sample.rays[k]] = std::min(limits[sample.rays[k]], found[k]);
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t first = sample.begin[e], last = sample.begin[e + 1];
        for (std::size_t k = first; k < last; ++k) {
            const std::size_t after = k + 1 < last ? k + 1 : first;
            const std::size_t from = sample.rays[k], to = sample.rays[after];
            if (next[from] == to || std::isinf(found[k]) || std::isinf(found[after])) continue;
            lower_between(set, next, {from, to}, {found[k], found[after]}, limits);
        }
    }
}

}  // namespace

std::vector<double> height_limits(const RaySet& set, std::span<const double> asked) {
    std::vector<double> limits(set.lines.size(), HUGE_VAL);
    if (is_one_convex_body(set)) return limits;
    const double reach = *std::max_element(asked.begin(), asked.end()) / wall_fraction;
    double low = 0;
    double high = set.lines.size() <= max_single_scale_rays ? reach : std::min(reach, 4 * mean_spacing(set));
    for (;;) {
        const RaySample sample = sample_rays(set, high, low > 0 ? sample_spacing * high : 0.0);
        lower_to_sample(set, sample, ScaleSearch(set, asked, limits, sample, low, high).limits(), limits);
        if (high >= reach) break;
        low = high;
        high = std::min(2 * high, reach);
    }
    return limits;
}

std::vector<double> wall_limits(const RaySet& set, std::span<const double> asked) {
    const RaySample all = sample_rays(set, 0, 0);
    const std::vector<double> unknown(set.lines.size(), HUGE_VAL);
    return ScaleSearch(set, asked, unknown, all, 0, HUGE_VAL).wall_limits();
}

}  // namespace lamina::layers
