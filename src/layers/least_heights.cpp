#include "layers/least_heights.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/parallel.hpp"
#include "layers/neighbours.hpp"

namespace lamina::layers {

namespace {

/// Returns the height at the point of the chain that is nearest to p.
double height_at(Point p, std::span<const WallHeight> chain) {
    double nearest = HUGE_VAL, height = 0;
    for (std::size_t k = 0; k < chain.size(); ++k) {
        const WallHeight &a = chain[k], &b = chain[k + 1 < chain.size() ? k + 1 : 0];
        const Point edge = b.at - a.at;
        const double square = squared_length(edge);
        const double share = square > 0 ? std::clamp(dot(p - a.at, edge) / square, 0.0, 1.0) : 0;
        const double away = squared_length(p - (a.at + share * edge));
        if (!(away < nearest)) continue;
        nearest = away;
        height = a.height + share * (b.height - a.height);
    }
    return height;
}

}  // namespace

std::vector<double> least_heights(const RaySet& set, std::span<const WallHeight> heights) {
    if (heights.empty()) return {};
    std::vector<double> least(set.lines.size(), 0.0);
    for (std::size_t e = 0; e < set.elements(); ++e) {
        std::vector<WallHeight> chain;
        std::copy_if(heights.begin(), heights.end(), std::back_inserter(chain),
                     [&](const WallHeight& height) { return height.element == e; });
        core::parallel_for(set.begin[e + 1] - set.begin[e], 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = set.begin[e] + begin; i < set.begin[e] + end; ++i)
                least[i] = height_at(set.lines[i].origin, chain);
        });
    }
    // Where the chain begins, at a trailing edge, heights of both sides stand at one point. The ends of a fan there have
    // those of the rays beside it.
    const RayNeighbours neighbours(set);
    const auto same_origin = [&](std::size_t a, std::size_t b) { return set.lines[a].origin == set.lines[b].origin; };
    std::vector<double> with_fans = least;
    for (std::size_t i = 0; i < least.size(); ++i) {
        const std::size_t before = neighbours.previous[i], after = neighbours.next[i];
        const bool fan_before = same_origin(before, i), fan_after = same_origin(i, after);
        if (fan_after && !fan_before) with_fans[i] = least[before];
        if (fan_before && !fan_after) with_fans[i] = least[after];
    }
    fill_fans(set, with_fans);
    return with_fans;
}

void limit_spacings(double max_spacing, std::span<double> heights) {
    if (std::isinf(max_spacing)) return;
    double height_below = heights[0], height = 0;
    for (double& h : heights.subspan(1)) {
        height += std::min(h - height_below, max_spacing);
        height_below = h;
        h = height;
    }
}

}  // namespace lamina::layers
