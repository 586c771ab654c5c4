#include <lamina/pipeline.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/busy_times.hpp"
#include "core/parallel.hpp"
#include "core/reproducible_math.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/feasible.hpp"
#include "pipeline/layer_region.hpp"
#include "pipeline/size_sources.hpp"

namespace lamina {

namespace {

double seconds_now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Announces stages and takes their times.
class Clock {
public:
    explicit Clock(const Progress& progress) : progress_(progress), start_(seconds_now()), last_(start_) {}
    void begin(const std::string& stage) const {
        if (progress_) progress_(stage);
    }
    double lap() {
        const double now = seconds_now();
        const double lap = now - last_;
        last_ = now;
        return lap;
    }
    double total() const { return seconds_now() - start_; }

private:
    const Progress& progress_;
    double start_, last_;
};

Box box_of(const Pslg& pslg) {
    Box box;
    for (const Element& e : pslg.elements)
        for (Point p : e.points) box.include(p);
    return box;
}

DecouplingOptions decoupling_options(const Pslg& pslg, const CaseOptions& options) {
    const Box bodies = box_of(pslg);
    DecouplingOptions d;
    d.far_field = options.far_field;
    d.far_field_shape = options.far_field_shape;
    d.outline = options.far_field_outline;
    d.chord = bodies.width();
    d.center = bodies.center();
    d.rule = options.separators;
    d.pieces_target = options.pieces_target;
    d.min_angle_deg = options.min_angle_deg;
    return d;
}

/// Largest first, each on whichever thread is free; every piece depends on its subdomain alone.
std::vector<Refinement> refine_all(const std::vector<Subdomain>& subdomains, BusyTimes& times) {
    std::vector<std::size_t> order(subdomains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return subdomains[a].estimated_triangles > subdomains[b].estimated_triangles;
    });
    std::vector<Refinement> pieces(subdomains.size());
    parallel_for(order.size(), 1, [&](std::size_t begin, std::size_t end) {
        const BusyTimes::Scope busy(&times, Work::refinement);
        for (std::size_t i = begin; i < end; ++i) pieces[order[i]] = refine(subdomains[order[i]]);
    });
    return pieces;
}

/// Times of the threads in a stage that took `elapsed` seconds, which are divided among its kinds of work.
void take_times(const BusyTimes& times, double elapsed, MeshResult& result) {
    ThreadSeconds sum;
    for (std::size_t i = 0; i < times.threads(); ++i) {
        const auto [decomposition, layer_triangulation, refinement] = times.of_thread(i);
        result.thread_seconds.push_back({decomposition, layer_triangulation, refinement, times.idle(i, elapsed)});
        sum.decomposition += decomposition;
        sum.layer_triangulation += layer_triangulation;
        sum.refinement += refinement;
    }
    const double all = sum.decomposition + sum.layer_triangulation + sum.refinement;
    const double share = all > 0 ? elapsed / all : 0;
    result.seconds.decomposition = share * sum.decomposition;
    result.seconds.layer_triangulation = share * sum.layer_triangulation;
    result.seconds.refinement = share * sum.refinement;
}

void add(RefineStats& sum, const RefineStats& stats) {
    sum.refused += stats.refused;
    sum.below_bound += stats.below_bound;
    sum.exempt += stats.exempt;
    sum.oversized += stats.oversized;
}

/// What the pieces hold against what was estimated.
void compare_loads(std::span<const Subdomain> subdomains, std::span<const Refinement> pieces, MeshResult& result) {
    std::size_t foreseen = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const std::size_t made = pieces[i].triangles.size();
        result.largest_inviscid_piece = std::max(result.largest_inviscid_piece, made);
        const auto outcome = static_cast<double>(made);
        foreseen += std::abs(subdomains[i].estimated_triangles - outcome) <= 0.15 * outcome;
    }
    if (!pieces.empty())
        result.estimates_within_15_percent = static_cast<double>(foreseen) / static_cast<double>(pieces.size());
}

void demand_valid(const MeshCheck& check) {
    if (check.valid()) return;
    const MeshDefect& first = check.defects.front();
    throw MeshError(fmt::format("the mesh made is not valid: {} near ({}, {}){}", first.what, first.at.x, first.at.y,
                                check.defect_count > 1 ? fmt::format(", and {} more", check.defect_count - 1) : ""));
}

