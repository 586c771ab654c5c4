// The Delaunay kernel on point sets like those of the program: random, layered, refined.
#include <benchmark/benchmark.h>

#include <vector>

#include <lamina/delaunay.hpp>
#include <lamina/predicates.hpp>
#include <lamina/sizing.hpp>

#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

void count_points(benchmark::State& state, std::size_t points) {
    state.counters["points/s"] =
        benchmark::Counter(static_cast<double>(points), benchmark::Counter::kIsIterationInvariantRate);
}

void orient2d_random(benchmark::State& state) {
    const std::vector<Point> points = random_points(1024, 1);
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(orient2d(points[i], points[(i + 1) & 1023], points[(i + 2) & 1023]));
        i = (i + 1) & 1023;
    }
}
BENCHMARK(orient2d_random);

void incircle_random(benchmark::State& state) {
    const std::vector<Point> points = random_points(1024, 2);
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            incircle_perturbed(points[i], points[(i + 1) & 1023], points[(i + 2) & 1023], points[(i + 3) & 1023]));
        i = (i + 1) & 1023;
    }
}
BENCHMARK(incircle_random);

void delaunay_random(benchmark::State& state) {
    const std::vector<Point> points = random_points(static_cast<std::size_t>(state.range(0)), 3);
    for (auto _ : state) benchmark::DoNotOptimize(delaunay(points).triangles.data());
    count_points(state, points.size());
}
BENCHMARK(delaunay_random)->Arg(10'000)->Arg(100'000)->Arg(1'000'000)->Unit(benchmark::kMillisecond);

void delaunay_lattice(benchmark::State& state) {
    const std::vector<Point> points = square_lattice(300, 300);
    for (auto _ : state) benchmark::DoNotOptimize(delaunay(points).triangles.data());
    count_points(state, points.size());
}
BENCHMARK(delaunay_lattice)->Unit(benchmark::kMillisecond);

void delaunay_layer(benchmark::State& state) {
    const std::vector<Point> points = layer_points(1000, 40);
    for (auto _ : state) benchmark::DoNotOptimize(delaunay(points).triangles.data());
    count_points(state, points.size());
}
BENCHMARK(delaunay_layer)->Unit(benchmark::kMillisecond);

void refine_square(benchmark::State& state) {
    const double spacing = 1.0 / static_cast<double>(state.range(0));
    const Border border = square_border(1, spacing);
    const SizeField size(spacing);
    std::size_t added = 0;
    for (auto _ : state) added = refine(border.points, border.segments, size).added.size();
    count_points(state, added);
}
BENCHMARK(refine_square)->Arg(100)->Arg(300)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamina::test
