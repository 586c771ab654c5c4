// A mesh before it is made: the stages up to the border of the layer, and an estimate of the triangles beyond.
#include <lamina/forecast.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <lamina/threads.hpp>

#include "core/limits.hpp"
#include "layers/growth.hpp"
#include "pipeline/budget.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/run.hpp"

namespace lamina::pipeline {

namespace {

/// Returns the number of cells between two neighbouring rays: triangles have a side of one ray each, unless they stand
/// on one point, and quadrilaterals join two of these.
double cells_between(const layers::Ray& a, const layers::Ray& b, LayerTopology topology) {
    if (topology == LayerTopology::quads) return std::max(a.layers, b.layers);
    const double sides = a.layers + b.layers;
    return a.origin == b.origin ? std::max(0.0, sides - 1) : sides;
}

double count_layer_cells(const layers::Layer& layer, LayerTopology topology) {
    double cells = 0;
    for (std::size_t e = 0; e < layer.rays.size(); ++e) {
        const std::vector<layers::Ray>& rays = layer.rays[e];
        for (std::size_t i = 0; i + 1 < rays.size(); ++i) cells += cells_between(rays[i], rays[i + 1], topology);
        const bool is_loop = e + layer.outer_walls < layer.rays.size();
        if (is_loop && !rays.empty()) cells += cells_between(rays.back(), rays.front(), topology);
    }
    return cells;
}

double thickness_on(const layers::Layer& layer, std::size_t element) {
    double thickness = 0;
    for (const layers::Ray& ray : layer.rays[element])
        if (ray.place == layers::RayPlace::wall)
            thickness = std::max(
                thickness, distance(layer.points[ray.origin.index()], layer.points[ray.vertex(ray.layers).index()]));
    return thickness;
}

/// A piece of a wall, and the skin friction there.
struct FrictionOnWall {
    double friction, length;
};

std::vector<FrictionOnWall> friction_along(const ElementFlow& flow) {
    std::vector<FrictionOnWall> pieces;
    for (const std::vector<FlowPoint>* side : {&flow.upper, &flow.lower})
        for (std::size_t i = 1; i < side->size(); ++i)
            pieces.push_back({(*side)[i].skin_friction, (*side)[i].s - (*side)[i - 1].s});
    return pieces;
}

/// Returns the friction below which it is along half of the wall. Precondition: there is a piece.
double median_friction(std::vector<FrictionOnWall> pieces) {
    std::sort(pieces.begin(), pieces.end(),
              [](const FrictionOnWall& a, const FrictionOnWall& b) { return a.friction < b.friction; });
    double length = 0;
    for (const FrictionOnWall& piece : pieces) length += piece.length;
    double before = 0;
    for (const FrictionOnWall& piece : pieces)
        if ((before += piece.length) >= 0.5 * length) return piece.friction;
    return pieces.back().friction;
}

/// Returns y+ on a wall where the flow is known. Compressible flow before the mesh has the largest friction, and where
/// the wall has less, the incompressible flow says how much less.
YPlusRange y_plus_on(const ElementFlow& flow, double largest_friction, double first_height,
                     const ReferenceConditions& conditions) {
    const std::vector<FrictionOnWall> pieces = friction_along(flow);
    const double at_largest =
        first_height * *conditions.reynolds / conditions.chord * std::sqrt(0.5 * largest_friction);
    const auto at = [&](double friction) {
        return at_largest * std::sqrt(std::clamp(friction / largest_skin_friction(flow), 0.0, 1.0));
    };
    const auto least =
        std::min_element(pieces.begin(), pieces.end(),
                         [](const FrictionOnWall& a, const FrictionOnWall& b) { return a.friction < b.friction; });
    return {at(least->friction), at(median_friction(pieces)), at_largest};
}

/// Returns y+ on a wall: by the flow, if there is one with boundary layers, or on a flat plate.
std::optional<YPlusRange> y_plus_on(const MeshResult& result, std::size_t element, double first_height) {
    const ReferenceConditions& conditions = result.conditions;
    if (!conditions.reynolds) return {};
    if (!result.flow || result.flow->estimated) {
        const double on_plate = first_height / layers::first_height_for(1, *conditions.reynolds, conditions.chord);
        return YPlusRange{on_plate, on_plate, on_plate};
    }
    const ElementFlow& flow = result.flow->elements[element];
    const std::vector<double>& frictions = result.decisions.frictions;
    return y_plus_on(flow, frictions.empty() ? largest_skin_friction(flow) : frictions[element], first_height,
                     conditions);
}

/// Runs the stages up to the estimate: run() without cells.
MeshForecast forecast(const Geometry& geometry, const CaseOptions& options, StageClock& clock) {
    PlannedLayer plan = plan_layer(geometry, options, core::mesh_cost, clock);
    MeshForecast forecast;
    MeshResult& result = forecast.result;
    const OutlinedMesh outlined = outline_mesh(plan.fitted, options.layer, options.surface, clock, result);
    const layers::Layer& layer = outlined.layer;
    result.estimate =
        estimate_within_limits(options.refine, options.order, options.sizing.gradation, layer,
                               outlined.outer(plan.fitted, options.decoupling), {options.limits, core::mesh_cost});
    clock.end(&StageSeconds::sizing);
    hand_over_decisions(plan, result);
    result.threads = thread_count();
    result.seconds = clock.seconds();

    forecast.cells_beyond = triangles_beyond_layer(result.estimate, layer);
    double triangles = forecast.cells_beyond;
    if (options.layer.enabled) {
        forecast.layer_cells = count_layer_cells(layer, options.layer.topology);
        triangles += count_layer_cells(layer, LayerTopology::layered);
        for (std::size_t e = 0; e < result.first_heights.size(); ++e) {
            const double height = result.first_heights[e];
            forecast.walls.push_back({result.geometry.elements[e].name, height, thickness_on(layer, e), {}});
            if (layer.growth.wall_first_heights.empty()) forecast.walls.back().y_plus = y_plus_on(result, e, height);
        }
    }
    // Euler's formula, but for the far field, which has few vertices.
    forecast.vertices = 0.5 * (triangles + static_cast<double>(result.surface_vertices));
    return forecast;
}

/// Returns the forecast of the scale with which there are as many vertices or cells as the options say.
MeshForecast forecast_within_budget(const Geometry& geometry, const CaseOptions& options, StageClock& clock) {
    MeshForecast last;
    const double wanted = static_cast<double>(options.vertices ? *options.vertices : *options.cells);
    const auto make = [&](double scale) {
        last = forecast(geometry, with_scale(options, scale), clock);
        return MeshResult{};
    };
    const auto count = [&](const MeshResult&) {
        return options.vertices ? last.vertices : last.layer_cells + last.cells_beyond;
    };
    const double scale = mesh_of_count(wanted, make, count).scale;
    last = forecast(geometry, with_scale(options, scale), clock);
    last.result.scale = scale;
    return last;
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

MeshForecast forecast_mesh(const Geometry& geometry, const CaseOptions& options, const Progress& progress) {
    validate(options);
    MeshForecast result;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        result =
            has_budget(options) ? forecast_within_budget(geometry, options, clock) : forecast(geometry, options, clock);
    });
    return result;
}

MeshForecast forecast_mesh(const std::vector<std::string>& inputs, const CaseOptions& options,
                           const Progress& progress) {
    validate(options);
    return forecast_mesh(read_inputs(inputs, options.geometry, options.far_field), options, progress);
}

}  // namespace lamina
