// Properties of the flow that hold for every configuration.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <lamina/flow.hpp>
#include <lamina/surface.hpp>
#include <lamina/threads.hpp>

#include "core/angles.hpp"
#include "flow/contour.hpp"
#include "flow/mapped_section.hpp"
#include "flow/panel_system.hpp"
#include "flow/potential.hpp"
#include "flow/sample_configurations.hpp"
#include "flow/sides.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

using shapes::geometry;
using shapes::Outline;

Geometry moved(Geometry g, double scale, Point shift) {
    for (Element& e : g.elements) e.points = shapes::moved(e.points, 0, scale, shift);
    return g;
}

double max_speed(const Flow& flow) {
    double fastest = 0;
    for (const flow::PanelSheet& sheet : flow::sheets_of(flow))
        for (const double strength : sheet.strengths) fastest = std::max(fastest, std::abs(strength));
    return fastest;
}

void expect_sound(const Flow& flow, std::size_t elements) {
    ASSERT_FALSE(flow.estimated) << flow.warnings[0].message;
    ASSERT_EQ(flow.elements.size(), elements);
    ASSERT_EQ(flow.panels->sheets.size(), elements);
    EXPECT_TRUE(flow.warnings.empty());
    double sum = 0;
    for (const ElementFlow& element : flow.elements) {
        sum += element.lift;
        for (const auto* side : {&element.upper, &element.lower}) {
            ASSERT_GE(side->size(), 2u);
            EXPECT_EQ(side->front().at, element.stagnation);
            EXPECT_EQ(side->front().s, 0);
            EXPECT_EQ(side->front().speed, 0);
            for (std::size_t i = 1; i < side->size(); ++i) {
                const FlowPoint &p = (*side)[i], &last = (*side)[i - 1];
                EXPECT_NEAR(p.s - last.s, distance(p.at, last.at), 1e-12 * p.s);
                EXPECT_GE(p.speed, 0);
                EXPECT_DOUBLE_EQ(p.pressure_coefficient, 1 - p.speed * p.speed);
            }
        }
        EXPECT_NEAR(element.upper.back().speed, element.lower.back().speed, 1e-9);
    }
    // The pressures of straight panels agree with the circulation up to the error of the panels.
    EXPECT_NEAR(flow.lift, sum, 0.01 * std::abs(flow.lift) + 0.002);
}

TEST(Flow, SymmetricSectionsHaveNoLiftAndEqualSides) {
    for (const double base : {0.0, 0.01, 0.2}) {
        const Flow flow = solve_flow(geometry({shapes::section(0.12, base, 80)}));
        expect_sound(flow, 1);
        EXPECT_NEAR(flow.lift, 0, 1e-9);
        EXPECT_NEAR(flow.elements[0].stagnation.y, 0, 1e-9);
        const auto &upper = flow.elements[0].upper, &lower = flow.elements[0].lower;
        for (std::size_t i = 1; i < std::min(upper.size(), lower.size()); ++i) {
            EXPECT_NEAR(upper[upper.size() - i].speed, lower[lower.size() - i].speed, 1e-8);
            EXPECT_NEAR(upper[upper.size() - i].at.y, -lower[lower.size() - i].at.y, 1e-9);
        }
    }
}

TEST(Flow, SheetsHaveTheLiftOfThinPlates) {
    for (const double alpha_deg : {2.0, 8.0}) {
        const Sheet plate{"plate", {{0, 0}, {1, 0}}};
        const Flow flow = solve_flow(make_geometry({}, {.sheets = {plate}}), {.alpha_deg = alpha_deg});
        const double wanted = 2 * core::pi * std::sin(core::radians(alpha_deg));
        EXPECT_NEAR(flow.lift, wanted, 0.02 * wanted);
        const Sheet turned{"plate", {{1, 0}, {0, 0}}};
        EXPECT_NEAR(solve_flow(make_geometry({}, {.sheets = {turned}}), {.alpha_deg = alpha_deg}).lift, flow.lift,
                    1e-9);
    }
}

TEST(Flow, SheetsOnWallsAreLeftOut) {
    const FlowConditions conditions{.alpha_deg = 4};
    const Sheet strip{"strip", {{0.4, 0}, {0.4, 0.2}}};
    const auto lift = [&](std::vector<Sheet> sheets) {
        return solve_flow(make_geometry({naca_airfoil("0012", 200)}, {.sheets = std::move(sheets)}), conditions).lift;
    };
    EXPECT_NEAR(lift({strip}), lift({}), 1e-3);
}

