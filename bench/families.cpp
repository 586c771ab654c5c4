// One table for those who choose a library: families of points and of segments, beside every other program that was
// there at build time. `./dev bench-picture` draws it.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <numbers>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <lamina/threads.hpp>
#include <lamina/triangulation.hpp>

#include "paired.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::bench {
namespace {

constexpr double full_turn = 2 * std::numbers::pi;
constexpr std::size_t usual_points = 100'000;

Point on_circle(Point centre, double radius, double angle) {
    return centre + radius * Point{std::cos(angle), std::sin(angle)};
}

// ---- points ----

std::vector<Point> uniform_family(std::size_t n) { return test::random_points(n, 3); }

/// Returns points of a normal distribution, by Box and Muller.
std::vector<Point> gaussian_family(std::size_t n) {
    test::Random random(7);
    std::vector<Point> points(n);
    for (Point& p : points) {
        const double radius = std::sqrt(-2 * std::log(random.real(1e-12, 1)));
        p = on_circle({}, radius, random.real(0, full_turn));
    }
    return points;
}

/// Returns points on 20 circles round random centres: many nearly cocircular points.
std::vector<Point> circles_family(std::size_t n) {
    test::Random random(8);
    std::vector<Point> centres(20), points(n);
    for (Point& c : centres) c = {random.real(), random.real()};
    for (std::size_t i = 0; i < n; ++i)
        points[i] = on_circle(centres[i % 20], 0.02 + 0.01 * static_cast<double>(i % 20), random.real(0, full_turn));
    return points;
}

/// Returns points on 100 circles round one centre.
std::vector<Point> rings_family(std::size_t n) {
    test::Random random(9);
    std::vector<Point> points(n);
    for (std::size_t i = 0; i < n; ++i)
        points[i] = on_circle({}, 0.01 * static_cast<double>(i % 100 + 1), random.real(0, full_turn));
    return points;
}

std::vector<Point> two_lines_family(std::size_t n) { return test::points_on_two_lines(n, 0); }
std::vector<Point> slanted_lines_family(std::size_t n) { return test::points_on_two_lines(n, 0.3); }

/// Returns points on an arc, and one that sees all of them.
std::vector<Point> fan_family(std::size_t n) {
    test::Random random(10);
    std::vector<Point> points(n);
    for (Point& p : points) p = on_circle({}, 1, random.real(0, 1));
    points[0] = {};
    return points;
}

// ---- points and segments ----

/// Appends a chain of points with the segments between them.
void append_chain(const std::vector<Point>& chain, bool closed, test::ConstrainedCase& to) {
    const std::size_t first = to.points.size();
    to.points.insert(to.points.end(), chain.begin(), chain.end());
    for (std::size_t i = 0; i + 1 < chain.size(); ++i)
        to.segments.push_back({VertexId{first + i}, VertexId{first + i + 1}});
    if (closed) to.segments.push_back({VertexId{first + chain.size() - 1}, VertexId{first}});
}

/// Returns 200 winding roads from west to east that do not meet.
test::ConstrainedCase roads_family(std::size_t n) {
    test::Random random(11);
    test::ConstrainedCase c;
    for (int road = 0; road < 200; ++road) {
        std::vector<Point> chain(n / 200);
        const double phase = random.real(0, full_turn);
        for (std::size_t i = 0; i < chain.size(); ++i) {
            const double x = (static_cast<double>(i) + 0.5 * random.real()) / static_cast<double>(chain.size());
            chain[i] = {x, 0.005 * (road + 0.3 * std::sin(20 * x + phase))};
        }
        append_chain(chain, false, c);
    }
    return c;
}

/// Returns the outlines of square blocks between streets, each side of 16 segments.
test::ConstrainedCase streets_family(std::size_t n) {
    const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(n) / 64));
    test::ConstrainedCase c;
    for (std::size_t block = 0; block < side * side; ++block) {
        const Point corner{static_cast<double>(block % side), static_cast<double>(block / side)};
        std::vector<Point> outline;
        for (int k = 0; k < 64; ++k) {
            const double s = k % 16 / 20.0;
            const Point turns[] = {{s, 0}, {0.8, s}, {0.8 - s, 0.8}, {0, 0.8 - s}};
            outline.push_back(corner + turns[k / 16]);
        }
        append_chain(outline, true, c);
    }
    return c;
}

