// Half-edges, neighbours, triangles round points and the boundary, against maps of edges made by brute force.
#include <lamina/delaunay_connectivity.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>
#include <lamina/threads.hpp>

#include "support/planar_graphs.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

/// Points and triangles, with what is known of their connectivity.
struct Connected {
    std::vector<Point> points;
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);

    std::size_t from(std::uint32_t h) const { return origin(triangles, h).index(); }
    std::size_t to(std::uint32_t h) const { return from(next_half_edge(h)); }
};

Connected plain(const std::vector<Point>& points) { return {points, triangulate(points).triangles}; }

/// Returns a triangulation with slits and dangling segments, without one in ten triangles: holes that touch each other
/// and the hull in every way.
Connected with_holes(std::uint64_t seed) {
    const PlanarGraph graph = random_planar_graph(seed).graph;
    std::vector<Triangle> triangles =
        triangulate(graph.points, graph.segments, {.keep = KeptRegion::inside_segments}).triangles;
    Random random(seed);
    std::erase_if(triangles, [&](const Triangle&) { return random.below(10) == 0; });
    return {graph.points, triangles};
}

/// Two squares with a triangular hole each, and all four meet in one point.
Connected touching_holes() {
    std::vector<Point> points{{0, 0}, {2, -1}, {2, 1}, {-2, 1}, {-2, -1}, {1, 0.2}, {1, -0.2}, {-1, 0.2}, {-1, -0.2}};
    const auto s = [](std::size_t a, std::size_t b) { return Segment{VertexId{a}, VertexId{b}}; };
    const std::vector<Segment> segments{s(0, 1), s(1, 2), s(2, 0), s(0, 3), s(3, 4), s(4, 0),
                                        s(0, 5), s(5, 6), s(6, 0), s(0, 7), s(7, 8), s(8, 0)};
    const auto t =
        triangulate(points, segments, {.keep = KeptRegion::inside_segments, .holes = {{0.9, 0.0}, {-0.9, 0.0}}});
    return {points, t.triangles};
}

std::vector<Connected> all_kinds() {
    std::vector<Connected> kinds{plain(random_points(3000, 1)), plain(random_grid_points(200, 20, 2)),
                                 plain(layer_points(60, 12)),   plain({{0, 0}, {1, 0}, {0, 1}}),
                                 plain({{0, 0}, {1, 1}}),       touching_holes()};
    for (std::uint64_t seed = 0; seed < 40; ++seed) kinds.push_back(with_holes(seed));
    return kinds;
}

TEST(Connectivity, HalfEdgesAreThoseOfAMapOfEdges) {
    for (const Connected& c : all_kinds()) {
        std::map<std::pair<std::size_t, std::size_t>, std::uint32_t> edges;
        for (std::uint32_t h = 0; h < c.twins.size(); ++h) edges[{c.from(h), c.to(h)}] = h;
        ASSERT_EQ(c.twins.size(), 3 * c.triangles.size());
        for (std::uint32_t h = 0; h < c.twins.size(); ++h) {
            const auto twin = edges.find({c.to(h), c.from(h)});
            ASSERT_EQ(c.twins[h], twin == edges.end() ? no_half_edge : twin->second);
        }
    }
}

TEST(Connectivity, NeighboursLieOppositeTheirCorners) {
    for (const Connected& c : all_kinds()) {
        const auto n = neighbours(c.twins);
        ASSERT_EQ(n.size(), c.triangles.size());
        for (std::size_t t = 0; t < n.size(); ++t)
            for (std::size_t e = 0; e < 3; ++e) {
                const VertexId a = c.triangles[t].v[(e + 1) % 3], b = c.triangles[t].v[(e + 2) % 3];
                std::size_t sharing = c.triangles.size();
                for (std::size_t s = 0; s < c.triangles.size() && c.triangles.size() < 500; ++s) {
                    const auto& v = c.triangles[s].v;
                    if (s != t && std::count(v, v + 3, a) && std::count(v, v + 3, b)) sharing = s;
                }
                if (c.triangles.size() >= 500) continue;
                ASSERT_EQ(n[t][e].valid(), sharing < c.triangles.size());
                if (n[t][e].valid()) {
                    ASSERT_EQ(n[t][e].index(), sharing);
                }
            }
    }
}

