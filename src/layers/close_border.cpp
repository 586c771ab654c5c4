// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include <algorithm>
#include <numbers>
#include <optional>

#include <lamina/layers.hpp>

#include "layers/coverage.hpp"
#include "layers/divide_borders.hpp"
#include "layers/front.hpp"
#include "layers/layer_builder.hpp"
#include "layers/layered_rays.hpp"
#include "layers/mechanisms.hpp"
#include "layers/stages.hpp"
#include "layers/target_length.hpp"

namespace lamina::layers {

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

/// The top of a cell of the grid stays whole up to this many times its target: up to where its halves would be as much too
/// short as it is too long. A point on the top of a flat cell makes an angle near 180 degrees, and halves of the tops of high
/// ones are farther in area from the triangles beyond. Walls that are kept have no other way to become finer than their borders.
constexpr double whole_top = std::numbers::sqrt2;

/// Divides the fronts through these corners. least_requests, whole_up_to: as for divide_borders().
BorderDivision divide_fronts(const LayeredRays& rays, const FrontCorners& corners, const BorderOptions& options,
                             std::span<const std::vector<double>> least_requests,
                             std::span<const std::vector<double>> whole_up_to) {
    std::vector<std::vector<Point>> fronts(corners.size()), walls(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e) {
        for (const FrontCorner& corner : corners[e]) fronts[e].push_back(place_of(rays, corner));
        for (std::size_t i = rays.set.begin[e]; i < rays.set.begin[e + 1]; ++i) {
            const RayLine& ray = rays.set.lines[i];
            if (walls[e].empty() || walls[e].back() != ray.origin) walls[e].push_back(ray.origin);
            walls[e].insert(walls[e].end(), ray.corner_after.begin(), ray.corner_after.end());
        }
    }
    return divide_borders(fronts, walls, options, least_requests, whole_up_to);
}

/// Returns what divide_borders() needs to leave the tops of the grid's cells whole.
std::vector<std::vector<double>> whole_tops(const Rays& grown, const FrontCorners& corners) {
    const bool of_grid = grown.topology != LayerTopology::delaunay;
    std::vector<std::vector<double>> whole_up_to(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const FrontCorner &a = corners[e][k], &b = corners[e][(k + 1) % corners[e].size()];
            const bool has_cell = a.layers > 0 && b.layers > 0 && !a.cleft;
            const bool whole = uses("whole_tops") && of_grid && grown.resampled[e] && has_cell;
            whole_up_to[e].push_back(whole ? whole_top : target_slack);
        }
    return whole_up_to;
}

/// The wall between the origins of two rays.
struct WallPart {
    Point a, b;   ///< its ends
    double edge;  ///< length of its edge, or the mean length of its edges where there is a corner between
};

/// Returns the part of the wall below an edge of a front.
WallPart wall_below(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    const RayLine &ray = rays.set.lines[corners[k].ray], &next = rays.set.lines[corners[(k + 1) % corners.size()].ray];
    const Point a = ray.origin, b = next.origin;
    Point from = a;
    double wall = 0;
    for (const Point p : ray.corner_after) {
        wall += distance(from, p);
        from = p;
    }
    return {a, b, (wall + distance(from, b)) / static_cast<double>(ray.corner_after.size() + 1)};
}

/// Returns whether an edge of a front lies above an edge of the wall, rather than of a wake.
bool is_above_wall(const Rays& rays, const std::vector<FrontCorner>& corners, std::size_t k) {
    const auto place = [&](std::size_t corner) { return rays.set.lines[corners[corner % corners.size()].ray].place; };
    return place(k) == RayPlace::wall && place(k + 1) == RayPlace::wall;
}

}  // namespace

/// Where rays converge, edges of the front are shorter than those of the wall below. If they requested their own
/// lengths, the wall beside would become finer for them, then the wall below, and then these edges themselves.
std::vector<WallSpacing> wall_spacings(const Rays& rays, const BorderOptions& options) {
    constexpr double margin = 0.97;  // for walls whose whole numbers of edges differ from those asked for
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    std::vector<std::vector<double>> least_requests(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k)
            least_requests[e].push_back(corners[e][k].cleft ? 0 : wall_below(rays, corners[e], k).edge);
    const BorderDivision division = divide_fronts(layered, corners, options, least_requests, {});
    std::vector<WallSpacing> spacings;
    for (std::size_t e = 0; e < corners.size(); ++e) {
        if (!rays.resampled[e]) continue;
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            if (corners[e][k].cleft || !is_above_wall(rays, corners[e], k)) continue;
            const WallPart wall = wall_below(rays, corners[e], k);
            const double excess = division.excess[e][k] / target_slack;
            if (wall.a != wall.b && excess > 1) spacings.push_back({e, wall.a, wall.b, margin * wall.edge / excess});
        }
    }
    return spacings;
}

Layer close_border(const Rays& rays, const BorderOptions& options) {
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(layered);
    const std::vector<std::vector<double>> whole_up_to = whole_tops(rays, corners);
    Layer layer = build_layer(rays, corners, divide_fronts(layered, corners, options, {}, whole_up_to));
    if (rays.enabled) layer.coverage = layer_coverage(rays);
    layer.growth = rays.growth;
    layer.jagged = rays.jagged;
    layer.edges = layer_edges(layer);
    return layer;
}

}  // namespace lamina::layers

namespace lamina {

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
                 const BorderOptions& border) {
    return layers::close_border(layers::grow_rays(geometry, options, growth), border);
}

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const BorderOptions& border) {
    validate(options);
    return make_layer(geometry, options, layer_growth(options, {.chord = bounding_box(geometry).width()}), border);
}

}  // namespace lamina
