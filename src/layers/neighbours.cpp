// The neighbours of rays, and limits on how much they differ.
#include "layers/neighbours.hpp"

#include "layers/stages.hpp"

namespace lamina::layers {

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

}  // namespace lamina::layers
