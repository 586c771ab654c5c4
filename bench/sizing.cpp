// Measures the size field by its number of sources: the time to build it by threads, and the time of an evaluation. The
// points of evaluation are those of refinement, subdomain by subdomain with each point within an edge length or two of
// the last one, or points in no order.
#include <benchmark/benchmark.h>

#include <cmath>
#include <vector>

#include <lamina/sizing.hpp>

#include "core/parallel.hpp"
#include "support/point_sets.hpp"

namespace lamina {
namespace {

const Box domain{{-50, -50}, {51, 50}};

/// Returns the outer border of a layer: a thin closed curve whose edges are finest at its ends.
std::vector<SizeSource> border(std::size_t edges) {
    std::vector<SizeSource> sources;
    const auto at = [&](std::size_t i) {
        const double t = 2 * M_PI * double(i % edges) / double(edges);
        return Point{0.5 + 0.5 * std::cos(t), 0.06 * std::sin(t)};
    };
    for (std::size_t i = 0; i < edges; ++i) sources.push_back({at(i), at(i + 1), distance(at(i), at(i + 1))});
    return sources;
}

/// Returns any number of sources for one and the same field: the parts of the edges of a border of 100 edges, which
/// request the size of the whole edge.
std::vector<SizeSource> same_border(std::size_t count) {
    std::vector<SizeSource> sources;
    for (const SizeSource& edge : border(100))
        for (std::size_t i = 0; i < count / 100; ++i) {
            const auto at = [&](std::size_t k) { return edge.a + double(100 * k) / double(count) * (edge.b - edge.a); };
            sources.push_back({at(i), at(i + 1), edge.size});
        }
    return sources;
}

/// Returns the vertices of a background mesh whose sizes grow from the middle.
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

/// The field in a subdomain, and points along a random walk with steps of an edge length or two.
struct SubdomainWalk {
    SizeField size;
    std::vector<Point> points;
};

/// Returns walks in subdomains some 200 edges wide, as many of them near the border as far from it.
std::vector<SubdomainWalk> subdomain_walks(const SizeField& size, std::size_t count, std::size_t points_each) {
    test::Random random(2);
    std::vector<SubdomainWalk> result;
    while (result.size() < count) {
        const double reach = 40 * std::pow(1e-3, random.real());
        Point p{0.5 + random.real(-reach, reach), random.real(-reach, reach)};
        const double half = 100 * size(p);
        const Box box{p - Point{half, half}, p + Point{half, half}};
        SubdomainWalk walk{size.restricted_to(box), {}};
        while (walk.points.size() < points_each) {
            walk.points.push_back(p);
            const double h = 2 * size(p);
            const Point q = p + Point{random.real(-h, h), random.real(-h, h)};
            if (box.contains(q) && domain.contains(q)) p = q;
        }
        result.push_back(std::move(walk));
    }
    return result;
}

/// Returns points in no order, as many near the border as far from it.
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
    const std::vector<SizeSource> field_sources = sources(static_cast<std::size_t>(state.range(0)));
    std::size_t cells = 0;
    with_threads(static_cast<unsigned>(state.range(1)), [&] {
        for (auto _ : state) cells = SizeField(field_sources, {.gradation = 0.1}, domain).cells();
    });
    state.counters["cells"] = double(cells);
}

void count_evaluations(benchmark::State& state, std::size_t evaluations) {
    state.counters["each"] = benchmark::Counter(
        double(evaluations), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <auto sources>
void in_subdomains(benchmark::State& state) {
    const SizeField size(sources(static_cast<std::size_t>(state.range(0))), {.gradation = 0.1}, domain);
    const std::vector<SubdomainWalk> walks = subdomain_walks(size, 16, 20'000);
    for (auto _ : state) {
        double sum = 0;
        for (const SubdomainWalk& walk : walks)
            for (const Point p : walk.points) sum += walk.size(p);
        benchmark::DoNotOptimize(sum);
    }
    count_evaluations(state, walks.size() * walks.front().points.size());
}

template <auto sources>
void all_over(benchmark::State& state) {
    const SizeField size(sources(static_cast<std::size_t>(state.range(0))), {.gradation = 0.1}, domain);
    const std::vector<Point> points = scattered(300'000);
    for (auto _ : state) {
        double sum = 0;
        for (Point p : points) sum += size(p);
        benchmark::DoNotOptimize(sum);
    }
    count_evaluations(state, points.size());
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

BENCHMARK(in_subdomains<border>)->Name("border, in subdomains")->Apply(with_sources);
BENCHMARK(all_over<border>)->Name("border, all over")->Apply(with_sources);
BENCHMARK(in_subdomains<same_border>)->Name("same border, in subdomains")->Apply(with_sources);
BENCHMARK(all_over<same_border>)->Name("same border, all over")->Apply(with_sources);
BENCHMARK(in_subdomains<background>)->Name("background, in subdomains")->Apply(with_sources);
BENCHMARK(all_over<background>)->Name("background, all over")->Apply(with_sources);
BENCHMARK(build<border>)->Name("build, border")->Apply(with_sources_and_threads);
BENCHMARK(build<background>)->Name("build, background")->Apply(with_sources_and_threads);

}  // namespace
}  // namespace lamina
