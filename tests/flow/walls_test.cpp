// Flow along walls of the domain, compared with what images are, and with a classical result.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <lamina/flow.hpp>

#include "flow/panel_system.hpp"
#include "flow/sample_configurations.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

using shapes::geometry;
using shapes::Outline;

/// Returns the configuration with its mirror image in the x axis, as bodies of their own.
Geometry with_image(Geometry given) {
    const std::size_t bodies = given.elements.size();
    for (std::size_t e = 0; e < bodies; ++e)
        given.elements.push_back(
            element_of_points(shapes::mirrored(given.elements[e].points), "image" + std::to_string(e)));
    return make_geometry(std::move(given.elements));
}

Geometry raised(const Geometry& given, double height) {
    std::vector<Element> elements;
    for (const Element& element : given.elements)
        elements.push_back(element_of_points(shapes::moved(element.points, 0, 1, {0, height}), element.name));
    return make_geometry(std::move(elements));
}

TEST(FlowAlongWalls, GroundIsThatOfTheMirroredBodies) {
    const Outline section = naca_airfoil("4412", 100).points, blunt = shapes::section(0.15, 0.02, 80);
    for (const double clearance : {0.05, 0.3, 2.0})
        for (const Geometry& at_origin : {geometry({shapes::moved(section, -0.1, 1, {})}),
                                          geometry({shapes::moved(blunt, -0.1, 1, {})}), three_elements()}) {
            double lowest = HUGE_VAL;
            for (const Element& element : at_origin.elements)
                for (const Point p : element.points) lowest = std::min(lowest, p.y);
            const Geometry above = raised(at_origin, clearance - lowest);
            const Flow flow = solve_flow(above, {}, {.below = 0.0}), both = solve_flow(with_image(above));
            ASSERT_FALSE(flow.estimated);
            for (std::size_t e = 0; e < above.elements.size(); ++e) {
                const auto &with_wall = flow.panels->sheets[e].strengths, &with_body = both.panels->sheets[e].strengths;
                ASSERT_EQ(with_wall.size(), with_body.size());
                for (std::size_t i = 0; i < with_wall.size(); ++i) EXPECT_NEAR(with_wall[i], with_body[i], 5e-6);
            }
            for (const Point p : {Point{0.3, 0}, Point{2, 0}, Point{-3, 0}}) {
                EXPECT_NEAR(flow_velocity(flow, p).y, 0, 1e-12);
                EXPECT_NEAR(flow_velocity(flow, p).x, flow_velocity(both, p).x, 1e-5);
            }
        }
}

/// A flat plate half way between walls lifts as much more as pi^2 / 24 (chord / height)^2, to the first order.
/// Source: H. Glauert, Wind tunnel interference on wings, bodies and airscrews, R. & M. 1566 (1933).
TEST(FlowAlongWalls, TunnelWallsRaiseTheLiftOfAPlate) {
    const Outline plate = shapes::moved(naca_airfoil("0002", 200).points, -2 * std::numbers::pi / 180, 1, {});
    const double free = solve_flow(geometry({plate})).lift;
    for (const double height : {2.0, 3.0, 5.0}) {
        const double middle = -0.5 * std::sin(2 * std::numbers::pi / 180);
        const Flow flow =
            solve_flow(geometry({plate}), {}, {.below = middle - height / 2, .above = middle + height / 2});
        const double expected = std::numbers::pi * std::numbers::pi / 24 / (height * height);
        EXPECT_NEAR(flow.lift / free - 1, expected, 0.12 * expected) << height;
        for (const double wall : {-0.5, 0.5})
            for (const double x : {-1.0, 0.5, 2.0})
                EXPECT_NEAR(flow_velocity(flow, {x, middle + wall * height}).y, 0, 1e-3) << height << " " << x;
    }
}

/// A source half way between walls is one of a row: z pitches away it gives coth(pi z) / (2 pitch).
/// Source: L. M. Milne-Thomson, Theoretical Hydrodynamics, 5th ed. (1968), chapter 10.
TEST(FlowAlongWalls, TunnelWallsKeepWhatASourceGives) {
    for (const double height : {1.0, 3.0})
        for (const double share : {0.25, 0.5, 1.0}) {
            const Point at{share * height, 0};
            Point velocity;
            for (const flow::Image& image : flow::bodies_and_images({.below = -0.5 * height, .above = 0.5 * height})) {
                const Point p = image.seen_from(at);
                const Point of_source = 1 / (2 * std::numbers::pi * squared_length(p)) * p;
                velocity = velocity + image.of_sources().velocity(of_source);
            }
            const double expected = 1 / (2 * height * std::tanh(std::numbers::pi * share));
            EXPECT_NEAR(velocity.x, expected, 1.5e-3 * expected) << share;
            EXPECT_NEAR(velocity.y, 0, 1e-12);
        }
}

/// Plates that stand one above the other lift (2 pitch / (pi chord)) tanh(pi chord / (2 pitch)) times as much as one,
/// in the mean of the streams ahead and behind. Source: F. Weinig, Die Stroemung um die Schaufeln von Turbomaschinen
/// (1935).
TEST(FlowThroughARow, IsThatOfPlatesOneAboveTheOther) {
    const Outline plate = naca_airfoil("0002", 200).points;
    const double free = solve_flow(geometry({plate}), {.alpha_deg = 4}).lift / std::sin(4 * std::numbers::pi / 180);
    for (const double pitch : {0.7, 1.0, 2.0, 200.0}) {
        const Flow flow = solve_flow(geometry({plate}), {.alpha_deg = 4}, {.pitch = pitch});
        ASSERT_FALSE(flow.estimated);
        const double alpha = 4 * std::numbers::pi / 180, circulation = flow.lift / 2;
        const Point mean{std::cos(alpha), std::sin(alpha) - circulation / (2 * pitch)};
        const double of_mean = flow.lift / mean.y;
        const double expected = 2 * pitch / std::numbers::pi * std::tanh(std::numbers::pi / (2 * pitch));
        EXPECT_NEAR(of_mean / free, expected, pitch < 100 ? 0.02 * expected : 1e-3) << pitch;
        if (pitch > 100) continue;
        // The given stream is that ahead; behind the row the flow is turned by the circulation over the pitch.
        const Point ahead = flow_velocity(flow, {-2 * pitch, 0.1}), behind = flow_velocity(flow, {1 + 2 * pitch, 0.1});
        EXPECT_NEAR(ahead.y, std::sin(alpha), 0.02 * std::sin(alpha)) << pitch;
        EXPECT_NEAR(behind.y, std::sin(alpha) - circulation / pitch, 0.02 * std::sin(alpha)) << pitch;
    }
}

}  // namespace
}  // namespace lamina::test
