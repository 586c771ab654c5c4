// What callers may hand to triangulation and refinement, and what is refused.
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "support/point_sets.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

/// A unit square with its border.
struct BorderedSquare {
    std::vector<Point> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    std::vector<Segment> segments{{VertexId{0u}, VertexId{1u}},
                                  {VertexId{1u}, VertexId{2u}},
                                  {VertexId{2u}, VertexId{3u}},
                                  {VertexId{3u}, VertexId{0u}}};
};

/// Returns the message of the InputError that a call throws.
std::string refusal(const std::function<void()>& call) {
    try {
        call();
    } catch (const InputError& e) {
        return e.reason();
    }
    return "no error";
}

TEST(Arguments, PointsOutsideTheExactRangeAreRefusedEverywhere) {
    for (const double bad : {not_a_number, infinite, -infinite, 1e61, 1e-61}) {
        BorderedSquare s;
        s.points.push_back({0.5, bad});
        const std::string expected = "point 4 is outside the range of exact arithmetic";
        EXPECT_EQ(refusal([&] { triangulate(s.points); }), expected);
        EXPECT_EQ(refusal([&] { triangulate(s.points, DecompositionOptions{}); }), expected);
        EXPECT_EQ(refusal([&] { triangulate(s.points, s.segments); }), expected);
        EXPECT_EQ(refusal([&] { refine(s.points, s.segments, SizeField(0.1)); }), expected);
        EXPECT_EQ(refusal([&] { refine(s.points, ConstrainedTriangulation{}, SizeField(0.1)); }), expected);
    }
}

TEST(Arguments, HolesAndRegionsMustBeNumbers) {
    const BorderedSquare s;
    const ConstrainedTriangulation t = triangulate(s.points, s.segments);
    for (const double bad : {not_a_number, infinite}) {
        EXPECT_EQ(refusal([&] {
                      triangulate(s.points, s.segments, {.holes = {{9, 9}, {bad, 0.5}}});
                  }),
                  "hole 1 is outside the range of exact arithmetic");
        EXPECT_EQ(refusal([&] {
                      refine(s.points, t, SizeField(0.1), {.regions = {{{0.5, bad}, SizeField(0.1)}}});
                  }),
                  "region 0 is outside the range of exact arithmetic");
    }
}

TEST(Arguments, SizesAndAnglesMustBeInRange) {
    const BorderedSquare s;
    const ConstrainedTriangulation t = triangulate(s.points, s.segments);
    for (const double bad : {not_a_number, infinite, -5.0, 60.0}) {
        EXPECT_THROW(refine(s.points, s.segments, SizeField(1), {.min_angle_deg = bad}), OptionError) << bad;
        EXPECT_THROW(refine(s.points, t, SizeField(1), {.refine = {.min_angle_deg = bad}}), OptionError) << bad;
        EXPECT_THROW(refine({}, ConstrainedTriangulation{}, SizeField(1), {.refine = {.min_angle_deg = bad}}),
                     OptionError)
            << bad;
    }
    for (const double bad : {not_a_number, infinite, -1.0, 0.0}) EXPECT_THROW(SizeField{bad}, OptionError) << bad;
}

