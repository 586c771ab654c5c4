// Measures triangulation in pieces against one triangulation of all points, both in the same run: the cost of each
// depth, how the times of decomposition and leaves grow with the number of points, and the gain by threads. Compare
// Figs. 23 and 31 of J. K. Pardue, thesis (2015).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>

#include "core/busy_times.hpp"
#include "core/parallel.hpp"
#include "delaunay/pieces/convex_hull.hpp"
#include "delaunay/pieces/pieces.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "layers/layer.hpp"
#include "paired.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::bench {
namespace {

/// Points and the edges that bound them all round, with the region on their left.
struct Region {
    std::vector<Point> points;
    std::vector<Segment> border;
};

/// Returns the points with their convex hull as the border.
Region in_convex_hull(std::vector<Point> points) {
    const auto sorted = delaunay::pieces::sort_points(points).value();
    Region region{std::move(points), {}};
    for (const delaunay::pieces::BorderEdge& e : delaunay::pieces::convex_hull(sorted))
        region.border.push_back({VertexId{sorted.original[e.a]}, VertexId{sorted.original[e.b]}});
    return region;
}
Region uniform(std::size_t n) { return in_convex_hull(test::random_points(n, 3)); }
Region naca_points(std::size_t n) { return in_convex_hull(test::naca_layer_points(n)); }

/// Returns the boundary layer of NACA 0012, 30 layers between wall and outer border, of about n points.
Region naca_layer(std::size_t n) {
    LayerOptions options;
    options.first_height = 1e-5;
    options.growth = 1.1;
    options.layers = 30;
    Geometry geometry;
    geometry.elements.push_back(naca_airfoil("0012", n / 32));
    layers::Layer layer = layers::make_layer(geometry, options);
    return {std::move(layer.points), std::move(layer.edges.region)};
}

/// Returns a decomposition that ends at this depth, whatever the number of points.
DecompositionOptions to_depth(unsigned depth) { return {.depth = depth, .leaf_vertices = 10}; }

std::size_t triangulate_at_once(const std::vector<Point>& points) {
    return delaunay::without_ghosts(delaunay::triangulate_points(points)).triangles.size();
}
std::size_t triangulate_at_once(const Region& region) {
    return triangulate(region.points, region.border, {.keep = KeptRegion::left_of_segments}).triangles.size();
}

Work on_one_thread(Work work) {
    return [work = std::move(work)] {
        std::size_t made = 0;
        with_threads(1, [&] { made = work(); });
        return made;
    };
}

/// Measures depths 3 to 7. Counter `ratio_to_depth_D`: time in pieces of depth D over the time at once.
template <class AtOnce, class InPieces>
void measure_depths(benchmark::State& state, AtOnce&& at_once, InPieces&& in_pieces) {
    std::vector<Reference> references;
    for (unsigned depth = 3; depth <= 7; ++depth)
        references.push_back({"depth_" + std::to_string(depth),
                              on_one_thread([&, depth] { return in_pieces(to_depth(depth)).triangles.size(); })});
    measure(state, "triangles", at_once, references);
}

void depths_of_points(benchmark::State& state, Region (*make)(std::size_t)) {
    const std::vector<Point> points = make(static_cast<std::size_t>(state.range(0))).points;
    measure_depths(
        state, [&] { return triangulate_at_once(points); },
        [&](const DecompositionOptions& options) { return delaunay::pieces::triangulate_in_pieces(points, options); });
}

void depths_of_region(benchmark::State& state, Region (*make)(std::size_t)) {
    const Region region = make(static_cast<std::size_t>(state.range(0)));
    measure_depths(
        state, [&] { return triangulate_at_once(region); },
        [&](const DecompositionOptions& options) {
            return delaunay::pieces::triangulate_in_pieces(region.points, region.border, options);
        });
}

/// Measures sets of up to a million points, five times each.
void usual(benchmark::internal::Benchmark* b) {
    b->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
}
/// Measures larger sets once.
void large(benchmark::internal::Benchmark* b) {
    b->Arg(10'000'000)->Iterations(1)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(depths_of_region, naca_layer, naca_layer)->Apply(usual);
BENCHMARK_CAPTURE(depths_of_points, naca_points, naca_points)->Apply(usual);
BENCHMARK_CAPTURE(depths_of_points, uniform, uniform)->Apply(usual);
BENCHMARK_CAPTURE(depths_of_points, naca_points, naca_points)->Apply(large);
BENCHMARK_CAPTURE(depths_of_points, uniform, uniform)->Apply(large);

/// Returns the slope of the straight line that fits log y over log x best.
double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i]), v = std::log(y[i]);
        sx += u, sy += v, sxx += u * u, sxy += u * v;
    }
    const auto n = static_cast<double>(x.size());
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Measures processor time at depth 6 for 1e4, 1e5 ... points up to the argument. Counters: nanoseconds per point, and
/// the exponents with which the times of decomposition and leaves grow. Processor time is divided between both in
/// proportion to wall-clock time.
void growth(benchmark::State& state, Region (*make)(std::size_t)) {
    std::vector<double> points, decomposition_s, leaves_s;
    for (auto _ : state) {
        for (std::size_t n = 10'000; n <= static_cast<std::size_t>(state.range(0)); n *= 10) {
            const Region region = make(n);
            std::vector<double> decomposition, leaves;
            for (int round = 0; round < (n > 1'000'000 ? 1 : 5); ++round)
                with_threads(1, [&] {
                    core::BusyTimes times;
                    std::size_t made = 0;
                    const double cpu_s = cpu_seconds(
                        [&] {
                            return delaunay::pieces::triangulate_in_pieces(region.points, region.border, to_depth(6),
                                                                           &times)
                                .triangles.size();
                        },
                        made);
                    const double cut = times.seconds(0, delaunay::pieces::cutting),
                                 fill = times.seconds(0, delaunay::pieces::triangulating);
                    decomposition.push_back(cpu_s * cut / (cut + fill));
                    leaves.push_back(cpu_s * fill / (cut + fill));
                });
            points.push_back(static_cast<double>(region.points.size()));
            decomposition_s.push_back(median(decomposition));
            leaves_s.push_back(median(leaves));
            const std::string size = std::to_string(n);
            state.counters["decomposition_ns_" + size] = 1e9 * decomposition_s.back() / points.back();
            state.counters["leaves_ns_" + size] = 1e9 * leaves_s.back() / points.back();
        }
    }
    state.counters["decomposition_exponent"] = fitted_exponent(points, decomposition_s);
    state.counters["leaves_exponent"] = fitted_exponent(points, leaves_s);
}
void up_to_ten_million(benchmark::internal::Benchmark* b) {
    b->ArgName("up_to")->Arg(1'000'000)->Arg(10'000'000)->Iterations(1)->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(growth, naca_layer, naca_layer)->Apply(up_to_ten_million);
BENCHMARK_CAPTURE(growth, uniform, uniform)->Apply(up_to_ten_million);

/// Measures wall-clock time for 2e6 layer points, on one thread and on several in turn. Counter `speed_up`: ratio of
/// the medians.
void threads(benchmark::State& state) {
    const Region region = naca_layer(2'000'000);
    const auto seconds = [&](unsigned count) {
        const auto begin = std::chrono::steady_clock::now();
        with_threads(count, [&] {
            benchmark::DoNotOptimize(
                delaunay::pieces::triangulate_in_pieces(region.points, region.border, to_depth(6)).triangles.data());
        });
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    std::vector<double> one, several;
    for (auto _ : state) {
        one.push_back(seconds(1));
        several.push_back(seconds(static_cast<unsigned>(state.range(0))));
        state.SetIterationTime(several.back());
    }
    state.counters["points"] = static_cast<double>(region.points.size());
    state.counters["one_thread_s"] = median(one);
    state.counters["median_s"] = median(several);
    state.counters["speed_up"] = median(one) / median(several);
}
void up_to_all_cores(benchmark::internal::Benchmark* b) {
    const unsigned cores = std::max(2u, std::thread::hardware_concurrency());
    for (unsigned count = 2; count <= cores; count *= 2) b->Arg(count);
    b->ArgName("threads")->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK(threads)->Apply(up_to_all_cores);

}  // namespace
}  // namespace lamina::bench
