// Runs the stages in their order, times them and announces them.
#include <lamina/pipeline.hpp>

#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <lamina/threads.hpp>

#include "core/busy_times.hpp"
#include "core/parallel.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/refine_all.hpp"
#include "layers/fill.hpp"
#include "mesh/isotropic_cells.hpp"
#include "pipeline/flow_guidance.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/ray_plan.hpp"
#include "pipeline/warnings.hpp"

namespace lamina::pipeline {

namespace {

/// Kinds of work that share the threads: those of delaunay::pieces in the layer, and the refinement of subdomains.
enum SharedWork : std::size_t {
    decomposition_work = delaunay::pieces::cutting,
    layer_work = delaunay::pieces::triangulating,
    refinement_work
};

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Announces the stages and measures their times.
class StageClock {
public:
    explicit StageClock(const Progress& progress) : progress_(progress), start_(seconds_now()), last_(start_) {}
    void begin(const std::string& stage, std::optional<RunEstimate> estimate = {}) const {
        if (progress_) progress_({stage, estimate});
    }
    /// Returns the seconds since the last call.
    double lap() {
        const double now = seconds_now();
        return now - std::exchange(last_, now);
    }
    double total() const { return seconds_now() - start_; }

private:
    const Progress& progress_;
    double start_, last_;
};

/// Records the times of the threads over `elapsed` seconds in which they shared several kinds of work, and divides
/// these seconds among the kinds.
void record_shared_times(const core::BusyTimes& times, double elapsed, StageSeconds& seconds,
                         std::vector<ThreadSeconds>& thread_seconds) {
    ThreadSeconds sum;
    for (std::size_t i = 0; i < times.threads(); ++i) {
        const ThreadSeconds thread{times.seconds(i, decomposition_work), times.seconds(i, layer_work),
                                   times.seconds(i, refinement_work), times.idle(i, elapsed)};
        sum.decomposition += thread.decomposition;
        sum.layer_triangulation += thread.layer_triangulation;
        sum.refinement += thread.refinement;
        thread_seconds.push_back(thread);
    }
    const double all = sum.decomposition + sum.layer_triangulation + sum.refinement;
    const double share = all > 0 ? elapsed / all : 0;
    seconds.decomposition += share * sum.decomposition;
    seconds.layer_triangulation += share * sum.layer_triangulation;
    seconds.refinement += share * sum.refinement;
}

/// Records the results of the refinement, and how good the estimates of the numbers of triangles were.
void summarize_refinement(std::span<const Subdomain> subdomains, std::span<const Refinement> refinements,
                          MeshResult& result) {
    result.inviscid_pieces = refinements.size();
    std::size_t good_estimates = 0;
    for (std::size_t i = 0; i < refinements.size(); ++i) {
        result.refinement += refinements[i].stats;
        const std::size_t made = refinements[i].triangles.size();
        result.largest_inviscid_piece = std::max(result.largest_inviscid_piece, made);
        const auto triangles = static_cast<double>(made);
        good_estimates += std::abs(subdomains[i].estimated_triangles - triangles) <= 0.15 * triangles;
    }
    if (!refinements.empty())
        result.estimates_within_15_percent =
            static_cast<double>(good_estimates) / static_cast<double>(refinements.size());
}

void summarize_layer(const Layer& layer, const LayerCells& cells, const LayerOptions& options, MeshResult& result) {
    result.layer_pieces = cells.pieces();
    result.decomposition = cells.decomposition;
    result.layer_grid_refused = cells.grid_refused;
    for (const auto& wall : layer.walls) result.surface_vertices += wall.size();
    result.layer_coverage = layer.coverage;
    if (!options.enabled) return;
    result.border_steps = border_steps(layer);
    for (std::size_t e = 0; e < layer.walls.size(); ++e)
        result.first_heights.push_back(layer.growth.first_height_on(e));
    if (const auto* y_plus = std::get_if<YPlus>(&options.first_height)) result.y_plus = *y_plus;
}

/// Records which column each cell of the layer belongs to, and where columns stand.
void record_columns(const Layer& layer, const LayerCells& cells, MeshResult& result) {
    if (cells.triangle_column.empty() && cells.quad_column.empty()) return;
    result.columns = cells.triangle_column;
    result.columns.insert(result.columns.end(), cells.quad_column.begin(), cells.quad_column.end());
    for (const std::vector<Ray>& rays : layer.rays)
        for (const Ray& ray : rays) result.column_origins.push_back(ray.origin);
}

void require_valid(const MeshCheck& check) {
    if (check.valid()) return;
    const MeshDefect& first = check.defects.front();
    throw MeshError(
        fmt::format("the mesh made is not valid: {} near ({}, {}){}", first.description, first.at.x, first.at.y,
                    check.defect_count > 1 ? fmt::format(", and {} more", check.defect_count - 1) : ""),
        first.at);
}

/// Returns the heights that first cells should have on each marker of the mesh. The marker of the base of an element
/// follows that of the element.
std::vector<double> first_heights_of_markers(const MeshResult& result) {
    std::vector<double> heights;
    if (result.first_heights.empty()) return heights;
    std::size_t next = 0;
    for (const Marker& marker : result.mesh.markers) {
        if (next < result.geometry.elements.size() && marker.name == result.geometry.elements[next].name) ++next;
        heights.push_back(result.first_heights[next - 1]);
    }
    return heights;
}

/// Returns the mean length of isotropic edges over h at their middles, of evenly chosen triangles: so many that the
/// mean is known within 0.5 %. Returns 0 where there are none.
double mean_edge_over_size(const Mesh& mesh, const SizeField& size) {
    constexpr std::size_t sampled_triangles = 4096;
    const std::size_t stride = 1 + mesh.triangles.size() / sampled_triangles;
    double sum = 0;
    std::size_t edges = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += stride) {
        if (!mesh::is_isotropic(mesh, t)) continue;
        const auto& v = mesh.triangles[t].v;
        for (unsigned e = 0; e < 3; ++e) {
            const Point a = mesh.points[v[e].index()], b = mesh.points[v[(e + 1) % 3].index()];
            sum += distance(a, b) / size(midpoint(a, b));
        }
        edges += 3;
    }
    return edges > 0 ? sum / static_cast<double>(edges) : 0.0;
}

/// Makes the mesh on these rays: the stages from the layer's border to the check. `seconds` holds the times so far;
/// `announce_estimate` says whether the estimate is part of the progress.
MeshResult mesh_on_rays(const RayPlan& plan, const CaseOptions& options, StageClock& clock, StageSeconds seconds,
                        bool announce_estimate) {
    MeshResult result;
    result.geometry = plan.geometry;
    result.conditions = plan.conditions;
    result.thinned_rays = plan.thinned_rays;
    result.thinned_at = plan.thinned_at;
    const Layer layer =
        close_border(plan.rays, border_options(options, plan.conditions.chord, plan.requests.at_borders));
    seconds.layers += clock.lap();

    clock.begin("sizing");
    const SizeField size = make_size_field(border_loops(layer), plan.requests.sources, options.sizing,
                                           plan.conditions.chord, plan.far_field.box());
    result.estimate = estimate_within_limits(options, layer, size, plan.far_field);
    seconds.sizing += clock.lap();

    clock.begin("decoupling", announce_estimate ? std::optional(result.estimate) : std::nullopt);
    Decoupling decoupling = decouple(layer.points, layer.borders, size, plan.far_field, options.decoupling,
                                     refine_options(options, plan.conditions.chord));
    seconds.decoupling += clock.lap();

    // Each of the first cuts of the layer occupies one thread, so the other threads refine meanwhile (thesis 6.6).
    clock.begin("layer triangulation and refinement");
    LayerCells cells;
    std::vector<Refinement> refinements;
    core::BusyTimes times;
    core::parallel_invoke(
        [&] { cells = layers::fill(layer, options.layer.topology, options.decomposition, &times); },
        [&] { refinements = decoupling::refine_all(decoupling.subdomains, &times, refinement_work); });
    record_shared_times(times, clock.lap(), seconds, result.thread_seconds);

    clock.begin("assembly");
    result.threads = thread_count();
    summarize_layer(layer, cells, options.layer, result);
    record_columns(layer, cells, result);
    summarize_refinement(decoupling.subdomains, refinements, result);
    result.mesh = assemble(plan.geometry, layer, std::move(cells), std::move(decoupling), std::move(refinements),
                           options.assemble);
    if (options.far_field.tunnel || options.far_field.ground)
        mark_slip_walls(result.mesh, plan.far_field, options.far_field.ground.has_value());
    if (options.inlet_outlet || options.far_field.tunnel) split_far_field(result.mesh, result.conditions.alpha_deg);
    require_made_within(options.limits, result.mesh);
    seconds.assembly += clock.lap();

    clock.begin("check");
    MeshCheckOptions check_options{.min_angle_deg = options.refine.min_angle_deg};
    check_options.first_heights = first_heights_of_markers(result);
    result.check = check_mesh(result.mesh, check_options);
    require_valid(result.check);
    result.mean_edge_over_size = mean_edge_over_size(result.mesh, size);
    result.warnings = find_warnings(result, options, size);
    seconds.check += clock.lap();
    result.seconds = seconds;
    return result;
}

/// Replaces the mesh by others, on shorter rays and with shorter edges of borders, for as long as fewer and fewer
/// triangles have an angle below the bound that no sharp corner excuses. A bound above the proved one is no promise, so
/// nothing is done for it.
void make_room(const CaseOptions& options, RayPlan& plan, StageClock& clock, MeshResult& best) {
    constexpr int max_rounds_without_gain = 2, max_rounds = 12;
    constexpr double gain = 0.9;  // the share of such triangles that a round must leave at most
    if (options.refine.min_angle_deg > proved_min_angle_deg) return;
    MeshResult next;
    const MeshResult* last = &best;
    int rounds_without_gain = 0;
    for (int round = 0; round < max_rounds && rounds_without_gain < max_rounds_without_gain; ++round) {
        const StageSeconds seconds = last->seconds;
        if (!make_room_at_narrow_triangles(*last, options, plan)) return;
        next = {};  // so that no more than two meshes are held
        clock.begin("layers, thinned");
        try {
            next = mesh_on_rays(plan, options, clock, seconds, false);
        } catch (const Error&) {
            return;  // the best mesh so far is valid
        }
        last = &next;
        const auto before = static_cast<double>(best.check.isotropic.unexcused()),
                   after = static_cast<double>(next.check.isotropic.unexcused());
        rounds_without_gain = after <= gain * before ? 0 : rounds_without_gain + 1;
        if (after < before) {
            best = std::move(next);
            last = &best;
        } else {
            best.seconds = next.seconds;
        }
    }
}

/// Puts what the flow decides into the growth of the layer.
void guide_growth(const Flow& flow, std::span<const ElementWake> wakes, const LayerOptions& options,
                  const ReferenceConditions& conditions, LayerGrowth& growth) {
    if (!options.enabled) return;
    if (const auto* y_plus = std::get_if<YPlus>(&options.first_height); y_plus && !flow.estimated)
        growth.first_heights =
            layer_growth(options, conditions, first_heights_of_flow(flow, y_plus->y_plus, *conditions.reynolds))
                .first_heights;
    growth.least_heights = heights_of_flow(flow);
    if (options.wake_layers) growth.wakes = wake_lines(flow, wakes, growth.least_heights);
}

/// Returns what the flow decided for a mesh on these rays.
FlowDecisions flow_decisions(const LayerGrowth& growth, std::span<const WallSpacing> spacings, const RayPlan& plan,
                             const SizingOptions& sizing) {
    FlowDecisions decisions;
    if (!growth.layers)
        for (const WallHeight& least : growth.least_heights)
            decisions.least_thickness = std::max(decisions.least_thickness, least.height);
    for (std::size_t e = 0; e < plan.wakes.size(); ++e) {
        if (plan.wakes[e].outer.empty() || (decides_on_sizes(sizing) && plan.rays.wake_lengths[e] == 0)) continue;
        decisions.wakes.push_back(plan.wakes[e].wake);
        decisions.wakes.back().with_layers = plan.rays.wake_lengths[e];
    }
    decisions.spacings = smallest_spacings(spacings, plan.geometry);
    return decisions;
}

/// Returns the options with edges short enough for a tunnel, where they do not say how long edges may be.
CaseOptions with_tunnel_sizes(CaseOptions options, double chord) {
    constexpr double edges_across = 20;
    if (options.far_field.tunnel && !options.sizing.far_size)
        options.sizing.far_size =
            Length{in_units(*options.far_field.tunnel, chord) / (edges_across * options.fineness), LengthUnit::input};
    return options;
}

MeshResult run(const Geometry& given, const CaseOptions& given_options, StageClock& clock, double geometry_seconds) {
    StageSeconds seconds;
    clock.lap();

    const ReferenceConditions conditions = reference_conditions(given_options.conditions, bounding_box(given));
    const CaseOptions options = with_tunnel_sizes(given_options, conditions.chord);
    LayerGrowth growth = layer_growth(options.layer, conditions);
    growth.fineness = options.fineness;
    std::optional<Flow> flow;
    std::vector<ElementWake> wakes;
    if (options.use_flow) {
        clock.begin("flow");
        flow = solve_flow(given, options.conditions);
        if (!flow->estimated) wakes = wakes_of_flow(*flow, options.fineness);
        guide_growth(*flow, wakes, options.layer, conditions, growth);
        seconds.flow = clock.lap();
    }

    clock.begin("surface");
    SpacingLimits limits = spacing_limits(options, growth);
    std::vector<WallSpacing> spacings;
    if (flow && !flow->estimated) spacings = spacings_of_flow(*flow, growth);
    limits.walls = spacings;
    Geometry prepared = prepare_surfaces(given, options.surface, limits, conditions.chord);
    require_options_within(options, growth, sized_bodies(prepared, conditions),
                           place_far_field(bounding_box(prepared), conditions.chord, options.far_field).box());
    seconds.geometry = geometry_seconds + clock.lap();

    clock.begin("layers");
    RayPlan plan = plan_rays(std::move(prepared), conditions, options, growth, std::move(wakes));
    refine_walls_below_borders(given, options, limits, growth, plan);
    MeshResult result = mesh_on_rays(plan, options, clock, seconds, true);
    make_room(options, plan, clock, result);
    if (flow) result.warnings.insert(result.warnings.begin(), flow->warnings.begin(), flow->warnings.end());
    result.flow = std::move(flow);
    result.decisions = flow_decisions(growth, spacings, plan, options.sizing);
    result.seconds.total = clock.total();
    return result;
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

MeshResult generate_mesh(const Geometry& geometry, const CaseOptions& options, const Progress& progress) {
    validate(options);
    MeshResult result;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        result = run(geometry, options, clock, 0);
    });
    return result;
}

MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const Progress& progress) {
    validate(options);
    MeshResult result;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        clock.begin("geometry");
        Geometry geometry = read_geometry(inputs, options.geometry);
        const double geometry_seconds = clock.lap();
        result = run(geometry, options, clock, geometry_seconds);
    });
    return result;
}

}  // namespace lamina
