// Velocities beside the bodies, and streamlines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/flow.hpp>

#include "core/segments.hpp"
#include "flow/mapped_section.hpp"
#include "flow/panel_system.hpp"
#include "flow/sample_configurations.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

/// Returns the flux per second through the segment from a to b, to its right, by Simpson's rule.
double flux(const Flow& flow, Point a, Point b) {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
        const double weight = i == 0 || i == n ? 1 : i % 2 == 0 ? 2 : 4;
        sum += weight * cross(flow_velocity(flow, a + (static_cast<double>(i) / n) * (b - a)), b - a);
    }
    return sum / (3 * n);
}

bool is_inside(const std::vector<Point>& outline, Point p) {
    bool inside = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i], b = outline[(i + 1) % outline.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
}

double path_length(const std::vector<Point>& points) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i) sum += distance(points[i], points[i + 1]);
    return sum;
}

TEST(Velocity, EqualsThatRoundACircle) {
    const Flow flow = solve_flow(shapes::geometry({shapes::circle(1, 300)}), {.alpha_deg = 20});
    // The rearmost point is a stagnation point: the circulation is 4 pi sin(alpha), clockwise.
    const double alpha = 20 * M_PI / 180;
    EXPECT_NEAR(flow.lift, 4 * M_PI * std::sin(alpha), 0.002);
    for (const double radius : {1.05, 1.5, 4.0, 30.0})
        for (int k = 0; k < 12; ++k) {
            const Complex z = std::polar(radius, 0.1 + k);
            const Complex w =
                std::polar(1.0, -alpha) - std::polar(1.0, alpha) / (z * z) + Complex(0, 1) * (2 * std::sin(alpha)) / z;
            const Point v = flow_velocity(flow, {z.real(), z.imag()});
            EXPECT_LT(distance(v, {w.real(), -w.imag()}), 0.002) << radius << ' ' << k;
        }
}

TEST(Velocity, InsideOfTheBodiesTheFluidIsAtRest) {
    const Flow flow = solve_flow(section_with_flap(0.02), {.alpha_deg = 6});
    ASSERT_FALSE(flow.estimated);
    for (const double x : {0.1, 0.3, 0.5, 0.7}) EXPECT_LT(length(flow_velocity(flow, {x, 0.002})), 0.003) << x;
}

TEST(Streamline, StaysOutsideOfTheBodiesAndHasItsLength) {
    const Geometry geometry = section_with_flap(0.01);
    const Flow flow = solve_flow(geometry, {.alpha_deg = 5});
    for (double y = -0.8; y < 0.8; y += 0.05) {
        const std::vector<Point> line = streamline(flow, {-1, y}, 4);
        EXPECT_GT(line.size(), 20u);
        for (const Point p : line)
            for (const flow::PanelSheet& sheet : flow::sheets_of(flow))
                ASSERT_FALSE(is_inside(sheet.nodes, p)) << p.x << ' ' << p.y;
        EXPECT_NEAR(path_length(line), 4, 0.02) << y;
    }
}

TEST(Streamline, NothingFlowsAcrossIt) {
    for (const double base : {0.0, 0.01}) {
        const Flow flow = solve_flow(shapes::geometry({shapes::section(0.12, base, 80)}), {.alpha_deg = 8});
        const std::vector<Point> upper = streamline(flow, {-1, 0.3}, 4), lower = streamline(flow, {-1, 0.1}, 4);
        const double before = flux(flow, lower.front(), upper.front()), behind = flux(flow, lower.back(), upper.back());
        EXPECT_NEAR(behind, before, 2e-5);
        EXPECT_GT(before, 0.15);
    }
}

TEST(Streamline, LeavesTheTrailingEdgeAlongTheBisector) {
    for (const double base : {0.0, 0.01}) {
        const Flow flow = solve_flow(shapes::geometry({shapes::section(0.12, base, 80)}), {.alpha_deg = 0});
        const std::vector<Point> wake = streamline(flow, {1, 0}, 3);
        ASSERT_GT(wake.size(), 10u);
        EXPECT_NEAR(path_length(wake), 3, 1e-9);
        for (const Point p : wake) EXPECT_NEAR(p.y, 0, 1e-6);
    }
    // The wake turns into the direction of the stream, and begins in that of the trailing edge.
    const Flow flow = solve_flow(shapes::geometry({shapes::section(0.12, 0, 80)}), {.alpha_deg = 10});
    const std::vector<Point> wake = streamline(flow, {1, 0}, 20);
    EXPECT_NEAR((wake[1].y - wake[0].y) / (wake[1].x - wake[0].x), 0, 0.02);
    const Point last = wake[wake.size() - 1] - wake[wake.size() - 2];
    EXPECT_NEAR(std::atan2(last.y, last.x) * 180 / M_PI, 10, 0.7);
}

/// Both sides arrive from opposite directions at a flat end without corners, up to rounding.
TEST(Streamline, LeavesAFlatEndStraightAcross) {
    for (const double tilt : {0.0, 1e-17, -1e-17, 1e-9, -1e-9, 1e-3, -1e-3}) {
        const std::vector<Point> end{{1, 0}, {1 - tilt, 0.1}, {0, 0.1}, {0, -0.1}, {1 - tilt, -0.1}, {1, 0}};
        const Point way = flow::leaving_direction(end);
        EXPECT_NEAR(way.x, 1, 1e-12) << tilt;
        EXPECT_NEAR(way.y, 0, 1e-12) << tilt;
    }
}

TEST(Streamline, EndsAtAStagnationPoint) {
    const Flow flow = solve_flow(shapes::geometry({shapes::circle(1, 300)}));
    const std::vector<Point> line = streamline(flow, {-3, 0}, 10);
    EXPECT_LT(distance(line.back(), {-1, 0}), 1e-3);
    EXPECT_LT(path_length(line), 2.001);
}

TEST(Streamline, AnEstimateHasStraightOnes) {
    const Flow flow = solve_flow(shapes::geometry({shapes::plate(1e-5, 20)}), {.alpha_deg = 45, .reynolds = 1e6});
    ASSERT_TRUE(flow.estimated);
    ASSERT_EQ(flow.warnings.size(), 1u);
    EXPECT_EQ(flow.warnings[0].code, WarningCode::flow_estimated);
    EXPECT_EQ(flow.warnings[0].element, "body0");
    EXPECT_EQ(flow.lift, 0);
    for (const FlowPoint& p : flow.elements[0].upper) EXPECT_EQ(p.speed, 1);
    // The momentum thickness is between those of a laminar and of a turbulent plate.
    EXPECT_GT(flow.elements[0].upper.back().momentum, 0.664e-3);
    EXPECT_LT(flow.elements[0].upper.back().momentum, 0.037 / std::pow(1e6, 0.2));
    const std::vector<Point> line = streamline(flow, {0, 1}, 2);
    EXPECT_LT(distance(line.back(), {std::sqrt(2.0), 1 + std::sqrt(2.0)}), 1e-7) << "each point is rounded to 1e-9";
}

}  // namespace
}  // namespace lamina::test
