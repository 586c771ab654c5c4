#include "pipeline/run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "decoupling/far_field.hpp"
#include "pipeline/curve_mesh.hpp"
#include "pipeline/derived_options.hpp"
#include "pipeline/internal_lines.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/solution_guidance.hpp"
#include "pipeline/warnings.hpp"
#include "sizing/requests.hpp"

namespace lamina::pipeline {

namespace {

/// Returns what the flow decided for a mesh on these rays.
FlowDecisions flow_decisions(const layers::LayerGrowth& growth, std::span<const geometry::WallSpacing> spacings,
                             const FittedLayer& fitted) {
    FlowDecisions decisions;
    if (!growth.layers)
        for (const layers::WallHeight& least : growth.least_heights)
            decisions.least_thickness = std::max(decisions.least_thickness, least.height);
    const std::vector<ElementWake>& wakes = fitted.sizes.wakes;
    const bool decided = decides_on_sizes(fitted.sizes.options);
    for (std::size_t e = 0; e < wakes.size(); ++e) {
        const double with_layers = fitted.rays.wake_lengths[e];
        if (wakes[e].outer.empty() || (decided && with_layers == 0)) continue;
        decisions.wakes.push_back(wakes[e].wake);
        decisions.wakes.back().with_layers = with_layers;
    }
    decisions.spacings = smallest_spacings(spacings, fitted.geometry);
    return decisions;
}

void add_sources(std::span<const SizeSource> sources, SizingOptions& sizing) {
    sizing.sources.insert(sizing.sources.end(), sources.begin(), sources.end());
}

/// Throws LimitError where walls, layers or sizes ask for more than the limits allow.
void require_plan_within(const PreparedWalls& walls, const LayerRequest& layer, const FarFieldOptions& domain,
                         const SizingOptions& sizing, const ReferenceConditions& conditions, const WorkBudget& budget) {
    const Geometry& prepared = walls.prepared.geometry;
    const decoupling::FarField far_field =
        decoupling::place_far_field(bounding_box(prepared), conditions.chord, domain);
    sizing::require_within_limits(sizing, sized_bodies(prepared, conditions), far_field.box(), budget.limits);
    if (!layer.options.enabled) return;
    require_layers_within(layer.growth, prepared, budget);
    require_walls_within(walls.options, prepared, budget);
}

}  // namespace

Geometry read_inputs(const std::vector<std::string>& inputs, GeometryOptions options, const FarFieldOptions& domain) {
    if (domain.symmetry) options.close = true;  // half a section without its chord
    return read_geometry(inputs, options);
}

PlannedLayer plan_layer(const Geometry& whole, const CaseOptions& options, const WorkCost& cost, StageClock& clock) {
    const Geometry given = part_in_domain(whole, options.far_field, options.conditions);
    refuse_curved_sheets(options.order, given);
    const ReferenceConditions conditions = reference_conditions(options.conditions, given);
    const WorkBudget budget{options.limits, cost};
    require_surface_points_within(options.surface, given.elements.size(), budget);
    SizingOptions sizing = sizes_between_borders(wakes_at_angles(options.sizing, options.conditions), options.far_field,
                                                 conditions.chord, options.fineness);
    add_sources(sizes_along(options.lines), sizing);
    layers::LayerGrowth growth = layers::layer_growth(options.layer, conditions);
    growth.fineness = options.fineness;

    FlowGuidance guidance;
    if (options.use_flow) {
        clock.begin("flow");
        const FlowWalls walls = flow_walls(given, options.conditions, options.far_field);
        guidance = guide_by_flow(given, walls, options.conditions, options.layer, conditions, growth);
        if (!decides_on_sizes(sizing)) add_sources(guidance.sources, sizing);
        clock.end(&StageSeconds::flow);
    }
    if (sizing.background && !sizing.background->walls.empty()) {
        const std::vector<geometry::WallSpacing> spacings =
            guide_by_solution(sizing.background->walls, given, options.layer, conditions, growth);
        guidance.spacings.insert(guidance.spacings.end(), spacings.begin(), spacings.end());
    }

    clock.begin("surface");
    surface::SpacingLimits limits =
        spacing_limits(options.layer, growth, wall_gradation(sizing, options.fineness), options.order);
    limits.walls = guidance.spacings;
    PreparedWalls walls = prepare_walls(given, options.surface, std::move(limits), conditions.chord);
    const LayerRequest layer{options.layer, options.decomposition, growth};
    require_plan_within(walls, layer, options.far_field, sizing, conditions, budget);
    clock.end(&StageSeconds::geometry);

    clock.begin("layers");
    const layers::BorderOptions border = border_options(sizing, options.refine, conditions.chord, {});
    FittedLayer fitted = fit_layer(std::move(walls), layer, {options.far_field, options.lines},
                                   {std::move(sizing), std::move(guidance.wakes), border}, conditions);
    return {std::move(growth), std::move(guidance), std::move(fitted)};
}

MadeMesh make_mesh(const FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver, StageClock& clock) {
    const WorkBudget budget{options.limits, driver.cost()};
    const double min_angle_deg = options.refine.min_angle_deg;
    MadeMesh made;
    MeshResult& result = made.result;
    const OutlinedMesh outlined = outline_mesh(fitted, options.layer, options.surface, clock, result);
    const layers::Layer& layer = outlined.layer;
    const decoupling::OuterRegion outer = outlined.outer(fitted, options.decoupling);
    made.constraints = layer.edges.interfaces;
    std::optional<RunEstimate> estimate;
    driver.lead([&] {
        estimate =
            estimate_within_limits(options.refine, options.order, options.sizing.gradation, layer, outer, budget);
        result.estimate = *estimate;
    });
    clock.end(&StageSeconds::sizing);

    clock.begin("decoupling", estimate);
    const DecoupledBorders borders =
        driver.decouple(outer, refine_within(options.refine, fitted.conditions.chord, budget),
                        triangles_beyond_layer(result.estimate, layer));
    std::vector<Marker> markers =
        markers_of_mesh(fitted, outlined, options.assemble, options.far_field, borders, driver);
    clock.end(&StageSeconds::decoupling);

    clock.begin("layer triangulation, refinement and check of pieces");
    mesh::PiecewiseCheck check(borders.points, options_of_check(fitted, layer, min_angle_deg, result, markers),
                               driver.matched_elsewhere(outlined.region.points.size()));
    core::BusyTimes times;
    MadePieces pieces =
        driver.make({layer, options.layer.topology, options.decomposition, markers, check, times, clock});
    result.threads = thread_count();
    result.thread_seconds = clock.end_shared(times);

    clock.begin("check");
    driver.lead([&] { finish_check(check, pieces, markers, made); });
    driver.tell_narrow(made.narrow);
    clock.end(&StageSeconds::check);

    clock.begin("assembly");
    require_made_within(budget, pieces.counts);
    take_cells(layer, pieces, result);
    result.mesh.markers = std::move(markers);
    if (!pieces.sink) complete_walls_without_thickness(options.lines, min_angle_deg, made);
    const WorstPlaces places{check.widest().middle, check.narrowest().middle, pieces.summary.oversized.middle,
                             made.narrow, min_angle_deg};
    driver.lead([&] {
        result.warnings = warnings_of_input(result, options.surface, options.conditions, options.assemble);
        const std::vector<Warning> of_mesh = warnings_of_mesh(result, options.layer, places, pieces.layer);
        result.warnings.insert(result.warnings.end(), of_mesh.begin(), of_mesh.end());
    });
    driver.keep_parts(pieces);
    hand_over(pieces, made);
    clock.end(&StageSeconds::assembly);
    return made;
}

namespace {

/// Makes meshes on shorter rays and with shorter edges of borders, for as long as fewer and fewer triangles have an
/// angle below the bound that no sharp corner excuses, and returns the best. A bound above the proved one is no
/// promise, so nothing is done for it. Room for one triangle takes some from others: two rounds that leave more than
/// nine tenths of them end the search, and twelve in any case.
MadeMesh make_mesh_until_angles_hold(FittedLayer& fitted, const CaseOptions& options, MeshDriver& driver,
                                     StageClock& clock) {
    constexpr int max_rounds_without_gain = 2, max_rounds = 12;
    constexpr double gain = 0.9;
    MadeMesh best = make_mesh(fitted, options, driver, clock);
    if (options.refine.min_angle_deg > proved_min_angle_deg) return best;
    std::vector<mesh::NarrowTriangle> narrow = best.narrow;
    int without_gain = 0;
    for (int round = 0; round < max_rounds && without_gain < max_rounds_without_gain; ++round) {
        // In a slot with one row of triangles, thinner layers move a triangle that misses the bound along the slot.
        if (!make_room_at_narrow_triangles(narrow, without_gain == 0, fitted)) break;
        clock.begin("layers, thinned");
        MadeMesh next;
        try {
            next = make_mesh(fitted, options, driver, clock);
        } catch (const RankFailure&) {
            break;  // the best mesh so far is valid
        } catch (const Error& error) {
            driver.fail(error);
            break;
        }
        narrow = next.narrow;
        const auto before = static_cast<double>(best.narrow.size()), after = static_cast<double>(narrow.size());
        without_gain = after <= gain * before ? 0 : without_gain + 1;
        if (after < before) best = std::move(next);
    }
    return best;
}

}  // namespace

void hand_over_decisions(PlannedLayer& plan, MeshResult& result) {
    FlowGuidance& guidance = plan.guidance;
    if (guidance.flow)
        result.warnings.insert(result.warnings.begin(), guidance.flow->warnings.begin(), guidance.flow->warnings.end());
    result.flow = std::move(guidance.flow);
    result.compressible_flow = std::move(guidance.compressible);
    result.decisions = flow_decisions(plan.growth, guidance.spacings, plan.fitted);
    result.decisions.shocks = std::move(guidance.shocks);
    result.decisions.knows_shocks = guidance.knows_shocks;
    result.decisions.frictions = std::move(guidance.frictions);
    result.decisions.angles = std::move(guidance.angles);
}

MadeMesh run(const Geometry& whole, const CaseOptions& options, MeshDriver& driver, StageClock& clock) {
    PlannedLayer plan = plan_layer(whole, options, driver.cost(), clock);
    MadeMesh made = make_mesh_until_angles_hold(plan.fitted, options, driver, clock);

    MeshResult& result = made.result;
    if (options.order > 1) {
        clock.begin("curving");
        curve_mesh({options.order, options.node_distribution}, *plan.fitted.curves, result);
        clock.end(&StageSeconds::curving);
    }
    hand_over_decisions(plan, result);
    result.seconds = clock.seconds();
    return made;
}

}  // namespace lamina::pipeline
