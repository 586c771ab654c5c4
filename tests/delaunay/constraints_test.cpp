// Constrained triangulation: segments that cross, overlap, touch and run through vertices; holes.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_connectivity.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "support/point_sets.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

using Segments = std::vector<Segment>;

Segment segment(std::size_t a, std::size_t b) { return {VertexId{a}, VertexId{b}}; }

std::vector<Point> with_steiner_points(std::vector<Point> points, const ConstrainedTriangulation& t) {
    points.insert(points.end(), t.steiner_points.begin(), t.steiner_points.end());
    return points;
}

bool on_segment(Point a, Point b, Point p) { return orient2d(a, b, p) == 0 && dot(p - a, p - b) <= 0; }

bool cross_properly(Point p, Point q, Point r, Point s) {
    return orient2d(p, q, r) * orient2d(p, q, s) < 0 && orient2d(r, s, p) * orient2d(r, s, q) < 0;
}

/// Returns the segments with the smaller vertex first, sorted, each once.
Segments undirected(Segments segments) {
    for (Segment& s : segments)
        if (s.b < s.a) std::swap(s.a, s.b);
    std::sort(segments.begin(), segments.end());
    segments.erase(std::unique(segments.begin(), segments.end()), segments.end());
    return segments;
}

/// Returns the segments cut at every vertex on them, by brute force.
Segments brute_force_pieces(const std::vector<Point>& points, const Segments& segments) {
    Segments pieces;
    for (const Segment& s : segments) {
        const Point a = points[s.a.index()], b = points[s.b.index()];
        std::vector<std::size_t> chain;
        for (std::size_t v = 0; v < points.size(); ++v)
            if (on_segment(a, b, points[v])) chain.push_back(v);
        std::sort(chain.begin(), chain.end(),
                  [&](std::size_t l, std::size_t r) { return lexicographically_less(points[l], points[r]); });
        for (std::size_t i = 0; i + 1 < chain.size(); ++i) pieces.push_back(segment(chain[i], chain[i + 1]));
    }
    return undirected(pieces);
}

/// A triangulation of few points as a set of edges, made by brute force.
class EdgeSet {
public:
    /// Makes any triangulation that holds the pieces.
    EdgeSet(const std::vector<Point>& points, const Segments& pieces) : points_(points), pieces_(pieces) {
        for (const Segment& s : pieces) edges_.insert({s.a.index(), s.b.index()});
        for (std::size_t a = 0; a < points.size(); ++a)
            for (std::size_t b = a + 1; b < points.size(); ++b)
                if (is_free(a, b)) edges_.insert({a, b});
    }

    /// Flips edges until every edge that is no piece is locally Delaunay.
    void flip_all() {
        const std::size_t none = points_.size();
        for (bool flipped = true; flipped;) {
            flipped = false;
            for (const auto& [a, b] : std::vector(edges_.begin(), edges_.end())) {
                if (!has(a, b) || std::binary_search(pieces_.begin(), pieces_.end(), segment(a, b))) continue;
                const std::size_t c = apex(a, b), d = apex(b, a);
                if (c == none || d == none) continue;
                if (incircle_perturbed(points_[a], points_[b], points_[c], points_[d]) < 0) continue;
                edges_.erase({a, b});
                edges_.insert({std::min(c, d), std::max(c, d)});
                flipped = true;
            }
        }
    }

    std::vector<Triangle> triangles() const {
        std::vector<Triangle> result;
        for (const auto& [a, b] : edges_)
            for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}})
                if (const std::size_t c = apex(from, to); c < points_.size() && c > from && c > to)
                    result.push_back({VertexId{from}, VertexId{to}, VertexId{c}});
        return result;
    }

