// Plain flaps: the rear turns about the hinge, an arc opens on one side, and the other side is cut at the crossing.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

/// Returns the outline with a flap deflected, in degrees downwards.
std::vector<Point> flapped(const std::vector<Point>& outline, double angle_deg, Point hinge) {
    const Transformation flap{"all", FlapDeflection{angle_deg, hinge}};
    return transformed(shapes::geometry({outline}), {&flap, 1}).elements[0].points;
}

/// Returns a point turned clockwise about a hinge.
Point turned_down(Point p, double angle_deg, Point hinge) {
    const double angle = angle_deg / 180 * 0.5 * shapes::full_turn;
    const Point arm = p - hinge;
    return hinge +
           Point{arm.x * std::cos(angle) + arm.y * std::sin(angle), arm.y * std::cos(angle) - arm.x * std::sin(angle)};
}

double area(const std::vector<Point>& outline) {
    double sum = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        sum += 0.5 * cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
    return sum;
}

double longest_edge(const std::vector<Point>& outline) {
    double longest = 0;
    for (std::size_t i = 0; i < outline.size(); ++i)
        longest = std::max(longest, distance(outline[i], outline[(i + 1) % outline.size()]));
    return longest;
}

/// Returns the angles in degrees by which the outline turns at its vertices.
std::vector<double> turning_deg(const std::vector<Point>& outline) {
    std::vector<double> result;
    for (std::size_t i = 0, n = outline.size(); i < n; ++i) {
        const Point in = outline[i] - outline[(i + n - 1) % n], out = outline[(i + 1) % n] - outline[i];
        result.push_back(std::atan2(cross(in, out), dot(in, out)) * 360 / shapes::full_turn);
    }
    return result;
}

std::vector<Point> sorted(std::vector<Point> points) {
    std::sort(points.begin(), points.end(), lexicographically_less);
    return points;
}

std::vector<std::vector<Point>> flapped_sections() {
    return {naca_airfoil("0012", 60).points,    naca_airfoil("4412", 201, TrailingEdge::blunt).points,
            naca_airfoil("23021", 2000).points, shapes::joukowski(0.1, 0.05, 80),
            shapes::section(0.1, 0.01, 12),     fixtures::loop};
}

TEST(PlainFlap, IsSimpleAndTurnsTheTrailingEdge) {
    for (const std::vector<Point>& section : flapped_sections())
        for (const double angle_deg : {-60.0, -20.0, -1.0, -1e-7, 1e-9, 1e-5, 0.01, 5.0, 10.0, 40.0})
            for (const double share : {0.4, 0.75, 0.9}) {
                const Geometry given = shapes::geometry({section});
                const Box box = bounding_box(given);
                const double x = box.lower.x + share * box.width();
                // The middle of the section at the hinge.
                double low = HUGE_VAL, high = -HUGE_VAL;
                for (const Point p : shapes::refined(section, 50)) {
                    if (std::abs(p.x - x) > 0.01 * box.width()) continue;
                    low = std::min(low, p.y);
                    high = std::max(high, p.y);
                }
                const Point hinge{x, 0.5 * (low + high)};
                SCOPED_TRACE(fmt::format("{} points, {} degrees at {}", section.size(), angle_deg, share));
                const std::vector<Point> result = flapped(section, angle_deg, hinge);
                EXPECT_NO_THROW(check_simple(shapes::geometry({result})));
                const Point tail = *std::max_element(section.begin(), section.end(), lexicographically_less);
                EXPECT_LT(distance(result[0], turned_down(tail, angle_deg, hinge)), 1e-13);
                EXPECT_NE(std::find(result.begin(), result.end(),
                                    *std::min_element(section.begin(), section.end(), lexicographically_less)),
                          result.end());
                // What the arc adds is about what the other side loses. A vertex beside each of the four ends may go
                // where it is hardly off its edge.
                const double thickness = high - low, sector = std::abs(angle_deg) / 360 * shapes::full_turn;
                const double dropped = 4 * 0.5 * 1e-5 * box.width() * longest_edge(section);
                EXPECT_LT(std::abs(area(result) - area(section)), thickness * thickness * sector + dropped);
            }
}

TEST(PlainFlap, HasASmoothArcAndACorner) {
    const std::vector<Point> section = naca_airfoil("0012", 400).points;
    const Point hinge{0.7, 0.01};
    for (const double angle_deg : {10.0, 30.0, -30.0}) {
        const std::vector<Point> result = flapped(section, angle_deg, hinge);
        const std::vector<double> turning = turning_deg(result);
        const auto corner = std::min_element(turning.begin(), turning.end());
        EXPECT_NEAR(*corner, -std::abs(angle_deg), 4) << "the closed side has a concave corner";
        const Point at = result[static_cast<std::size_t>(corner - turning.begin())];
        EXPECT_EQ(at.y<hinge.y, angle_deg> 0) << "down closes the lower side";
        std::size_t on_arc = 0;
        for (std::size_t i = 1; i < result.size(); ++i) {
            const bool opened_side = (result[i].y > hinge.y) == (angle_deg > 0);
            if (opened_side && std::abs(result[i].x - hinge.x) < 0.03) {
                EXPECT_LE(turning[i], 5.1);
                EXPECT_GE(turning[i], -0.5);
            }
            on_arc += turning[i] > 3;
        }
        EXPECT_GE(on_arc, static_cast<std::size_t>(std::abs(angle_deg) / 5) - 1);
    }
}