TEST(Flow, MirroredSectionsHaveTheOppositeLift) {
    for (const double base : {0.0, 0.008}) {
        const Outline outline = shapes::moved(shapes::section(0.15, base, 80), 0.05, 1, {});
        const Flow flow = solve_flow(geometry({outline}), {.alpha_deg = 6});
        const Flow mirrored = solve_flow(geometry({shapes::mirrored(outline)}), {.alpha_deg = -6});
        expect_sound(flow, 1);
        EXPECT_NEAR(mirrored.lift, -flow.lift, 1e-7);
        EXPECT_LT(
            distance(mirrored.elements[0].stagnation, {flow.elements[0].stagnation.x, -flow.elements[0].stagnation.y}),
            1e-7);
    }
}

TEST(Flow, PowersOfTwoScaleItBitForBit) {
    const Geometry given = three_elements();
    const Flow flow = solve_flow(given, {.alpha_deg = 7});
    expect_sound(flow, 3);
    for (const double scale : {0x1p-20, 0.5, 1024.0}) {
        const Flow scaled = solve_flow(moved(given, scale, {}), {.alpha_deg = 7});
        EXPECT_EQ(scaled.lift, flow.lift);
        for (std::size_t e = 0; e < 3; ++e) {
            EXPECT_EQ(scaled.panels->sheets[e].strengths, flow.panels->sheets[e].strengths);
            EXPECT_EQ(scaled.elements[e].stagnation, scale * flow.elements[e].stagnation);
            EXPECT_EQ(scaled.elements[e].lift, flow.elements[e].lift);
        }
    }
}

TEST(Flow, DoesNotDependOnTheNumberOfThreads) {
    const Geometry given = three_elements();
    Flow one, eight;
    with_threads(1, [&] { one = solve_flow(given, {.alpha_deg = 4}); });
    with_threads(8, [&] { eight = solve_flow(given, {.alpha_deg = 4}); });
    EXPECT_EQ(one.lift, eight.lift);
    for (std::size_t e = 0; e < 3; ++e) EXPECT_EQ(one.panels->sheets[e].strengths, eight.panels->sheets[e].strengths);
}

TEST(Flow, HardlyDependsOnShiftsAndOtherScales) {
    const Geometry given = three_elements();
    const Flow flow = solve_flow(given, {.alpha_deg = 4});
    const Flow other = solve_flow(moved(given, 1000.0 / 3, {123, -456}), {.alpha_deg = 4});
    EXPECT_NEAR(other.lift, flow.lift, 1e-6);
    EXPECT_NEAR(max_speed(other), max_speed(flow), 1e-5);
}

TEST(Flow, HardlyDependsOnThePointsOfTheWall) {
    const auto lift = [](Geometry g) { return solve_flow(g, {.alpha_deg = 8}).lift; };
    const double exact = lift(geometry({naca_airfoil("2412", 2000).points}));
    for (const std::size_t points : {40u, 60u, 100u, 300u})
        EXPECT_NEAR(lift(geometry({naca_airfoil("2412", points).points})), exact, 1e-3 * exact) << points;
    EXPECT_NEAR(lift(prepare_surfaces(geometry({naca_airfoil("2412", 80).points}))), exact, 1e-3 * exact);
    // Noise as in tables of four digits.
    std::mt19937 random(5);
    Outline noisy = naca_airfoil("2412", 300).points;
    for (std::size_t i = 1; i < noisy.size(); ++i) noisy[i].y += 1e-4 * (static_cast<double>(random()) / 0x1p32 - 0.5);
    const Flow flow = solve_flow(geometry({noisy}), {.alpha_deg = 8});
    expect_sound(flow, 1);
    EXPECT_NEAR(flow.lift, exact, 5e-3 * exact);
}

TEST(Flow, ElementsFarApartHaveTheirOwnFlows) {
    const Outline section = naca_airfoil("4412", 100).points;
    const Flow alone = solve_flow(geometry({section}), {.alpha_deg = 5});
    const Flow both =
        solve_flow(geometry({section, shapes::moved(section, 0, 1, {0, 1000})}), {.alpha_deg = 5, .chord = 1});
    expect_sound(both, 2);
    // The other section induces a velocity of lift / (4 pi 1000).
    for (const ElementFlow& element : both.elements) EXPECT_NEAR(element.lift, alone.elements[0].lift, 5e-4);
}

