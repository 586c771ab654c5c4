// The decoupling: separators, borders of subdomains, and the union of all refined subdomains.
#include <lamina/decoupling.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "decoupling/line_border.hpp"
#include "decoupling/lines.hpp"
#include "decoupling/separators.hpp"
#include "decoupling/subdomain.hpp"
#include "decoupling/traced_border.hpp"
#include "sizing/requests.hpp"
#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

using namespace decoupling;

/// Returns the border of a body: n points on an ellipse of unit length, whose spacing shrinks evenly by `ratio` from
/// the middle to the two ends.
std::vector<Point> ellipse(std::size_t n, double thickness, Point center = {0.5, 0}, double ratio = 1.0) {
    // A fine polyline of the upper half is weighted by 1 / spacing and divided into equal shares of the weight.
    constexpr int fine = 20000;
    const auto at = [&](double t) { return center + Point{0.5 * std::cos(t), 0.5 * thickness * std::sin(t)}; };
    std::vector<double> weight{0};
    for (int i = 0; i < fine; ++i) {
        const Point a = at(M_PI * i / fine), b = at(M_PI * (i + 1) / fine);
        const double off_middle = std::abs(midpoint(a, b).x - center.x) / 0.5;
        weight.push_back(weight.back() + distance(a, b) / (1 + (1 / ratio - 1) * off_middle));
    }
    std::vector<Point> points;
    for (int half = 0; half < 2; ++half)
        for (std::size_t k = 0; k < n / 2; ++k) {
            const double target = weight.back() * double(k) / double(n / 2);
            const auto i = std::upper_bound(weight.begin(), weight.end(), target) - weight.begin() - 1;
            const Point p = at(M_PI * double(i) / fine);
            points.push_back(half == 0 ? p : 2.0 * center - p);
        }
    return points;
}

/// Bodies with their borders, and a source for each border edge that requests its length / frozen_share.
struct Bodies {
    std::vector<Point> points;
    std::vector<std::vector<VertexId>> borders;
    std::vector<SizeSource> sources;
    double area = 0;

    void add(const std::vector<Point>& loop) {
        auto& border = borders.emplace_back();
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Point a = loop[i], b = loop[(i + 1) % loop.size()];
            border.push_back(VertexId{points.size()});
            points.push_back(a);
            sources.push_back({a, b, distance(a, b) / sizing::frozen_share});
            area += 0.5 * cross(a, b);
        }
    }
    /// Returns the size field in a square about the middle of a unit chord.
    SizeField size(double gradation, double half) const {
        return SizeField(sources, {.gradation = gradation}, {{0.5 - half, -half}, {0.5 + half, half}});
    }
};

/// Decouples the region between the bodies and a box round a unit chord.
Decoupling decouple_to(const Bodies& bodies, const SizeField& size, double far_field, double pieces_target) {
    return decouple({bodies.points, bodies.borders, size, {FarFieldShape::box, {0.5, 0}, far_field}, {pieces_target}});
}