private:
    bool has(std::size_t a, std::size_t b) const { return edges_.count({std::min(a, b), std::max(a, b)}) > 0; }

    /// Returns whether a-b runs through no vertex and crosses no edge.
    bool is_free(std::size_t a, std::size_t b) const {
        for (std::size_t v = 0; v < points_.size(); ++v)
            if (v != a && v != b && on_segment(points_[a], points_[b], points_[v])) return false;
        return std::none_of(edges_.begin(), edges_.end(), [&](const auto& edge) {
            return cross_properly(points_[a], points_[b], points_[edge.first], points_[edge.second]);
        });
    }

    /// Returns the vertex on the left of a -> b that forms a triangle with it, or the number of points if a -> b has
    /// the outside of the hull on its left.
    std::size_t apex(std::size_t a, std::size_t b) const {
        std::size_t best = points_.size();
        for (std::size_t c = 0; c < points_.size(); ++c) {
            if (c == a || c == b || !has(a, c) || !has(b, c) || orient2d(points_[a], points_[b], points_[c]) <= 0)
                continue;
            if (best == points_.size() || (orient2d(points_[a], points_[best], points_[c]) <= 0 &&
                                           orient2d(points_[best], points_[b], points_[c]) <= 0))
                best = c;
        }
        return best;
    }

    const std::vector<Point>& points_;
    const Segments& pieces_;
    std::set<std::pair<std::size_t, std::size_t>> edges_;
};

/// Returns the constrained Delaunay triangulation: by Lee and Lin (1986) it is the one that flips lead to, and with the
/// tie rule there is only one.
std::vector<Triangle> brute_force_constrained(const std::vector<Point>& points, const Segments& pieces) {
    EdgeSet edges(points, pieces);
    edges.flip_all();
    return canonical(edges.triangles());
}

/// Returns random segments between the points, without crossings if `planar`.
Segments random_segments(const std::vector<Point>& points, std::size_t tries, bool planar, Random& random) {
    Segments segments;
    for (std::size_t i = 0; i < tries; ++i) {
        const Segment s = segment(random.below(points.size()), random.below(points.size()));
        if (s.a == s.b) continue;
        const bool free = std::none_of(segments.begin(), segments.end(), [&](const Segment& o) {
            return cross_properly(points[s.a.index()], points[s.b.index()], points[o.a.index()], points[o.b.index()]);
        });
        if (free || !planar) segments.push_back(s);
    }
    return segments;
}

/// Returns n points, or fewer, of one of four kinds: random, full of ties, cocircular, or on a few lines.
std::vector<Point> mixed_points(std::size_t n, std::uint64_t seed) {
    switch (seed % 4) {
        case 0:
            return random_points(n, seed);
        case 1:
            return random_grid_points(n, std::max(4, int(std::sqrt(2.0 * double(n)))), seed);
        case 2: {
            auto circle = cocircular_points(5);
            Random random(seed);
            shuffle(circle, random);
            circle.resize(std::min(n, circle.size()));
            return circle;
        }
        default: {
            // Points on a few slanted lines.
            Random random(seed);
            std::set<std::pair<double, double>> seen;
            while (seen.size() < n) {
                const double k = double(random.below(3 * n));
                const double line = double(random.below(3));
                seen.insert({k, 2 * k + 7 * line * line});
            }
            std::vector<Point> points;
            for (const auto& [x, y] : seen) points.push_back({x, y});
            return points;
        }
    }
}

