// Stage "close the border": the fronts are divided, and all points of the layer placed. Source: J. K. Pardue, thesis
// (2015), chapter 3.
#include "layers/border/close_border.hpp"
#include "layers/layer.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

#include <lamina/layers.hpp>

#include "layers/border/divide_borders.hpp"
#include "layers/border/layer_builder.hpp"
#include "layers/border/target_length.hpp"
#include "layers/layered_rays.hpp"
#include "layers/measures.hpp"
#include "layers/mechanisms.hpp"
#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

// The corners of fronts, and the fronts as points.

std::vector<std::vector<FrontCorner>> front_corners(const Rays& rays) {
    const RaySet& set = rays.set;
    const std::vector<std::uint32_t>& counts = rays.counts;
    std::vector<std::vector<FrontCorner>> fronts(set.elements());
    const std::vector<CleftEnd> clefts = cleft_ends(layered_rays(rays));
    std::size_t cleft = 0;  // the next one
    for (std::size_t e = 0; e < set.elements(); ++e) {
        const std::size_t begin = set.begin[e], end = set.begin[e + 1];
        if (rays.is_outer(e)) {
            for (std::size_t i = begin; i < end; ++i) fronts[e].push_back({i, i < rays.domain_end(e) ? counts[i] : 0});
            continue;
        }
        for (std::size_t i = begin; i < end; ++i) {
            if (cleft < clefts.size() && i == clefts[cleft].first) {
                fronts[e].push_back({i, counts[i], 0, clefts[cleft]});
                i = clefts[cleft++].last - 1;
                continue;
            }
            const std::size_t next = i + 1 < end ? i + 1 : begin;
            const bool one_corner = counts[i] == 0 && counts[next] == 0 &&
                                    set.lines[i].origin == set.lines[next].origin && i + 1 != rays.domain_end(e);
            if (!one_corner) fronts[e].push_back({i, counts[i]});
            if (counts[i] > 0 || counts[next] > 0) continue;
            for (std::size_t k = 1; k <= set.lines[i].corner_after.size(); ++k) fronts[e].push_back({i, 0, k});
        }
    }
    return fronts;
}

std::size_t corners_in_domain(const Rays& rays, std::size_t element, std::span<const FrontCorner> corners) {
    const auto hidden = std::find_if(corners.begin(), corners.end(),
                                     [&](const FrontCorner& corner) { return corner.ray >= rays.domain_end(element); });
    return static_cast<std::size_t>(hidden - corners.begin());
}

Point place_of(const LayeredRays& rays, const FrontCorner& corner) {
    return corner.after > 0 ? rays.set.lines[corner.ray].corner_after[corner.after - 1]
                            : rays.point(corner.ray, corner.layers);
}

std::vector<std::vector<Point>> fronts(const Rays& rays) {
    const LayeredRays layered = layered_rays(rays);
    std::vector<std::vector<Point>> result;
    for (const std::vector<FrontCorner>& corners : front_corners(rays)) {
        std::vector<Point>& front = result.emplace_back();
        front.reserve(corners.size());
        for (const FrontCorner& corner : corners) front.push_back(place_of(layered, corner));
    }
    return result;
}

// The edges of walls and outer borders, sorted by what lies beside them.

