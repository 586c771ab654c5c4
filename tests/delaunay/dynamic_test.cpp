// Changing triangulations against triangulate(), which has to make the same triangles of the same points and segments.
#include <lamina/dynamic_triangulation.hpp>

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "support/constrained_cases.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

Segment join(VertexId a, VertexId b) { return {a, b}; }

std::vector<VertexId> contained(const DynamicTriangulation& d) {
    std::vector<VertexId> ids;
    for (std::size_t i = 0; i < d.points().size(); ++i)
        if (d.contains(VertexId{i})) ids.emplace_back(i);
    return ids;
}

/// Expects the triangles that triangulate() makes of the points and segments.
void expect_static_triangles(const DynamicTriangulation& d) {
    const std::vector<VertexId> ids = contained(d);
    ASSERT_EQ(ids.size(), d.size());
    std::vector<Point> points;
    std::vector<VertexId> number(d.points().size());
    for (const VertexId id : ids) {
        number[id.index()] = VertexId{points.size()};
        points.push_back(d.points()[id.index()]);
    }
    std::vector<Segment> segments;
    for (const Segment& s : d.segments()) segments.push_back({number[s.a.index()], number[s.b.index()]});
    const std::vector<Triangle> expected =
        segments.empty() ? triangulate(points).triangles : triangulate(points, segments).triangles;
    std::vector<Triangle> triangles = d.triangles();
    for (Triangle& t : triangles)
        for (VertexId& v : t.v) v = number[v.index()];
    ASSERT_EQ(canonical(triangles), canonical(expected));
}

TEST(Dynamic, ATriangulationMadeAtOnceIsTheStaticOne) {
    for (const auto& points : {random_points(2000, 1), random_grid_points(300, 20, 2), layer_points(60, 15),
                               cocircular_points(), square_lattice(20, 10), std::vector<Point>{{0, 0}, {1, 1}, {2, 2}}})
        expect_static_triangles(DynamicTriangulation(points));
    const ConstrainedCase with_segments = stretched_edges_case(2000, 5);
    const DynamicTriangulation d(with_segments.points, with_segments.segments);
    EXPECT_EQ(d.segments().size(), with_segments.segments.size());
    expect_static_triangles(d);
}

TEST(Dynamic, EveryInsertionAndRemovalOfTiesIsExact) {
    // Few grid points, so that hulls, lines and single points come and go, and all is full of ties.
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        Random random(seed);
        const std::uint64_t side = 2 + seed % 6;
        DynamicTriangulation d;
        for (int change = 0; change < 300; ++change) {
            const std::vector<VertexId> ids = contained(d);
            if (!ids.empty() && random.below(2) == 0) {
                d.remove(ids[random.below(ids.size())]);
            } else {
                const Point p{double(random.below(side)), double(random.below(side))};
                const std::optional<VertexId> there = d.find(p);
                const VertexId id = d.insert(p);
                if (there) {
                    ASSERT_EQ(id, *there);
                }
                ASSERT_EQ(d.find(p), id);
            }
            expect_static_triangles(d);
        }
    }
}

TEST(Dynamic, ARandomMixtureOfAHundredThousandChangesIsExact) {
    Random random(7);
    DynamicTriangulation d(random_points(2000, 8));
    std::vector<VertexId> ids = contained(d);
    const std::vector<Point> layer = layer_points(300, 20);
    for (int change = 0; change < 100000; ++change) {
        if (random.below(2) == 0 && !ids.empty()) {
            const std::size_t k = random.below(ids.size());
            d.remove(ids[k]);
            ids[k] = ids.back();
            ids.pop_back();
        } else {
            const bool nearly_cocircular = random.below(4) == 0;
            const Point p = nearly_cocircular ? layer[random.below(layer.size())] : Point{random.real(), random.real()};
            const bool is_new = !d.find(p);
            const VertexId id = d.insert(p);
            if (is_new) ids.push_back(id);
        }
        if (change % 5000 == 4999) expect_static_triangles(d);
    }
}

TEST(Dynamic, BatchesOfInsertionsAndRemovalsAreExact) {
    for (const auto& points : {random_points(4000, 3), random_grid_points(1500, 50, 4), layer_points(80, 25)}) {
        DynamicTriangulation d;
        const std::span<const Point> all(points);
        const std::size_t half = points.size() / 2;
        const std::vector<VertexId> first = d.insert(all.first(half));
        std::vector<VertexId> second = d.insert(all.subspan(half));
        EXPECT_EQ(d.size(), points.size());
        for (std::size_t i = half; i < points.size(); ++i) EXPECT_EQ(second[i - half].index(), i);
        EXPECT_EQ(d.insert(all.first(half)), first);  // all there already
        EXPECT_EQ(d.size(), points.size());
        expect_static_triangles(d);
        Random random(5);
        shuffle(second, random);
        d.remove(second);
        EXPECT_EQ(d.size(), half);
        expect_static_triangles(d);
        d.remove(first);
        EXPECT_EQ(d.size(), 0u);
        EXPECT_TRUE(d.triangles().empty());
    }
}