/// Checks all that triangulate() promises where the convex hull is kept.
void expect_constrained(const std::vector<Point>& points, const Segments& segments, const ConstrainedTriangulation& t) {
    const auto all = with_steiner_points(points, t);
    expect_valid(all, t.triangles, t.segments);
    // The triangles cover the convex hull if they are as many as any triangulation of these points has.
    EXPECT_EQ(t.triangles.size(), triangulate(all).triangles.size());
    ASSERT_EQ(t.segments.size(), t.parents.size());
    EXPECT_EQ(undirected(t.segments).size(), t.segments.size()) << "listed twice";
    EXPECT_TRUE(std::is_sorted(t.parents.begin(), t.parents.end()));
    if (t.steiner_points.empty()) {
        EXPECT_EQ(undirected(t.segments), brute_force_pieces(points, segments));
    }
    for (std::size_t i = 0; i < t.segments.size(); ++i) {
        // An edge lies near its parent and has its direction; it lies exactly on it where nothing was rounded.
        const Point a = points[segments[t.parents[i]].a.index()], b = points[segments[t.parents[i]].b.index()];
        const Point p = all[t.segments[i].a.index()], q = all[t.segments[i].b.index()];
        if (t.steiner_points.empty() || distance(p, q) > 1e-14) {
            EXPECT_GT(dot(q - p, b - a), 0);
        }
        const double size = std::max({length(a), length(b), 1.0});
        for (Point end : {p, q}) EXPECT_LE(std::abs(cross(b - a, end - a)), 1e-12 * size * distance(a, b));
        if (t.steiner_points.empty()) {
            EXPECT_TRUE(on_segment(a, b, p) && on_segment(a, b, q));
        }
    }
}

Segments shuffled(Segments segments, std::uint64_t seed) {
    Random random(seed);
    shuffle(segments, random);
    for (Segment& s : segments)
        if (random.below(2)) std::swap(s.a, s.b);
    return segments;
}

TEST(Constraints, EqualBruteForceOnSmallSets) {
    for (std::uint64_t seed = 1; seed <= 600; ++seed) {
        Random random(seed);
        const auto points = mixed_points(4 + random.below(11), seed);
        const auto segments = random_segments(points, 1 + random.below(8), true, random);
        ConstrainedTriangulation t;
        try {
            t = triangulate(points, segments);
        } catch (const InputError& e) {
            EXPECT_TRUE(triangulate(points).triangles.empty()) << e.what();
            continue;
        }
        SCOPED_TRACE(seed);
        expect_constrained(points, segments, t);
        EXPECT_EQ(canonical(t.triangles), brute_force_constrained(points, undirected(t.segments)));
    }
}

TEST(Constraints, PlanarSegmentsOnLargerSetsInAnyOrder) {
    for (std::uint64_t seed = 1; seed <= 700; ++seed) {
        Random random(1000 + seed);
        const auto points = mixed_points(20 + random.below(80), seed);
        const auto segments = random_segments(points, 10 + random.below(60), true, random);
        const auto t = triangulate(points, segments);
        SCOPED_TRACE(seed);
        expect_constrained(points, segments, t);
        const auto other = triangulate(points, shuffled(segments, seed));
        EXPECT_EQ(canonical(other.triangles), canonical(t.triangles));
        EXPECT_EQ(undirected(other.segments), undirected(t.segments));
        // No segments cross, so allowing crossings changes nothing.
        const auto resolved = triangulate(points, segments, {.crossings = Crossings::insert});
        EXPECT_TRUE(resolved.steiner_points.empty());
        EXPECT_EQ(resolved.triangles, t.triangles);
        EXPECT_EQ(resolved.segments, t.segments);
        EXPECT_EQ(resolved.parents, t.parents);
    }
}

TEST(Constraints, CrossingSegmentsAreResolvedInAnyOrder) {
    for (std::uint64_t seed = 1; seed <= 700; ++seed) {
        Random random(5000 + seed);
        const auto points = mixed_points(8 + random.below(40), seed);
        const auto segments = random_segments(points, 4 + random.below(25), false, random);
        SCOPED_TRACE(seed);
        const auto t = triangulate(points, segments, {.crossings = Crossings::insert});
        expect_constrained(points, segments, t);
        const auto other = triangulate(points, shuffled(segments, seed), {.crossings = Crossings::insert});
        EXPECT_EQ(other.steiner_points, t.steiner_points);
        EXPECT_EQ(canonical(other.triangles), canonical(t.triangles));
        EXPECT_EQ(undirected(other.segments), undirected(t.segments));
        const bool crossing = std::any_of(segments.begin(), segments.end(), [&](const Segment& s) {
            return std::any_of(segments.begin(), segments.end(), [&](const Segment& o) {
                return cross_properly(points[s.a.index()], points[s.b.index()], points[o.a.index()],
                                      points[o.b.index()]);
            });
        });
        if (crossing) {
            EXPECT_THROW(triangulate(points, segments), InputError);
        }
    }
}

