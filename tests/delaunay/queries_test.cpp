// Queries to triangulations, against searches of all triangles and vertices and against clipped Voronoi cells.
#include <lamina/delaunay_queries.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>
#include <lamina/threads.hpp>

#include "core/predicates.hpp"
#include "support/planar_graphs.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

/// Points, triangles, and their index.
struct Indexed {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    TriangulationIndex index{points, triangles};
};

Indexed indexed_plain(const std::vector<Point>& points) { return {points, triangulate(points).triangles}; }

/// Returns the triangulation of a graph without one in ten triangles.
Indexed indexed_graph(std::uint64_t seed) {
    const PlanarGraph graph = random_planar_graph(seed).graph;
    std::vector<Triangle> triangles = triangulate(graph.points, graph.segments).triangles;
    Random random(seed);
    std::erase_if(triangles, [&](const Triangle&) { return random.below(10) == 0; });
    return {graph.points, triangles};
}

/// Returns the location of p by a search of all triangles.
PointLocation brute_force_location(const Indexed& i, Point p) {
    for (std::size_t t = 0; t < i.triangles.size(); ++t) {
        std::vector<std::uint8_t> zero;
        bool holds = true;
        for (std::uint8_t e = 0; e < 3; ++e) {
            const double side = orient2d(i.points[i.triangles[t].v[(e + 1) % 3].index()],
                                         i.points[i.triangles[t].v[(e + 2) % 3].index()], p);
            holds = holds && side >= 0;
            if (side == 0) zero.push_back(e);
        }
        if (!holds) continue;
        if (zero.empty()) return {TriangleId{t}, PointPlace::inside, 0};
        if (zero.size() == 1) return {TriangleId{t}, PointPlace::on_edge, zero[0]};
        return {TriangleId{t}, PointPlace::on_vertex, std::uint8_t(3 - zero[0] - zero[1])};
    }
    return {};
}

/// Returns points inside and outside the box of the points, and points on vertices and in the middle of edges.
std::vector<Point> queries_round(const Indexed& i, std::size_t n, std::uint64_t seed) {
    Random random(seed);
    Box box;
    for (const Point p : i.points) box.include(p);
    const Point size = box.upper - box.lower;
    std::vector<Point> queries;
    for (std::size_t k = 0; k < n; ++k) {
        queries.push_back(
            {box.lower.x + size.x * (1.4 * random.real() - 0.2), box.lower.y + size.y * (1.4 * random.real() - 0.2)});
        queries.push_back(i.points[random.below(i.points.size())]);
        if (i.triangles.empty()) continue;
        const auto& v = i.triangles[random.below(i.triangles.size())].v;
        queries.push_back(midpoint(i.points[v[0].index()], i.points[v[1].index()]));
    }
    return queries;
}

std::vector<Indexed> all_indexed() {
    std::vector<Indexed> all{indexed_plain(random_points(800, 1)), indexed_plain(random_grid_points(150, 16, 2)),
                             indexed_plain(layer_points(40, 10)), indexed_plain(cocircular_points()),
                             indexed_plain({{0, 0}, {2, 0}, {1, 1}})};
    for (std::uint64_t seed = 0; seed < 30; ++seed) all.push_back(indexed_graph(seed));
    return all;
}

TEST(Queries, LocationsAreThoseOfASearchWhateverTheHint) {
    Random random(3);
    for (const Indexed& i : all_indexed()) {
        const std::vector<Point> queries = queries_round(i, 60, 4);
        const std::vector<PointLocation> locations = i.index.locate(queries);
        for (std::size_t k = 0; k < queries.size(); ++k) {
            const PointLocation expected = brute_force_location(i, queries[k]);
            ASSERT_EQ(locations[k], expected) << queries[k].x << " " << queries[k].y;
            ASSERT_EQ(i.index.locate(queries[k]), expected);
            ASSERT_EQ(i.index.locate(queries[k], TriangleId{random.below(i.triangles.size())}), expected);
        }
    }
}