TEST(Flow, NarrowSlotsAndCovesAreSolved) {
    const Flow slot = solve_flow(section_with_flap(0.005), {.alpha_deg = 8});
    expect_sound(slot, 2);
    // A flap raises the lift of the main section more than its own.
    const Flow alone = solve_flow(geometry({naca_airfoil("0012", 100).points}), {.alpha_deg = 8, .chord = slot.chord});
    EXPECT_GT(slot.elements[0].lift, 1.5 * alone.lift);
    for (const double alpha_deg : {-10.0, 0.0, 10.0, 25.0}) {
        const Flow cove = solve_flow(three_elements(), {.alpha_deg = alpha_deg});
        ASSERT_FALSE(cove.estimated) << alpha_deg;
        EXPECT_LT(max_speed(cove), 40) << alpha_deg;
    }
}

TEST(Flow, BluntTrailingEdgesActLikeSharpOnes) {
    const auto solve = [](double base) {
        return solve_flow(geometry({shapes::section(0.12, base, 80)}), {.alpha_deg = 5});
    };
    const Flow sharp = solve(0);
    for (const double base : {5e-5, 2e-4, 0.002, 0.01}) {
        const Flow blunt = solve(base);
        expect_sound(blunt, 1);
        EXPECT_NEAR(blunt.lift, sharp.lift, 0.001 + 2 * base) << base;
    }
    // The sources of the base fill a wake as wide as the base with the speed at the trailing edge.
    const Flow wide = solve(0.01);
    EXPECT_NEAR(wide.panels->sheets[0].base_source, wide.elements[0].upper.back().speed, 0.03);
}

/// Returns the section bent on an arc of 130 degrees, so that its tail points down by 65.
Outline strongly_cambered(const Outline& section) {
    constexpr double angle = 2.27;
    Outline bent;
    for (const Point p : section) {
        const double a = angle * (p.x - 0.5), r = 1 / angle + p.y;
        bent.push_back({r * std::sin(a), r * std::cos(a)});
    }
    return bent;
}

/// As the smoothed points of scans.
TEST(Flow, BluntSectionsOfManyPointsAreSolved) {
    for (const std::size_t points_a_side : {60, 5000}) {
        const Geometry section = shapes::geometry({shapes::section(0.12, 0.0034, points_a_side)});
        const Flow flow = solve_flow(section, {.alpha_deg = 4});
        EXPECT_FALSE(flow.estimated) << points_a_side;
        EXPECT_NEAR(flow.lift, 0.47, 0.02) << points_a_side;
    }
}

TEST(Flow, AWallThatIsSteepBeforeTheTrailingEdgeIsNoBase) {
    for (const double base : {0.0, 0.002, 0.01}) {
        const Flow flow =
            solve_flow(geometry({strongly_cambered(shapes::section(0.06, base, 80))}), {.alpha_deg = 0, .chord = 1});
        ASSERT_EQ(flow.elements.size(), 1u);
        const Point above = flow.elements[0].upper.back().at, below = flow.elements[0].lower.back().at;
        EXPECT_NEAR(distance(above, below), base, 1e-3) << base;
    }
}

// A wake that begins wide across the stream is that of a stalled section or a bluff body.
TEST(Flow, SaysWhereItDoesNotStayAtTheWalls) {
    const auto width = [](const std::vector<std::string>& inputs, double alpha_deg) {
        const Flow flow = solve_flow(read_geometry(inputs), {.alpha_deg = alpha_deg, .reynolds = 6e6});
        return flow.warnings.empty() ? 0.0 : flow.warnings[0].number;
    };
    for (const double alpha_deg : {0.0, 4.0, 15.0, -15.0, 17.0})
        EXPECT_EQ(width({"naca:0012"}, alpha_deg), 0) << alpha_deg;
    EXPECT_NEAR(width({"naca:0012"}, 30), 0.51, 0.02);
    EXPECT_NEAR(width({"naca:0012"}, -30), 0.51, 0.02);
    const Flow bluff = solve_flow(geometry({shapes::circle(1, 100)}), {.reynolds = 1e5});
    ASSERT_EQ(bluff.warnings.size(), 1u);
    EXPECT_EQ(bluff.warnings[0].code, WarningCode::flow_separates);
    EXPECT_TRUE(solve_flow(geometry({shapes::circle(1, 100)})).warnings.empty()) << "no boundary layers";
}

