// Plain and constrained triangulation, and the check of triangulations.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

TEST(Delaunay, EqualsBruteForceOnRandomAndDegenerateSets) {
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        Random random(seed);
        const std::size_t n = 4 + random.below(18);
        for (const auto& points : {random_points(n, seed), random_grid_points(n, 6, seed)}) {
            const auto triangles = triangulate(points).triangles;
            EXPECT_EQ(canonical(triangles), brute_force_delaunay(points)) << "seed " << seed;
        }
    }
}

TEST(Delaunay, EqualsBruteForceOnLatticesAndCircles) {
    for (const auto& points : {square_lattice(5, 6), hexagonal_lattice(5, 5), cocircular_points()}) {
        const auto triangles = triangulate(points).triangles;
        EXPECT_EQ(canonical(triangles), brute_force_delaunay(points));
        expect_valid(points, triangles);
    }
}

TEST(Delaunay, DoesNotDependOnTheOrderOfPoints) {
    for (const auto& original : {square_lattice(40, 30), hexagonal_lattice(30, 30), random_points(3000, 7),
                                 layer_points(100, 20), cocircular_points(5)}) {
        auto points = original;
        std::vector<std::uint32_t> original_index(points.size());
        std::iota(original_index.begin(), original_index.end(), 0u);
        const auto expected = canonical(triangulate(points).triangles);
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
            Random random(seed);
            shuffle(original_index, random);
            for (std::size_t i = 0; i < points.size(); ++i) points[i] = original[original_index[i]];
            auto triangles = triangulate(points).triangles;
            for (Triangle& t : triangles)
                for (VertexId& v : t.v) v = VertexId{original_index[v.index()]};
            EXPECT_EQ(canonical(triangles), expected);
        }
    }
}

TEST(Delaunay, LargeSetsAreValidAndCoverTheirHull) {
    for (const auto& points : {random_points(50000, 3), square_lattice(200, 200), hexagonal_lattice(200, 200),
                               layer_points(1000, 40), cocircular_points(8)}) {
        const auto triangles = triangulate(points).triangles;
        expect_valid(points, triangles);
    }
    EXPECT_NEAR(covered_area(square_lattice(200, 200), triangulate(square_lattice(200, 200)).triangles), 199.0 * 199.0,
                1e-6);
}