TEST(Queries, ManyLocationsInALargeTriangulation) {
    const Indexed i = indexed_plain(random_points(20000, 8));
    const std::vector<Point> queries = queries_round(i, 20000, 9);
    std::vector<PointLocation> sequential, parallel;
    with_threads(1, [&] { sequential = i.index.locate(queries); });
    with_threads(4, [&] { parallel = i.index.locate(queries); });
    EXPECT_EQ(sequential, parallel);
    std::size_t outside = 0;
    for (std::size_t k = 0; k < queries.size(); ++k) {
        const PointLocation& l = parallel[k];
        if (l.place == PointPlace::outside) {
            ++outside;
            continue;
        }
        const auto& v = i.triangles[l.triangle.index()].v;
        int zeros = 0;
        for (int e = 0; e < 3; ++e) {
            const double side =
                orient2d(i.points[v[(e + 1) % 3].index()], i.points[v[(e + 2) % 3].index()], queries[k]);
            ASSERT_GE(side, 0);
            zeros += side == 0;
        }
        ASSERT_EQ(zeros, l.place == PointPlace::inside ? 0 : l.place == PointPlace::on_edge ? 1 : 2);
    }
    EXPECT_NEAR(double(outside), 20000 * (1 - 1 / 1.96), 1500);
}

TEST(Queries, WalksEndInTriangulationsThatAreNotDelaunay) {
    // A spiral of needles round the origin: a walk that always takes the same edge first could run in circles.
    std::vector<Point> points{{0, 0}};
    std::vector<Triangle> triangles;
    for (int k = 0; k < 40; ++k)
        points.push_back((1 + 0.3 * (k % 7)) * Point{std::cos(2 * M_PI * k / 40), std::sin(2 * M_PI * k / 40)});
    for (std::size_t k = 1; k <= 40; ++k) triangles.push_back({{VertexId{0u}, VertexId{k}, VertexId{k % 40 + 1}}});
    const Indexed i{points, triangles};
    EXPECT_FALSE(i.index.is_delaunay());
    for (const Point p : queries_round(i, 300, 5)) ASSERT_EQ(i.index.locate(p), brute_force_location(i, p));
}

TEST(Queries, NearestVerticesAreThoseOfASearch) {
    for (const auto& points : {random_points(500, 1), random_grid_points(120, 14, 2), layer_points(30, 10),
                               cocircular_points(), square_lattice(9, 9)}) {
        const Indexed i = indexed_plain(points);
        EXPECT_TRUE(i.index.is_delaunay());
        std::vector<Point> queries = queries_round(i, 80, 6);
        queries.push_back({0, 0});      // as far from all cocircular points
        queries.push_back({3.5, 4.5});  // as far from four lattice points
        queries.push_back({1e9, -3e9});
        const std::vector<VertexId> nearest = i.index.nearest_vertices(queries);
        for (std::size_t k = 0; k < queries.size(); ++k) {
            std::size_t best = 0;
            for (std::size_t v = 1; v < points.size(); ++v)
                if (core::compare_distances(queries[k], points[v], points[best]) < 0) best = v;
            ASSERT_EQ(nearest[k].index(), best);
            ASSERT_EQ(i.index.nearest_vertex(queries[k]).index(), best);
        }
    }
}