/// Refines every subdomain and checks the union from scratch: it must be valid, of the right area and globally
/// Delaunay. Returns the number of triangles.
std::size_t expect_global_delaunay(const Bodies& bodies, const Decoupling& d, double far_field) {
    std::vector<Point> points = d.points;
    std::vector<Triangle> triangles;
    std::size_t below = 0;
    for (const Subdomain& s : d.subdomains) {
        const Refinement r = refine(s);
        EXPECT_EQ(r.stats.refused, 0u);
        EXPECT_EQ(r.stats.oversized, 0u);
        for (const Segment& e : s.segments) {
            const Point a = s.points[e.a.index()], b = s.points[e.b.index()];
            EXPECT_LT(distance(a, b), 1.06 * sizing::frozen_share * s.size(midpoint(a, b)))
                << "the test's own border is not graded";
        }
        below += r.stats.below_bound - r.stats.exempt;
        const std::size_t first = points.size();
        points.insert(points.end(), r.steiner_points.begin(), r.steiner_points.end());
        for (const Triangle& t : r.triangles) {
            Triangle global;
            for (int k = 0; k < 3; ++k)
                global.v[k] = t.v[k].index() < s.global.size() ? s.global[t.v[k].index()]
                                                               : VertexId{first + t.v[k].index() - s.global.size()};
            triangles.push_back(global);
        }
    }
    EXPECT_EQ(below, 0u);
    // No subdomain can decide ties across separators, so the Delaunay property is demanded without the tie rule.
    for (const std::string& defect : check_triangulation(points, triangles, {}, {.require_delaunay = false}))
        ADD_FAILURE() << defect;
    std::map<std::pair<VertexId, VertexId>, VertexId> apex;
    for (const Triangle& t : triangles)
        for (int e = 0; e < 3; ++e) apex[{t.v[(e + 1) % 3], t.v[(e + 2) % 3]}] = t.v[e];
    std::size_t violations = 0;
    for (const auto& [edge, w] : apex) {
        const auto other = apex.find({edge.second, edge.first});
        if (other == apex.end()) continue;
        violations += incircle(points[edge.first.index()], points[edge.second.index()], points[w.index()],
                               points[other->second.index()]) > 0;
    }
    EXPECT_EQ(violations, 0u);
    double area = 0;
    for (const Triangle& t : triangles) {
        const Point a = points[t.v[0].index()];
        area += 0.5 * cross(points[t.v[1].index()] - a, points[t.v[2].index()] - a);
    }
    EXPECT_NEAR(area, 4 * far_field * far_field - bodies.area, 1e-9 * area);
    return triangles.size();
}

TEST(Separators, EquidistributedSegmentsFollowTheField) {
    const std::vector<SizeSource> sources{{{0, 0}, {0, 0}, 0.01}};
    const SizeField size(sources, {.gradation = 0.2}, {{-20, -20}, {20, 20}});
    const Point u{0.3, 0}, v{17, 11};
    auto points = decoupling::divide_separator(u, v, size);
    points.insert(points.begin(), u);
    points.push_back(v);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
        const double h = size(midpoint(points[i], points[i + 1])), l = distance(points[i], points[i + 1]);
        EXPECT_LT(l, 1.06 * sizing::frozen_share * h);
        EXPECT_GT(l, 0.6 * h);
        if (i > 0) {
            EXPECT_LT(l / distance(points[i - 1], points[i]), 1.25);
        }
    }
    auto back = decoupling::divide_separator(v, u, size);
    std::reverse(back.begin(), back.end());
    EXPECT_TRUE(std::equal(back.begin(), back.end(), points.begin() + 1));
}

TEST(SubdomainBorders, SquareWithHoleCutAndIslands) {
    // A square cut in two by a diagonal chain, with a triangular hole in one half and a diamond loop in the other.
    std::vector<Point> points{{0, 0},     {4, 0},     {4, 4}, {0, 4},     {2.5, 0.5}, {3.5, 0.5},
                              {3.5, 1.5}, {0.5, 2.5}, {1, 3}, {0.5, 3.5}, {0.2, 3}};
    std::vector<Segment> edges;
    const auto add = [&](std::size_t a, std::size_t b, bool both) {
        edges.push_back({VertexId{a}, VertexId{b}});
        if (both) edges.push_back({VertexId{b}, VertexId{a}});
    };
    add(0, 1, false), add(1, 2, false), add(2, 3, false), add(3, 0, false), add(0, 2, true);
    add(4, 6, false), add(6, 5, false), add(5, 4, false);                  // a hole, clockwise
    add(7, 8, true), add(8, 9, true), add(9, 10, true), add(10, 7, true);  // an island, meshed on both sides
    const auto borders = decoupling::trace_borders(points, edges);
    ASSERT_EQ(borders.size(), 3u);
    std::multiset<std::size_t> sizes;
    std::size_t used = 0;
    for (const auto& border : borders) {
        std::size_t count = 0;
        for (const auto& loop : border.loops) count += loop.size();
        sizes.insert(count);
        used += count;
    }
    EXPECT_EQ(used, edges.size());
    EXPECT_EQ(sizes, (std::multiset<std::size_t>{4, 6, 7}));
}