/// triangulate() cuts sets of this size into pieces; delaunay::triangulate_points() does not.
TEST(Delaunay, PiecesGiveTheSequentialTriangulation) {
    auto clustered = random_points(60'000, 8);
    for (std::size_t i = 0; i < clustered.size(); i += 2) clustered[i].x = 0.5 + 1e-4 * clustered[i].x;
    auto column = random_points(60'000, 9);
    for (std::size_t i = 0; i < 40'000; ++i) column[i].x = 0.25;  // most points share one x
    for (const auto& points : {random_points(250'000, 6), square_lattice(250, 240), hexagonal_lattice(250, 240),
                               layer_points(1400, 45), clustered, column}) {
        const auto expected = delaunay::without_ghosts(delaunay::triangulate_points(points)).triangles;
        EXPECT_EQ(canonical(triangulate(points).triangles), canonical(expected));
    }
}

TEST(Delaunay, TrianglesAndTheirOrderDoNotDependOnTheNumberOfThreads) {
    for (const std::size_t n : {1000u, 300'000u}) {
        const auto points = random_points(n, 10);
        std::vector<Triangle> one, three;
        with_threads(1, [&] { one = triangulate(points).triangles; });
        with_threads(3, [&] { three = triangulate(points).triangles; });
        EXPECT_EQ(one, three);
    }
}

TEST(Delaunay, NamesDuplicatesAmongManyPointsByTheirNumbers) {
    auto points = random_points(250'000, 11);
    points[200'123] = points[17];
    try {
        triangulate(points);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("points 17 and 200123 are the same"), std::string::npos) << e.what();
    }
}

TEST(Delaunay, FewPointsOrOneLineGiveNoTriangles) {
    EXPECT_TRUE(triangulate(std::vector<Point>{}).triangles.empty());
    EXPECT_TRUE(triangulate(std::vector<Point>{{0, 0}, {1, 1}}).triangles.empty());
    std::vector<Point> line;
    for (int i = 0; i < 100; ++i) line.push_back({double(i * 37 % 101), 2.0 * (i * 37 % 101)});
    EXPECT_TRUE(triangulate(line).triangles.empty());
    line.push_back({5, 5});
    EXPECT_EQ(triangulate(line).triangles.size(), 99u);
}

TEST(Delaunay, RefusesDuplicatesAndCoordinatesOutOfRange) {
    auto points = random_points(1000, 5);
    points[777] = points[123];
    try {
        triangulate(points);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("points 123 and 777 are the same"), std::string::npos) << e.what();
    }
    std::vector<Point> line{{0, 0}, {1, 1}, {2, 2}, {1, 1}};
    EXPECT_THROW(triangulate(line), InputError);
    for (double bad : {std::nan(""), HUGE_VAL, 1e80, 1e-80}) {
        auto some = random_points(10, 1);
        some[4].y = bad;
        EXPECT_THROW(triangulate(some), InputError) << bad;
    }
}

TEST(Delaunay, CavityOfEveryTriangle) {
    // The points are a ring and one point in its middle, which comes late or last in the order of insertion.
    for (std::size_t n = 3000; n < 3008; ++n) {
        std::vector<Point> points;
        for (std::size_t i = 0; i < n; ++i) {
            const double t = 2 * M_PI * double(i) / double(n);
            points.push_back({std::cos(t), std::sin(t)});
        }
        points.push_back({1e-3, 2e-3});
        const auto triangles = triangulate(points).triangles;
        expect_valid(points, triangles);
        EXPECT_GE(triangles.size(), n);
    }
}

TEST(Delaunay, ManyPointsOnOneLine) {
    std::vector<Point> line;
    for (int i = 0; i < 100'000; ++i) line.push_back({double(i * 7919L % 100'003), 0});
    EXPECT_TRUE(triangulate(line).triangles.empty());
    line.push_back(line[5]);
    EXPECT_THROW(triangulate(line), InputError);
}

TEST(Delaunay, RefusesDuplicatesOnHullEdgesAndLattices) {
    auto points = square_lattice(20, 20);
    for (const std::size_t copied : {0, 7, 19, 190, 399}) {
        points.push_back(points[copied]);
        EXPECT_THROW(triangulate(points), InputError) << copied;
        points.pop_back();
    }
}

TEST(Delaunay, ScalesExactlyByPowersOfTwo) {
    const auto points = layer_points(200, 20);
    const auto expected = canonical(triangulate(points).triangles);
    for (double scale : {0x1p-140, 0x1p-20, 0x1p30, 0x1p150}) {
        auto scaled = points;
        for (Point& p : scaled) p = scale * p;
        EXPECT_EQ(canonical(triangulate(scaled).triangles), expected) << scale;
    }
}

TEST(ConstrainedDelaunay, EqualsDelaunayWhereSegmentsAreDelaunayEdges) {
    const auto points = random_points(500, 9);
    const auto triangles = triangulate(points).triangles;
    std::vector<Segment> segments;
    for (std::size_t t = 0; t < triangles.size(); t += 7) segments.push_back({triangles[t].v[0], triangles[t].v[1]});
    EXPECT_EQ(canonical(triangulate(points, segments).triangles), canonical(triangles));
}

TEST(ConstrainedDelaunay, RandomCases) {
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const std::size_t n = 10 + random.below(200);
        const auto points = seed % 2 ? random_points(n, seed) : random_grid_points(n, 30, seed);
        std::vector<Segment> segments;
        for (int tries = 0; tries < 40; ++tries) {
            const Segment s{VertexId{random.below(n)}, VertexId{random.below(n)}};
            if (s.a == s.b) continue;
            const Point a = points[s.a.index()], b = points[s.b.index()];
            bool free = true;
            for (std::size_t v = 0; v < n && free; ++v)
                free = v == s.a.index() || v == s.b.index() || orient2d(a, b, points[v]) != 0 ||
                       dot(points[v] - a, points[v] - b) > 0;
            for (const Segment& o : segments) {
                const Point c = points[o.a.index()], d = points[o.b.index()];
                if (o.a == s.a || o.a == s.b || o.b == s.a || o.b == s.b) continue;
                free =
                    free && !(orient2d(a, b, c) * orient2d(a, b, d) <= 0 && orient2d(c, d, a) * orient2d(c, d, b) <= 0);
            }
            if (free) segments.push_back(s);
        }
        const auto triangles = triangulate(points, segments).triangles;
        expect_valid(points, triangles, segments);
        EXPECT_EQ(triangles.size(), triangulate(points).triangles.size());
        // The order of the segments does not matter.
        std::reverse(segments.begin(), segments.end());
        EXPECT_EQ(canonical(triangulate(points, segments).triangles), canonical(triangles)) << "seed " << seed;
    }
}

TEST(ConstrainedDelaunay, OneSegmentThroughManyTriangles) {
    auto points = random_points(2000, 21);
    points.push_back({-1, 0.5});
    points.push_back({2, 0.5000001});
    const std::vector<Segment> segments{{VertexId{2000}, VertexId{2001}}};
    expect_valid(points, triangulate(points, segments).triangles, segments);
}

TEST(ConstrainedDelaunay, KeepsAnnulusBetweenLoops) {
    Border border;
    border.add_loop({{0, 0}, {4, 0}, {4, 4}, {0, 4}}, 0.3);
    border.add_loop({{1, 1}, {1, 3}, {3, 3}, {3, 1}}, 0.2);
    const auto triangles =
        triangulate(border.points, border.segments, {.keep = KeptRegion::left_of_segments}).triangles;
    expect_valid(border.points, triangles, border.segments);
    EXPECT_NEAR(covered_area(border.points, triangles), 12.0, 1e-12);
}

TEST(ConstrainedDelaunay, CarvesSliversOfRoundedPointsOnSlantedBorders) {
    Border border;
    border.add_loop({{0, 0}, {1, 0.1}, {0.7, 1.3}, {-0.4, 0.9}}, 0.01);
    const auto triangles =
        triangulate(border.points, border.segments, {.keep = KeptRegion::left_of_segments}).triangles;
    expect_valid(border.points, triangles, border.segments);
    EXPECT_EQ(triangles.size(), border.points.size() - 2);
}

TEST(ConstrainedDelaunay, NamesCrossingSegments) {
    const std::vector<Point> points{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1.5}, {1, 0}};
    const auto message = [&](std::vector<Segment> segments) -> std::string {
        try {
            triangulate(points, segments);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    const auto s = [](std::size_t a, std::size_t b) { return Segment{VertexId{a}, VertexId{b}}; };
    EXPECT_EQ(message({s(0, 2), s(1, 3)}), "segment 1 (1-3) crosses segment 0 (0-2) (at 1, 1)");
    EXPECT_EQ(message({s(0, 9)}), "segment 0 (0-9) does not join two of the 6 points");
}

TEST(Validate, FindsEveryKindOfDefect) {
    const auto points = random_points(200, 4);
    const auto good = triangulate(points).triangles;
    ASSERT_TRUE(check_triangulation(points, good).empty());
    auto bad = good;
    std::swap(bad[5].v[0], bad[5].v[1]);
    EXPECT_FALSE(check_triangulation(points, bad).empty()) << "clockwise";
    bad = good;
    bad.push_back(good[3]);
    EXPECT_FALSE(check_triangulation(points, bad).empty()) << "duplicate";
    bad = good;
    bad[0].v[1] = VertexId{10000};
    EXPECT_FALSE(check_triangulation(points, bad).empty()) << "index";
    EXPECT_FALSE(check_triangulation(points, good, std::vector<Segment>{{VertexId{0}, VertexId{0}}}).empty())
        << "constraint";
    // A flipped edge is a valid triangulation that is not Delaunay.
    const std::vector<Point> kite{{0, 0}, {4, 0}, {2, 1}, {2, -1}};
    const std::vector<Triangle> flat{{{VertexId{0}, VertexId{1}, VertexId{2}}},
                                     {{VertexId{0}, VertexId{3}, VertexId{1}}}};
    EXPECT_FALSE(check_triangulation(kite, flat).empty());
    EXPECT_TRUE(check_triangulation(kite, flat, {}, {.require_delaunay = false}).empty());
    EXPECT_TRUE(check_triangulation(kite, flat, std::vector<Segment>{{VertexId{0}, VertexId{1}}}).empty());
}

}  // namespace
}  // namespace lamina::test
