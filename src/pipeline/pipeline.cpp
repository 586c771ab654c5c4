#include <lamina/pipeline.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "core/reproducible_math.hpp"
#include "pipeline/assemble.hpp"
#include "pipeline/layer_region.hpp"

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
    d.chord = bodies.width();
    d.center = bodies.center();
    d.rule = options.separators;
    d.pieces_target = options.pieces_target;
    d.min_angle_deg = options.min_angle_deg;
    return d;
}

/// The layer with an outer border fit to be frozen for refinement to the angle and sizes asked for.
LayerOptions layer_options(const CaseOptions& options) {
    LayerOptions layer = options.layer;
    // Edges are divided into whole numbers of pieces: graded as steeply as the field, some would be too long for it.
    constexpr double rounding_of_pieces = 1.15;
    layer.border_gradation = frozen_share * options.gradation / rounding_of_pieces;
    layer.longest_border_edge =
        frozen_share * std::min(options.wall_size.value_or(HUGE_VAL), options.far_size.value_or(HUGE_VAL));
    // Neighbouring frozen edges may differ by sqrt 2 / (2 sin(bound)) before a quality-driven vertex can encroach
    // (docs/decisions/0003); a tenth more saves many splits and is never seen to.
    layer.border_ratio = 1.1 * std::sqrt(2.0) / (2 * sin_reproducible(radians(options.min_angle_deg)));
    return layer;
}

/// A border edge asks for at most this many times the size of which it is a fit share. Without a bound a long edge's
/// excess of a few per cent would be a multiple of the size at a fine edge far away.
constexpr double largest_raise = 2.5;

/// The size that each edge of a closed border asks for: that of which it is a fit share, or more beside a longer edge,
/// so that no edge is too long for the field that its neighbours make: the largest of (size - gradation x distance
/// along the border), within the bound.
std::vector<double> border_sizes(std::span<const double> lengths, double gradation) {
    std::vector<double> sizes;
    for (double l : lengths) sizes.push_back(l / frozen_share);
    const std::size_t n = lengths.size();
    const auto spread = [&](std::size_t from, std::size_t to) {
        const double passed_on = sizes[from] - gradation * 0.5 * (lengths[from] + lengths[to]);
        sizes[to] = std::max(sizes[to], std::min(passed_on, largest_raise * lengths[to] / frozen_share));
    };
    // Twice round in both directions: what the first round brings to the loop's start goes on in the second.
    for (std::size_t i = 0; i < 2 * n; ++i) spread(i % n, (i + 1) % n);
    for (std::size_t i = 2 * n; i > 0; --i) spread(i % n, (i - 1) % n);
    return sizes;
}

/// The edges of the layers' outer borders ask for sizes: each for its own, or for `wall_size` where that is less. More
/// than its own would be a jump from frozen edges to triangles many times as large.
SizeField make_size_field(const Layer& layer, const CaseOptions& options, const DecouplingOptions& decoupling) {
    std::vector<SizeSource> sources;
    for (const auto& border : layer.borders) {
        const auto point = [&](std::size_t i) { return layer.points[border[i < border.size() ? i : 0].index()]; };
        std::vector<double> lengths;
        for (std::size_t i = 0; i < border.size(); ++i) lengths.push_back(distance(point(i), point(i + 1)));
        const std::vector<double> sizes = border_sizes(lengths, options.gradation);
        for (std::size_t i = 0; i < border.size(); ++i)
            sources.push_back({point(i), point(i + 1), std::min(sizes[i], options.wall_size.value_or(HUGE_VAL))});
    }
    const double half = decoupling.far_field * decoupling.chord;
    const Box domain{decoupling.center - Point{half, half}, decoupling.center + Point{half, half}};
    return SizeField(sources, {.gradation = options.gradation, .max_size = options.far_size.value_or(HUGE_VAL)},
                     domain);
}

struct RefinedPieces {
    std::vector<Refinement> pieces;
    std::vector<ThreadSeconds> threads;
};

/// Largest first, each on whichever thread is free; every piece depends on its subdomain alone.
RefinedPieces refine_all(const std::vector<Subdomain>& subdomains) {
    std::vector<std::size_t> order(subdomains.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return subdomains[a].estimated_triangles > subdomains[b].estimated_triangles;
    });
    RefinedPieces result;
    result.pieces.resize(subdomains.size());
    result.threads.resize(thread_count());
    const double start = seconds_now();
    parallel_for(order.size(), 1, [&](std::size_t begin, std::size_t end) {
        const double begun = seconds_now();
        for (std::size_t i = begin; i < end; ++i) result.pieces[order[i]] = refine(subdomains[order[i]]);
        result.threads[thread_index()].busy += seconds_now() - begun;
    });
    const double elapsed = seconds_now() - start;
    for (ThreadSeconds& t : result.threads) t.idle = std::max(0.0, elapsed - t.busy);
    return result;
}

void add(RefineStats& sum, const RefineStats& stats) {
    sum.refused += stats.refused;
    sum.below_bound += stats.below_bound;
    sum.exempt += stats.exempt;
    sum.oversized += stats.oversized;
}

void demand_valid(const MeshCheck& check) {
    if (check.valid()) return;
    const MeshDefect& first = check.defects.front();
    throw MeshError(fmt::format("the mesh made is not valid: {} near ({}, {}){}", first.what, first.at.x, first.at.y,
                                check.defect_count > 1 ? fmt::format(", and {} more", check.defect_count - 1) : ""));
}

MeshResult run(Pslg pslg, const CaseOptions& options, Clock& clock, double geometry_seconds) {
    MeshResult result;
    StageSeconds& seconds = result.seconds;
    seconds.geometry = geometry_seconds;
    const DecouplingOptions outer_options = decoupling_options(pslg, options);
    clock.lap();

    clock.begin("layers");
    const Layer layer = make_layer(pslg, layer_options(options));
    const LayerEdges edges = layer_edges(layer);
    seconds.layers = clock.lap();

    clock.begin("layer triangulation");
    LayerCells layer_cells = fill_layer(layer, edges, options.layer.topology);
    seconds.layer_triangulation = clock.lap();

    clock.begin("sizing");
    const SizeField size = make_size_field(layer, options, outer_options);
    seconds.sizing = clock.lap();

    clock.begin("decoupling");
    Decoupling decoupling = decouple(layer.points, layer.borders, size, outer_options);
    seconds.decoupling = clock.lap();

    clock.begin("refinement");
    RefinedPieces refined = refine_all(decoupling.subdomains);
    seconds.refinement = clock.lap();

    clock.begin("assembly");
    result.refinement_threads = std::move(refined.threads);
    result.threads = thread_count();
    result.layer_pieces = edges.region.empty() ? 0 : 1;
    result.inviscid_pieces = refined.pieces.size();
    for (const Refinement& piece : refined.pieces) add(result.refinement, piece.stats);
    for (const auto& wall : layer.walls) result.surface_vertices += wall.size();
    result.incomplete_rays = layer.incomplete_rays;
    result.requested_layer_cells = layer.requested_cells;
    result.made_layer_cells = layer.made_cells;
    result.mesh = assemble(pslg, edges, std::move(layer_cells), std::move(decoupling), std::move(refined.pieces));
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
