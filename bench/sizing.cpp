// The size field by number of sources: what building it takes by threads, and what an evaluation takes in the order in
// which refinement asks, each point within an edge length or two of the last, and all over the region.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/parallel.hpp"
#include "support/point_sets.hpp"

namespace lamina {
namespace {

const Box domain{{-50, -50}, {51, 50}};

/// The outer border of a layer: a thin closed curve, edges finest at its ends.
std::vector<SizeSource> border(std::size_t edges) {
    std::vector<SizeSource> sources;
    const auto at = [&](std::size_t i) {
        const double t = 2 * M_PI * double(i % edges) / double(edges);
        return Point{0.5 + 0.5 * std::cos(t), 0.06 * std::sin(t)};
    };
    for (std::size_t i = 0; i < edges; ++i) sources.push_back({at(i), at(i + 1), distance(at(i), at(i + 1))});
    return sources;
}

/// The vertices of a background mesh, with sizes that grow from the middle.
std::vector<SizeSource> background(std::size_t count) {
    test::Random random(1);
    std::vector<SizeSource> sources;
    for (std::size_t i = 0; i < count; ++i) {
        const double reach = 50 * std::pow(1e-4, random.real());
        const Point p{0.5 + random.real(-reach, reach), random.real(-reach, reach)};
        sources.push_back({p, p, 1e-3 + 0.02 * distance(p, {0.5, 0})});
    }
    return sources;
}

/// Points of a walk over the region, by steps of an edge length: near and far are as frequent as triangles are there.
std::vector<Point> walk(const SizeField& size, std::size_t count) {
    test::Random random(2);
    std::vector<Point> points;
    Point p{0.5, 0.06};
    while (points.size() < count) {
        points.push_back(p);
        const double h = 2 * size(p);
        const Point q = p + Point{random.real(-h, h), random.real(-h, h)};
        if (domain.contains(q)) p = q;
    }
    return points;
}

std::vector<Point> scattered(std::size_t count) {
    test::Random random(3);
    std::vector<Point> points;
    while (points.size() < count) {
        const double reach = 50 * std::pow(1e-3, random.real());
        points.push_back({0.5 + random.real(-reach, reach), random.real(-reach, reach)});
    }
    return points;
}

template <auto sources>
void build(benchmark::State& state) {
    const std::vector<SizeSource> of_field = sources(static_cast<std::size_t>(state.range(0)));
    std::size_t cells = 0;
    with_threads(static_cast<unsigned>(state.range(1)), [&] {
        for (auto _ : state) cells = SizeField(of_field, {.gradation = 0.1}, domain).cells();
    });
    state.counters["cells"] = double(cells);
}

template <auto sources, bool in_order>
void evaluate(benchmark::State& state) {
    const SizeField size(sources(static_cast<std::size_t>(state.range(0))), {.gradation = 0.1}, domain);
    const std::vector<Point> points = in_order ? walk(size, 1 << 18) : scattered(1 << 18);
    for (auto _ : state) {
        double sum = 0;
        for (Point p : points) sum += size(p);
        benchmark::DoNotOptimize(sum);
    }
    state.counters["ns each"] = benchmark::Counter(
        double(points.size()) * 1e-9, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void with_sources(benchmark::internal::Benchmark* b) {
    for (long n : {100, 1'000, 10'000, 100'000, 1'000'000}) b->Arg(n);
    b->ArgName("sources")->Unit(benchmark::kMillisecond);
}

void with_sources_and_threads(benchmark::internal::Benchmark* b) {
    for (long n : {100, 1'000, 10'000, 100'000, 1'000'000})
        for (long threads : {1, 2}) b->Args({n, threads});
    b->ArgNames({"sources", "threads"})->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(evaluate<border, true>)->Name("border, in order")->Apply(with_sources);
BENCHMARK(evaluate<border, false>)->Name("border, scattered")->Apply(with_sources);
BENCHMARK(evaluate<background, true>)->Name("background, in order")->Apply(with_sources);
BENCHMARK(evaluate<background, false>)->Name("background, scattered")->Apply(with_sources);
BENCHMARK(build<border>)->Name("build, border")->Apply(with_sources_and_threads);
BENCHMARK(build<background>)->Name("build, background")->Apply(with_sources_and_threads);

}  // namespace
}  // namespace lamina
