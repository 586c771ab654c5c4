// Runs the stages in their order, times them and announces them.
#include <lamina/pipeline.hpp>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include <lamina/shared_mesh.hpp>
#include <lamina/stream.hpp>
#include <lamina/threads.hpp>

#include "core/busy_times.hpp"
#include "core/packing.hpp"
#include "core/parallel.hpp"
#include "decoupling/cut_region.hpp"
#include "decoupling/far_field.hpp"
#include "decoupling/refine_all.hpp"
#include "layers/cells/fill.hpp"
#include "layers/stages.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/flow_guidance.hpp"
#include "pipeline/mesh_limits.hpp"
#include "pipeline/ray_plan.hpp"
#include "pipeline/sharing/checked_pieces.hpp"
#include "pipeline/sharing/held_parts.hpp"
#include "pipeline/sharing/piece_streamer.hpp"
#include "pipeline/sharing/shared_pieces.hpp"
#include "pipeline/sharing/shared_seams.hpp"
#include "pipeline/warnings.hpp"

namespace lamina::pipeline {

namespace {

/// Kinds of work that share the threads: those of delaunay::pieces in the layer, the refinement of subdomains, and the
/// check of each.
enum SharedWork : std::size_t {
    decomposition_work = delaunay::pieces::cutting,
    layer_work = delaunay::pieces::triangulating,
    refinement_work,
    check_work
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
                                   times.seconds(i, refinement_work), times.seconds(i, check_work),
                                   times.idle(i, elapsed)};
        sum.decomposition += thread.decomposition;
        sum.layer_triangulation += thread.layer_triangulation;
        sum.refinement += thread.refinement;
        sum.check += thread.check;
        thread_seconds.push_back(thread);
    }
    const double all = sum.decomposition + sum.layer_triangulation + sum.refinement + sum.check;
    const double share = all > 0 ? elapsed / all : 0;
    seconds.decomposition += share * sum.decomposition;
    seconds.layer_triangulation += share * sum.layer_triangulation;
    seconds.refinement += share * sum.refinement;
    seconds.check += share * sum.check;
}

/// Records the results of the refinement, and how good the estimates of the numbers of triangles were.
void summarize_refinement(const PiecesSummary& pieces, MeshResult& result) {
    result.inviscid_pieces = pieces.pieces;
    result.refinement += pieces.stats;
    result.largest_inviscid_piece = pieces.largest;
    if (pieces.pieces > 0)
        result.estimates_within_15_percent =
            static_cast<double>(pieces.good_estimates) / static_cast<double>(pieces.pieces);
    result.mean_edge_over_size = pieces.mean_edge_over_size();
}

void summarize_layer(const Layer& layer, const LayerCells& cells, MeshResult& result) {
    result.layer_pieces = cells.pieces();
    result.decomposition = cells.decomposition;
    result.layer_grid_refused = cells.grid_refused;
    for (const auto& wall : layer.walls) result.surface_vertices += wall.size();
    result.layer_coverage = layer.coverage;
}