MeshResult run(Pslg pslg, const CaseOptions& given, Clock& clock, double geometry_seconds) {
    const CaseOptions options = options_in_force(pslg, given);
    MeshResult result;
    if (options.layer.enabled) {
        result.first_height = options.layer.first_height;
        result.y_plus = options.y_plus;
    }
    StageSeconds& seconds = result.seconds;
    seconds.geometry = geometry_seconds;
    clock.lap();

    clock.begin("surface");
    pslg = prepare_surfaces(std::move(pslg), surface_options(options));
    const DecouplingOptions outer_options = decoupling_options(pslg, options);
    require_feasible_sizes(pslg, options, far_field_box(outer_options));
    seconds.geometry += clock.lap();

    clock.begin("layers");
    const SizedLayer sized_layer = make_sized_layer(pslg, options, far_field_box(outer_options));
    const Layer& layer = sized_layer.layer;
    const LayerEdges edges = layer_edges(layer);
    seconds.layers = clock.lap();

    clock.begin("sizing");
    const SizeField size = make_size_field(sized_layer, options, far_field_box(outer_options));
    require_feasible(size, options);
    seconds.sizing = clock.lap();

    clock.begin("decoupling");
    Decoupling decoupling = decouple(layer.points, layer.borders, size, outer_options);
    seconds.decoupling = clock.lap();

    // The layer's first cuts occupy one thread each: the others refine meanwhile (thesis 6.6).
    clock.begin("layer triangulation and refinement");
    LayerFill layer_fill;
    std::vector<Refinement> refined;
    BusyTimes times;
    parallel_invoke(
        [&] { layer_fill = fill_layer(layer, edges, options.layer.topology, options.decomposition, &times); },
        [&] { refined = refine_all(decoupling.subdomains, times); });
    take_times(times, clock.lap(), result);

    clock.begin("assembly");
    result.threads = thread_count();
    result.layer_pieces = layer_fill.pieces();
    result.decomposition = layer_fill.decomposition;
    result.inviscid_pieces = refined.size();
    for (const Refinement& piece : refined) add(result.refinement, piece.stats);
    compare_loads(decoupling.subdomains, refined, result);
    for (const auto& wall : layer.walls) result.surface_vertices += wall.size();
    result.layer_coverage = layer.coverage;
    result.mesh = assemble(pslg, edges, std::move(layer_fill), std::move(decoupling), std::move(refined));
    seconds.assembly = clock.lap();

    clock.begin("check");
    result.check = check_mesh(result.mesh, {.min_angle_deg = options.min_angle_deg});
    demand_valid(result.check);
    seconds.check = clock.lap();

    result.pslg = std::move(pslg);
    seconds.total = clock.total();
    return result;
}

}  // namespace

CaseOptions options_in_force(const Pslg& pslg, CaseOptions options) {
    if (options.y_plus) {
        auto& [y_plus, reynolds, chord] = *options.y_plus;
        if (!chord) chord = box_of(pslg).width();
        options.layer.first_height = first_height_for(y_plus, reynolds, *chord);
    }
    return options;
}

SurfaceOptions surface_options(const CaseOptions& options) {
    SurfaceOptions surface = options.surface;
    surface.max_turning_deg = std::min(surface.max_turning_deg, options.layer.max_ray_angle_deg);
    // The layer's border over a fan of rays has edges of height x ray angle, and grows no faster than its gradation.
    // Where the wall's spacing exceeds that, border edges are divided and the rows below fan out to the division
    // points.
    constexpr double margin = 0.9;
    surface.gradation =
        std::min(surface.gradation, std::max(margin * border_gradation(options), slowest_wall_gradation));
    // Layers that go by the wall's spacing are as high over it as that allows.
    if (options.layer.enabled && options.layer.layers && options.layer.growth_law != GrowthLaw::adaptive) {
        const double height =
            std::min(layer_height(options.layer, *options.layer.layers), options.layer.thickness.value_or(HUGE_VAL));
        const double fan_edge = height * radians(options.layer.max_ray_angle_deg);
        if (fan_edge > 0 && !surface.fan_spacing) surface.fan_spacing = fan_edge;
    }
    return surface;
}

MeshResult generate_mesh(Pslg pslg, const CaseOptions& options, const Progress& progress) {
    MeshResult result;
    with_threads(options.threads, [&] {
        Clock clock(progress);
        result = run(std::move(pslg), options, clock, 0);
    });
    return result;
}

MeshResult generate_mesh(const std::vector<std::string>& inputs, const CaseOptions& options, const Progress& progress) {
    MeshResult result;
    with_threads(options.threads, [&] {
        Clock clock(progress);
        clock.begin("geometry");
        Pslg pslg = read_geometry(inputs, options.geometry);
        const double geometry_seconds = clock.lap();
        result = run(std::move(pslg), options, clock, geometry_seconds);
    });
    return result;
}

}  // namespace lamina
