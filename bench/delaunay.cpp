// Benchmarks of predicates stage by stage, of plain and constrained triangulation and of refinement; beside CGAL and
// Triangle if these were there at build time.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <lamina/delaunay.hpp>
#include <lamina/predicates.hpp>

#include "paired.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::bench {
namespace {

using Quadruple = std::array<Point, 4>;
constexpr std::size_t quadruple_count = 1024;

/// Returns quadruples that the filter decides.
std::vector<Quadruple> random_quadruples() {
    const std::vector<Point> p = test::random_points(4 * quadruple_count, 1);
    std::vector<Quadruple> result(quadruple_count);
    for (std::size_t i = 0; i < quadruple_count; ++i) result[i] = {p[4 * i], p[4 * i + 1], p[4 * i + 2], p[4 * i + 3]};
    return result;
}

/// Returns quadruples that integers decide: the corners of cells of a lattice, as ties of incircle(), or with the first
/// three on one line, as ties of orient2d().
std::vector<Quadruple> lattice_quadruples(bool on_line) {
    test::Random random(2);
    std::vector<Quadruple> result;
    for (std::size_t i = 0; i < quadruple_count; ++i) {
        const auto x = static_cast<double>(random.below(1000)), y = static_cast<double>(random.below(1000));
        if (on_line)
            result.push_back({Point{x, y}, {x + 1, y + 1}, {x + 2, y + 2}, {x, y + 1}});
        else
            result.push_back({Point{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
        for (Point& p : result.back()) p = 0.001 * p;
        if (!on_line) {  // or rounding would break the tie
            Quadruple& q = result.back();
            q[1] = {q[1].x, q[0].y};
            q[2] = {q[1].x, q[3].y};
            q[3] = {q[0].x, q[3].y};
        }
    }
    return result;
}

/// Returns quadruples that expansions decide: rectangles, or lines, with one end near the origin, so that differences
/// are beyond the reach of integers.
std::vector<Quadruple> wide_quadruples(bool on_line) {
    test::Random random(3);
    std::vector<Quadruple> result;
    for (std::size_t i = 0; i < quadruple_count; ++i) {
        const double x = 1e-9 * random.real(), y = 1e-9 * random.real(), u = random.real(), v = random.real();
        if (on_line)
            result.push_back({Point{x, y}, {-x, -y}, {0x1p30 * x, 0x1p30 * y}, {u, v}});
        else
            result.push_back({Point{x, y}, {u, y}, {u, v}, {x, v}});
    }
    return result;
}

void orient2d_of(benchmark::State& state, const std::vector<Quadruple>& quadruples) {
    std::size_t i = 0;
    for (auto _ : state) {
        const Quadruple& q = quadruples[i++ % quadruple_count];
        benchmark::DoNotOptimize(orient2d(q[0], q[1], q[2]));
    }
}
BENCHMARK_CAPTURE(orient2d_of, filter, random_quadruples());
BENCHMARK_CAPTURE(orient2d_of, integers, lattice_quadruples(true));
BENCHMARK_CAPTURE(orient2d_of, expansions, wide_quadruples(true));

void incircle_of(benchmark::State& state, const std::vector<Quadruple>& quadruples) {
    std::size_t i = 0;
    for (auto _ : state) {
        const Quadruple& q = quadruples[i++ % quadruple_count];
        benchmark::DoNotOptimize(incircle_perturbed(q[0], q[1], q[2], q[3]));
    }
}
BENCHMARK_CAPTURE(incircle_of, filter, random_quadruples());
BENCHMARK_CAPTURE(incircle_of, integers_and_tie, lattice_quadruples(false));
BENCHMARK_CAPTURE(incircle_of, expansions_and_tie, wide_quadruples(false));

std::vector<Point> uniform(std::size_t n) { return test::random_points(n, 3); }
std::vector<Point> square_lattice(std::size_t n) {
    const int side = static_cast<int>(std::sqrt(static_cast<double>(n)));
    return test::square_lattice(side, side);
}
std::vector<Point> hexagonal_lattice(std::size_t n) {
    const int side = static_cast<int>(std::sqrt(static_cast<double>(n)));
    return test::hexagonal_lattice(side, side);
}
std::vector<Point> flat_plate(std::size_t n) { return test::flat_plate_points(n, 1, 0); }
std::vector<Point> flat_plate_at_10_degrees(std::size_t n) {
    return test::flat_plate_points(n, 0.984807753012208, 0.17364817766693033);
}

std::vector<Point> two_flat_lines(std::size_t n) { return test::points_on_two_lines(n, 0); }
std::vector<Point> two_slanted_lines(std::size_t n) { return test::points_on_two_lines(n, 0.3); }

void triangulate(benchmark::State& state, std::vector<Point> (*make)(std::size_t)) {
    const std::vector<Point> points = make(static_cast<std::size_t>(state.range(0)));
    std::vector<Reference> references;
#ifdef LAMINA_BENCH_TRIANGLE
    references.push_back({"triangle", triangle_delaunay(points)});
#endif
#ifdef LAMINA_BENCH_CGAL
    references.push_back({"cgal", cgal_delaunay(points)});
#endif
    measure(
        state, "triangles", [&] { return triangulate(points).triangles.size(); }, references);
    state.counters["points/s"] = static_cast<double>(points.size()) / state.counters["median_s"].value;
}

/// Takes medians of five runs.
void usual(benchmark::internal::Benchmark* b) {
    b->Arg(100'000)->Arg(1'000'000)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
}
/// Takes medians of three runs, since each takes many seconds.
void large(benchmark::internal::Benchmark* b) {
    b->Arg(10'000'000)->Iterations(3)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(triangulate, uniform, uniform)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, layer, test::naca_layer_points)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, square_lattice, square_lattice)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, hexagonal_lattice, hexagonal_lattice)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, flat_plate, flat_plate)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, flat_plate_at_10_degrees, flat_plate_at_10_degrees)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, two_flat_lines, two_flat_lines)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, two_slanted_lines, two_slanted_lines)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, cross, test::points_on_a_cross)->Apply(usual);