/// Thwaites' method separates potential flow round a cylinder at 103.1 degrees from the stagnation point (F. M. White,
/// Viscous Fluid Flow, 3rd ed. (2006), section 4-6.6), at any Reynolds number. Turbulent layers go on beyond.
TEST(Flow, IsLaminarAtLowReynoldsNumbers) {
    const auto separation_deg = [](double reynolds) {
        const Flow flow = solve_flow(geometry({shapes::circle(1, 200)}), {.reynolds = reynolds});
        const auto& side = flow.elements[0].upper;
        const auto at = std::find_if(side.begin(), side.end(),
                                     [](const FlowPoint& p) { return p.state == BoundaryLayerState::separated; });
        for (auto p = side.begin(); p != at; ++p)
            EXPECT_EQ(p->state == BoundaryLayerState::turbulent && reynolds < 1e4, false);
        return at == side.end() ? 180 : 180 / std::acos(-1) * at->s;
    };
    for (const double reynolds : {40.0, 100.0, 9999.0}) EXPECT_NEAR(separation_deg(reynolds), 103.1, 2) << reynolds;
    EXPECT_GT(separation_deg(1e5), 110);
}

TEST(Flow, AnyBodyIsSolvedOrEstimated) {
    for (const Outline& outline :
         {shapes::wedge(), shapes::diamond(), shapes::box(), shapes::l_shape(), shapes::c_shape(0.2),
          shapes::circle(1, 7), shapes::v_notch(0.5), shapes::comb(4, 0.1), shapes::plate(0.001, 20),
          shapes::plate(1e-5, 20), shapes::joukowski(0.1, 0.3, 50), Outline{{0, 0}, {1, 0}, {0.5, 0.1}}})
        for (const double alpha_deg : {-90.0, -20.0, 0.0, 45.0, 90.0}) {
            const Flow flow = solve_flow(geometry({outline}), {.alpha_deg = alpha_deg, .reynolds = 1e6});
            ASSERT_EQ(flow.elements.size(), 1u);
            ASSERT_EQ(flow.estimated, !flow.warnings.empty() && flow.warnings[0].code == WarningCode::flow_estimated);
            for (const auto* side : {&flow.elements[0].upper, &flow.elements[0].lower})
                for (const FlowPoint& p : *side) {
                    ASSERT_TRUE(std::isfinite(p.speed) && std::isfinite(p.s));
                    ASSERT_LE(p.speed, flow::max_flow_speed);
                }
        }
    std::mt19937 random(3);
    for (int i = 0; i < 20; ++i) {
        const Flow flow = solve_flow(geometry({shapes::star(30, 0.3, random)}), {.alpha_deg = 3});
        ASSERT_EQ(flow.elements.size(), 1u);
    }
}

TEST(Flow, SidesCarryTheirBoundaryLayers) {
    const double reynolds = 3e6;
    const Geometry given = three_elements();
    const Flow without = solve_flow(given, {.alpha_deg = 4});
    const Flow flow = solve_flow(given, {.alpha_deg = 4, .reynolds = reynolds});
    EXPECT_EQ(flow.lift, without.lift);
    for (const FlowPoint& p : without.elements[1].upper) EXPECT_EQ(p.thickness, 0);
    for (const ElementFlow& element : flow.elements)
        for (const auto* side : {&element.upper, &element.lower})
            for (const FlowPoint& p : *side) {
                EXPECT_GT(p.momentum, 0);
                EXPECT_GT(p.displacement, p.momentum);
                EXPECT_GT(p.thickness, p.displacement);
                EXPECT_LT(p.thickness, 0.5 * flow.chord);
                EXPECT_GE(p.skin_friction, 0);
                // At a Reynolds number of 3e6, only lips at which the flow is infinitely fast could exceed this.
                EXPECT_LT(p.skin_friction, 0.12) << element.name << ' ' << p.at.x << ' ' << p.at.y;
            }
    // Where the flow hardly accelerates the layer of a thin section is that of a plate, whose momentum thickness is
    // between a laminar and a turbulent one.
    const Flow thin = solve_flow(geometry({naca_airfoil("0003", 100).points}), {.alpha_deg = 0, .reynolds = reynolds});
    const FlowPoint& end = thin.elements[0].upper.back();
    EXPECT_NEAR(end.momentum, 0.037 / std::pow(reynolds, 0.2), 0.25 * end.momentum);
    EXPECT_EQ(end.state, BoundaryLayerState::turbulent);
    EXPECT_EQ(thin.elements[0].upper[1].state, BoundaryLayerState::laminar);
    // Lengths scale with the units, numbers do not.
    const Flow scaled = solve_flow(moved(given, 0.25, {}), {.alpha_deg = 4, .reynolds = reynolds});
    for (std::size_t i = 0; i < flow.elements[1].upper.size(); ++i) {
        EXPECT_EQ(scaled.elements[1].upper[i].thickness, 0.25 * flow.elements[1].upper[i].thickness);
        EXPECT_EQ(scaled.elements[1].upper[i].skin_friction, flow.elements[1].upper[i].skin_friction);
    }
}

