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
#include "layers/target_length.hpp"

namespace lamina::layers {

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

/// The top of a cell that is flat or high, or leans by more than it is wide, stays whole up to this many times its target:
/// up to where its halves would be as much too short as it is too long.
constexpr double whole_top = std::numbers::sqrt2;
/// A cell is flat that is this many times as wide as high. The angle at the middle of its top would be 150 degrees.
constexpr double flat_cell = 7.46;
/// From this height on, in widths, half of a cell is nearer in area to the equilateral triangle on its whole top than a
/// quarter of it is to that on half of its top: the root of 3 / 8.
constexpr double high_cell = 0.6124;

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

/// Returns whether the cell below the edge between two corners leans by more than it is wide: seen along its normals,
/// the edge and that between its lower corners do not overlap. Triangles below parts of the edge would have their
/// middles farther to the side than the parts are long, which makes skewed faces (docs/decisions/0060).
bool leans_by_its_width(const LayeredRays& rays, const FrontCorner& a, const FrontCorner& b) {
    if (a.layers == 0 || b.layers == 0 || a.cleft) return false;
    const Point tip_a = rays.tip(a.ray), tip_b = rays.tip(b.ray), edge = tip_b - tip_a;
    const double along_a = dot(tip_a - rays.point(a.ray, a.layers - 1), edge);
    const double along_b = dot(tip_b - rays.point(b.ray, b.layers - 1), edge);
    return std::min(along_a, along_b) > squared_length(edge) || std::max(along_a, along_b) < -squared_length(edge);
}

/// The cell of the layer below the edge of a front between two corners: the length of the edge, and the heights of the last
/// layer at its ends.
struct TopCell {
    double width, height_a, height_b;
};

/// Returns the cell below the edge between two corners, or nothing where a corner has no layers or the edge lies before a cleft.
std::optional<TopCell> top_cell(const LayeredRays& rays, const FrontCorner& a, const FrontCorner& b) {
    if (a.layers == 0 || b.layers == 0 || a.cleft) return std::nullopt;
    const auto last_height = [&](const FrontCorner& corner) {
        return distance(rays.tip(corner.ray), rays.point(corner.ray, corner.layers - 1));
    };
    return TopCell{distance(rays.tip(a.ray), rays.tip(b.ray)), last_height(a), last_height(b)};
}

/// Returns whether a cell is flat. The angle between the lines from the middle of its top to its lower corners would be near
/// 180 degrees.
bool is_flat(const TopCell& cell) { return cell.width > flat_cell * std::max(cell.height_a, cell.height_b); }

/// Returns whether a cell is so high that its triangles match those beyond better with its whole top than with half of it.
bool is_high(const TopCell& cell) { return 0.5 * (cell.height_a + cell.height_b) > high_cell * cell.width; }

/// Returns what divide_borders() needs to leave the tops of flat, high and leaning cells whole.
std::vector<std::vector<double>> whole_tops(const Rays& grown, const LayeredRays& rays, const FrontCorners& corners) {
    const bool of_grid = grown.topology != LayerTopology::delaunay;
    std::vector<std::vector<double>> whole_up_to(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k) {
            const FrontCorner &a = corners[e][k], &b = corners[e][(k + 1) % corners[e].size()];
            const std::optional<TopCell> cell = top_cell(rays, a, b);
            const bool suits = cell && of_grid && grown.resampled[e] && (is_flat(*cell) || is_high(*cell));
            const bool whole = uses("whole_tops") && (suits || leans_by_its_width(rays, a, b));
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
    const std::vector<std::vector<double>> whole_up_to = whole_tops(rays, layered, corners);
    Layer layer = build_layer(rays, corners, divide_fronts(layered, corners, options, {}, whole_up_to));
    if (rays.enabled) layer.coverage = layer_coverage(rays.set, rays.heights, rays.counts);
    layer.growth = rays.growth;
    layer.jagged = rays.jagged;
    layer.edges = layer_edges(layer);
    return layer;
}

}  // namespace lamina