TEST(Queries, BothInterpolationsReproduceLinearFunctions) {
    const auto f = [](Point p) { return 3 - 2 * p.x + 0.7 * p.y; };
    for (const auto& points : {random_points(3000, 1), random_grid_points(150, 16, 2), layer_points(60, 12),
                               square_lattice(12, 7), hexagonal_lattice(9, 9)}) {
        const Indexed i = indexed_plain(points);
        std::vector<double> values;
        for (const Point p : points) values.push_back(f(p));
        const std::vector<Point> queries = queries_round(i, 500, 7);
        const std::vector<double> linear = i.index.interpolate_linear(values, queries);
        const std::vector<double> sibson = i.index.interpolate_sibson(values, queries);
        for (std::size_t k = 0; k < queries.size(); ++k) {
            const bool outside = i.index.locate(queries[k]).place == PointPlace::outside;
            ASSERT_EQ(std::isnan(linear[k]), outside);
            ASSERT_EQ(std::isnan(sibson[k]), outside);
            if (outside) continue;
            const double scale = 1 + std::abs(f(queries[k]));
            ASSERT_NEAR(linear[k], f(queries[k]), 1e-14 * scale) << queries[k].x << " " << queries[k].y;
            ASSERT_NEAR(sibson[k], f(queries[k]), 1e-9 * scale) << queries[k].x << " " << queries[k].y;
        }
    }
}

TEST(Queries, InterpolationsHaveTheValuesAtTheVertices) {
    const std::vector<Point> points = random_points(300, 11), heights = random_points(300, 12);
    const Indexed i = indexed_plain(points);
    std::vector<double> values;
    for (const Point p : heights) values.push_back(p.x);
    EXPECT_EQ(i.index.interpolate_linear(values, points), values);
    EXPECT_EQ(i.index.interpolate_sibson(values, points), values);
    // Sibson's interpolation is continuous towards the vertices and across edges.
    for (std::size_t v = 0; v < points.size(); v += 7) {
        const std::vector<Point> near{points[v] + Point{1e-9, 2e-9}};
        const double value = i.index.interpolate_sibson(values, near)[0];
        if (!std::isnan(value)) {
            EXPECT_NEAR(value, values[v], 1e-5);
        }
    }
}

/// Returns the part of a convex polygon that is nearer to `a` than to `b`.
std::vector<Point> clipped_by_bisector(const std::vector<Point>& polygon, Point a, Point b) {
    std::vector<Point> result;
    const auto excess = [&](Point p) { return squared_length(p - a) - squared_length(p - b); };
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Point p = polygon[k], q = polygon[(k + 1) % polygon.size()];
        const double at_p = excess(p), at_q = excess(q);
        if (at_p <= 0) result.push_back(p);
        if ((at_p < 0 && at_q > 0) || (at_p > 0 && at_q < 0)) result.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    return result;
}

double polygon_area(const std::vector<Point>& polygon) {
    double twice = 0;
    for (std::size_t k = 2; k < polygon.size(); ++k)
        twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
    return 0.5 * twice;
}

TEST(Queries, SibsonWeightsAreSharesOfCellsClippedByBruteForce) {
    for (const auto& points : {random_points(60, 1), random_grid_points(40, 7, 2), square_lattice(6, 6)}) {
        const Indexed i = indexed_plain(points);
        for (const Point p : queries_round(i, 25, 13)) {
            const NaturalNeighbours n = i.index.natural_neighbours(p);
            const PointLocation at = i.index.locate(p);
            ASSERT_EQ(n.vertices.empty(), at.place == PointPlace::outside);
            if (at.place == PointPlace::outside || at.place == PointPlace::on_vertex) continue;
            double sum = 0;
            for (const double w : n.weights) sum += w;
            ASSERT_NEAR(sum, 1, 1e-14);
            // The cell that p would have, and its parts nearest to each vertex.
            constexpr double far = 50;
            std::vector<Point> cell{p + Point{-far, -far}, p + Point{far, -far}, p + Point{far, far},
                                    p + Point{-far, far}};
            for (const Point q : points) cell = clipped_by_bisector(cell, p, q);
            const bool is_unbounded = std::any_of(cell.begin(), cell.end(), [&](Point q) {
                return std::max(std::abs(q.x - p.x), std::abs(q.y - p.y)) > 0.99 * far;
            });
            if (is_unbounded) continue;
            for (std::size_t v = 0; v < points.size(); ++v) {
                std::vector<Point> part = cell;
                for (std::size_t w = 0; w < points.size(); ++w)
                    if (w != v) part = clipped_by_bisector(part, points[v], points[w]);
                const auto place = std::find(n.vertices.begin(), n.vertices.end(), VertexId{v});
                const double weight =
                    place == n.vertices.end() ? 0 : n.weights[std::size_t(place - n.vertices.begin())];
                ASSERT_NEAR(weight, polygon_area(part) / polygon_area(cell), 1e-8);
            }
        }
    }
}

