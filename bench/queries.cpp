// Connectivity, queries and changing triangulations, on one thread. Changing ones are measured in pairs with the static
// kernel; `ratio` is the median of their ratios.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <span>
#include <vector>

#include <benchmark/benchmark.h>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/dynamic_triangulation.hpp>
#include <lamina/threads.hpp>

#include "delaunay/triangulate/triangulate_points.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_families.hpp"

namespace {

using namespace lamina;

constexpr std::size_t point_count = 1'000'000;

/// A triangulation and as many queries, sorted in strips.
struct QueryCase {
    std::vector<Point> points = test::random_points(point_count, 1);
    std::vector<Triangle> triangles = triangulate(points).triangles;
    TriangulationIndex index{points, triangles};
    std::vector<Point> unordered = test::random_points(point_count, 2);
    std::vector<Point> ordered = unordered;

    QueryCase() {
        const double strips = std::sqrt(0.5 * double(point_count));
        std::sort(ordered.begin(), ordered.end(), [strips](Point p, Point q) {
            const double i = std::floor(p.x * strips), j = std::floor(q.x * strips);
            if (i != j) return i < j;
            return std::fmod(i, 2) == 0 ? p.y < q.y : p.y > q.y;
        });
    }
};

const QueryCase& query_case() {
    static const QueryCase the_case;
    return the_case;
}

/// Runs one of the functions on a case; reports items a second.
template <class F>
void run_queries(benchmark::State& state, const F& f) {
    const QueryCase& c = query_case();
    with_threads(1, [&] {
        for (auto _ : state) f(c);
    });
    state.SetItemsProcessed(std::int64_t(point_count) * state.iterations());
}

void locate_from_last(benchmark::State& state) {
    run_queries(state, [](const QueryCase& c) {
        TriangleId hint;
        for (const Point p : c.ordered)
            if (const PointLocation l = c.index.locate(p, hint); l.triangle.valid()) hint = l.triangle;
        benchmark::DoNotOptimize(hint);
    });
}
void locate_one_by_one(benchmark::State& state) {
    run_queries(state, [](const QueryCase& c) {
        for (const Point p : c.unordered) benchmark::DoNotOptimize(c.index.locate(p));
    });
}
void locate_batch(benchmark::State& state) {
    run_queries(state, [](const QueryCase& c) { benchmark::DoNotOptimize(c.index.locate(c.unordered).data()); });
}
void nearest_vertices(benchmark::State& state) {
    run_queries(state,
                [](const QueryCase& c) { benchmark::DoNotOptimize(c.index.nearest_vertices(c.unordered).data()); });
}
void interpolate(benchmark::State& state, bool sibson) {
    const std::vector<double> values(point_count, 1.0);
    run_queries(state, [&](const QueryCase& c) {
        const auto result =
            sibson ? c.index.interpolate_sibson(values, c.unordered) : c.index.interpolate_linear(values, c.unordered);
        benchmark::DoNotOptimize(result.data());
    });
}
void make_half_edges(benchmark::State& state) {
    run_queries(state,
                [](const QueryCase& c) { benchmark::DoNotOptimize(half_edges(c.points.size(), c.triangles).data()); });
}

/// Returns the processor time that f takes.
double seconds(const std::function<void()>& f) {
    const std::clock_t start = std::clock();
    f();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
}

enum class Change { insert_all, insert_half, remove_half };

/// Times a change of half the points, or the insertion of all, against the static kernel's time for as many.
void change(benchmark::State& state, bool layer, Change kind) {
    auto points = layer ? test::naca_layer_points(point_count) : test::random_points(point_count, 1);
    test::Random random(3);
    test::shuffle(points, random);
    const std::span<const Point> all(points), first = all.first(points.size() / 2),
                                              second = all.subspan(points.size() / 2);
    std::vector<double> ratios;
    with_threads(1, [&] {
        for (auto _ : state) {
            const double whole = seconds([&] { delaunay::triangulate_points(all); });
            const double half = seconds([&] { delaunay::triangulate_points(first); });
            DynamicTriangulation changing;
            if (kind == Change::insert_all) {
                ratios.push_back(seconds([&] { changing.insert(all); }) / whole);
                continue;
            }
            changing.insert(first);
            std::vector<VertexId> ids;
            const double inserting = seconds([&] { ids = changing.insert(second); });
            const double removing = seconds([&] { changing.remove(ids); });
            ratios.push_back((kind == Change::insert_half ? inserting : removing) / (whole - half));
        }
    });
    std::sort(ratios.begin(), ratios.end());
    state.counters["ratio"] = ratios[ratios.size() / 2];
}

BENCHMARK(locate_from_last)->Unit(benchmark::kMillisecond);
BENCHMARK(locate_one_by_one)->Unit(benchmark::kMillisecond);
BENCHMARK(locate_batch)->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_vertices)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpolate, linear, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(interpolate, sibson, true)->Unit(benchmark::kMillisecond);
BENCHMARK(make_half_edges)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(change, uniform_insert_all, false, Change::insert_all)->Iterations(5);
BENCHMARK_CAPTURE(change, uniform_insert_half, false, Change::insert_half)->Iterations(5);
BENCHMARK_CAPTURE(change, uniform_remove_half, false, Change::remove_half)->Iterations(5);
BENCHMARK_CAPTURE(change, layer_insert_all, true, Change::insert_all)->Iterations(5);
BENCHMARK_CAPTURE(change, layer_insert_half, true, Change::insert_half)->Iterations(5);
BENCHMARK_CAPTURE(change, layer_remove_half, true, Change::remove_half)->Iterations(5);

}  // namespace
