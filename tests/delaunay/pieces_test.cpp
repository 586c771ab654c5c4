// Compares triangulation in pieces with brute force and with one triangulation of all points, on points full of ties.
#include "delaunay/pieces/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::test {
namespace {

using delaunay::pieces::PiecewiseTriangulation;
using delaunay::pieces::triangulate_in_pieces;

/// Returns the triangles of one triangulation of all points.
std::vector<Triangle> triangulated_at_once(const std::vector<Point>& points) {
    return canonical(delaunay::without_ghosts(delaunay::triangulate_points(points)).triangles);
}

void expect_pieces_of_whole(const PiecewiseTriangulation& t) {
    ASSERT_EQ(t.first.size(), t.stats.pieces + 1);
    EXPECT_EQ(t.first.front(), 0u);
    EXPECT_EQ(t.first.back(), t.triangles.size());
    EXPECT_TRUE(std::is_sorted(t.first.begin(), t.first.end()));
    EXPECT_LE(t.stats.largest_piece, t.stats.piece_vertices);
}

/// Returns points on concentric circles round a lattice point: many cocircular points and mirror images.
std::vector<Point> concentric_circles() {
    std::vector<Point> points;
    for (int k = 1; k <= 8; ++k) {
        const std::vector<Point> circle = cocircular_points(k);
        points.insert(points.end(), circle.begin(), circle.end());
    }
    points.push_back({0, 0});
    return points;
}

/// Returns points that are exactly symmetric about y = 0, x = 0 and x = y.
std::vector<Point> symmetric_points(std::size_t n) {
    std::vector<Point> points;
    for (const Point p : random_points(n / 8, 5))
        for (const Point q : {p, Point{p.y, p.x}})
            for (const Point r : {q, Point{-q.x, q.y}})
                for (const Point s : {r, Point{r.x, -r.y}}) points.push_back(s);
    return points;
}

TEST(Decomposition, EqualsBruteForceOnSmallSets) {
    std::size_t pieces = 0;
    for (std::uint64_t seed = 1; seed <= 300; ++seed) {
        Random random(seed);
        const std::size_t n = 5 + random.below(20);
        for (const auto& points : {random_points(n, seed), random_grid_points(n, 6, seed), symmetric_points(8 + n)}) {
            const PiecewiseTriangulation t = triangulate_in_pieces(points, {.depth = 4, .leaf_vertices = 4});
            ASSERT_EQ(canonical(t.triangles), brute_force_delaunay(points)) << "seed " << seed;
            expect_pieces_of_whole(t);
            pieces += t.stats.pieces;
        }
    }
    EXPECT_GT(pieces, 2000u);
    for (const auto& points : {square_lattice(5, 6), hexagonal_lattice(5, 5), cocircular_points()})
        EXPECT_EQ(canonical(triangulate_in_pieces(points, {.depth = 4, .leaf_vertices = 4}).triangles),
                  brute_force_delaunay(points));
}

TEST(Decomposition, EqualsOneTriangulationAtEveryDepth) {
    for (const auto& points :
         {random_points(20'000, 3), square_lattice(120, 100), hexagonal_lattice(120, 100), concentric_circles(),
          symmetric_points(4000), random_grid_points(4000, 80, 1), layer_points(300, 30), naca_layer_points(20'000),
          flat_plate_points(10'000, 1, 0), flat_plate_points(10'000, 0.8, 0.6)}) {
        const auto expected = triangulated_at_once(points);
        for (unsigned depth = 0; depth <= 7; ++depth) {
            const PiecewiseTriangulation t = triangulate_in_pieces(points, {.depth = depth, .leaf_vertices = 10});
            ASSERT_EQ(canonical(t.triangles), expected) << "depth " << depth;
            expect_pieces_of_whole(t);
            EXPECT_GE(t.stats.pieces, (std::size_t{1} << depth) / 2) << "depth " << depth;
        }
    }
}

TEST(Decomposition, EqualsOneTriangulationOnManyPoints) {
    for (const auto& points : {random_points(100'000, 4), naca_layer_points(100'000), square_lattice(300, 300)})
        EXPECT_EQ(canonical(triangulate(points).triangles), triangulated_at_once(points));
    const auto many = random_points(300'000, 4);
    const PiecewiseTriangulation t = triangulate_in_pieces(many, {.depth = 6, .leaf_vertices = 10});
    EXPECT_EQ(canonical(t.triangles), triangulated_at_once(many));
    EXPECT_EQ(t.stats.pieces, 64u);
    EXPECT_LE(t.stats.largest_piece * t.stats.pieces, 2 * t.stats.piece_vertices);
}

TEST(Decomposition, PointsTooCloseForSortKeys) {
    // Nearly all points lie on a few lines in a spot that is 1e-12 of the extent wide.
    auto points = random_grid_points(20'000, 300, 7);
    for (Point& p : points) p = {0.3 + 1e-12 * p.x, -0.2 + 1e-12 * p.y};
    std::sort(points.begin(), points.end(), [](Point p, Point q) { return lexicographically_less(p, q); });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    std::size_t i = 0;
    for (const Point p : random_points(100, 8)) std::swap(points[i += 50], points.emplace_back(Point{2 * p.x, p.y}));
    const DecompositionOptions deep{.depth = 6, .leaf_vertices = 10};
    ASSERT_GT(points.size(), 10'000u);
    EXPECT_EQ(canonical(triangulate_in_pieces(points, deep).triangles), triangulated_at_once(points));
    points.push_back(points[points.size() / 2]);
    EXPECT_THROW(triangulate_in_pieces(points, deep), InputError);
}

TEST(Decomposition, TurnedAndScaledPoints) {
    auto points = square_lattice(90, 90);
    for (Point& p : points) p = {0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y};
    EXPECT_EQ(canonical(triangulate_in_pieces(points, {.depth = 6, .leaf_vertices = 10}).triangles),
              triangulated_at_once(points));
    for (Point& p : points) p = {1e50 * p.x, 1e50 * p.y};
    EXPECT_EQ(canonical(triangulate_in_pieces(points, {.depth = 6, .leaf_vertices = 10}).triangles),
              triangulated_at_once(points));
}

TEST(Decomposition, DoesNotDependOnTheNumberOfThreads) {
    for (const auto& points : {random_points(60'000, 10), naca_layer_points(60'000)}) {
        std::vector<Triangle> one, three;
        with_threads(1, [&] { one = triangulate(points).triangles; });
        with_threads(3, [&] { three = triangulate(points).triangles; });
        EXPECT_EQ(one, three);
    }
}

TEST(Decomposition, LeavesAreSmallEnough) {
    const PiecewiseTriangulation t =
        triangulate_in_pieces(random_points(30'000, 2), {.depth = 20, .leaf_vertices = 500});
    EXPECT_LE(t.stats.largest_piece, 500u);
    EXPECT_EQ(t.stats.uncut, 0u);
}

TEST(Decomposition, FewPointsOrOneLineGiveNoTriangles) {
    const DecompositionOptions deep{.depth = 6, .leaf_vertices = 2};
    EXPECT_TRUE(triangulate(std::vector<Point>{}, deep).triangles.empty());
    std::vector<Point> line;
    for (int i = 0; i < 100; ++i) line.push_back({double(i * 37 % 101), 2.0 * (i * 37 % 101)});
    EXPECT_TRUE(triangulate(line, deep).triangles.empty());
    line.push_back({5, 5});
    EXPECT_EQ(canonical(triangulate(line, deep).triangles), triangulated_at_once(line));
}

TEST(Decomposition, RefusesDuplicatesAndNaN) {
    auto points = random_points(20'000, 11);
    points[17'123] = points[17];
    try {
        triangulate(points);
        FAIL() << "no error";
    } catch (const InputError& e) {
        EXPECT_NE(std::string(e.what()).find("points 17 and 17123 are the same"), std::string::npos) << e.what();
    }
    points[17] = {std::nan(""), 0};
    EXPECT_THROW(triangulate(points), InputError);
}

/// Points and the border round them.
struct Region {
    std::vector<Point> points;
    std::vector<Segment> border;
};

/// Returns a winding polygon with points inside. Most of its edges are no Delaunay edges of the points.
Region winding_region(std::size_t corners, std::size_t inside, std::uint64_t seed) {
    Random random(seed);
    Region region;
    for (std::size_t i = 0; i < corners; ++i) {
        const double t = 2 * M_PI * (double(i) + 0.8 * random.real()) / double(corners);
        const double r = random.real(0.3, 1);
        region.points.push_back({r * std::cos(t), r * std::sin(t)});
        region.border.push_back({VertexId{i}, VertexId{(i + 1) % corners}});
    }
    while (region.points.size() < corners + inside) {  // the points lie in a disc inside the polygon
        const Point p{random.real(-1, 1), random.real(-1, 1)};
        if (squared_length(p) < 0.04) region.points.push_back(p);
    }
    return region;
}

TEST(Decomposition, EqualsOneTriangulationInRegions) {
    DecompositionStats sum;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        const Region region = winding_region(20 + 5 * seed, 20 * seed, seed);
        const auto expected =
            canonical(triangulate(region.points, region.border, {.keep = KeptRegion::left_of_segments}).triangles);
        for (unsigned depth : {1u, 3u, 6u}) {
            const PiecewiseTriangulation t =
                triangulate_in_pieces(region.points, region.border, {.depth = depth, .leaf_vertices = 5});
            ASSERT_EQ(canonical(t.triangles), expected) << "seed " << seed << ", depth " << depth;
            expect_pieces_of_whole(t);
            EXPECT_EQ(t.stats.fallbacks, 0u);
            sum.pieces += t.stats.pieces;
            sum.crossing_cuts += t.stats.crossing_cuts;
        }
    }
    EXPECT_GT(sum.pieces, 500u);
    EXPECT_GT(sum.crossing_cuts, 500u);  // winding borders provoke them
}

TEST(Decomposition, NamesCrossingSegmentsByTheirNumbers) {
    Region region = winding_region(100, 2000, 3);
    std::swap(region.points[20], region.points[22]);
    std::string whole, pieces;
    try {
        triangulate(region.points, region.border, {.keep = KeptRegion::left_of_segments});
    } catch (const InputError& e) {
        whole = e.what();
    }
    try {
        triangulate_in_pieces(region.points, region.border, {.depth = 6, .leaf_vertices = 5});
    } catch (const InputError& e) {
        pieces = e.what();
    }
    EXPECT_FALSE(whole.empty());
    EXPECT_EQ(pieces, whole);
}

TEST(Pieces, LargeSetsAreCut) {
    EXPECT_EQ(triangulate(random_points(60'000, 4)).decomposition.pieces, 16u);
    EXPECT_EQ(triangulate(random_points(10'000, 4)).decomposition.pieces, 1u);
}

TEST(Pieces, PointsOnLinesStayInOne) {
    Random random(4);
    for (const double slope : {0.0, 0.3}) {
        std::vector<Point> lines(60'000), cross(60'000);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const double x = random.real();
            lines[i] = {x, slope * x + static_cast<double>(i % 2)};
            const double along = random.real(-1, 1);
            cross[i] = along * (i % 2 == 0 ? Point{1, slope} : Point{-slope, 1});
        }
        for (const auto& points : {lines, cross}) {
            const Triangulation t = triangulate(points);
            EXPECT_EQ(t.decomposition.pieces, 1u);
            EXPECT_EQ(canonical(t.triangles), triangulated_at_once(points));
        }
    }
}

TEST(Pieces, NoPathRunsRoundLargeCircles) {
    // The paths from one side of such a set to the other would hold half the points of each circle that they meet.
    Random random(8);
    std::vector<Point> points(100'000);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double radius = 0.02 + 0.01 * static_cast<double>(i % 20), angle = random.real(0, 6.28);
        points[i] = Point{0.31 * static_cast<double>(i % 20 % 5), 0.37 * static_cast<double>(i % 20 / 5)} +
                    radius * Point{std::cos(angle), std::sin(angle)};
    }
    const Triangulation t = triangulate(points);
    EXPECT_GT(t.decomposition.long_cuts, 0u);
    EXPECT_LT(t.decomposition.piece_vertices, points.size() * 5 / 4);
    EXPECT_EQ(canonical(t.triangles), triangulated_at_once(points));
}

}  // namespace
}  // namespace lamina::test