LayerEdges layer_edges(const Layer& layer) {
    LayerEdges result;
    std::vector<Segment> wall_edges, border_edges;  // both counter-clockwise
    for (const auto& wall : layer.walls) {
        const bool open = layer.is_open(result.walls.size());
        auto& clockwise = result.walls.emplace_back();
        for (std::size_t i = 0; i + open < wall.size(); ++i) {
            const VertexId a = wall[i], b = wall[i + 1 < wall.size() ? i + 1 : 0];
            wall_edges.push_back({a, b});
            clockwise.push_back({b, a});
        }
    }
    for (std::size_t e = 0; e < layer.borders.size(); ++e) {
        const std::vector<VertexId>& border = layer.borders[e];
        for (std::size_t i = 0; i + layer.is_open(e) < border.size(); ++i)
            border_edges.push_back({border[i], border[i + 1 < border.size() ? i + 1 : 0]});
    }
    for (std::size_t e = 0; e < layer.rays.size(); ++e) {
        if (!layer.is_open(e) || layer.rays[e].empty()) continue;
        std::vector<Segment>& ends = layer.is_outer(e) ? result.sides : result.symmetry;
        const Ray &first = layer.rays[e].front(), &last = layer.rays[e].back();
        for (std::uint32_t n = 1; n <= first.layers; ++n) ends.push_back({first.vertex(n - 1), first.vertex(n)});
        for (std::uint32_t n = 1; n <= last.layers; ++n) ends.push_back({last.vertex(n), last.vertex(n - 1)});
    }
    result.region = result.sides;
    result.region.insert(result.region.end(), result.symmetry.begin(), result.symmetry.end());

    std::sort(wall_edges.begin(), wall_edges.end());
    std::sort(border_edges.begin(), border_edges.end());
    for (const Segment& e : border_edges) {
        if (std::binary_search(wall_edges.begin(), wall_edges.end(), e)) continue;
        result.region.push_back(e);
        result.interfaces.push_back({std::min(e.a, e.b), std::max(e.a, e.b)});
    }
    for (const Segment& e : wall_edges)
        if (!std::binary_search(border_edges.begin(), border_edges.end(), e)) result.region.push_back({e.b, e.a});
    std::sort(result.interfaces.begin(), result.interfaces.end());
    return result;
}

std::vector<std::vector<Point>> border_loops(const Layer& layer) {
    std::vector<std::vector<Point>> loops;
    for (const auto& border : layer.borders) {
        const bool back = layer.is_open(loops.size());
        std::vector<Point>& loop = loops.emplace_back();
        loop.reserve(border.size());
        for (VertexId v : border) loop.push_back(layer.points[v.index()]);
        if (back && loop.size() > 2) loop.insert(loop.end(), loop.rbegin() + 1, loop.rend() - 1);
    }
    return loops;
}

namespace {

using FrontCorners = std::vector<std::vector<FrontCorner>>;

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
std::vector<geometry::WallSpacing> wall_spacings(const Rays& rays, const BorderOptions& options) {
    constexpr double margin = 0.97;  // for walls whose whole numbers of edges differ from those asked for
    validate(options);
    const LayeredRays layered = layered_rays(rays);
    const FrontCorners corners = front_corners(rays);
    std::vector<std::vector<double>> least_requests(corners.size());
    for (std::size_t e = 0; e < corners.size(); ++e)
        for (std::size_t k = 0; k < corners[e].size(); ++k)
            least_requests[e].push_back(corners[e][k].cleft ? 0 : wall_below(rays, corners[e], k).edge);
    const BorderDivision division = divide_fronts(layered, corners, options, least_requests, {});
    std::vector<geometry::WallSpacing> spacings;
    for (std::size_t e = 0; e < rays.shown(); ++e) {
        if (!rays.resampled[e]) continue;
        const std::size_t shown = corners_in_domain(rays, e, corners[e]) - rays.is_open(e);
        for (std::size_t k = 0; k < shown; ++k) {
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
    const FrontCorners corners = front_corners(rays);
    const std::vector<std::vector<double>> whole_up_to = whole_tops(rays, corners);
    Layer layer = build_layer(rays, corners, divide_fronts(layered, corners, options, {}, whole_up_to));
    if (rays.enabled) layer.coverage = layer_coverage(rays);
    layer.growth = rays.growth;
    layer.jagged = rays.jagged;
    layer.edges = layer_edges(layer);
    return layer;
}

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth,
                 const BorderOptions& border) {
    return close_border(grow_rays(geometry, options, growth), border);
}

Layer make_layer(const Geometry& geometry, const LayerOptions& options, const BorderOptions& border) {
    validate(options);
    return make_layer(geometry, options, layer_growth(options, {.chord = bounding_box(geometry).width()}), border);
}

}  // namespace lamina::layers
