// The reader warns of sections that do not stand in the flow as sections usually do, and of no others.
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using Map = Point (*)(Point);

/// Returns the warnings of a closed outline after a map of its points.
std::vector<Warning> warnings_of(const std::vector<Point>& outline, Map map) {
    std::string text = "t\n";
    for (Point p : outline) text += fmt::format("{} {}\n", map(p).x, map(p).y);
    text += fmt::format("{} {}\n", map(outline[0]).x, map(outline[0]).y);
    return fixtures::read(text).elements[0].warnings;
}

std::vector<std::vector<Point>> sections() {
    return {naca_airfoil("0012", 60).points, naca_airfoil("4412", 100, TrailingEdge::blunt).points,
            naca_airfoil("23021", 200).points, naca_airfoil("0006", 30).points, shapes::joukowski(0.1, 0.05, 80)};
}

TEST(OrientationWarnings, SwappedColumns) {
    for (const std::vector<Point>& section : sections()) {
        const auto warnings = warnings_of(section, [](Point p) { return Point{p.y, p.x}; });
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_EQ(warnings[0].code, WarningCode::swapped_columns);
        EXPECT_GT(warnings[0].number, 2);
        EXPECT_NE(warnings[0].message.find("awk '{ print $2, $1 }'"), std::string::npos);
    }
}

TEST(OrientationWarnings, FlowFromTheRight) {
    for (const std::vector<Point>& section : sections()) {
        const auto warnings = warnings_of(section, [](Point p) { return Point{1 - p.x, p.y}; });
        ASSERT_EQ(warnings.size(), 1u);
        EXPECT_EQ(warnings[0].code, WarningCode::reversed_flow);
        EXPECT_GT(warnings[0].number, 2);
    }
}

TEST(OrientationWarnings, NoneForOtherBodies) {
    std::vector<std::vector<Point>> bodies = sections();
    bodies.push_back(shapes::ellipse(1, 0.2, 60));
    bodies.push_back(shapes::ellipse(1, 1, 60));
    bodies.push_back({{1, 0.1}, {0, 0}, {1, -0.1}});                           // a wedge with a base
    bodies.push_back({{1, 0}, {0.5, 0.1}, {0, 0}, {0.5, -0.1}});               // a diamond
    bodies.push_back({{1, 0.1}, {0.3, 0.1}, {0, 0}, {0.3, -0.1}, {1, -0.1}});  // a bullet
    for (const std::vector<Point>& body : bodies) {
        EXPECT_TRUE(warnings_of(body, [](Point p) { return p; }).empty());
        // The same at angles of attack of 53 and 16 degrees.
        EXPECT_TRUE(warnings_of(body, [](Point p) {
                        return Point{0.6 * p.x + 0.8 * p.y, 0.6 * p.y - 0.8 * p.x};
                    }).empty());

        EXPECT_TRUE(warnings_of(body, [](Point p) {
                        return Point{0.96 * p.x + 0.28 * p.y, 0.96 * p.y - 0.28 * p.x};
                    }).empty());
    }
}

}  // namespace
}  // namespace lamina