TEST(Constraints, NearlyParallelAndNearlyConcurrentSegmentsStayPlanar) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        Random random(seed);
        std::vector<Point> points;
        Segments segments;
        for (int i = 0; i < 14; ++i) {
            // The segments run through one point but for rounding, or form a bundle a few ulps wide.
            const double a = random.real(0, 6.28), tilt = seed % 2 ? a : 1e-15 * random.real(-8, 8) + 0.7;
            const Point c{0.3 + 1e-16 * random.real(-4, 4), 0.1 + 1e-16 * random.real(-4, 4)};
            const Point d{std::cos(tilt), std::sin(tilt)};
            segments.push_back(segment(points.size(), points.size() + 1));
            points.push_back(c + random.real(0.5, 1) * d);
            points.push_back(c - random.real(0.5, 1) * d);
        }
        points.push_back({0.31, 5});
        const auto t = triangulate(points, segments, {.crossings = Crossings::insert});
        SCOPED_TRACE(seed);
        expect_constrained(points, segments, t);
        EXPECT_EQ(triangulate(points, shuffled(segments, seed), {.crossings = Crossings::insert}).steiner_points,
                  t.steiner_points);
    }
}

TEST(Constraints, CrossingAtAVertexSnapsToIt) {
    const std::vector<Point> points{{0, 0}, {2, 2}, {0, 2}, {2, 0}, {1, 1}, {1, 5}};
    const Segments segments{segment(0, 1), segment(2, 3)};
    for (Crossings crossings : {Crossings::refuse, Crossings::insert}) {
        const auto t = triangulate(points, segments, {.crossings = crossings});
        EXPECT_TRUE(t.steiner_points.empty());
        const Segments expected{segment(0, 4), segment(4, 1), segment(2, 4), segment(4, 3)};
        EXPECT_EQ(t.segments, expected);
        EXPECT_EQ(t.parents, (std::vector<std::uint32_t>{0, 0, 1, 1}));
    }
}

TEST(Constraints, OverlappingAndRepeatedSegmentsMerge) {
    const std::vector<Point> points{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 2}, {1, -2}};
    const Segments segments{segment(0, 2), segment(3, 1), segment(0, 2), segment(1, 2), segment(0, 3)};
    const auto t = triangulate(points, segments);
    EXPECT_EQ(t.segments, (Segments{segment(0, 1), segment(1, 2), segment(3, 2)}));
    EXPECT_EQ(t.parents, (std::vector<std::uint32_t>{0, 0, 1}));
    expect_constrained(points, segments, t);
}

TEST(Constraints, ErrorsNameTheSegments) {
    const std::vector<Point> points{{0, 0}, {4, 4}, {0, 4}, {4, 0}, {1, 1}, {3, 5}};
    const auto message = [&](const Segments& segments, ConstrainedOptions options = {}) -> std::string {
        try {
            triangulate(points, segments, options);
        } catch (const InputError& e) {
            return e.what();
        }
        return "no error";
    };
    // Segment 0 is split at point 4: its pieces still carry its name.
    EXPECT_EQ(message({segment(0, 1), segment(2, 3)}), "segment 1 (2-3) crosses segment 0 (0-1) (at 2, 2)");
    EXPECT_EQ(message({segment(0, 1), segment(2, 3)}, {.crossings = Crossings::insert}), "no error");
    EXPECT_EQ(message({segment(0, 9)}, {.crossings = Crossings::insert}),
              "segment 0 (0-9) does not join two of the 6 points");
    EXPECT_EQ(message({segment(0, 1)}, {.holes = {{2, 2}}}), "hole 0 lies on a segment (at 2, 2)");
    EXPECT_EQ(message({segment(0, 1)}, {.holes = {{9, 9}, {1, 1}}}), "hole 1 lies on a vertex (at 1, 1)");
}

