#include "layers/least_heights.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "layers/neighbours.hpp"
#include "layers/stages.hpp"

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

void set_least_heights(std::span<const WallHeight> chain, std::span<RayVertex> outline) {
    const std::size_t n = outline.size();
    core::parallel_for(n, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (outline[i].place == RayPlace::wall) outline[i].least_height = height_at(outline[i].at, chain);
    });
    // At a trailing edge heights of both sides stand at one point. Before a wake it has a vertex for either side.
    for (std::size_t i = 0; i < n; ++i) {
        const RayVertex &before = outline[(i + n - 1) % n], &after = outline[(i + 1) % n];
        if (outline[i].place != RayPlace::wall) continue;
        if (after.place != RayPlace::wall) outline[i].least_height = before.least_height;
        if (before.place != RayPlace::wall) outline[i].least_height = after.least_height;
    }
}

std::vector<double> least_heights(const RaySet& set) {
    std::vector<double> least(set.lines.size());
    for (std::size_t i = 0; i < least.size(); ++i) least[i] = set.lines[i].least_height;
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

}  // namespace lamina::layers