void summarize_growth(const Layer& layer, const LayerOptions& options, MeshResult& result) {
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
std::vector<double> first_heights_of_markers(const MeshResult& result, std::span<const Marker> markers) {
    std::vector<double> heights;
    if (result.first_heights.empty()) return heights;
    std::size_t next = 0;
    for (const Marker& marker : markers) {
        if (next < result.geometry.elements.size() && marker.name == result.geometry.elements[next].name) ++next;
        heights.push_back(result.first_heights[next - 1]);
    }
    return heights;
}

/// What becomes of a mesh: it is kept as a whole, unless it goes to sinks or stays with the processes that make it.
struct Destination {
    const OpenSink* open_sink = nullptr;
    Ranks* ranks = nullptr;
    std::optional<std::filesystem::path> beside{};  ///< as in share_mesh()

    bool keeps_mesh() const { return open_sink == nullptr && ranks == nullptr; }
    /// Returns whether this process completes the check of the mesh.
    bool checks() const { return ranks == nullptr || ranks->rank() == 0; }
    WorkCost cost() const {
        if (ranks != nullptr) return shared_cost(ranks->size(), !beside);
        return open_sink != nullptr ? stream_cost : mesh_cost;
    }
};

/// A mesh with the triangles that MeshCheck::unexcused_cells numbers. Where it is not kept, a sink or parts hold its
/// cells.
struct MadeMesh {
    MeshResult result;
    std::vector<mesh::NarrowTriangle> unexcused{};
    std::unique_ptr<MeshSink> sink{};
    std::unique_ptr<MeshParts> parts{};
    std::vector<Segment> constraints{};
    MeshCounts counts{};
    std::string hash{};
};

/// Returns whether markers depend on where the edges of the far field lie.
bool divides_far_field(const CaseOptions& options) {
    return options.inlet_outlet || options.far_field.tunnel || options.far_field.ground;
}

/// Returns the markers of the mesh, with the far field divided if the options ask for it.
std::vector<Marker> markers_of(const RayPlan& plan, const CaseOptions& options, const Layer& layer,
                               std::span<const Point> points, const std::vector<Segment>& far_field) {
    std::vector<Marker> markers = make_markers(plan.geometry, layer, far_field, options.assemble);
    const FarFieldOptions& outer = options.far_field;
    if (outer.tunnel || outer.ground) mark_slip_walls(points, markers, plan.far_field, outer.ground.has_value());
    if (options.inlet_outlet || outer.tunnel) split_far_field(points, markers, plan.conditions.alpha_deg);
    return markers;
}

/// What the pieces of a mesh are made of, and where their check and their times go.
struct PiecesWork {
    const RayPlan& plan;
    const CaseOptions& options;
    const Layer& layer;
    const Decoupling& decoupling;
    const PieceRules& rules;
    mesh::PiecewiseCheck& check;
    core::BusyTimes& times;
    std::span<const Marker> markers;

    LayerCells fill_layer() const { return layers::fill(layer, options.layer.topology, options.decomposition, &times); }
    PiecesSummary refine(std::span<const std::size_t> order, const PieceKeeper& keeper) const {
        return refine_and_check(decoupling, order, rules, times, check, keeper);
    }
};

/// The pieces of a mesh.
struct MadePieces {
    LayerCells cells{};
    PiecesSummary summary{};
    std::vector<std::size_t> first_triangle{};  ///< of the subdomains in the mesh
    HeldNumbers held{};                         ///< of a shared mesh
    Mesh layer{};                               ///< its cells as a mesh, once they are part of the check
};

/// Makes the layer a part of the check.
void check_layer(const PiecesWork& work, MadePieces& made) {
    made.layer = layer_mesh(work.layer, made.cells);
    if (!made.layer.triangles.empty() || !made.layer.quads.empty())
        work.check.add_layer(made.layer, work.layer.edges.interfaces);
}

/// Makes all pieces and hands them to the taker in the order of their numbers.
MadePieces make_pieces(const PiecesWork& work, PartTaker& taker, bool with_hash, MadeMesh& mesh) {
    MadePieces made;
    PieceStreamer streamer(work.decoupling, taker, with_hash);
    const auto fill_layer = [&] {
        made.cells = work.fill_layer();
        streamer.start(made.cells);
    };
    const auto refine = [&] {
        made.summary = work.refine(
            streamer.order(), {.begin = [&](std::size_t piece) { streamer.begin(piece); },
                               .keep = [&](std::size_t piece, Refinement r) { streamer.take(piece, std::move(r)); },
                               .fail = [&] { streamer.fail(); }});
    };
    // Each of the first cuts of the layer occupies one thread, so the others refine meanwhile if that is not in vain
    // (thesis 6.6).
    if (streamer.holds_all()) {
        core::parallel_invoke(fill_layer, refine);
    } else {
        fill_layer();
        refine();
    }
    streamer.finish(work.markers);
    made.first_triangle = streamer.take_first_triangles();
    mesh.counts = streamer.counts();
    mesh.hash = streamer.hash();
    return made;
}

/// Makes all pieces and a mesh of them.
MadePieces keep_pieces(const PiecesWork& work, MadeMesh& mesh) {
    MeshTaker taker(work.decoupling, mesh.result.mesh);
    return make_pieces(work, taker, false, mesh);
}

/// Makes all pieces and hands them to a sink.
MadePieces stream_pieces(const PiecesWork& work, const OpenSink& open_sink, MadeMesh& mesh) {
    mesh.sink = open_sink();
    SinkTaker taker(*mesh.sink);
    MadePieces made = make_pieces(work, taker, true, mesh);
    mesh.sink->finish(mesh.counts, work.markers, work.layer.edges.interfaces);
    return made;
}

/// Makes the pieces that this process gets and keeps them. Rank 0 alone fills the layer, and checks it.
MadePieces share_pieces(const PiecesWork& work, SharedDecoupling& shared, PieceMaker& maker,
                        const Destination& destination, const StageClock& clock, MadeMesh& mesh) {
    Ranks& ranks = *destination.ranks;
    MadePieces made;
    HeldPieces held;
    mesh::HashOfParts hash;
    // All that rank 0 can do before the pieces are made keeps the others from waiting for it once they are. It makes fewer
    // pieces meanwhile.
    const auto fill_layer = [&] {
        if (!destination.checks()) return;
        shared.place(shared.cut.far_field);
        shared.outer_places = sum_of_places(shared.cut.far_field, shared.points());
        made.cells = work.fill_layer();
        check_layer(work, made);
        work.check.expect_boundary(work.markers, shared.cut.far_field);
        hash.add(shared.points(), std::span<const Triangle>(made.cells.triangles));
        hash.add(shared.points(), std::span<const Quad>(made.cells.quads));
        hash.add(shared.points(), work.markers);
    };
    core::parallel_invoke(fill_layer, [&] { held = take_and_refine(shared, maker, work.times, ranks); });
    clock.begin("numbering");
    CountedMesh counted = count_and_check(shared, held, made.cells, work.rules.min_angle_deg, ranks,
                                          destination.checks() ? &work.check : nullptr);
    made.held.store = maker.take_store();
    for (const HeldPiece& piece : held.pieces) {
        made.held.pieces.push_back(piece.piece);
        made.held.places.push_back(piece.place);
    }
    made.held.numbers = std::move(counted.numbers);
    made.held.layer_pieces = counted.layer_pieces;
    made.summary = counted.summary;
    made.first_triangle = {0};
    mesh.counts = counted.counts;
    if (!destination.checks()) return made;
    hash.add(counted.hash);
    mesh.hash = hash.text();
    return made;
}

/// Makes a value of rank 0, which the others do not need before they wait for each other, known to all.
template <class Value>
void share_value(Ranks& ranks, Value& value) {
    core::Packer packer;
    packer.put(value);
    const std::string packed = ranks.broadcast(packer.take());
    value = core::Unpacker(packed).get<Value>();
}

/// Makes the narrow triangles of rank 0, which has checked the mesh, known to all.
void share_unexcused(Ranks& ranks, std::vector<mesh::NarrowTriangle>& unexcused) {
    core::Packer packer;
    packer.put_all<mesh::NarrowTriangle>(unexcused);
    const std::string packed = ranks.broadcast(packer.take());
    core::Unpacker unpacker(packed);
    unexcused = unpacker.get_all<mesh::NarrowTriangle>();
}

/// Collective: returns what cut_and_deal() returns, with all that the markers need.
std::unique_ptr<SharedDecoupling> share_decoupling(const Layer& layer, const SizeField& size, const FarField& far_field,
                                                   const CaseOptions& options, const RefineOptions& refine,
                                                   PieceMaker& maker, Ranks& ranks,
                                                   const std::function<void()>& before_pieces) {
    validate(options.decoupling);
    validate(options.refine);
    auto shared = cut_and_deal({layer.points, layer.borders, size, far_field, options.decoupling}, refine, maker, ranks,
                               before_pieces);
    if (divides_far_field(options)) shared->place(shared->cut.far_field);
    return shared;
}

/// Makes the mesh on these rays: the stages from the layer's border to the check. `seconds` holds the times so far;
/// `announce_estimate` says whether the estimate is part of the progress.
MadeMesh mesh_on_rays(const RayPlan& plan, const CaseOptions& options, const Destination& destination,
                      StageClock& clock, StageSeconds seconds, bool announce_estimate) {
    const WorkCost cost = destination.cost();
    MadeMesh made;
    MeshResult& result = made.result;
    result.geometry = plan.geometry;
    result.conditions = plan.conditions;
    result.thinned_rays = plan.thinned_rays;
    result.thinned_at = plan.thinned_at;
    const Layer layer =
        layers::close_border(plan.rays, border_options(options, plan.conditions.chord, plan.requests.at_borders));
    seconds.layers += clock.lap();

    clock.begin("sizing");
    const SizeField size = make_size_field(border_loops(layer), plan.requests.sources, options.sizing,
                                           plan.conditions.chord, plan.far_field.box());
    if (destination.checks()) result.estimate = estimate_within_limits(options, layer, size, plan.far_field, cost);
    seconds.sizing += clock.lap();

    clock.begin("decoupling",
                announce_estimate && destination.checks() ? std::optional(result.estimate) : std::nullopt);
    const RefineOptions refine = refine_options(options, plan.conditions.chord, cost);
    PieceRules rules{
        options.refine.min_angle_deg, triangles_beyond_layer(result.estimate, layer), {refinement_work, check_work}};
    std::unique_ptr<SharedDecoupling> shared;
    std::optional<PieceMaker> maker;
    Decoupling decoupling;
    if (destination.ranks != nullptr)
        shared = share_decoupling(layer, size, plan.far_field, options, refine,
                                  maker.emplace(rules, destination.beside), *destination.ranks, [&] {
                                      share_value(*destination.ranks, result.estimate);
                                      rules.expected_triangles = triangles_beyond_layer(result.estimate, layer);
                                  });
    else
        decoupling = decouple(layer.points, layer.borders, size, plan.far_field, options.decoupling, refine);
    const std::span<const Point> points = shared ? shared->points() : std::span<const Point>(decoupling.points);
    seconds.decoupling += clock.lap();

    result.threads = thread_count();
    std::vector<Marker> markers =
        markers_of(plan, options, layer, points, shared ? shared->cut.far_field : decoupling.far_field);
    const std::span<const Segment> constraints = layer.edges.interfaces;
    // The heights are those of the layer as it is closed.
    summarize_growth(layer, options.layer, result);
    // Processes match the borders between their pieces themselves.
    const auto elsewhere = shared ? std::optional(VertexId{layer.points.size()}) : std::nullopt;
    mesh::PiecewiseCheck check(
        points,
        {.min_angle_deg = options.refine.min_angle_deg, .first_heights = first_heights_of_markers(result, markers)},
        elsewhere);

    clock.begin("layer triangulation, refinement and check of pieces");
    core::BusyTimes times;
    PiecesWork work{plan, options, layer, decoupling, rules, check, times, markers};
    MadePieces pieces = destination.ranks       ? share_pieces(work, *shared, *maker, destination, clock, made)
                        : destination.open_sink ? stream_pieces(work, *destination.open_sink, made)
                                                : keep_pieces(work, made);
    record_shared_times(times, clock.lap(), seconds, result.thread_seconds);

    clock.begin("check");
    if (destination.checks()) {
        if (destination.ranks == nullptr) check_layer(work, pieces);
        result.check = check.finish(markers, constraints, pieces.first_triangle);
        require_valid(result.check);
        made.unexcused = check.unexcused();
    }
    if (destination.ranks != nullptr) share_unexcused(*destination.ranks, made.unexcused);
    seconds.check += clock.lap();

    clock.begin("assembly");
    summarize_layer(layer, pieces.cells, result);
    record_columns(layer, pieces.cells, result);
    summarize_refinement(pieces.summary, result);
    result.mesh.markers = std::move(markers);
    if (destination.keeps_mesh()) result.mesh.constraints = layer.edges.interfaces;
    require_made_within(options.limits, made.counts.triangles, made.counts.quads, cost);
    if (destination.checks())
        result.warnings = find_warnings(
            result, options,
            {check.widest().middle, check.narrowest().middle, pieces.summary.oversized.middle, made.unexcused},
            destination.keeps_mesh() ? result.mesh : pieces.layer);
    if (destination.ranks != nullptr) {
        made.constraints = layer.edges.interfaces;
        made.parts = std::make_unique<HeldParts>(std::move(shared), std::move(pieces.cells), std::move(pieces.held),
                                                 made.counts, *destination.ranks);
    }
    seconds.assembly += clock.lap();
    result.seconds = seconds;
    return made;
}

/// Tells all other processes that this one has failed.
void fail_elsewhere(Ranks& ranks, const Error& error) {
    try {
        ranks.fail(error.exit_code(), error.what());
    } catch (const RankFailure&) {
        // All of them know it now.
    }
}

/// Replaces the mesh by others, on shorter rays and with shorter edges of borders, for as long as fewer and fewer
/// triangles have an angle below the bound that no sharp corner excuses. A bound above the proved one is no promise, so
/// nothing is done for it.
void make_room(const CaseOptions& options, const Destination& destination, RayPlan& plan, StageClock& clock,
               MadeMesh& best) {
    constexpr int max_rounds_without_gain = 2, max_rounds = 12;
    constexpr double gain = 0.9;  // the share of such triangles that a round must leave at most
    if (options.refine.min_angle_deg > proved_min_angle_deg) return;
    MadeMesh next;
    const MadeMesh* last = &best;
    int rounds_without_gain = 0;
    for (int round = 0; round < max_rounds && rounds_without_gain < max_rounds_without_gain; ++round) {
        const StageSeconds seconds = last->result.seconds;
        // In a slot with one row of triangles, thinner layers move a triangle that misses the bound along the slot.
        const bool thin = rounds_without_gain == 0;
        if (!make_room_at_narrow_triangles(last->unexcused, thin, options, plan)) return;
        next = {};  // so that no more than two meshes are held
        clock.begin("layers, thinned");
        try {
            next = mesh_on_rays(plan, options, destination, clock, seconds, false);
        } catch (const RankFailure&) {
            return;  // the best mesh so far is valid
        } catch (const Error& error) {
            if (destination.ranks != nullptr) fail_elsewhere(*destination.ranks, error);
            return;
        }
        last = &next;
        const auto before = static_cast<double>(best.unexcused.size()),
                   after = static_cast<double>(next.unexcused.size());
        rounds_without_gain = after <= gain * before ? 0 : rounds_without_gain + 1;
        if (after < before) {
            best = std::move(next);
            last = &best;
        } else {
            best.result.seconds = next.result.seconds;
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

MadeMesh run(const Geometry& given, const CaseOptions& given_options, const Destination& destination, StageClock& clock,
             double geometry_seconds) {
    StageSeconds seconds;
    clock.lap();

    const ReferenceConditions conditions = reference_conditions(given_options.conditions, reference_box(given));
    const CaseOptions options = with_tunnel_sizes(given_options, conditions.chord);
    require_surface_points_within(options, given.elements.size(), destination.cost());
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
                           place_far_field(bounding_box(prepared), conditions.chord, options.far_field).box(),
                           destination.cost());
    require_walls_within(options, prepared, destination.cost());
    seconds.geometry = geometry_seconds + clock.lap();

    clock.begin("layers");
    RayPlan plan = plan_rays(std::move(prepared), conditions, options, growth, std::move(wakes));
    refine_walls_below_borders(given, options, limits, growth, plan);
    end_columns_below_obtuse_cells(options, plan);
    MadeMesh made = mesh_on_rays(plan, options, destination, clock, seconds, true);
    make_room(options, destination, plan, clock, made);
    MeshResult& result = made.result;
    if (flow) result.warnings.insert(result.warnings.begin(), flow->warnings.begin(), flow->warnings.end());
    result.flow = std::move(flow);
    result.decisions = flow_decisions(growth, spacings, plan, options.sizing);
    result.seconds.total = clock.total();
    return made;
}

}  // namespace

}  // namespace lamina::pipeline

namespace lamina {

using namespace pipeline;

namespace {

/// Reads the inputs, and runs all stages on them.
MadeMesh read_and_run(const std::vector<std::string>& inputs, const CaseOptions& options,
                      const Destination& destination, const Progress& progress) {
    validate(options);
    MadeMesh made;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        clock.begin("geometry");
        const Geometry geometry = read_geometry(inputs, options.geometry);
        const double geometry_seconds = clock.lap();
        made = run(geometry, options, destination, clock, geometry_seconds);
    });
    return made;
}

}  // namespace

MeshResult generate_mesh(const Geometry& geometry, const CaseOptions& options, const Progress& progress) {
    validate(options);
    MeshResult result;
    with_threads(options.threads, [&] {
        StageClock clock(progress);
        result = run(geometry, options, {}, clock, 0).result;
    });
    return result;
}

MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const Progress& progress) {
    return read_and_run(inputs, options, {}, progress).result;
}

StreamedMesh stream_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const OpenSink& open_sink,
                         const Progress& progress) {
    MadeMesh made = read_and_run(inputs, options, {.open_sink = &open_sink}, progress);
    return {std::move(made.result), made.counts, std::move(made.hash), std::move(made.sink)};
}

SharedMesh share_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, Ranks& ranks,
                      const std::optional<std::filesystem::path>& beside, const Progress& progress) {
    MadeMesh made = read_and_run(inputs, options, {.ranks = &ranks, .beside = beside}, progress);
    return {std::move(made.result), made.counts, std::move(made.hash), std::move(made.constraints),
            std::move(made.parts)};
}

}  // namespace lamina