/// Returns 100 closed contours, one in another.
test::ConstrainedCase contours_family(std::size_t n) {
    test::ConstrainedCase c;
    for (int level = 1; level <= 100; ++level) {
        std::vector<Point> contour(n / 100);
        for (std::size_t i = 0; i < contour.size(); ++i) {
            const double angle =
                full_turn * (static_cast<double>(i) + 0.37 * level) / static_cast<double>(contour.size());
            contour[i] = on_circle({}, 0.01 * level * (1 + 0.2 * std::sin(5 * angle)), angle);
        }
        append_chain(contour, true, c);
    }
    return c;
}

/// Returns random points and 1,000 segments from one side of them to the other.
test::ConstrainedCase long_lines_family(std::size_t n) {
    test::Random random(6);
    test::ConstrainedCase c{test::random_points(n, 3), {}};
    for (int i = 0; i < 1000; ++i) {
        const double y = (i + 0.5) / 1000;
        append_chain({{-0.01, y}, {1.01, y + random.real(0, 1e-4)}}, false, c);
    }
    return c;
}

/// Returns segments from one point to all others.
test::ConstrainedCase hub_family(std::size_t n) {
    test::Random random(5);
    test::ConstrainedCase c;
    c.points.push_back({});
    for (std::size_t i = 1; i < n; ++i) {
        c.points.push_back(on_circle({}, random.real(0.1, 1), 6.28 * static_cast<double>(i) / static_cast<double>(n)));
        c.segments.push_back({VertexId{0u}, VertexId{i}});
    }
    return c;
}

/// Returns random points with a third of the edges of another triangulation of them.
test::ConstrainedCase stretched_family(std::size_t n) { return test::stretched_edges_case(n, 3); }

/// Returns the same of half as many points, each of which stands in the list twice.
test::ConstrainedCase twofold_family(std::size_t n) {
    test::ConstrainedCase c = test::stretched_edges_case(n / 2, 3);
    const std::vector<Point> copies = c.points;
    const std::size_t half = copies.size();
    c.points.insert(c.points.end(), copies.begin(), copies.end());
    for (std::size_t i = 0; i < c.segments.size(); i += 2) c.segments[i].b = VertexId{c.segments[i].b.index() + half};
    return c;
}

// ---- measurements ----

