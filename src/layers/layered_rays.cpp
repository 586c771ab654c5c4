// Fronts, columns and numbers of layers found anew for a set of rays.
#include "layers/layered_rays.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "layers/heights/heights.hpp"
#include "layers/heights/stretch.hpp"
#include "layers/room/counts.hpp"
#include "layers/room/truncation.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// The neighbours of rays, and limits on how much they differ.

RayNeighbours::RayNeighbours(const RaySet& set) : next(set.following()), previous(next.size()) {
    for (std::size_t i = 0; i < next.size(); ++i) previous[next[i]] = i;
}

WallNeighbours wall_neighbours(const RayLine& before, const RayLine& ray, const RayLine& after) {
    return {before.corner_after.empty() ? before.origin : before.corner_after.back(),
            ray.corner_after.empty() ? after.origin : ray.corner_after.front()};
}

void bound_slopes(const RaySet& set, std::vector<double>& heights) {
    lower_to_neighbours(set, heights, [&](std::size_t from, std::size_t to) {
        const auto end = [&](std::size_t ray) {
            return set.lines[ray].origin + heights[from] * set.lines[ray].direction;
        };
        return heights[from] + max_front_slope * distance(end(from), end(to));
    });
}

void fill_fans(const RaySet& set, std::vector<double>& values) {
    const RayNeighbours rays(set);
    const auto same_origin = [&](std::size_t a, std::size_t b) { return set.lines[a].origin == set.lines[b].origin; };
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (same_origin(rays.previous[i], i) || !same_origin(i, rays.next[i])) continue;
        std::vector<std::size_t> fan{i};
        while (same_origin(i, rays.next[fan.back()])) fan.push_back(rays.next[fan.back()]);
        const std::size_t last_index = fan.size() - 1;
        const double first = values[fan.front()], last = values[fan.back()];
        const auto [min, max] = std::minmax(first, last);
        for (std::size_t k = 1; k < last_index; ++k) {
            const double share = static_cast<double>(k), rest = static_cast<double>(last_index - k);
            // Rounding must not lead out of the range that values may lie in.
            values[fan[k]] = std::clamp((first * rest + last * share) / static_cast<double>(last_index), min, max);
        }
    }
}

void limit_count_differences(const RaySet& set, std::vector<std::uint32_t>& counts) {
    lower_to_neighbours(set, counts, [&](std::size_t from, std::size_t) { return counts[from] + 1; });
}

std::vector<std::size_t> RaySet::following() const {
    std::vector<std::size_t> next(lines.size());
    for (std::size_t e = 0; e < elements(); ++e)
        for (std::size_t i = begin[e]; i < begin[e + 1]; ++i) next[i] = i + 1 < begin[e + 1] ? i + 1 : begin[e];
    return next;
}

namespace {

/// Returns the largest heights along the rays, at most those asked for and the limits, that rise by no more than a
/// slope.
std::vector<double> bounded_heights(const Rays& rays) {
    std::vector<double> heights(rays.asked);
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = std::min(heights[i], rays.limits[i]);
    // A requested number of layers is kept on every ray where nothing is in the way of any.
    if (!rays.growth.layers || heights != rays.asked) bound_slopes(rays.set, heights);
    return heights;
}

}  // namespace

LayeredRays layered_rays(const Rays& rays) { return {rays.set, rays.heights, rays.counts}; }

void measure_room(Rays& rays, const Obstacles& obstacles) {
    set_slants(rays.set);
    rays.asked = asked_heights(rays.set, rays.growth);
    rays.limits = height_limits(rays.set, rays.asked);
    std::vector<Point> bare = obstacles.bare, along_lines;
    for (const LineFoot& foot : obstacles.feet) bare.push_back(foot.at);
    for (std::size_t i = 0; i < rays.limits.size(); ++i) {
        const RayLine& ray = rays.set.lines[i];
        if (!(ray.line_room > 0)) continue;
        along_lines.push_back(ray.origin);
        rays.limits[i] = std::min(rays.limits[i], ray.line_room);
    }
    std::sort(bare.begin(), bare.end(), lexicographically_less);
    std::sort(along_lines.begin(), along_lines.end(), lexicographically_less);
    const auto is_in = [](const std::vector<Point>& points, Point p) {
        return std::binary_search(points.begin(), points.end(), p, lexicographically_less);
    };
    for (std::size_t i = 0; i < rays.limits.size(); ++i)
        if (const Point at = rays.set.lines[i].origin; is_in(bare, at) && !is_in(along_lines, at)) rays.limits[i] = 0;
    rays.lower_to_copies(rays.limits);
    rays.front = bounded_heights(rays);
}

std::vector<double> front_heights(const Rays& rays) {
    std::vector<double> front = bounded_heights(rays);
    // Lowered limits take no first layer away from rays beside.
    const std::vector<double> first = first_heights_along(rays.set, rays.growth);
    for (std::size_t i = 0; i < front.size(); ++i)
        front[i] = std::min(std::max(front[i], std::min(first[i], rays.limits[i])), rays.asked[i]);
    return front;
}

void fit_and_count_layers(Rays& rays) {
    rays.lower_to_copies(rays.limits);
    rays.front = front_heights(rays);
    rays.heights = columns_up_to(rays.set, rays.growth, rays.asked, rays.front);
    rays.counts.resize(rays.set.lines.size());
    for (std::size_t i = 0; i < rays.counts.size(); ++i) rays.counts[i] = rays.heights.column(i).layers;
    for (std::vector<std::uint32_t> before; before != rays.counts;) {
        before = layer_counts(rays.set, rays.heights, rays.counts);
        rays.counts = before;
        rays.lower_to_copies(rays.counts);
    }
    fit_end_spacings(rays);
}

}  // namespace lamina::layers
