// Tails whose surfaces cross are cut at the crossing; other crossings are refused.
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

/// Returns a file of a section whose surfaces cross at x = 1 - tail and part again up to its end at x = 1.
std::string crossing_section(double tail, bool is_open, double angle, bool clockwise) {
    std::vector<Point> points;
    const auto half = [&](double x) { return 0.4 * x * (1 - tail - x); };  // negative behind the crossing
    constexpr int steps = 101;
    for (int i = is_open ? 0 : 1; i < steps; ++i) {
        const double x = 1 - static_cast<double>(i) / steps;
        points.push_back({x, half(x)});
    }
    for (int i = steps; i >= (is_open ? 0 : 1); --i) {
        const double x = 1 - static_cast<double>(i) / steps;
        points.push_back({x, -half(x)});
    }
    if (!is_open) {
        points.insert(points.begin(), {1, 0});
        points.push_back({1, 0});
    }
    if (clockwise) std::reverse(points.begin(), points.end());
    std::string text = "crossing\n";
    for (Point p : points)
        text += fmt::format("{} {}\n", std::cos(angle) * p.x - std::sin(angle) * p.y,
                            std::sin(angle) * p.x + std::cos(angle) * p.y);
    return text;
}

TEST(TailCrossing, IsTheNewTrailingEdge) {
    constexpr double tail = 0.015;
    for (const bool is_open : {false, true})
        for (const bool clockwise : {false, true})
            for (const double angle : {0.0, 0.5, -1.0}) {
                SCOPED_TRACE(fmt::format("open {}, clockwise {}, angle {}", is_open, clockwise, angle));
                const Element e = fixtures::read(crossing_section(tail, is_open, angle, clockwise)).elements[0];
                EXPECT_NO_THROW(check_simple({{e}}));
                const Point end = e.points[0];
                EXPECT_NEAR(std::hypot(end.x, end.y), 1 - tail, 1e-3);
                EXPECT_NEAR(std::atan2(end.y, end.x), angle, 1e-3);
                ASSERT_EQ(e.warnings.size(), 1u);
                EXPECT_EQ(e.warnings[0].code, WarningCode::crossing_tail_cut);
                EXPECT_EQ(e.warnings[0].at, end);
                EXPECT_NEAR(e.warnings[0].number, tail, 5e-3);
                EXPECT_TRUE(std::any_of(e.repairs.begin(), e.repairs.end(), [](const std::string& repair) {
                    return repair.starts_with("lines 2") &&
                           repair.find("the surfaces cross near the trailing edge, at (") != std::string::npos;
                }));
            }
}

TEST(TailCrossing, FartherFromTheTailIsRefused) {
    for (const double tail : {0.025, 0.1, 0.3})
        EXPECT_THROW(fixtures::read(crossing_section(tail, false, 0, false)), InputError) << tail;
}

TEST(TailCrossing, AtTheNoseIsRefused) {
    EXPECT_THROW(
        fixtures::read("nose\n1 0\n0.5 0.1\n0.1 0.05\n0.005 -0.002\n0 0\n0.005 0.002\n0.1 -0.05\n0.5 -0.1\n1 0\n"),
        InputError);
}

TEST(TailCrossing, PointsBehindACommonVertexAreCutOff) {
    const Element e =
        fixtures::read("stray\n1 0\n0.6 0.05\n0 0\n0.6 -0.04\n0.98 -0.001\n1 0\n0.999 -0.001\n").elements[0];
    EXPECT_EQ(e.points, (std::vector<Point>{{1, 0}, {0.6, 0.05}, {0, 0}, {0.6, -0.04}, {0.98, -0.001}}));
    ASSERT_FALSE(e.repairs.empty());
    EXPECT_NE(e.repairs[0].find("line 8: the surfaces meet near the trailing edge, at (1, 0)"), std::string::npos)
        << e.repairs[0];
    EXPECT_EQ(e.lines, (std::vector<std::size_t>{2, 3, 4, 5, 6}));
}

}  // namespace
}  // namespace lamina