/// A square of side 10 with a square hole of side 2 and a pocket open to the outside.
///
///      3 ---- 6   5 ---- 2
///      |       \ /       |
///      |        4        |
///      |    [ ]          |
///      0 --------------- 1
struct Plate {
    std::vector<Point> points{{0, 0},  {10, 0}, {10, 10}, {0, 10}, {5, 8}, {6, 10},
                              {4, 10}, {3, 3},  {3, 5},   {5, 5},  {5, 3}};
    Segments segments{segment(0, 1), segment(1, 2), segment(2, 5), segment(5, 4),  segment(4, 6), segment(6, 3),
                      segment(3, 0), segment(7, 8), segment(8, 9), segment(9, 10), segment(10, 7)};
    double area = 100 - 2 - 4;
};

TEST(Constraints, HolesBySeedByLoopAndFromOutside) {
    const Plate plate;
    const auto by_loop = triangulate(plate.points, plate.segments, {.keep = KeptRegion::left_of_segments});
    const auto by_seed =
        triangulate(plate.points, plate.segments, {.keep = KeptRegion::inside_segments, .holes = {{4, 4}, {50, 50}}});
    EXPECT_NEAR(covered_area(plate.points, by_loop.triangles), plate.area, 1e-12);
    EXPECT_EQ(by_loop.triangles, by_seed.triangles);
    EXPECT_EQ(by_seed.idle_holes, (std::vector<std::size_t>{1}));
    EXPECT_EQ(by_loop.segments, plate.segments);
    EXPECT_EQ(by_seed.segments, plate.segments);
    expect_valid(plate.points, by_seed.triangles, by_seed.segments);
    const auto inside = triangulate(plate.points, plate.segments, {.keep = KeptRegion::inside_segments});
    EXPECT_NEAR(covered_area(plate.points, inside.triangles), plate.area + 4, 1e-12);
    // The second seed lies in the pocket, the third where the first one does.
    const auto idle = triangulate(plate.points, plate.segments,
                                  {.keep = KeptRegion::inside_segments, .holes = {{4, 4}, {5, 9}, {4.5, 4.5}}});
    EXPECT_EQ(idle.triangles, by_seed.triangles);
    EXPECT_EQ(idle.idle_holes, (std::vector<std::size_t>{1, 2}));
    const std::vector<Point> line{{0, 0}, {1, 1}, {2, 2}};
    EXPECT_EQ(triangulate(line, {}, {.holes = {{5, 5}, {1, 0}}}).idle_holes, (std::vector<std::size_t>{0, 1}));
    const auto hull = triangulate(plate.points, plate.segments);
    EXPECT_NEAR(covered_area(plate.points, hull.triangles), 100, 1e-12);
    // An open polygon encloses nothing. A seed in the region removes all of it and leaves only the hole.
    const Segments open(plate.segments.begin(), plate.segments.begin() + 6);
    EXPECT_TRUE(triangulate(plate.points, open, {.keep = KeptRegion::inside_segments}).triangles.empty());
    const auto core =
        triangulate(plate.points, plate.segments, {.keep = KeptRegion::inside_segments, .holes = {{1, 1}}});
    EXPECT_NEAR(covered_area(plate.points, core.triangles), 4, 1e-12);
    EXPECT_EQ(core.segments.size(), 4u);
}