TEST(SubdomainBorders, OneSlitCutsNothingAndTwoSlitsCutInTwo) {
    std::vector<Point> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {1, 1}, {3, 1}, {3, 3}, {1, 3}};
    std::vector<Segment> edges;
    for (std::size_t i = 0; i < 4; ++i) {
        edges.push_back({VertexId{i}, VertexId{(i + 1) % 4}});
        edges.push_back({VertexId{4 + (i + 1) % 4}, VertexId{4 + i}});
    }
    EXPECT_EQ(decoupling::trace_borders(points, edges).size(), 1u);
    edges.push_back({VertexId{0}, VertexId{4}});
    edges.push_back({VertexId{4}, VertexId{0}});
    EXPECT_EQ(decoupling::trace_borders(points, edges).size(), 1u);
    edges.push_back({VertexId{2}, VertexId{6}});
    edges.push_back({VertexId{6}, VertexId{2}});
    EXPECT_EQ(decoupling::trace_borders(points, edges).size(), 2u);
}

TEST(Decouple, UnionOfSubdomainsIsGloballyDelaunay) {
    Bodies bodies;
    bodies.add(ellipse(400, 0.15, {0.5, 0}, 10));
    std::map<double, std::size_t> count;
    for (double target : {1e9, 20'000.0, 3'000.0, 800.0}) {
        const SizeField size = bodies.size(0.08, 30);
        const Decoupling d = decouple_to(bodies, size, 30, target);
        count[target] = expect_global_delaunay(bodies, d, 30);
    }
    // Cutting costs few triangles.
    EXPECT_LT(double(count[3'000.0]), 1.06 * double(count[1e9]));
}

TEST(Decouple, SeveralBodies) {
    Bodies bodies;
    bodies.add(ellipse(120, 0.2, {0.5, 0}, 4));
    bodies.add(ellipse(100, 0.3, {1.7, -0.2}));
    const SizeField size = bodies.size(0.1, 20);
    const Decoupling d = decouple_to(bodies, size, 20, 5000);
    expect_global_delaunay(bodies, d, 20);
}

TEST(Decouple, SubdomainsStayNearTheirTargetAndEstimatesNearTheOutcome) {
    Bodies bodies;
    bodies.add(ellipse(400, 0.12));
    const SizeField size = bodies.size(0.03, 50);
    const double target = 8000;
    const Decoupling d = decouple_to(bodies, size, 50, target);
    EXPECT_GT(d.subdomains.size(), 10u);
    for (const Subdomain& s : d.subdomains) {
        const double made = double(refine(s).triangles.size());
        EXPECT_LT(made, 2 * target);
        EXPECT_NEAR(s.estimated_triangles / made, 1.0, 0.1);
    }
}

/// Expects that no subdomain holds more than twice the target, that the estimates of most subdomains are within 15 % of
/// the outcome, that decoupling costs few triangles, and that frozen borders are kept.
void expect_cut_to_size(const Bodies& bodies, const SizeField& size, double far_field, double target) {
    SCOPED_TRACE(target);
    const Decoupling whole = decouple_to(bodies, size, far_field, 1e9);
    const auto undivided = double(expect_global_delaunay(bodies, whole, far_field));
    const Decoupling d = decouple_to(bodies, size, far_field, target);
    const auto divided = double(expect_global_delaunay(bodies, d, far_field));
    EXPECT_LT(divided, (target < 1000 ? 1.03 : 1.015) * undivided);
    std::size_t well_estimated = 0;
    for (const Subdomain& s : d.subdomains) {
        const auto made = double(refine(s).triangles.size());
        EXPECT_LT(made, 2 * target);
        well_estimated += std::abs(s.estimated_triangles - made) <= 0.15 * made;
    }
    EXPECT_GE(double(well_estimated), 0.95 * double(d.subdomains.size()));
}

TEST(Decouple, OneBodyIsCutToAnySize) {
    Bodies bodies;
    bodies.add(ellipse(400, 0.15, {0.5, 0}, 10));
    for (double target : {5'000.0, 1'000.0, 400.0}) expect_cut_to_size(bodies, bodies.size(0.07, 30), 30, target);
}

TEST(Decouple, SeveralBodiesAreCutToAnySize) {
    Bodies bodies;
    bodies.add(ellipse(300, 0.2, {0.5, 0}, 4));
    bodies.add(ellipse(200, 0.3, {1.7, -0.2}, 3));
    bodies.add(ellipse(240, 0.3, {0.2, 0.45}, 2));
    for (double target : {5'000.0, 1'000.0, 400.0}) expect_cut_to_size(bodies, bodies.size(0.07, 20), 20, target);
}

TEST(Decouple, SourcesOfSizesAreCutToSizeWhereverTheyLie) {
    Bodies bodies;
    bodies.add(ellipse(300, 0.2, {0.5, 0}, 4));
    bodies.sources.push_back({.a = {1.05, 0}, .b = {6, 0.4}, .size = 0.01});
    bodies.sources.push_back({.a = {-6, 3}, .b = {-6, 3}, .size = 0.02, .radius = 0.7});
    bodies.sources.push_back({.a = {-0.3, -1.2}, .b = {0.2, -0.4}, .size = 0.008, .shape = SizeSource::Shape::box});
    for (double target : {10'000.0, 2'000.0}) expect_cut_to_size(bodies, bodies.size(0.1, 20), 20, target);
}

// A ring that is many edges wide where h is small may be one or two edges wide on the other side.
TEST(Decouple, RingsKeepTheirWidthWhereTheyAreCoarsest) {
    Bodies bodies;
    bodies.add(ellipse(400, 0.12, {0.5, 0}, 4));
    bodies.sources.push_back({.a = {1.2, -0.3}, .b = {2.2, 0.3}, .size = 0.002, .shape = SizeSource::Shape::box});
    const SizeField size = bodies.size(0.1, 50);
    expect_global_delaunay(bodies, decouple_to(bodies, size, 50, 4000), 50);
}

TEST(Decouple, NarrowGapsAreLeftAlone) {
    Bodies bodies;
    bodies.add(ellipse(600, 0.2, {0.5, 0}, 4));
    bodies.add(ellipse(600, 0.2, {0.6, 0.215}, 4));
    const SizeField size = bodies.size(0.1, 10);
    const Decoupling d = decouple_to(bodies, size, 10, 500);
    expect_global_delaunay(bodies, d, 10);
    // The gap, which is about five edges wide at its narrowest, holds no vertex of a separator.
    for (std::size_t v = bodies.points.size(); v < d.points.size(); ++v) {
        const Point p = d.points[v];
        EXPECT_FALSE(p.x > 0.5 && p.x < 0.6 && p.y > 0.08 && p.y < 0.135) << p.x << ' ' << p.y;
    }
}

TEST(SubdomainBorders, SplitAndJoinKeepEveryEdge) {
    const auto ids = [](std::initializer_list<int> values) {
        std::vector<VertexId> result;
        for (int v : values) result.push_back(VertexId{static_cast<std::size_t>(v)});
        return result;
    };
    const std::vector<Point> points(7);
    decoupling::Lines lines(points);
    const std::uint32_t outer = lines.add_loop(ids({0, 1, 2, 3})), hole = lines.add_loop(ids({4, 5, 6}));
    const auto add_line = [&](const decoupling::LineBorder& border, decoupling::LoopVertex from,
                              decoupling::LoopVertex to, std::uint32_t interior) {
        const std::uint32_t line = lines.add_line(vertex_of(border, from, lines), vertex_of(border, to, lines), 1);
        lines.number(line, interior);
        return decoupling::Stretch{line, 0, interior + 1};
    };
    decoupling::LineBorder ring{{{}, {}}};
    ring.loops[0].add({outer, 0, 4});
    ring.loops[1].add({hole, 0, 3});
    const decoupling::Stretch line = add_line(ring, {1, 2}, {0, 1}, 2);  // vertices 7 and 8
    const decoupling::LineBorder slit = decoupling::join(ring, {1, 2}, {0, 1}, line);
    ASSERT_EQ(slit.loops.size(), 1u);
    EXPECT_TRUE(slit.may_dangle);
    EXPECT_EQ(ids_of(slit.loops[0], lines), ids({6, 4, 5, 6, 7, 8, 1, 2, 3, 0, 1, 8, 7}));
    EXPECT_EQ(slit.loops[0].vertices, 13u);
    const decoupling::Stretch across = add_line(slit, {0, 1}, {0, 8}, 1);  // vertex 9
    const decoupling::BorderHalves halves = decoupling::split(slit, 1, 8, across);
    EXPECT_EQ(ids_of(halves.first.loops[0], lines), ids({4, 9, 3, 0, 1, 8, 7, 6}));
    EXPECT_EQ(ids_of(halves.second.loops[0], lines), ids({3, 9, 4, 5, 6, 7, 8, 1, 2}));
    // A line that ends inside another one.
    const decoupling::Stretch inside = add_line(halves.second, {0, 5}, {0, 3}, 3);  // from 7 to 5: vertices 10 to 12
    const decoupling::BorderHalves quarters = decoupling::split(halves.second, 5, 3, inside);
    EXPECT_EQ(ids_of(quarters.first.loops[0], lines), ids({7, 10, 11, 12, 5, 6}));
    EXPECT_EQ(ids_of(quarters.second.loops[0], lines), ids({5, 12, 11, 10, 7, 8, 1, 2, 3, 9, 4}));
}

// A line dangles in a subdomain, for instance between a body and the border to which it was joined.
TEST(Decouple, DanglingLinesAreRefinedFromBothSides) {
    Bodies bodies;
    bodies.add(ellipse(60, 0.4));
    const SizeField size = bodies.size(0.1, 3);
    Decoupling d = decouple_to(bodies, size, 1.2, 1e9);
    ASSERT_EQ(d.subdomains.size(), 1u);
    Subdomain& s = d.subdomains.front();
    VertexId rear = s.segments.front().a, on_far_field = rear;
    for (const Segment& e : s.segments) {
        if (std::abs(s.points[e.a.index()].y) < 0.3 && s.points[e.a.index()].x > 0.99 && s.points[e.a.index()].x < 1.1)
            rear = std::abs(s.points[e.a.index()].y) <= std::abs(s.points[rear.index()].y) ? e.a : rear;
    }
    for (const Segment& e : s.segments)
        if (s.points[e.a.index()].x > 1.6 &&
            (s.points[on_far_field.index()].x < 1.6 ||
             std::abs(s.points[e.a.index()].y) < std::abs(s.points[on_far_field.index()].y)))
            on_far_field = e.a;
    const auto line = decoupling::divide_separator(s.points[rear.index()], s.points[on_far_field.index()], size, 3);
    ASSERT_GT(line.size(), 2u);
    VertexId before = rear;
    const auto add = [&](VertexId v) {
        s.segments.push_back({before, v});
        s.segments.push_back({v, before});
        before = v;
    };
    for (Point p : line) {
        s.global.push_back(VertexId{d.points.size()});
        d.points.push_back(p);
        s.points.push_back(p);
        add(VertexId{s.points.size() - 1});
    }
    add(on_far_field);
    expect_global_delaunay(bodies, d, 1.2);
}

// Three borders are a thousand times as fine as the space between them, so triangles of the border have fine corners
// and a wide middle.
TEST(Decouple, EstimatesSeeWideSpacesBetweenFineBorders) {
    Bodies bodies;
    const auto small = [](Point center) {
        std::vector<Point> loop = ellipse(40, 1, {0, 0});
        for (Point& p : loop) p = center + 2e-4 * p;
        return loop;
    };
    for (Point center : {Point{0, 0}, Point{1, 0}, Point{0.5, 0.8}}) bodies.add(small(center));
    const SizeField size = bodies.size(0.3, 5);
    const Decoupling d = decouple_to(bodies, size, 5, 1e5);
    for (const Subdomain& s : d.subdomains)
        EXPECT_NEAR(s.estimated_triangles / double(refine(s).triangles.size()), 1.0, 0.15);
}

TEST(Decouple, RefusesAFarFieldWithoutRoom) {
    Bodies bodies;
    bodies.add(ellipse(60, 0.12));
    const SizeField size = bodies.size(0.1, 5);
    EXPECT_THROW(decouple_to(bodies, size, 0.5, 1e5), UsageError);
    EXPECT_NO_THROW(decouple_to(bodies, size, 0.8, 1e5));
}

}  // namespace
}  // namespace lamina::test