TEST(Queries, LinearInterpolationLeavesHolesOut) {
    const Indexed i = indexed_graph(5);
    EXPECT_THROW(i.index.nearest_vertex({0, 0}), UsageError);
    EXPECT_THROW(i.index.natural_neighbours({0, 0}), UsageError);
    const std::vector<double> values(i.points.size(), 2.5);
    const std::vector<Point> queries = queries_round(i, 200, 14);
    const std::vector<double> linear = i.index.interpolate_linear(values, queries);
    for (std::size_t k = 0; k < queries.size(); ++k) {
        if (i.index.locate(queries[k]).place == PointPlace::outside) {
            EXPECT_TRUE(std::isnan(linear[k]));
        } else {
            EXPECT_EQ(linear[k], 2.5);
        }
    }
}

TEST(Queries, ArgumentsAreChecked) {
    const Indexed i = indexed_plain(random_points(20, 1));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(i.index.locate(Point{nan, 0}).place, PointPlace::outside);
    EXPECT_EQ(i.index.locate(std::vector<Point>{{nan, 0}, {1e300, 0}, {0, -HUGE_VAL}})[1].place, PointPlace::outside);
    EXPECT_THROW(i.index.locate(Point{0.5, 0.5}, TriangleId{i.triangles.size()}), InputError);
    EXPECT_THROW(i.index.nearest_vertex({nan, 0}), InputError);
    EXPECT_THROW(i.index.interpolate_linear(std::vector<double>(19), i.points), InputError);
    const TriangulationIndex empty({}, {});
    EXPECT_EQ(empty.locate(Point{0, 0}).place, PointPlace::outside);
    EXPECT_EQ(empty.locate(std::vector<Point>(3)).size(), 3u);
    std::vector<Triangle> flipped = i.triangles;
    std::swap(flipped[4].v[0], flipped[4].v[1]);
    try {
        TriangulationIndex{i.points, std::vector<Triangle>{flipped[4]}};
        ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
        EXPECT_EQ(e.place().triangles, std::vector<std::size_t>{0});
    }
}

TEST(Queries, ValuesBetweenPointsNearlyOnALine) {
    // Points on a slanted line up to rounding, in several directions and places, have triangles that are all needles.
    Random random(17);
    for (const Point along : {Point{0.7, 0.3}, Point{0.1, 0.9}, Point{-0.3, 0.4}})
        for (const double offset : {0.0, 66.1}) {
            std::vector<Point> points;
            for (int i = 0; i < 60; ++i) points.push_back(random.real() * along + Point{offset, 0.7 * offset});
            const std::vector<Triangle> triangles = triangulate(points).triangles;
            if (triangles.empty()) continue;
            const TriangulationIndex index(points, triangles);
            std::vector<double> values;
            for (const Point p : points) values.push_back(3 * p.x - 2 * p.y);
            int inside = 0;
            for (std::size_t i = 0; i + 1 < points.size(); ++i) {
                const Point p = points[i] + random.real() * (points[i + 1] - points[i]);
                if (index.locate(p).place == PointPlace::outside) continue;
                ++inside;
                const double exact = 3 * p.x - 2 * p.y, scale = 1e-9 * (1 + std::abs(exact));
                EXPECT_NEAR(index.interpolate_linear(values, p), exact, scale);
                const std::vector<Point> queries{p};
                EXPECT_NEAR(index.interpolate_sibson(values, queries)[0], exact, scale);
            }
            EXPECT_GT(inside, 0);
        }
}

}  // namespace
}  // namespace lamina::test
