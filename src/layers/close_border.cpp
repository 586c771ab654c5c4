// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include <utility>

#include <lamina/layers.hpp>

#include "layers/coverage.hpp"
#include "layers/divide_borders.hpp"
#include "layers/front.hpp"
#include "layers/layer_builder.hpp"
#include "layers/layered_rays.hpp"
#include "layers/target_length.hpp"

namespace lamina::layers {

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

/// Divides the fronts through these corners. least_requests: as for divide_borders().
BorderDivision divide_fronts(const LayeredRays& rays, const FrontCorners& corners, const BorderOptions& options,
                             std::span<const std::vector<double>> least_requests = {}) {
    std::vector<std::vector<Point>> fronts(corners.size()), walls(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e) {
        for (const FrontCorner& corner : corners[e]) fronts[e].push_back(rays.tip(corner.ray));
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i)
            if (const Point origin = rays.set.lines[i].origin; walls[e].empty() || walls[e].back() != origin)
                walls[e].push_back(origin);
    }
    return divide_borders(fronts, walls, options, least_requests);
}

/// Returns the edge of the wall below an edge of a front: that between the origins of the rays at its ends.
std::pair<Point, Point> wall_below(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    return {rays.set.lines[corners[k].ray].origin, rays.set.lines[corners[(k + 1) % corners.size()].ray].origin};
}

/// Returns whether an edge of a front lies above an edge of the wall, rather than of a wake.
bool is_above_wall(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    const auto place = [&](std::size_t corner) { return rays.set.lines[corners[corner % corners.size()].ray].place; };
    return place(k) == RayPlace::wall && place(k + 1) == RayPlace::wall;
}

}  // namespace

}  // namespace lamina::layers

namespace lamina {

using namespace layers;

/// Where rays converge, edges of the front are shorter than those of the wall below. If they requested their own
/// lengths, the wall beside would become finer for them, then the wall below, and then these edges themselves.
std::vector<WallSpacing> wall_spacings(const Rays& rays, const BorderOptions& options) {
    constexpr double margin = 0.97;  // for walls whose whole numbers of edges differ from those asked for
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    std::vector<std::vector<double>> least_requests(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const auto [a, b] = wall_below(rays, corners[e], k);
            least_requests[e].push_back(distance(a, b));
        }
    const BorderDivision division = divide_fronts(layered, corners, options, least_requests);
    std::vector<WallSpacing> spacings;
    for (std::size_t e = 0; e < corners.size(); ++e) {
        if (!rays.resampled[e]) continue;
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const auto [a, b] = wall_below(rays, corners[e], k);
            if (!is_above_wall(rays, corners[e], k)) continue;
            const double excess = division.excess[e][k] / target_slack;
            if (a != b && excess > 1) spacings.push_back({e, a, b, margin * distance(a, b) / excess});
        }
    }
    return spacings;
}

Layer close_border(const Rays& rays, const BorderOptions& options) {
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    Layer layer = build_layer(rays, corners, divide_fronts(layered, corners, options));
    if (rays.enabled) layer.coverage = layer_coverage(rays.set, rays.heights, rays.counts);
    layer.growth = rays.growth;
    layer.edges = layer_edges(layer);
    return layer;
}

}  // namespace lamina
