#include "pipeline/ray_plan.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/cell_shape.hpp"
#include "decoupling/far_field.hpp"
#include "mesh/isotropic_cells.hpp"

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
                    growth.first_height, growth.layers ? fmt::format(" and {} layers", *growth.layers) : "",
                    growth.layers ? "make" : "makes", thickness, distance,
                    growth.layers ? "the number of layers or " : "", growth.growth));
}

/// Returns circles round the isotropic triangles with an angle below the bound. They hold the ends of the rays beside.
std::vector<Circle> narrow_triangles(const Mesh& mesh, double min_angle_deg) {
    constexpr double reach = 1.5;  // in longest edges
    std::vector<Circle> circles;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (!mesh::is_isotropic(mesh, t)) continue;
        const auto corner = [&](int i) { return mesh.points[mesh.triangles[t].v[i].index()]; };
        const Point a = corner(0), b = corner(1), c = corner(2);
        if (core::measure_triangle(a, b, c).min_angle_deg >= min_angle_deg) continue;
        circles.push_back(
            {(1.0 / 3) * (a + b + c), reach * std::max({distance(a, b), distance(b, c), distance(c, a)})});
    }
    return circles;
}

}  // namespace

RayPlan plan_rays(Geometry geometry, double chord, const CaseOptions& options, const LayerGrowth& growth) {
    FarField far_field = place_far_field(bounding_box(geometry), options.far_field);
    Rays rays = grow_rays(geometry, options.layer, growth);
    const auto tips = fronts(rays);
    if (options.layer.enabled) require_room_for_layers(geometry, tips, far_field, options.layer, growth);
    SizeRequests requests = gather_size_requests(options.sizing, sized_bodies(geometry), tips, far_field.box());
    return {std::move(geometry), chord, std::move(far_field), std::move(rays), std::move(requests)};
}

void refine_walls_below_borders(const Geometry& given, const CaseOptions& options, SpacingLimits limits,
                                const LayerGrowth& growth, RayPlan& plan) {
    constexpr int max_rounds = 3;
    if (!options.layer.enabled) return;
    for (int round = 0; round < max_rounds; ++round) {
        const std::vector<WallSpacing> finer =
            wall_spacings(plan.rays, wall_border_options(options, plan.requests.at_borders));
        if (finer.empty()) return;
        limits.walls.insert(limits.walls.end(), finer.begin(), finer.end());
        plan = plan_rays(prepare_surfaces(given, options.surface, limits), plan.chord, options, growth);
    }
}

bool make_room_at_narrow_triangles(const MeshResult& result, const CaseOptions& options, RayPlan& plan) {
    // Where no layer is left to be thinned, the borders' edges are shortened to this share of the triangles'.
    constexpr double edge_share = 0.3;
    const QualitySummary& quality = result.check.isotropic;
    if (!options.layer.enabled || quality.angles_below_bound == quality.exempt) return false;
    const std::vector<Circle> narrow = narrow_triangles(result.mesh, options.refine.min_angle_deg);
    const std::size_t shortened = shorten_rays(narrow, plan.rays);
    if (shortened > 0) {
        plan.requests =
            gather_size_requests(options.sizing, sized_bodies(plan.geometry), fronts(plan.rays), plan.far_field.box());
        plan.thinned_rays += shortened;
    } else {
        for (const Circle& place : narrow)
            plan.short_edges.push_back({.a = place.middle, .b = place.middle, .size = edge_share * place.radius});
    }
    plan.requests.at_borders.insert(plan.requests.at_borders.end(), plan.short_edges.begin(), plan.short_edges.end());
    return true;
}

}  // namespace lamina::pipeline
