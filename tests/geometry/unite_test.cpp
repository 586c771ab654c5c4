// Bodies that overlap or touch become one (GeometryOptions::unite).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "core/tight_box.hpp"
#include "geometry/unite.hpp"

namespace lamina {
namespace {

using Outline = std::vector<Point>;

Geometry united(const std::vector<Outline>& outlines, const std::vector<std::string>& names) {
    std::vector<Element> elements;
    for (const Outline& outline : outlines) elements.push_back(element_of_points(outline, "points", {.close = true}));
    return make_geometry(std::move(elements), {.names = names, .unite = true});
}

Outline box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

double area_of(const Outline& outline) {
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) area += 0.5 * cross(outline[i], outline[(i + 1) % outline.size()]);
    return area;
}

double area_of(const Geometry& geometry) {
    double area = 0;
    for (const Element& element : geometry.elements) area += area_of(element.points);
    return area;
}

std::vector<std::string> part_names(const Element& element) {
    std::vector<std::string> names;
    for (const WallPart& part : element.parts) names.push_back(part.name);
    std::sort(names.begin(), names.end());
    return names;
}

using Rational = boost::multiprecision::cpp_rational;

struct RationalPoint {
    Rational x, y;
};

/// Returns the area that two convex polygons with small whole coordinates have in common: one is clipped by the edges
/// of the other, in rational arithmetic.
double common_area(const Outline& a, const Outline& b) {
    const auto exact = [](Point p) { return RationalPoint{Rational(p.x), Rational(p.y)}; };
    std::vector<RationalPoint> clipped;
    for (const Point p : a) clipped.push_back(exact(p));
    for (std::size_t i = 0; i < b.size(); ++i) {
        const RationalPoint u = exact(b[i]), v = exact(b[(i + 1) % b.size()]);
        const auto side = [&](const RationalPoint& p) -> Rational {
            return (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
        };
        std::vector<RationalPoint> next;
        for (std::size_t k = 0; k < clipped.size(); ++k) {
            const RationalPoint &p = clipped[k], &q = clipped[(k + 1) % clipped.size()];
            const Rational at_p = side(p), at_q = side(q);
            if (at_p >= 0) next.push_back(p);
            if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
                const Rational t = at_p / (at_p - at_q);
                next.push_back({p.x + t * (q.x - p.x), p.y + t * (q.y - p.y)});
            }
        }
        clipped = std::move(next);
    }
    Rational doubled;
    for (std::size_t k = 0; k < clipped.size(); ++k) {
        const RationalPoint &p = clipped[k], &q = clipped[(k + 1) % clipped.size()];
        doubled += p.x * q.y - p.y * q.x;
    }
    return 0.5 * doubled.convert_to<double>();
}

/// Returns a convex polygon with whole coordinates from 0 to 40: the hull of a few points.
Outline random_convex(std::mt19937& random) {
    std::uniform_int_distribution<int> coordinate(0, 40);
    for (;;) {
        Outline points(5);
        for (Point& p : points) p = {double(coordinate(random)), double(coordinate(random))};
        Outline hull = core::convex_hull(points);
        if (hull.size() >= 3) return hull;
    }
}

TEST(Unite, AreasOfPairsFollowFromInclusionAndExclusion) {
    std::mt19937 random(7);
    int joined = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Outline a = random_convex(random), b = random_convex(random);
        const double common = common_area(a, b);
        Geometry geometry;
        try {
            geometry = united({a, b}, {"a", "b"});
        } catch (const InputError&) {
            EXPECT_EQ(common, 0) << trial;  // they touch at a point
            continue;
        }
        const double expected = area_of(a) + area_of(b) - common;
        EXPECT_NEAR(area_of(geometry), expected, 1e-13 * expected) << trial;
        if (common > 0) {
            EXPECT_EQ(geometry.elements.size(), 1u) << trial;
            ++joined;
        }
        EXPECT_NO_THROW(check_simple(geometry)) << trial;
    }
    EXPECT_GT(joined, 1500);
}

TEST(Unite, WallsKeepTheNamesOfTheirBodies) {
    const Geometry geometry = united({box(0, 0, 4, 1), box(1, -1, 2, 2), box(3, 0, 5, 1)}, {"a", "b", "c"});
    ASSERT_EQ(geometry.elements.size(), 1u);
    const Element& element = geometry.elements[0];
    EXPECT_EQ(element.name, "a");
    // b stands out above and below; c goes on where a ends.
    EXPECT_EQ(part_names(element), (std::vector<std::string>{"a", "a", "a", "b", "b", "c"}));
    EXPECT_DOUBLE_EQ(area_of(geometry), 4 + 3 + 2 - 1 - 1);
    for (const WallPart& part : element.parts) {
        const auto at = std::find(element.points.begin(), element.points.end(), part.begin);
        ASSERT_NE(at, element.points.end());
        EXPECT_TRUE(std::binary_search(element.given_corners.begin(), element.given_corners.end(),
                                       std::size_t(at - element.points.begin())));
    }
}