TEST(Connectivity, HalfEdgesRoundPointsRunCounterClockwise) {
    for (const Connected& c : all_kinds()) {
        const IndexLists at = half_edges_at_points(c.points.size(), c.triangles, c.twins);
        ASSERT_EQ(at.size(), c.points.size());
        std::set<std::uint32_t> seen(at.items.begin(), at.items.end());
        ASSERT_EQ(seen.size(), 3 * c.triangles.size());
        for (std::size_t v = 0; v < at.size(); ++v) {
            std::size_t gaps = 0;
            for (std::size_t i = 0; i < at[v].size(); ++i) {
                const std::uint32_t h = at[v][i], after = at[v][(i + 1) % at[v].size()];
                ASSERT_EQ(c.from(h), v);
                // Two that follow each other share an edge unless the boundary lies between them.
                const bool gap = c.twins[previous_half_edge(h)] == no_half_edge;
                gaps += gap;
                if (!gap) {
                    ASSERT_EQ(c.twins[previous_half_edge(h)], after);
                } else {
                    ASSERT_EQ(c.twins[after], no_half_edge);
                }
            }
            if (gaps > 0) {
                ASSERT_EQ(c.twins[at[v][0]], no_half_edge);
            }
        }
    }
}

TEST(Connectivity, LoopsHoldEachBoundaryEdgeOnceAndBoundTheArea) {
    for (const Connected& c : all_kinds()) {
        const IndexLists loops = boundary_loops(c.twins);
        std::set<std::uint32_t> seen(loops.items.begin(), loops.items.end());
        EXPECT_EQ(seen.size(), loops.items.size());
        EXPECT_EQ(std::ptrdiff_t(seen.size()), std::count(c.twins.begin(), c.twins.end(), no_half_edge));
        double area = 0;
        for (std::size_t i = 0; i < loops.size(); ++i) {
            EXPECT_EQ(loops[i][0], *std::min_element(loops[i].begin(), loops[i].end()));
            for (std::size_t k = 0; k < loops[i].size(); ++k) {
                EXPECT_EQ(c.twins[loops[i][k]], no_half_edge);
                EXPECT_EQ(c.to(loops[i][k]), c.from(loops[i][(k + 1) % loops[i].size()]));
                area += 0.5 * cross(c.points[c.from(loops[i][k])], c.points[c.to(loops[i][k])]);
            }
        }
        const double covered = covered_area(c.points, c.triangles);
        EXPECT_NEAR(area, covered, 1e-12 * (1 + covered));
    }
}

TEST(Connectivity, PlainTriangulationsHaveOneConvexLoop) {
    const Connected c = plain(random_grid_points(300, 25, 7));
    const IndexLists loops = boundary_loops(c.twins);
    ASSERT_EQ(loops.size(), 1u);
    for (std::size_t k = 0; k < loops[0].size(); ++k) {
        const Point a = c.points[c.from(loops[0][k])], b = c.points[c.to(loops[0][k])];
        for (const Point p : c.points) ASSERT_GE(orient2d(a, b, p), 0);
    }
}

TEST(Connectivity, DoesNotDependOnTheNumberOfThreads) {
    const std::vector<Point> points = random_points(60000, 5);
    const std::vector<Triangle> triangles = triangulate(points).triangles;
    std::vector<std::vector<std::uint32_t>> results;
    for (const unsigned threads : {1u, 4u}) {
        with_threads(threads, [&] {
            std::vector<std::uint32_t> twins = half_edges(points.size(), triangles);
            const IndexLists at = half_edges_at_points(points.size(), triangles, twins);
            const IndexLists loops = boundary_loops(twins);
            for (const auto* more : {&at.starts, &at.items, &loops.starts, &loops.items})
                twins.insert(twins.end(), more->begin(), more->end());
            results.push_back(twins);
        });
    }
    EXPECT_EQ(results[0], results[1]);
}

TEST(Connectivity, RefusesEdgesOfTooManyTriangles) {
    const auto triangle = [](std::size_t a, std::size_t b, std::size_t c) {
        return Triangle{{VertexId{a}, VertexId{b}, VertexId{c}}};
    };
    const std::vector<Triangle> same_side{triangle(0, 1, 2), triangle(4, 3, 0), triangle(0, 1, 3)};
    const std::vector<Triangle> three{triangle(0, 1, 2), triangle(1, 0, 3), triangle(0, 1, 4)};
    for (const auto& triangles : {same_side, three}) {
        try {
            half_edges(5, triangles);
            ADD_FAILURE() << "not refused";
        } catch (const InputError& e) {
            EXPECT_EQ(std::set(e.place().points.begin(), e.place().points.end()), (std::set<std::size_t>{0, 1}));
            ASSERT_EQ(e.place().triangles.size(), 2u);
        }
    }
    try {
        half_edges(4, three);
        ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
        EXPECT_EQ(e.place().triangles, std::vector<std::size_t>{2});
    }
}

}  // namespace
}  // namespace lamina::test