TEST(Constraints, HolesInManyCells) {
    // Every second cell of a lattice is a hole.
    const int n = 21;
    const auto points = square_lattice(n, n);
    Segments segments;
    for (int i = 0; i < n; ++i) {
        segments.push_back(segment(std::size_t(i) * n, std::size_t(i) * n + n - 1));
        segments.push_back(segment(i, std::size_t(n - 1) * n + i));
    }
    ConstrainedOptions options;
    for (int i = 0; i < n - 1; ++i)
        for (int j = i % 2; j < n - 1; j += 2) options.holes.push_back({i + 0.3, j + 0.4});
    const auto t = triangulate(points, segments, options);
    EXPECT_EQ(t.triangles.size(), std::size_t((n - 1) * (n - 1)));
    EXPECT_NEAR(covered_area(points, t.triangles), (n - 1) * (n - 1) / 2.0, 1e-9);
}

TEST(Constraints, LatticesWithLongSegments) {
    const auto points = square_lattice(60, 60);
    const Segments segments{segment(0, 3599), segment(59, 3540), segment(30, 3599), segment(0, 59), segment(1, 3541)};
    EXPECT_THROW(triangulate(points, segments), InputError);
    const auto t = triangulate(points, segments, {.crossings = Crossings::insert});
    expect_constrained(points, segments, t);
    EXPECT_FALSE(t.steiner_points.empty());
    const Segments apart{segment(0, 3599), segment(30, 1859), segment(1860, 3570), segment(0, 59)};
    expect_constrained(points, apart, triangulate(points, apart));
}

TEST(Constraints, CocircularRingsWithChords) {
    auto points = cocircular_points(5);
    const std::size_t n = points.size();
    for (Point p : cocircular_points(3)) points.push_back(p);
    Segments chords;
    for (std::size_t i = 0; i < n; i += 3) chords.push_back(segment(i, (i * 7 + 5) % n));
    const auto t = triangulate(points, chords, {.crossings = Crossings::insert});
    expect_constrained(points, chords, t);
}

TEST(Constraints, CollinearChainsOfManyVertices) {
    std::vector<Point> points;
    for (int i = 0; i < 500; ++i) points.push_back({3.0 * i, 7.0 * i});
    points.push_back({-1000, 4000});
    points.push_back({4000, 1000});
    const Segments segments{segment(0, 499), segment(400, 20), segment(250, 251)};
    const auto t = triangulate(points, segments);
    expect_constrained(points, segments, t);
    EXPECT_EQ(t.segments.size(), 499u);
}

TEST(Constraints, NestedThinSpirals) {
    // Two arms close to each other are wound up together.
    for (double gap : {0.3, 1e-3, 1e-9}) {
        std::vector<Point> points;
        Segments segments;
        for (double shift : {0.0, gap}) {
            for (int i = 0; i <= 1200; ++i) {
                const double a = 0.05 * i, r = 1 + a + shift;
                if (i > 0) segments.push_back(segment(points.size() - 1, points.size()));
                points.push_back({r * std::cos(a), r * std::sin(a)});
            }
        }
        const auto t = triangulate(points, segments);
        expect_constrained(points, segments, t);
        // If both ends are closed, the arms bound a ribbon, which is one strip of triangles.
        auto ribbon = segments;
        ribbon.push_back(segment(0, 1201));
        ribbon.push_back(segment(1200, 2401));
        const auto strip = triangulate(points, ribbon, {.keep = KeptRegion::inside_segments});
        EXPECT_EQ(strip.triangles.size(), points.size() - 2) << gap;
    }
}

TEST(Constraints, OneSegmentThroughManyTriangles) {
    auto points = random_points(60000, 21);
    const std::size_t n = points.size();
    points.push_back({-1, 0.5});
    points.push_back({2, 0.5000001});
    // Two rows of points lie along a segment on both sides, so that the segment crosses all triangles between them.
    for (int i = 0; i < 1000; ++i) {
        points.push_back({3 + 0.001 * i, 0.1 + 1e-5 * i * (999 - i) / 1e3});
        points.push_back({3 + 0.001 * i + 0.0005, -0.1});
    }
    points.push_back({2.5, 0});
    points.push_back({4.5, 0.001});
    const Segments segments{segment(n, n + 1), segment(points.size() - 2, points.size() - 1)};
    expect_constrained(points, segments, triangulate(points, segments));
}