/// Returns the middles of the edges of the only element with the names of their parts, sorted.
std::vector<std::pair<Point, std::string>> named_middles(const Geometry& geometry) {
    const Element& element = geometry.elements.at(0);
    const std::vector<std::size_t> parts = geometry::parts_of_edges(element);
    std::vector<std::pair<Point, std::string>> result;
    for (std::size_t i = 0; i < element.points.size(); ++i) {
        const Point middle = midpoint(element.points[i], element.points[(i + 1) % element.points.size()]);
        result.emplace_back(middle, element.parts.at(parts[i]).name);
    }
    std::sort(result.begin(), result.end(),
              [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); });
    return result;
}

TEST(Unite, PartsOfTheWallMoveWithTheBody) {
    const Geometry geometry = united({box(0, 0, 4, 1), box(1, -1, 2, 2), box(3, 0, 5, 1)}, {"a", "b", "c"});
    const auto before = named_middles(geometry);
    const auto expect_moved = [&](const Geometry& moved, auto map) {
        auto expected = before;
        for (auto& [middle, name] : expected) middle = map(middle);
        std::sort(expected.begin(), expected.end(),
                  [](const auto& a, const auto& b) { return lexicographically_less(a.first, b.first); });
        EXPECT_EQ(named_middles(moved), expected);
    };
    const auto change = [&](const std::string& text) {
        return transformed(geometry, std::vector{parse_transformation(text)});
    };
    expect_moved(change("a:shift:2,3"), [](Point p) { return p + Point{2, 3}; });
    expect_moved(change("a:scale:2"), [](Point p) { return 2 * p; });
    expect_moved(change("all:rotate:90"), [](Point p) { return perpendicular(p); });
    expect_moved(change("a:mirror"), [](Point p) { return Point{p.x, -p.y}; });
    expect_moved(blade_row(geometry, 8, 90), [](Point p) { return perpendicular(p); });
    const Geometry turned = blade_row(geometry, 8, 20);
    const std::vector<Point>& points = turned.elements[0].points;
    for (const WallPart& part : turned.elements[0].parts)
        EXPECT_NE(std::find(points.begin(), points.end(), part.begin), points.end());
    EXPECT_THROW(change("a:flap:10:3.5,0.5"), InputError);
}

TEST(Unite, BodiesThatTouchAlongAnEdgeBecomeOne) {
    const Geometry geometry = united({box(0, 0, 1, 1), box(1, 0.25, 2, 0.5)}, {"a", "b"});
    ASSERT_EQ(geometry.elements.size(), 1u);
    EXPECT_DOUBLE_EQ(area_of(geometry), 1.25);
}

TEST(Unite, OthersStayAsTheyAre) {
    const Outline far = box(9, 9, 10, 10);
    const Geometry geometry = united({far, box(0, 0, 2, 1), box(1, 0.5, 3, 2)}, {"far", "a", "b"});
    ASSERT_EQ(geometry.elements.size(), 2u);
    EXPECT_EQ(geometry.elements[0].points, far);
    EXPECT_TRUE(geometry.elements[0].parts.empty());
    EXPECT_EQ(geometry.elements[1].name, "a");
}

TEST(Unite, PocketsAndWhatLiesInsideAreFilled) {
    // A frame of four bars with a body in its middle, and one within a bar.
    const Geometry geometry = united(
        {box(0, 0, 5, 1), box(0, 4, 5, 5), box(0, 0, 1, 5), box(4, 0, 5, 5), box(2, 2, 3, 3), box(2, 0.25, 3, 0.5)},
        {"south", "north", "west", "east", "island", "inside"});
    ASSERT_EQ(geometry.elements.size(), 1u);
    EXPECT_DOUBLE_EQ(area_of(geometry), 25);
    EXPECT_EQ(geometry.elements[0].transformations.back(), "inside lies inside the union");
}

TEST(Unite, RepairsOfAllBodiesAreKept) {
    Outline repeated = box(1, 0.5, 3, 2);
    repeated.insert(repeated.begin() + 1, repeated[0]);
    const Geometry geometry = united({box(0, 0, 2, 1), repeated}, {"a", "b"});
    const std::vector<std::string>& repairs = geometry.elements.at(0).repairs;
    EXPECT_TRUE(std::any_of(repairs.begin(), repairs.end(),
                            [](const std::string& r) { return r.find("duplicate") != std::string::npos; }));
}

TEST(Unite, BodiesThatTouchAtAPointAreRefused) {
    try {
        united({box(0, 0, 1, 1), box(1, 1, 2, 2)}, {"a", "b"});
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("at the single point (1, 1)"), std::string::npos) << error.what();
    }
}

TEST(Unite, RefusalsOfOverlapsNameTheOption) {
    const auto message = [](const Outline& a, const Outline& b) {
        try {
            make_geometry({element_of_points(a, "a", {.close = true}), element_of_points(b, "b", {.close = true})});
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message(box(0, 0, 2, 1), box(1, 0.5, 3, 2)).find("--union"), std::string::npos);
    EXPECT_NE(message(box(0, 0, 4, 4), box(1, 1, 2, 2)).find("--union"), std::string::npos);
}

}  // namespace
}  // namespace lamina