TEST(Arguments, IndicesMustBeInRange) {
    const BorderedSquare s;
    for (const std::size_t bad : {std::size_t{4}, std::size_t{1'000'000'000}, std::size_t{0xffffffff}}) {
        std::vector<Segment> segments = s.segments;
        segments[2].b = VertexId{bad};
        const std::string segment = "segment 2 (2-" + std::to_string(bad) + ") does not join two of the 4 points";
        for (const Crossings crossings : {Crossings::refuse, Crossings::insert})
            EXPECT_EQ(refusal([&] { triangulate(s.points, segments, {.crossings = crossings}); }), segment);
        EXPECT_EQ(refusal([&] { refine(s.points, segments, SizeField(0.1)); }), segment);
        EXPECT_EQ(refusal([&] { refine(s.points, segments, SizeField(0.1), {.lattice = false}); }), segment);

        const ConstrainedTriangulation good = triangulate(s.points, s.segments);
        ConstrainedTriangulation t = good;
        t.triangles[1].v[2] = VertexId{bad};
        EXPECT_THROW(refine(s.points, t, SizeField(0.1)), InputError);
        EXPECT_THROW(smallest_angle_deg(s.points, t.triangles), InputError);
        EXPECT_FALSE(check_triangulation(s.points, t.triangles).empty());
        EXPECT_FALSE(check_triangulation(s.points, good.triangles, segments).empty());
        t = good;
        t.segments[0].a = VertexId{bad};
        EXPECT_THROW(refine(s.points, t, SizeField(0.1)), InputError);
        t = good;
        t.parents.pop_back();
        EXPECT_EQ(refusal([&] { refine(s.points, t, SizeField(0.1)); }), "3 parents for 4 segments");
    }
}

TEST(Arguments, SegmentsThatChangeNothingAreCounted) {
    const BorderedSquare s;
    const ConstrainedTriangulation plain = triangulate(s.points, s.segments);
    EXPECT_EQ(plain.zero_length_segments, 0u);
    EXPECT_EQ(plain.repeated_segments, 0u);
    std::vector<Segment> segments = s.segments;
    segments.insert(segments.begin() + 1, {VertexId{2u}, VertexId{2u}});
    segments.push_back({VertexId{1u}, VertexId{0u}});
    segments.push_back({VertexId{3u}, VertexId{3u}});
    segments.push_back({VertexId{2u}, VertexId{3u}});
    for (const Crossings crossings : {Crossings::refuse, Crossings::insert}) {
        const ConstrainedTriangulation t = triangulate(s.points, segments, {.crossings = crossings});
        EXPECT_EQ(t.zero_length_segments, 2u);
        EXPECT_EQ(t.repeated_segments, 2u);
        EXPECT_EQ(t.triangles, plain.triangles);
        EXPECT_EQ(t.segments, plain.segments);
        EXPECT_EQ(t.parents, (std::vector<std::uint32_t>{0, 2, 3, 4}));
    }
    // With a crossing, which takes another way through the code.
    segments.push_back({VertexId{0u}, VertexId{2u}});
    segments.push_back({VertexId{1u}, VertexId{3u}});
    segments.push_back({VertexId{3u}, VertexId{1u}});
    const ConstrainedTriangulation t = triangulate(s.points, segments, {.crossings = Crossings::insert});
    EXPECT_EQ(t.steiner_points, (std::vector<Point>{{0.5, 0.5}}));
    EXPECT_EQ(t.zero_length_segments, 2u);
    EXPECT_EQ(t.repeated_segments, 3u);
    // Refinement of a region takes them, too.
    std::vector<Segment> border = s.segments;
    border.push_back({VertexId{1u}, VertexId{1u}});
    EXPECT_EQ(refine(s.points, border, SizeField(1)).triangles, refine(s.points, s.segments, SizeField(1)).triangles);
    // Points on a line have no triangles, but segments from a point to itself ask for none.
    const std::vector<Point> line{{0, 0}, {1, 1}, {2, 2}};
    const std::vector<Segment> points_only{{VertexId{1u}, VertexId{1u}}};
    EXPECT_TRUE(triangulate(line, points_only).triangles.empty());
}

TEST(Arguments, NothingIsTaken) {
    EXPECT_TRUE(triangulate(std::vector<Point>{}).triangles.empty());
    EXPECT_TRUE(triangulate(std::vector<Point>{}, std::vector<Segment>{}).triangles.empty());
    EXPECT_TRUE(refine({}, ConstrainedTriangulation{}, SizeField(1)).triangles.empty());
    EXPECT_TRUE(check_triangulation({}, {}).empty());
    EXPECT_EQ(lamina::smallest_angle_deg({}, std::vector<Triangle>{}), 0);
}

}  // namespace
}  // namespace lamina::test