TEST(PlainFlap, MarksTheCornerOfTheSideThatCloses) {
    const FlapDeflection flap{5, {0.75, 0.01}};
    Geometry geometry = transformed(shapes::geometry({naca_airfoil("0012", 200).points}), {{{"all", flap}}});
    const std::vector<std::size_t> corners = geometry.elements[0].given_corners;
    ASSERT_EQ(corners.size(), 1u);
    const Point corner = geometry.elements[0].points[corners[0]];
    EXPECT_LT(distance(corner, {0.75, -0.03}), 0.02);
    // It stays the same vertex in the mirror image, and beside that of a second flap.
    geometry = transformed(std::move(geometry), {{{"all", Mirroring{0}}, {"all", FlapDeflection{5, {0.5, 0}}}}});
    const Element& e = geometry.elements[0];
    ASSERT_EQ(e.given_corners.size(), 2u);
    EXPECT_EQ(std::count_if(e.given_corners.begin(), e.given_corners.end(),
                            [&](std::size_t i) {
                                return distance(e.points[i], turned_down({corner.x, -corner.y}, 5, {0.5, 0})) < 1e-13;
                            }),
              1);
    EXPECT_TRUE(std::is_sorted(e.given_corners.begin(), e.given_corners.end()));
}

TEST(PlainFlap, OfTheMirrorImageIsTheMirrorImage) {
    const std::vector<Point> section = naca_airfoil("0012", 100).points;
    const std::vector<Point> up = flapped(section, -25, {0.8, 0}), down = flapped(section, 25, {0.8, 0});
    EXPECT_EQ(sorted(up), sorted(shapes::mirrored(down)));
    EXPECT_EQ(flapped(section, 0, {0.8, 0}), section);
}

TEST(PlainFlap, MayHaveItsHingeOnOrOutsideTheSurface) {
    const std::vector<Point> section = naca_airfoil("0012", 200).points;
    const Point lower = section[150], upper = section[50];
    for (const Point hinge : {lower, upper, lower - Point{0, 0.01}, upper + Point{0, 0.01}})
        for (const double angle_deg : {-15.0, 15.0}) {
            SCOPED_TRACE(fmt::format("{} degrees at {}, {}", angle_deg, hinge.x, hinge.y));
            const std::vector<Point> result = flapped(section, angle_deg, hinge);
            EXPECT_NO_THROW(check_simple(shapes::geometry({result})));
            EXPECT_LT(distance(result[0], turned_down(section[0], angle_deg, hinge)), 1e-13);
        }
    // Both sides open below a hinge under the section, and both close above it.
    EXPECT_GT(area(flapped(section, 15, lower - Point{0, 0.01})), area(section));
    EXPECT_LT(area(flapped(section, -15, lower - Point{0, 0.01})), area(section));
}

TEST(PlainFlap, KeepsTheLinesOfPointsThatStay) {
    const Geometry given = fixtures::read(fixtures::selig);
    const Transformation flap = parse_transformation("airfoil:flap:20:0.6,0.01");
    const Element e = transformed(given, {&flap, 1}).elements[0];
    ASSERT_EQ(e.lines.size(), e.points.size());
    for (std::size_t i = 0; i < e.points.size(); ++i) {
        if (e.lines[i] == 0) continue;
        const auto line = std::find(given.elements[0].lines.begin(), given.elements[0].lines.end(), e.lines[i]);
        const Point p = given.elements[0].points[static_cast<std::size_t>(line - given.elements[0].lines.begin())];
        const Point expected = p.x > 0.6 ? turned_down(p, 20, {0.6, 0.01}) : p;
        EXPECT_LT(distance(e.points[i], expected), 1e-14);
    }
    EXPECT_EQ(e.transformations, std::vector<std::string>{"flap deflected by 20 degrees about (0.6, 0.01)"});
}

TEST(PlainFlap, IsRefusedWhereItCannotBeDeflected) {
    const std::vector<Point> section = naca_airfoil("0012", 200).points;
    const auto reason = [&](double angle_deg, Point hinge) -> std::string {
        try {
            flapped(section, angle_deg, hinge);
        } catch (const InputError& error) {
            EXPECT_EQ(error.place().at, hinge);
            EXPECT_EQ(error.place().element, "body0");
            return error.reason();
        }
        return "";
    };
    EXPECT_NE(reason(10, {-0.1, 0}).find("nearest to it at the nose or the tail"), std::string::npos);
    EXPECT_NE(reason(10, {1.1, 0}).find("nearest to it at the nose or the tail"), std::string::npos);
    EXPECT_NE(reason(80, {0.97, 0.05}).find("overlap as a whole"), std::string::npos);
}

}  // namespace
}  // namespace lamina