/// Measures constrained triangulation, or plain triangulation where there are no segments.
void measure_case(benchmark::State& state, const test::ConstrainedCase& c) {
    std::vector<Reference> references;
    const bool plain = c.segments.empty();
#ifdef LAMINA_BENCH_CGAL
    references.push_back({"CGAL", plain ? cgal_delaunay(c.points) : cgal_constrained(c.points, c.segments)});
#endif
#ifdef LAMINA_BENCH_TRIANGLE
    references.push_back(
        {"Triangle", plain ? triangle_delaunay(c.points) : triangle_constrained(c.points, c.segments)});
#endif
#ifdef LAMINA_BENCH_CDT
    references.push_back({"CDT", cdt_constrained(c.points, c.segments)});
#endif
#ifdef LAMINA_BENCH_DELAUNATOR
    if (plain) references.push_back({"delaunator", delaunator_delaunay(c.points)});
#endif
    measure(
        state, "triangles",
        [&] { return (plain ? triangulate(c.points).triangles : triangulate(c.points, c.segments).triangles).size(); },
        references);
}
void points_of(benchmark::State& state, std::vector<Point> (*make)(std::size_t)) {
    measure_case(state, {make(static_cast<std::size_t>(state.range(0))), {}});
}
void segments_of(benchmark::State& state, test::ConstrainedCase (*make)(std::size_t)) {
    measure_case(state, make(static_cast<std::size_t>(state.range(0))));
}
void medians_of_five(benchmark::internal::Benchmark* b) {
    b->Arg(usual_points)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(points_of, uniform, uniform_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, Gaussian, gaussian_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, circles, circles_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, rings, rings_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, two_lines, two_lines_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, slanted_lines, slanted_lines_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, cross, test::points_on_a_cross)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, fan, fan_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(points_of, layer, test::naca_layer_points)->Apply(medians_of_five);
BENCHMARK_CAPTURE(segments_of, roads, roads_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(segments_of, streets, streets_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(segments_of, contours, contours_family)->Apply(medians_of_five);
BENCHMARK_CAPTURE(segments_of, long_lines, long_lines_family)->Apply(medians_of_five);
// CDT takes O(n^2) here.
BENCHMARK_CAPTURE(segments_of, hub, hub_family)
    ->Arg(5'000)
    ->Iterations(5)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(segments_of, stretched, stretched_family)->Apply(medians_of_five);

// ---- threads ----

/// Returns the processor time of the calling thread.
double thread_seconds() {
    timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Measures triangulation on two threads beside one, in turn. Counters: `one_thread_s` and `two_threads_s`, medians of
/// wall-clock time, and their ratio `speed_up`; `cost`, processor time on two threads over that on one; and
/// `calling_thread`, the share of the calling thread in it. On a busy machine the last two say what to expect of an
/// idle one: the speed-up is about 1 / (cost * calling_thread).
/// Without segments it is plain triangulation.
void measure_two_threads(benchmark::State& state, const test::ConstrainedCase& c, const ConstrainedOptions& options) {
    const auto triangles = [&] {
        return c.segments.empty() ? triangulate(c.points).triangles.size()
                                  : triangulate(c.points, c.segments, options).triangles.size();
    };
    struct Times {
        std::vector<double> wall, processor, calling;
    } one, two;
    const auto run = [&](unsigned count, Times& times) {
        with_threads(count, [&] {
            const auto begin = std::chrono::steady_clock::now();
            const double calling = thread_seconds();
            std::size_t made = 0;
            times.processor.push_back(cpu_seconds(triangles, made));
            times.calling.push_back(thread_seconds() - calling);
            times.wall.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        });
    };
    for (auto _ : state) {
        run(1, one);
        run(2, two);
        state.SetIterationTime(two.wall.back());
    }
    state.counters["one_thread_s"] = median(one.wall);
    state.counters["two_threads_s"] = median(two.wall);
    state.counters["speed_up"] = median(one.wall) / median(two.wall);
    state.counters["cost"] = median(two.processor) / median(one.processor);
    state.counters["calling_thread"] = median(two.calling) / median(two.processor);
}
void two_threads(benchmark::State& state, test::ConstrainedCase (*make)(std::size_t)) {
    measure_two_threads(state, make(static_cast<std::size_t>(state.range(0))), {});
}
void two_threads_points(benchmark::State& state, std::vector<Point> (*make)(std::size_t)) {
    measure_two_threads(state, {make(static_cast<std::size_t>(state.range(0))), {}}, {});
}
void two_threads_merging(benchmark::State& state, test::ConstrainedCase (*make)(std::size_t)) {
    measure_two_threads(state, make(static_cast<std::size_t>(state.range(0))), {.merge_distance = 0.0});
}
void million_points(benchmark::internal::Benchmark* b) {
    b->Arg(1'000'000)->Iterations(5)->UseManualTime()->Unit(benchmark::kMillisecond);
}
BENCHMARK_CAPTURE(two_threads_points, uniform, uniform_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, Gaussian, gaussian_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, circles, circles_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, rings, rings_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, two_lines, two_lines_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, slanted_lines, slanted_lines_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, cross, test::points_on_a_cross)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, fan, fan_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_points, layer, test::naca_layer_points)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, roads, roads_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, streets, streets_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, contours, contours_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, long_lines, long_lines_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, hub, hub_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads, stretched, stretched_family)->Apply(million_points);
BENCHMARK_CAPTURE(two_threads_merging, twofold, twofold_family)->Apply(million_points);

}  // namespace
}  // namespace lamina::bench