/// A flow with less lift keeps to the same walls. Strengths are rounded to 1e-6.
TEST(Flow, AShareOfTheLiftIsAsGoodAFlow) {
    for (const Geometry& given : {geometry({naca_airfoil("4412", 100).points}),
                                  geometry({naca_airfoil("2412", 100, TrailingEdge::blunt).points,
                                            shapes::moved(naca_airfoil("0012", 80).points, -0.4, 0.3, {0.98, -0.03})}),
                                  geometry({shapes::circle(0.5, 200)})}) {
        const Flow flow = solve_flow(given, {.alpha_deg = 7});
        ASSERT_FALSE(flow.estimated);
        ASSERT_EQ(flow.panels->without_lift.size(), flow.panels->sheets.size());
        for (std::size_t e = 0; e < flow.panels->sheets.size(); ++e)
            EXPECT_NEAR(flow::circulation(flow.panels->without_lift[e]), 0, 2e-6);
        const Flow weaker = flow::with_share_of_lift(flow, 0.6), same = flow::with_share_of_lift(flow, 1);
        for (std::size_t e = 0; e < flow.panels->sheets.size(); ++e) {
            const double with = flow::circulation(flow.panels->sheets[e]);
            EXPECT_NEAR(flow::circulation(weaker.panels->sheets[e]), 0.6 * with, 2e-6);
            std::size_t leaks = 0;
            const std::vector<Point>& nodes = weaker.panels->sheets[e].nodes;
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
                EXPECT_NEAR(same.panels->sheets[e].strengths[i], flow.panels->sheets[e].strengths[i], 1e-9);
                const Point along = unit(nodes[i + 1] - nodes[i]);
                leaks += std::abs(cross(along, flow_velocity(weaker, midpoint(nodes[i], nodes[i + 1])))) > 0.01;
            }
            EXPECT_LT(leaks, nodes.size() / 10);
        }
    }
}

/// The exact flow round a circle without circulation is twice as fast at its sides as the free stream.
TEST(Flow, ACircleWithoutLiftHasItsExactSpeeds) {
    const Flow flow = solve_flow(geometry({shapes::circle(1, 300)}), {.alpha_deg = 20});
    const flow::PanelSheet& sheet = flow.panels->without_lift.front();
    const double alpha = 20 * M_PI / 180;
    for (std::size_t i = 0; i < sheet.nodes.size(); ++i) {
        const Point p = sheet.nodes[i];
        EXPECT_NEAR(sheet.strengths[i], -2 * std::sin(std::atan2(p.y, p.x) - alpha), 0.01) << p.x << ' ' << p.y;
    }
}

TEST(Flow, ConditionsOutOfRangeAreRefused) {
    const Geometry given = geometry({naca_airfoil("0012", 60).points});
    EXPECT_THROW(solve_flow(given, {.alpha_deg = 91}), OptionError);
    EXPECT_THROW(solve_flow(given, {.alpha_deg = NAN}), OptionError);
    EXPECT_THROW(solve_flow(given, {.reynolds = 0}), OptionError);
    EXPECT_THROW(solve_flow(given, {.chord = -1}), OptionError);
}

// The system of equations grows with the square of the number of panels, and its solution with the cube: sixty sections
// with as many panels each as one of them would ask for 3 GB and minutes.
TEST(Flow, ManyElementsShareTheirPanels) {
    const Geometry one = read_geometry(std::vector<std::string>{"naca:0012:200"});
    Geometry many;
    for (int i = 0; i < 60; ++i) {
        Element& element = many.elements.emplace_back(one.elements[0]);
        for (Point& p : element.points) p = p + Point{0, 1.0 * i};
    }
    const auto panels = [](const Geometry& geometry) {
        std::size_t sum = 0;
        for (const flow::Contour& contour : flow::make_contours(geometry)) sum += contour.nodes.size() - 1;
        return sum;
    };
    EXPECT_GT(panels(one), 100u);
    EXPECT_LE(panels(many), 3060u);
}

}  // namespace
}  // namespace lamina::test
