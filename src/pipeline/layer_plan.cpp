// From the geometry to rays: what is known before the first cell is made.
#include "pipeline/layer_plan.hpp"

#include <algorithm>
#include <utility>

#include "decoupling/far_field.hpp"
#include "pipeline/curve_mesh.hpp"
#include "pipeline/derived_options.hpp"
#include "pipeline/internal_lines.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/solution_guidance.hpp"
#include "sizing/requests.hpp"

namespace lamina::pipeline {

namespace {

/// Returns what the flow decided for a mesh on these rays.
FlowDecisions flow_decisions(const layers::LayerGrowth& growth, std::span<const geometry::WallSpacing> spacings,
                             const FittedLayer& fitted, const SizingOptions& sizing) {
    FlowDecisions decisions;
    if (!growth.layers)
        for (const layers::WallHeight& least : growth.least_heights)
            decisions.least_thickness = std::max(decisions.least_thickness, least.height);
    for (std::size_t e = 0; e < fitted.wakes.size(); ++e) {
        const double with_layers = fitted.rays.wake_lengths[e];
        if (fitted.wakes[e].outer.empty() || (decides_on_sizes(sizing) && with_layers == 0)) continue;
        decisions.wakes.push_back(fitted.wakes[e].wake);
        decisions.wakes.back().with_layers = with_layers;
    }
    decisions.spacings = smallest_spacings(spacings, fitted.geometry);
    return decisions;
}

/// Prepares walls for the layer that is to grow on them. Throws LimitError where they or the options ask for too much.
PreparedWalls prepare_walls(const Geometry& given, const CaseOptions& options, const ReferenceConditions& conditions,
                            const layers::LayerGrowth& growth, std::span<const geometry::WallSpacing> spacings,
                            const WorkBudget& budget) {
    PreparedWalls walls{
        given,
        {},
        spacing_limits(options.layer, growth, wall_gradation(options.sizing, options.fineness), options.order)};
    walls.limits.walls.assign(spacings.begin(), spacings.end());
    walls.prepared = surface::prepare_with_curves(given, options.surface, walls.limits, conditions.chord);
    const decoupling::FarField far_field =
        decoupling::place_far_field(bounding_box(walls.prepared.geometry), conditions.chord, options.far_field);
    sizing::require_within_limits(options.sizing, sized_bodies(walls.prepared.geometry, conditions), far_field.box(),
                                  budget.limits);
    if (options.layer.enabled) {
        require_layers_within(growth, walls.prepared.geometry, budget);
        require_walls_within(options.surface, walls.prepared.geometry, budget);
    }
    return walls;
}

}  // namespace

Geometry read_inputs(const std::vector<std::string>& inputs, GeometryOptions options, const FarFieldOptions& domain) {
    if (domain.symmetry) options.close = true;  // half a section without its chord
    return read_geometry(inputs, options);
}

PlannedLayer plan_layer(const Geometry& whole, CaseOptions options, const WorkCost& cost, StageClock& clock) {
    const Geometry given = part_in_domain(whole, options.far_field, options.conditions);
    refuse_curved_sheets(options.order, given);
    const ReferenceConditions conditions = reference_conditions(options.conditions, reference_box(given));
    options.sizing = sizes_between_borders(wakes_at_angles(std::move(options.sizing), options.conditions),
                                           options.far_field, conditions.chord, options.fineness);
    const std::vector<SizeSource> along_lines = sizes_along(options.lines);
    options.sizing.sources.insert(options.sizing.sources.end(), along_lines.begin(), along_lines.end());
    const WorkBudget budget{options.limits, cost};
    require_surface_points_within(options.surface, given.elements.size(), budget);
    layers::LayerGrowth growth = layers::layer_growth(options.layer, conditions);
    growth.fineness = options.fineness;

    FlowGuidance guidance;
    if (options.use_flow) {
        clock.begin("flow");
        guidance =
            guide_by_flow(given, flow_walls(given, options), options.conditions, options.layer, conditions, growth);
        if (!decides_on_sizes(options.sizing))
            options.sizing.sources.insert(options.sizing.sources.end(), guidance.sources.begin(),
                                          guidance.sources.end());
        clock.end(&StageSeconds::flow);
    }

    if (options.sizing.background && !options.sizing.background->walls.empty()) {
        const std::vector<geometry::WallSpacing> spacings =
            guide_by_solution(options.sizing.background->walls, given, options.layer, conditions, growth);
        guidance.spacings.insert(guidance.spacings.end(), spacings.begin(), spacings.end());
    }

    clock.begin("surface");
    PreparedWalls walls = prepare_walls(given, options, conditions, growth, guidance.spacings, budget);
    clock.end(&StageSeconds::geometry);

    clock.begin("layers");
    FittedLayer fitted = fit_layer(std::move(walls), options, conditions, growth, std::move(guidance.wakes));
    return {std::move(options), std::move(growth), std::move(guidance), std::move(fitted)};
}

void hand_over_decisions(PlannedLayer& plan, MeshResult& result) {
    FlowGuidance& guidance = plan.guidance;
    if (guidance.flow)
        result.warnings.insert(result.warnings.begin(), guidance.flow->warnings.begin(), guidance.flow->warnings.end());
    result.flow = std::move(guidance.flow);
    result.decisions = flow_decisions(plan.growth, guidance.spacings, plan.fitted, plan.options.sizing);
    result.decisions.shocks = std::move(guidance.shocks);
    result.decisions.knows_shocks = guidance.knows_shocks;
    result.decisions.frictions = std::move(guidance.frictions);
    result.decisions.angles = std::move(guidance.angles);
}

}  // namespace lamina::pipeline