/// Returns a hub and n points round it, at random distances, or all at one.
std::vector<Point> hub_points(std::size_t n, bool on_circle) {
    Random random(n);
    std::vector<Point> points{{0, 0}};
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::acos(-1.0) * static_cast<double>(i) / static_cast<double>(n);
        const double r = on_circle ? 1 : random.real(0.1, 1);
        points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return points;
}

// Quadratic time would make this test take a minute.
TEST(Constraints, HubsOfManySegments) {
    constexpr std::size_t n = 30'000;
    for (const bool on_circle : {false, true})
        for (const bool outwards : {false, true}) {
            const std::vector<Point> points = hub_points(n, on_circle);
            Segments segments;
            for (std::size_t i = 1; i <= n; ++i) segments.push_back(outwards ? segment(0, i) : segment(i, 0));
            const auto t = triangulate(points, segments, {.crossings = Crossings::insert});
            EXPECT_EQ(t.segments, segments);
            expect_valid(points, t.triangles, t.segments);
        }
}

TEST(Constraints, SegmentsFromHubsRunThroughVertices) {
    // A segment that is walked from its far end meets the vertices on it in the other order.
    std::vector<Point> points = hub_points(200, true);
    Segments segments;
    for (std::size_t i = 1; i <= 200; ++i) segments.push_back(segment(0, i));
    const std::size_t first = points.size();
    for (const double x : {1.5, 2.0, 2.5, 3.0}) points.push_back({x, 0});
    points.push_back({2.2, 1});
    points.push_back({2.3, -1});
    segments.push_back(segment(0, first + 3));
    segments.push_back(segment(first + 3, 0));
    const auto t = triangulate(points, segments);
    expect_constrained(points, segments, t);
    Segments chain(t.segments.end() - 4, t.segments.end());
    EXPECT_EQ(chain, (Segments{segment(1, first), segment(first, first + 1), segment(first + 1, first + 2),
                               segment(first + 2, first + 3)}));
    EXPECT_EQ(t.repeated_segments, 1u);
}

