// Input as it comes: points that are equal or close, rings, and errors that name what is wrong.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "support/point_sets.hpp"

namespace lamina::test {
namespace {

using Index = std::uint32_t;

Segment edge(std::size_t a, std::size_t b) { return {VertexId{a}, VertexId{b}}; }

TEST(Input, PointsMergeWithTheFirstNearOneThatStandsForItself) {
    for (const double merge_distance : {0.0, 0.01, 0.1, 2.0}) {
        std::vector<Point> points = random_points(400, 1);
        const std::vector<Point> grid = random_grid_points(50, 9, 2);
        for (const Point p : grid) points.push_back({p.x / 8, p.y / 8});
        for (std::size_t i = 0; i < 100; ++i) points.push_back(points[3 * i]);
        points.push_back({-0.0, 0.0});
        points.push_back({0.0, -0.0});
        const std::vector<Index> stand_in = merge_points(points, merge_distance);
        ASSERT_EQ(stand_in.size(), points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            std::size_t expected = i;
            for (std::size_t k = i; k-- > 0;)
                if (stand_in[k] == k && distance(points[k], points[i]) <= merge_distance) expected = k;
            ASSERT_EQ(stand_in[i], expected) << merge_distance;
        }
    }
}

TEST(Input, ManyEqualPointsMergeWithTheFirst) {
    Random random(3);
    std::vector<Point> points(30'000);
    for (Point& p : points) p = {double(random.below(120)), double(random.below(120))};
    const std::vector<Index> stand_in = merge_points(points, 0);
    std::map<std::pair<double, double>, Index> first;
    for (Index i = 0; i < points.size(); ++i)
        ASSERT_EQ(stand_in[i], first.try_emplace({points[i].x, points[i].y}, i).first->second);
    EXPECT_LT(first.size(), points.size() / 2);
}

TEST(Input, MergesNearPointsFarFromTheOrigin) {
    const double ulp = 0x1p-22;  // of coordinates near 1e9
    const std::vector<Point> points{
        {1e9, 1e9}, {1e9 + 4 * ulp, 1e9}, {1e9 + 8 * ulp, 1e9}, {-1e58, 1e58}, {-1e58, 1e58}};
    EXPECT_EQ(merge_points(points, 4 * ulp), (std::vector<Index>{0, 0, 2, 3, 3}));
    EXPECT_EQ(merge_points(points, 1e-30), (std::vector<Index>{0, 1, 2, 3, 3}));
    EXPECT_THROW(merge_points(points, -1), OptionError);
    EXPECT_THROW(merge_points(points, NAN), OptionError);
}

TEST(Input, MergedTrianglesAreThoseOfThePointsThatStandForThemselves) {
    std::vector<Point> points = random_points(300, 3);
    for (std::size_t i = 0; i < 90; ++i) points.push_back(points[2 * i] + Point{1e-7, -2e-7});
    std::vector<Segment> segments;
    for (std::size_t i = 0; i + 1 < 20; ++i) segments.push_back(edge(300 + i, 301 + i));
    segments.push_back(edge(0, 300));  // joins a point and the one that stands for it
    const auto merged = triangulate(points, segments, {.crossings = Crossings::insert, .merge_distance = 1e-6});
    EXPECT_EQ(merged.zero_length_segments, 1u);
    std::vector<Segment> between_first;
    for (std::size_t i = 0; i + 1 < 20; ++i) between_first.push_back(edge(2 * i, 2 * (i + 1)));
    const std::vector<Point> first(points.begin(), points.begin() + 300);
    const auto expected = triangulate(first, between_first, {.crossings = Crossings::insert});
    ASSERT_FALSE(expected.steiner_points.empty());
    EXPECT_EQ(merged.steiner_points, expected.steiner_points);
    // Steiner points follow all points handed in: here 90 further on.
    std::vector<Triangle> shifted = expected.triangles;
    for (Triangle& t : shifted)
        for (VertexId& v : t.v)
            if (v.index() >= 300) v = VertexId{v.index() + 90};
    EXPECT_EQ(canonical(merged.triangles), canonical(shifted));
    EXPECT_EQ(merged.parents, expected.parents);
    for (std::size_t i = 0; i < 90; ++i) EXPECT_EQ(merged.merged_into[300 + i], 2 * i);
}

/// Returns how often the rings wind round p, and how often a ray from p crosses them. p lies on none.
std::pair<int, int> brute_force_turns(const std::vector<Point>& points, const std::vector<Segment>& segments, Point p) {
    int turns = 0, crossings = 0;
    for (const Segment& s : segments) {
        const Point a = points[s.a.index()], b = points[s.b.index()];
        if ((a.y > p.y) == (b.y > p.y)) continue;
        if ((orient2d(a, b, p) > 0) != (b.y > a.y)) continue;
        turns += b.y > a.y ? 1 : -1;
        ++crossings;
    }
    return {turns, crossings};
}

TEST(Input, RingsKeepTheTrianglesThatTheRuleSays) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        Random random(seed);
        // Rings with random corners on a grid: they cross, overlap, and touch themselves and each other.
        std::vector<Point> points;
        std::vector<std::size_t> starts;
        for (std::size_t r = 0; r < 1 + seed % 4; ++r) {
            starts.push_back(points.size());
            for (std::size_t k = random.below(7) + 3; k > 0; --k)
                points.push_back({double(random.below(9)), double(random.below(9))});
            if (seed % 2) points.push_back(points[starts.back()]);  // as GeoJSON does
        }
        const std::vector<Segment> segments = ring_segments(points.size(), starts);
        const ConstrainedTriangulation whole =
            triangulate(points, segments, {.crossings = Crossings::insert, .merge_distance = 0.0});
        for (const bool non_zero : {false, true}) {
            const auto t = triangulate(points, segments,
                                       {.keep = non_zero ? KeptRegion::non_zero : KeptRegion::even_odd,
                                        .crossings = Crossings::insert,
                                        .merge_distance = 0.0});
            std::vector<Point> all = points;
            all.insert(all.end(), t.steiner_points.begin(), t.steiner_points.end());
            EXPECT_TRUE(check_triangulation(all, t.triangles, t.segments).empty());
            const std::vector<Triangle> kept = canonical(t.triangles);
            for (const Triangle& triangle : canonical(whole.triangles)) {
                const Point a = all[triangle.v[0].index()], b = all[triangle.v[1].index()],
                            c = all[triangle.v[2].index()];
                // Off the middle, so that no ray runs through corners; slivers between rounded crossings are left out.
                if (cross(b - a, c - a) < 1e-9) continue;
                const Point inside = 0.31 * a + 0.331 * b + 0.359 * c;
                const auto [turns, crossings] = brute_force_turns(points, segments, inside);
                const bool expected = non_zero ? turns != 0 : crossings % 2 != 0;
                const bool is_kept = std::find(kept.begin(), kept.end(), triangle) != kept.end();
                ASSERT_EQ(is_kept, expected) << "seed " << seed;
            }
        }
    }
}

TEST(Input, RingsInRingsAreHolesWhateverTheirDirection) {
    std::vector<Point> points{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
    std::vector<std::size_t> starts{0};
    for (const int shift : {0, 4}) {  // two holes, one in each direction
        starts.push_back(points.size());
        std::vector<Point> hole{{1.0 + shift, 1}, {3.0 + shift, 1}, {3.0 + shift, 3}, {1.0 + shift, 3}};
        if (shift) std::reverse(hole.begin(), hole.end());
        points.insert(points.end(), hole.begin(), hole.end());
    }
    const std::vector<Segment> rings = ring_segments(points.size(), starts);
    const auto t = triangulate(points, rings, {.keep = KeptRegion::even_odd});
    EXPECT_EQ(covered_area(points, t.triangles), 81 - 8);
    // Wound round by the outer ring alone, or by it and one against it.
    const auto u = triangulate(points, rings, {.keep = KeptRegion::non_zero});
    EXPECT_EQ(covered_area(points, u.triangles), 81 - 4);
}

template <class Throw>
InputPlace place_of_error(const Throw& f) {
    try {
        f();
    } catch (const InputError& e) {
        return e.place();
    }
    ADD_FAILURE() << "not refused";
    return {};
}

TEST(Input, ErrorsNameWhatTheyRefuse) {
    using Indices = std::vector<std::size_t>;
    const std::vector<Point> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 1}};
    const std::vector<Segment> open{edge(0, 1), edge(1, 2), edge(2, 3)};
    for (const KeptRegion keep : {KeptRegion::even_odd, KeptRegion::non_zero}) {
        const InputPlace place = place_of_error([&] { triangulate(square, open, {.keep = keep}); });
        EXPECT_EQ(place.points, Indices{0});
        EXPECT_EQ(place.segments, Indices{0});
    }
    const std::vector<Segment> against{edge(0, 1), edge(1, 2), edge(0, 2)};
    EXPECT_EQ(place_of_error([&] { triangulate(square, against, {.keep = KeptRegion::non_zero}); }).points, Indices{0});
    EXPECT_NO_THROW(triangulate(square, against, {.keep = KeptRegion::even_odd}));