BENCHMARK_CAPTURE(triangulate, uniform, uniform)->Apply(large);
BENCHMARK_CAPTURE(triangulate, layer, test::naca_layer_points)->Apply(large);

/// Returns a hub with n segments.
test::ConstrainedCase hub(std::size_t n) {
    test::Random random(5);
    test::ConstrainedCase c;
    c.points.push_back({0, 0});
    for (std::size_t i = 1; i <= n; ++i) {
        const double angle = 6.28 * static_cast<double>(i) / static_cast<double>(n), r = random.real(0.1, 1);
        c.points.push_back({r * std::cos(angle), r * std::sin(angle)});
        c.segments.push_back({VertexId{0u}, VertexId{i}});
    }
    return c;
}
/// Returns n random points and 1,000 segments from one side of them to the other.
test::ConstrainedCase long_lines(std::size_t n) {
    test::Random random(6);
    test::ConstrainedCase c;
    c.points = uniform(n);
    for (int i = 0; i < 1000; ++i) {
        const double y = (i + 0.5) / 1000;
        c.segments.push_back({VertexId{c.points.size()}, VertexId{c.points.size() + 1}});
        c.points.push_back({-0.01, y});
        c.points.push_back({1.01, y + random.real(0, 1e-4)});
    }
    return c;
}

void constrain_case(benchmark::State& state, const test::ConstrainedCase& c) {
    std::vector<Reference> references;
#ifdef LAMINA_BENCH_TRIANGLE
    references.push_back({"triangle", triangle_constrained(c.points, c.segments)});
#endif
#ifdef LAMINA_BENCH_CGAL
    references.push_back({"cgal", cgal_constrained(c.points, c.segments)});
#endif
    measure(
        state, "triangles", [&] { return triangulate(c.points, c.segments).triangles.size(); }, references);
    state.counters["segments"] = static_cast<double>(c.segments.size());
}
/// Constrains one edge in `one_edge_in` of a triangulation that is not Delaunay.
void constrain(benchmark::State& state, std::size_t one_edge_in) {
    constrain_case(state, test::stretched_edges_case(static_cast<std::size_t>(state.range(0)), one_edge_in));
}
void constrain_family(benchmark::State& state, test::ConstrainedCase (*make)(std::size_t)) {
    constrain_case(state, make(static_cast<std::size_t>(state.range(0))));
}
BENCHMARK_CAPTURE(constrain_family, hub, hub)
    ->Arg(30'000)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(constrain_family, long_lines, long_lines)
    ->Arg(300'000)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(constrain, some, 30)->Apply(usual);
BENCHMARK_CAPTURE(constrain, every_third, 3)->Apply(usual);

/// Refines the unit square: with lattice patches, as the library does by default, or without.
void refine_square(benchmark::State& state, double area_ratio, double min_angle_deg, bool lattice) {
    const test::RefinementCase c = test::unit_square_case(static_cast<double>(state.range(0)), area_ratio);
    RefineOptions options;
    options.min_angle_deg = min_angle_deg;
    options.lattice = lattice;
    std::vector<Reference> references;
#ifdef LAMINA_BENCH_TRIANGLE
    references.push_back(
        {"triangle", triangle_refine(c.border.points, c.border.segments, c.size, c.gradation, min_angle_deg)});
#endif
    std::vector<Point> steiner_points;
    std::vector<Triangle> triangles;
    measure(
        state, "triangles",
        [&] {
            Refinement r = refine(c.border.points, c.border.segments, c.field, options);
            steiner_points = std::move(r.steiner_points);
            triangles = std::move(r.triangles);
            state.counters["below_bound"] = static_cast<double>(r.stats.below_bound);
            state.counters["oversized"] = static_cast<double>(r.stats.oversized);
            return triangles.size();
        },
        references);

    std::vector<Point> points = c.border.points;
    points.insert(points.end(), steiner_points.begin(), steiner_points.end());
    double smallest = 180, sum = 0;
    for (const Triangle& t : triangles) {
        const double angle = test::smallest_angle_deg(points, t);
        smallest = std::min(smallest, angle);
        sum += angle;
    }
    state.counters["min_angle"] = smallest;
    state.counters["mean_min_angle"] = sum / static_cast<double>(triangles.size());
}
void refinement_sizes(benchmark::internal::Benchmark* b) {
    usual(b);
    b->Arg(5'000'000);
}
constexpr double graded = 1000;
BENCHMARK_CAPTURE(refine_square, uniform_20_7_pure, 1, 20.7, false)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, uniform_20_7_patches, 1, 20.7, true)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, uniform_30_pure, 1, 30, false)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, uniform_30_patches, 1, 30, true)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, graded_20_7_pure, graded, 20.7, false)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, graded_20_7_patches, graded, 20.7, true)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, graded_30_pure, graded, 30, false)->Apply(refinement_sizes);
BENCHMARK_CAPTURE(refine_square, graded_30_patches, graded, 30, true)->Apply(refinement_sizes);

}  // namespace
}  // namespace lamina::bench
