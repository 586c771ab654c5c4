#include "layers/insert_rays.hpp"

#include <algorithm>
#include <cstdint>

#include "layers/intermediate_rays.hpp"

namespace lamina::layers {

namespace {

/// The end of a ray under its limit.
struct RayEnd {
    double height;         ///< limit, or height of all layers if that is less
    std::uint32_t layers;  ///< number of layers that fit below the limit
};

/// Rays are inserted where they will stand apart by at least this many heights of the last layer there. Numbers that
/// change on narrower columns shear their last cells more than the wall gains.
constexpr double least_width = 2;

/// Returns where between two rays, of which the second has several layers more, a ray for each layer between should
/// start, as shares of the way from the first. Each share is the mean of an even division and of the place where a
/// straight line between the ends passes the layer.
std::vector<double> shares_between(const RayEnd& low, const RayEnd& high, std::span<const double> heights) {
    std::vector<double> shares;
    const double layers = high.layers - low.layers;
    for (std::uint32_t n = low.layers + 1; n < high.layers; ++n) {
        const double even = (n - low.layers) / layers;
        const double at_height = (heights[n] - low.height) / (high.height - low.height);
        shares.push_back(0.5 * (even + std::clamp(at_height, 0.0, 1.0)));
    }
    return shares;
}

/// Inserts rays on the edges between the origins of neighbouring rays; directions turn evenly. shares: for each ray,
/// how far along the edge to the origin of the following ray the new ones start, ascending, in (0, 1). No rays are
/// inserted where both rays have one origin or a corner between them, nor where an edge is too short to be divided.
RaySet insert_rays(const RaySet& set, const std::vector<std::vector<double>>& shares) {
    const std::vector<std::size_t> next = set.following();
    RaySet result;
    for (std::size_t e = 0; e < set.elements(); ++e) {
        for (std::size_t i = set.begin[e]; i < set.begin[e + 1]; ++i) {
            const RayLine &ray = set.lines[i], &after = set.lines[next[i]];
            result.lines.push_back(ray);
            if (shares[i].empty() || ray.origin == after.origin || !ray.corner_after.empty()) continue;
            // Both sides of a wake have the same vertices.
            if (ray.place != RayPlace::wall || after.place != RayPlace::wall) continue;
            const IntermediateRays between(ray, after);
            for (const double share : shares[i]) between.add(share, 1, result.lines);
        }
        result.begin.push_back(result.lines.size());
    }
    return result;
}

}  // namespace

RaySet insert_rays_where_counts_change(const RaySet& set, std::span<const char> jagged, const LayerHeights& heights,
                                       std::span<const double> limits) {
    const std::vector<std::size_t> next = set.following();
    const auto end_of = [&](std::size_t i) {
        const std::span<const double> column = heights.of(i);
        const auto first_above = std::upper_bound(column.begin(), column.end(), limits[i]);
        return RayEnd{std::min(limits[i], column.back()), static_cast<std::uint32_t>(first_above - column.begin()) - 1};
    };
    const auto would_be_narrow = [&](std::size_t i, const RayEnd& low, const RayEnd& high,
                                     std::span<const double> column) {
        const double last_spacing = column[high.layers] - column[high.layers - 1];
        const double width = distance(set.lines[i].origin, set.lines[next[i]].origin) / (high.layers - low.layers);
        return width < least_width * last_spacing;
    };
    std::vector<std::vector<double>> shares(set.lines.size());
    std::size_t element = 0;
    for (std::size_t i = 0; i < set.lines.size(); ++i) {
        while (i == set.begin[element + 1]) ++element;
        if (jagged[element]) continue;
        const RayEnd end = end_of(i), next_end = end_of(next[i]);
        const bool rises = end.layers < next_end.layers;
        const RayEnd &low = rises ? end : next_end, &high = rises ? next_end : end;
        const std::span<const double> column = heights.of(rises ? next[i] : i);
        if (low.layers == high.layers || would_be_narrow(i, low, high, column)) continue;
        shares[i] = shares_between(low, high, column);
        if (rises) continue;
        std::reverse(shares[i].begin(), shares[i].end());
        for (double& share : shares[i]) share = 1 - share;
    }
    return insert_rays(set, shares);
}

}  // namespace lamina::layers
