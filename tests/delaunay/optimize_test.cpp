// Smoothing of triangulations that exist already.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/cell_shape.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

double mean_ratio(std::span<const Point> points, std::span<const Triangle> triangles) {
    double sum = 0;
    for (const Triangle& t : triangles)
        sum +=
            core::measure_triangle(points[t.v[0].index()], points[t.v[1].index()], points[t.v[2].index()]).mean_ratio;
    return sum / static_cast<double>(triangles.size());
}

/// A square with a slit, a segment that ends inside and two isolated vertices, refined but not smoothed.
struct Unsmoothed {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<Segment> segments;
    std::size_t input_points;
};

Unsmoothed unsmoothed(double scale = 1) {
    std::vector<Point> points{{0, 0},      {1, 0},     {1, 1},     {0, 1},      {0.2, 0.5},
                              {0.6, 0.52}, {0.3, 0.2}, {0.5, 0.3}, {0.8, 0.75}, {0.82, 0.76}};
    for (Point& p : points) p = scale * p;
    std::vector<Segment> segments;
    for (const auto& [a, b] : {std::pair{0u, 1u}, {1u, 2u}, {2u, 3u}, {3u, 0u}, {4u, 5u}, {6u, 7u}})
        segments.push_back({VertexId{a}, VertexId{b}});
    const auto triangulation = triangulate(points, segments);
    ConstrainedRefineOptions options;
    options.refine.smoothing = 0;
    const auto r = refine(points, triangulation, SizeField(0.03 * scale), options);
    Unsmoothed result{points, r.triangles, r.segments, points.size()};
    result.points.insert(result.points.end(), r.steiner_points.begin(), r.steiner_points.end());
    return result;
}

TEST(Optimize, ImprovesTrianglesAndKeepsWhatIsFixed) {
    const Unsmoothed before = unsmoothed();
    const double old_ratio = mean_ratio(before.points, before.triangles);
    double last_ratio = old_ratio;
    for (unsigned rounds : {1u, 3u, 20u}) {
        SCOPED_TRACE(rounds);
        const OptimizeOptions options{.min_angle_deg = 20, .rounds = rounds, .fixed_points = before.input_points};
        const auto after = optimize(before.points, before.triangles, before.segments, options);
        expect_valid(after.points, after.triangles, before.segments);
        EXPECT_EQ(after.triangles.size(), before.triangles.size());
        const double ratio = mean_ratio(after.points, after.triangles);
        EXPECT_GT(ratio, last_ratio);
        last_ratio = ratio;
        EXPECT_GE(smallest_angle_deg(after.points, after.triangles),
                  std::min(20.0, smallest_angle_deg(before.points, before.triangles)));
        for (std::size_t i = 0; i < before.input_points; ++i) EXPECT_EQ(after.points[i], before.points[i]);
        for (const Segment& s : before.segments)
            for (const VertexId v : {s.a, s.b}) EXPECT_EQ(after.points[v.index()], before.points[v.index()]);
    }
    EXPECT_GT(last_ratio, 0.97);
}

TEST(Optimize, DelaunayTriangulationsOfRandomPointsGetFatter) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        SCOPED_TRACE(seed);
        const auto points = random_points(400, seed);
        const std::vector<Triangle> triangles = triangulate(points).triangles;
        const auto after = optimize(points, triangles, {}, {.rounds = 10});
        expect_valid(after.points, after.triangles, {});
        EXPECT_GT(mean_ratio(after.points, after.triangles), mean_ratio(points, triangles) + 0.05);
        EXPECT_GE(smallest_angle_deg(after.points, after.triangles), smallest_angle_deg(points, triangles));
    }
}

TEST(Optimize, PowersOfTwoChangeNothingButTheScale) {
    const auto at = [](double scale) {
        const Unsmoothed before = unsmoothed(scale);
        return optimize(before.points, before.triangles, before.segments, {.fixed_points = before.input_points});
    };
    const auto one = at(1);
    for (const double scale : {0x1p-120, 0x1p100}) {
        const auto other = at(scale);
        EXPECT_EQ(other.triangles, one.triangles);
        ASSERT_EQ(other.points.size(), one.points.size());
        for (std::size_t i = 0; i < one.points.size(); ++i) EXPECT_EQ(other.points[i], scale * one.points[i]);
    }
}

TEST(Optimize, NothingToMoveIsNoError) {
    EXPECT_TRUE(optimize({}, {}, {}).triangles.empty());
    const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
    const std::vector<Triangle> one{{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
    EXPECT_EQ(optimize(points, one, {}).points, points);
    EXPECT_EQ(optimize(points, one, {}, {.rounds = 0}).triangles, one);
}

TEST(Optimize, WrongArgumentsAreRefused) {
    const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
    const std::vector<Triangle> outside{{{VertexId{0u}, VertexId{1u}, VertexId{3u}}}};
    EXPECT_THROW(optimize(points, outside, {}), InputError);
    EXPECT_THROW(optimize(points, {}, {}, {.min_angle_deg = NAN}), OptionError);
    EXPECT_THROW(optimize(points, {}, {}, {.min_angle_deg = -1}), OptionError);
    EXPECT_THROW(optimize(std::vector<Point>{{0, NAN}}, {}, {}), InputError);
}

}  // namespace
}  // namespace lamina::test