TEST(Constraints, LongSegmentsThroughRandomPoints) {
    auto points = random_points(40'000, 8);
    Segments segments;
    for (int i = 0; i < 50; ++i) {
        const double y = (i + 0.5) / 50;
        segments.push_back(segment(points.size(), points.size() + 1));
        points.push_back({-0.01, y});
        points.push_back({1.01, y + 0.002 * (i % 7)});
    }
    const auto t = triangulate(points, segments);
    expect_valid(points, t.triangles, t.segments);
    EXPECT_EQ(t.segments, segments);
}

TEST(Constraints, SegmentsThatSplitOffOneEndAfterAnother) {
    // Beside a convex arc the vertex opposite the base is next to its end each time, the worst case of the recursion.
    std::vector<Point> points;
    const int n = 3000;
    for (int i = 0; i <= n; ++i) {
        const double x = static_cast<double>(i) / n;
        points.push_back({x, 0.001 + x * x * x});
        points.push_back({x, -0.001 - (1 - x) * (1 - x) * (1 - x)});
    }
    points.push_back({-1, 0});
    points.push_back({2, 0});
    const Segments segments{segment(points.size() - 2, points.size() - 1)};
    expect_valid(points, triangulate(points, segments).triangles, segments);
}

/// Returns the points of a regular grid, rotated and moved, so that its sides are straight but for rounding.
std::vector<Point> rotated_grid(int columns, int rows, double angle, Point offset) {
    std::vector<Point> points;
    const Point along{std::cos(angle), std::sin(angle)}, across{-along.y, along.x};
    for (int i = 0; i < columns; ++i)
        for (int k = 0; k < rows; ++k) points.push_back(offset + (0.1 * i) * along + (0.1 * k) * across);
    return points;
}

TEST(DropFlat, GridsHaveTheTrianglesOfExactOnes) {
    std::size_t flat = 0;
    for (const double angle : {0.0, 0.1, 0.5, 1.0, 2.0, 3.0}) {
        for (const Point offset : {Point{0, 0}, Point{1000, -3}}) {
            for (const auto& [columns, rows] : {std::pair{2, 40}, {7, 5}, {30, 30}, {100, 3}}) {
                const std::vector<Point> points = rotated_grid(columns, rows, angle, offset);
                const std::size_t exact = 2 * std::size_t(columns - 1) * std::size_t(rows - 1);
                const auto all = triangulate(points, {}, {});
                const auto kept = triangulate(points, {}, {.drop_flat = 1e-9});
                EXPECT_EQ(kept.triangles.size(), exact) << angle << " " << columns << " x " << rows;
                EXPECT_EQ(all.triangles.size(), exact + kept.dropped_triangles);
                EXPECT_EQ(all.triangles, triangulate(points, {}, {.drop_flat = 0}).triangles);
                EXPECT_EQ(all.dropped_triangles, 0u);
                EXPECT_TRUE(check_triangulation(points, kept.triangles).empty());
                EXPECT_EQ(half_edges(points.size(), kept.triangles).size(), 3 * exact);
                flat += kept.dropped_triangles;
                std::vector<char> used(points.size(), 0);
                for (const Triangle& t : kept.triangles)
                    for (const VertexId v : t.v) used[v.index()] = 1;
                EXPECT_EQ(std::count(used.begin(), used.end(), 0), 0);
            }
        }
    }
    EXPECT_GT(flat, 100u);
}

TEST(DropFlat, KeepsSegmentsVerticesAndConnections) {
    // A strip that is flat all over keeps its triangles, since each vertex is on the hull.
    const std::vector<Point> strip{{0, 0}, {1, 0}, {1, 1e-12}, {0, 1e-12}};
    EXPECT_EQ(triangulate(strip, {}, {.drop_flat = 1e-9}).triangles.size(), 2u);
    // The point beside the lower side, and the segments to it.
    std::vector<Point> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0.5, 1e-12}};
    EXPECT_EQ(triangulate(points, {}, {}).triangles.size(), 4u);
    EXPECT_EQ(triangulate(points, {}, {.drop_flat = 1e-9}).triangles.size(), 3u);
    EXPECT_EQ(triangulate(points, {}, {.drop_flat = 1e-13}).triangles.size(), 4u);
    std::vector<Segment> segments{{VertexId{0u}, VertexId{4u}}, {VertexId{4u}, VertexId{1u}}};
    const auto beside = triangulate(points, segments, {.drop_flat = 1e-9});
    EXPECT_EQ(beside.triangles.size(), 3u);
    EXPECT_EQ(beside.segments, segments);
    segments = {{VertexId{0u}, VertexId{1u}}};
    EXPECT_EQ(triangulate(points, segments, {.drop_flat = 1e-9}).triangles.size(), 4u);
    // It goes on as far as from the hull, not from the last triangle: a circle and what is round stay.
    std::vector<Point> circle;
    for (int i = 0; i < 1000; ++i) circle.push_back({std::cos(0.002 * M_PI * i), std::sin(0.002 * M_PI * i)});
    EXPECT_EQ(triangulate(circle, {}, {.drop_flat = 1e-3}).triangles.size(), 998u);
}

TEST(DropFlat, RefusesWhatMakesNoSense) {
    const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
    for (const double share : {-1e-9, 0.2, double(NAN), HUGE_VAL})
        EXPECT_THROW(triangulate(points, {}, {.drop_flat = share}), OptionError) << share;
    EXPECT_THROW(triangulate(points, {}, {.keep = KeptRegion::inside_segments, .drop_flat = 1e-9}), OptionError);
}

}  // namespace
}  // namespace lamina::test