    const std::vector<Point> line{{0, 0}, {1, 1}, {2, 2}};
    const std::vector<Segment> on_line{edge(1, 1), edge(0, 2)};
    EXPECT_EQ(place_of_error([&] { triangulate(line, on_line); }).segments, Indices{1});
    EXPECT_EQ(place_of_error([&] {
                  triangulate(std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {1, 0}});
              }).points,
              (Indices{1, 3}));
    const std::vector<Segment> crossing{edge(0, 1), edge(0, 2), edge(1, 3)};
    const std::vector<Point> corners(square.begin(), square.begin() + 4);
    EXPECT_EQ(place_of_error([&] { triangulate(corners, crossing); }).segments, (Indices{2, 1}));
    const std::vector<Segment> beyond{edge(0, 1), edge(0, 5)};
    EXPECT_EQ(place_of_error([&] { triangulate(square, beyond, {.merge_distance = 0.0}); }).segments, Indices{1});
    EXPECT_EQ(place_of_error([&] { triangulate(square, open, {.holes = {{0.5, 0.6}, {1, 1}}}); }).seeds, Indices{1});
    EXPECT_EQ(place_of_error([&] { triangulate(square, open, {.holes = {{0.5, 0.6}, {NAN, 1}}}); }).seeds, Indices{1});
    EXPECT_EQ(place_of_error([&] { triangulate(std::vector<Point>{{0, 0}, {1, HUGE_VAL}}); }).points, Indices{1});
    const std::vector<std::size_t> starts{0, 4, 2};
    EXPECT_EQ(place_of_error([&] { ring_segments(5, starts); }).points, Indices{4});
}

}  // namespace
}  // namespace lamina::test
