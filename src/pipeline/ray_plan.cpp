#include "pipeline/ray_plan.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "decoupling/far_field.hpp"
#include "layers/mechanisms.hpp"
#include "layers/stages.hpp"
#include "pipeline/wake_sizes.hpp"

namespace lamina::pipeline {

namespace {

/// Throws OptionError where the bodies fit into the far field, but not with their layers: the heights are wrong then,
/// rather than the far field.
void require_room_for_layers(const Geometry& geometry, const std::vector<std::vector<Point>>& fronts,
                             const FarField& far_field, const LayerOptions& options, const LayerGrowth& growth) {
    const Box bodies = bounding_box(geometry), domain = far_field.box();
    Box with_layers = bodies;
    for (const std::vector<Point>& front : fronts)
        for (const Point p : front) with_layers.include(p);
    if (!decoupling::leaves_room(far_field, bodies) || decoupling::leaves_room(far_field, with_layers)) return;
    const bool by_y_plus = std::holds_alternative<YPlus>(options.first_height);
    const double thickness = std::max({bodies.lower.x - with_layers.lower.x, bodies.lower.y - with_layers.lower.y,
                                       with_layers.upper.x - bodies.upper.x, with_layers.upper.y - bodies.upper.y});
    const double distance = std::min({bodies.lower.x - domain.lower.x, bodies.lower.y - domain.lower.y,
                                      domain.upper.x - bodies.upper.x, domain.upper.y - bodies.upper.y});
    throw OptionError(
        by_y_plus ? "y_plus" : "first_height",
        fmt::format("a first height of {:.4g}{} {} a layer that is {:.4g} thick, but the far field is "
                    "only {:.4g} away: lower the first height, {}the growth ({:.4g}), or set a thickness",
                    largest_first_height(growth), growth.layers ? fmt::format(" and {} layers", *growth.layers) : "",
                    growth.layers ? "make" : "makes", thickness, distance,
                    growth.layers ? "the number of layers or " : "", growth.growth));
}

/// Returns circles round the triangles with an angle below the bound that no sharp corner excuses. They hold the ends of
/// the rays beside.
std::vector<layers::Circle> circles_round_unexcused(std::span<const mesh::NarrowTriangle> narrow) {
    constexpr double reach = 1.5;  // in longest edges
    std::vector<layers::Circle> circles;
    for (const mesh::NarrowTriangle& triangle : narrow) {
        const auto [a, b, c] = triangle.corners;
        circles.push_back(
            {(1.0 / 3) * (a + b + c), reach * std::max({distance(a, b), distance(b, c), distance(c, a)})});
    }
    return circles;
}

bool same_points(const Geometry& a, const Geometry& b) {
    return std::equal(a.elements.begin(), a.elements.end(), b.elements.begin(), b.elements.end(),
                      [](const Element& first, const Element& second) { return first.points == second.points; });
}

/// Returns the sizes that the options, the fronts of these rays and the wakes behind their layers request. Where a
/// background mesh decides on sizes, wakes request them of borders alone.
SizeRequests request_sizes(SizingOptions options, const SizedBodies& bodies, const layers::Rays& rays,
                           std::span<const ElementWake> wakes, const Box& domain) {
    std::vector<SizeSource> along_wakes;
    for (std::size_t e = 0; e < wakes.size(); ++e) {
        const std::size_t first = along_wakes.size();
        for (const auto* sources : {&wakes[e].outer, &wakes[e].inner, &wakes[e].mixing})
            for (const WakeSource& wake : *sources)
                if (wake.begins >= rays.wake_lengths[e]) along_wakes.push_back(wake.source);
        fit_wake_to_layer(rays, e, border_gradation(field_gradation(options)), std::span(along_wakes).subspan(first));
    }
    const bool decided = decides_on_sizes(options);
    if (!decided) options.sources.insert(options.sources.end(), along_wakes.begin(), along_wakes.end());
    SizeRequests requests = gather_size_requests(options, bodies, layers::fronts(rays), domain);
    if (decided) requests.at_borders.insert(requests.at_borders.end(), along_wakes.begin(), along_wakes.end());
    return requests;
}

/// Counts the rays whose front is lower than it was at first, and finds the one that lost most of its height.
void count_thinned(RayPlan& plan) {
    plan.thinned_rays = 0;
    double least_share = 1;
    for (std::size_t i = 0; i < plan.first_front.size(); ++i) {
        const double before = plan.first_front[i];
        if (plan.rays.front[i] >= before) continue;
        ++plan.thinned_rays;
        if (plan.rays.front[i] >= least_share * before) continue;
        least_share = plan.rays.front[i] / before;
        plan.thinned_at = plan.rays.set.lines[i].origin;
    }
}

/// Requests sizes anew, since the fronts are others.
void renew_requests(const CaseOptions& options, RayPlan& plan) {
    plan.requests = request_sizes(options.sizing, sized_bodies(plan.geometry, plan.conditions), plan.rays, plan.wakes,
                                  plan.far_field.box());
}

/// Returns whether all rays have all layers that were requested.
bool all_layers_fit(const layers::Rays& rays) {
    for (std::size_t i = 0; i < rays.counts.size(); ++i)
        if (rays.counts[i] < rays.heights.column(i).asked_layers) return false;
    return true;
}

}  // namespace

RayPlan plan_rays(Geometry geometry, const ReferenceConditions& conditions, const CaseOptions& options,
                  const LayerGrowth& growth, std::vector<ElementWake> wakes) {
    FarField far_field = place_far_field(bounding_box(geometry), conditions.chord, options.far_field);
    layers::Rays rays = layers::grow_rays(geometry, options.layer, growth);
    if (options.layer.enabled)
        require_room_for_layers(geometry, layers::fronts(rays), far_field, options.layer, growth);
    SizeRequests requests =
        request_sizes(options.sizing, sized_bodies(geometry, conditions), rays, wakes, far_field.box());
    std::vector<double> front = rays.front;
    return {.geometry = std::move(geometry),
            .conditions = conditions,
            .far_field = std::move(far_field),
            .rays = std::move(rays),
            .requests = std::move(requests),
            .wakes = std::move(wakes),
            .first_front = std::move(front)};
}

void refine_walls_below_borders(const Geometry& given, const CaseOptions& options, SpacingLimits limits,
                                const LayerGrowth& growth, RayPlan& plan) {
    constexpr int max_rounds = 3;
    if (!options.layer.enabled || !layers::uses("refine_walls")) return;
    for (int round = 0; round < max_rounds; ++round) {
        const std::vector<WallSpacing> finer = layers::wall_spacings(
            plan.rays, wall_border_options(options, plan.conditions.chord, plan.requests.at_borders));
        if (finer.empty()) return;
        limits.walls.insert(limits.walls.end(), finer.begin(), finer.end());
        Geometry prepared = prepare_surfaces(given, options.surface, limits, plan.conditions.chord);
        if (same_points(prepared, plan.geometry)) return;  // the rest are stretches that keep their given points
        plan = plan_rays(std::move(prepared), plan.conditions, options, growth, std::move(plan.wakes));
    }
}

void end_columns_below_obtuse_cells(const CaseOptions& options, RayPlan& plan) {
    constexpr int max_rounds = 7, max_rounds_without_gain = 3;
    // Cells far from the wall go first: what ends below cells in a cleft can be worse than these, and would hide the gain.
    constexpr std::uint16_t far_from_wall = 10, above_first = 1;
    // Where all layers are made, nothing is in their way; equal numbers of layers are a promise.
    if (!layers::uses("end_obtuse") || !options.layer.enabled || options.layer.fan_rays || all_layers_fit(plan.rays))
        return;
    const auto obtuse_cells_of = [&](const layers::Rays& rays) {
        const Layer layer =
            layers::close_border(rays, border_options(options, plan.conditions.chord, plan.requests.at_borders));
        return layers::obtuse_cells(layer, fill_layer(layer, options.layer.topology, options.decomposition),
                                    largest_layer_angle_deg);
    };
    std::vector<layers::ObtuseCell> fewest = obtuse_cells_of(plan.rays);
    bool is_changed = false;
    for (const std::uint16_t above : {far_from_wall, above_first}) {
        layers::Rays rays = plan.rays;
        std::vector<layers::ObtuseCell> obtuse = fewest;
        for (int round = 0, without_gain = 0; round < max_rounds && without_gain < max_rounds_without_gain; ++round) {
            std::erase_if(obtuse, [&](const layers::ObtuseCell& cell) { return cell.layer <= above; });
            if (!layers::end_columns_below(obtuse, rays)) break;
            obtuse = obtuse_cells_of(rays);
            ++without_gain;
            if (obtuse.size() >= fewest.size()) continue;
            fewest = obtuse;
            plan.rays = rays;
            is_changed = true;
            without_gain = 0;
        }
    }
    if (!is_changed) return;
    count_thinned(plan);
    renew_requests(options, plan);
}

bool make_room_at_narrow_triangles(std::span<const mesh::NarrowTriangle> narrow, bool thin, const CaseOptions& options,
                                   RayPlan& plan) {
    // Where no layer is thinned, the borders' edges become this share of the circles' radii.
    constexpr double edge_share = 0.3;
    if (!options.layer.enabled || narrow.empty() || !layers::uses("make_room")) return false;
    const std::vector<layers::Circle> places = circles_round_unexcused(narrow);
    std::vector<std::size_t> ends(places.size(), 0);
    if (thin) ends = layers::shorten_rays(places, plan.rays);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Point at = places[k].middle;
        if (ends[k] == 0) plan.short_edges.push_back({.a = at, .b = at, .size = edge_share * places[k].radius});
    }
    count_thinned(plan);
    renew_requests(options, plan);
    plan.requests.at_borders.insert(plan.requests.at_borders.end(), plan.short_edges.begin(), plan.short_edges.end());
    return true;
}

}  // namespace lamina::pipeline