TEST(Dynamic, SegmentsComeAndGo) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        Random random(seed);
        const auto points = seed % 2 ? random_grid_points(60, 12, seed) : random_points(60, seed);
        DynamicTriangulation d(points);
        std::set<Segment> edges;
        const auto normal = [](Segment s) { return s.a < s.b ? s : join(s.b, s.a); };
        std::size_t refused = 0;
        for (int change = 0; change < 250; ++change) {
            const std::vector<VertexId> ids = contained(d);
            const Segment s{ids[random.below(ids.size())], ids[random.below(ids.size())]};
            const std::uint64_t kind = random.below(10);
            if (kind < 5) {
                try {
                    const std::vector<Segment> chain = d.insert(s);
                    for (std::size_t i = 0; i < chain.size(); ++i) {
                        EXPECT_EQ(chain[i].a, i == 0 ? s.a : chain[i - 1].b);
                        edges.insert(normal(chain[i]));
                    }
                    if (!chain.empty()) {
                        EXPECT_EQ(chain.back().b, s.b);
                    }
                } catch (const InputError& e) {
                    ++refused;
                    ASSERT_EQ(e.place().points.size(), 4u);
                    const auto at = [&](std::size_t i) { return d.points()[e.place().points[i]]; };
                    EXPECT_LT(orient2d(at(0), at(1), at(2)) * orient2d(at(0), at(1), at(3)), 0);
                    EXPECT_LT(orient2d(at(2), at(3), at(0)) * orient2d(at(2), at(3), at(1)), 0);
                }
            } else if (kind < 8 && !edges.empty()) {
                const Segment edge = *std::next(edges.begin(), std::ptrdiff_t(random.below(edges.size())));
                d.remove(edge);
                edges.erase(edge);
            } else if (kind == 8 && !edges.empty()) {
                // A point on a segment cuts it, where rounding lets it lie there.
                const Segment edge = *std::next(edges.begin(), std::ptrdiff_t(random.below(edges.size())));
                const Point a = d.points()[edge.a.index()], b = d.points()[edge.b.index()], p = midpoint(a, b);
                const VertexId v = d.insert(p);
                if (orient2d(a, b, p) == 0) {
                    edges.erase(edge);
                    edges.insert({normal({edge.a, v}), normal({v, edge.b})});
                }
            } else {
                try {
                    d.remove(s.a);
                    EXPECT_TRUE(std::none_of(edges.begin(), edges.end(),
                                             [&](const Segment& e) { return e.a == s.a || e.b == s.a; }));
                } catch (const InputError& e) {
                    EXPECT_EQ(e.place().points, std::vector<std::size_t>{s.a.index()});
                }
            }
            ASSERT_EQ(d.segments(), std::vector<Segment>(edges.begin(), edges.end()));
            expect_static_triangles(d);
        }
        EXPECT_GT(refused, 5u);
    }
}

TEST(Dynamic, WaysOfSeveralEdgesAreRemovedAtOnce) {
    DynamicTriangulation d(square_lattice(6, 6));
    const auto id = [](std::size_t x, std::size_t y) { return VertexId{6 * x + y}; };
    EXPECT_EQ(d.insert(join(id(0, 0), id(5, 5))).size(), 5u);
    EXPECT_EQ(d.insert(join(id(4, 4), id(1, 1))).size(), 3u);
    EXPECT_THROW(d.insert(join(id(0, 1), id(1, 0))), InputError);
    EXPECT_THROW(d.remove(join(id(0, 0), id(0, 3))), InputError);
    d.remove(join(id(4, 4), id(2, 2)));
    EXPECT_EQ(d.segments().size(), 3u);
    EXPECT_THROW(d.remove(join(id(0, 0), id(5, 5))), InputError);
    EXPECT_EQ(d.segments().size(), 3u);
    d.remove(join(id(0, 0), id(2, 2)));
    d.remove(join(id(5, 5), id(4, 4)));
    EXPECT_TRUE(d.segments().empty());
    expect_static_triangles(d);
}

TEST(Dynamic, CopiesAreIndependentAndErrorsChangeNothing) {
    DynamicTriangulation d(random_points(50, 9));
    const std::vector<Triangle> before = d.triangles();
    DynamicTriangulation copy = d;
    copy.remove(VertexId{3u});
    EXPECT_FALSE(copy.contains(VertexId{3u}));
    EXPECT_TRUE(d.contains(VertexId{3u}));
    EXPECT_THROW(copy.remove(VertexId{3u}), InputError);
    EXPECT_THROW(d.remove(VertexId{50u}), InputError);
    EXPECT_THROW(d.remove(VertexId{}), InputError);
    EXPECT_THROW(d.remove(std::vector{VertexId{1u}, VertexId{2u}, VertexId{1u}}), InputError);
    EXPECT_THROW(d.insert(Point{1e300, 0}), InputError);
    EXPECT_THROW(d.insert(std::vector<Point>{{0.5, 0.5}, {NAN, 0}}), InputError);
    EXPECT_THROW(d.insert(join(VertexId{1u}, VertexId{77u})), InputError);
    EXPECT_EQ(d.triangles(), before);
    EXPECT_EQ(d.size(), 50u);
    d = copy;
    EXPECT_EQ(d.size(), 49u);
    try {
        const std::vector<Segment> crossing{join(VertexId{0u}, VertexId{1u}), join(VertexId{0u}, VertexId{2u}),
                                            join(VertexId{1u}, VertexId{3u})};
        const DynamicTriangulation refused(std::vector<Point>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, crossing);
        ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
        EXPECT_EQ(e.place().segments, std::vector<std::size_t>{2});
        EXPECT_EQ(std::set(e.place().points.begin(), e.place().points.end()), (std::set<std::size_t>{0, 1, 2, 3}));
    }
    const DynamicTriangulation equal_points(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {1, 0}});
    EXPECT_EQ(equal_points.size(), 3u);
    EXPECT_NE(equal_points.contains(VertexId{1u}), equal_points.contains(VertexId{3u}));
}

}  // namespace
}  // namespace lamina::test
