// Flow and boundary layers solved together, beside XFOIL 6.99, and the equations beside differences.
#include <lamina/coupled_flow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "flow/coupled/interval.hpp"
#include "flow/coves.hpp"

namespace lamina {
namespace {

std::vector<CoupledFlow> coupled_flows(const Geometry& geometry, double reynolds, std::initializer_list<double> alphas,
                                       const TransitionOptions& transition = {}) {
    std::vector<FlowConditions> conditions;
    for (const double alpha : alphas) conditions.push_back({.alpha_deg = alpha, .reynolds = reynolds});
    return solve_coupled_flow(geometry, conditions, transition);
}

Geometry section_of(const char* digits) { return make_geometry({naca_airfoil(digits, 241, TrailingEdge::blunt)}); }

/// Returns a section, turned nose up, scaled and moved.
Element placed(const char* digits, double angle_deg, double scale, Point to) {
    Element element = naca_airfoil(digits, 121, TrailingEdge::blunt);
    const double angle = angle_deg * 0.017453292519943295, c = scale * std::cos(angle), s = scale * std::sin(angle);
    for (Point& p : element.points) p = Point{c * p.x + s * p.y, -s * p.x + c * p.y} + to;
    return element_of_points(element.points, digits);
}

/// Returns a section whose lower side is cut away between two places down to a depth, with a sharp corner ahead.
std::vector<Point> section_with_cove(double from, double to, double depth) {
    std::vector<Point> points = naca_airfoil("4412", 161, TrailingEdge::blunt).points;
    const std::size_t nose = points.size() / 2;
    for (std::size_t i = nose; i < points.size(); ++i)
        if (const double share = (points[i].x - from) / (to - from); share > 0 && share < 1)
            points[i].y += depth * std::min(1.0, 8 * share) * (1 - share);
    return points;
}

struct XfoilRow {
    const char* digits;
    double reynolds, alpha_deg, lift, drag, moment, upper, lower;
};

/// XFOIL 6.99 with 160 panels and N = 9, on the coordinates of these sections.
TEST(CoupledFlow, HasTheForcesAndTransitionsOfXfoil) {
    constexpr double lift_tolerance = 0.01, drag_tolerance = 0.015, moment_tolerance = 0.0015, place_tolerance = 0.01;
    for (const XfoilRow& row : {XfoilRow{"0012", 1e6, 0, 0.0, 0.00540, 0.0, 0.6870, 0.6870},
                                XfoilRow{"0012", 1e6, 4, 0.4278, 0.00728, 0.0060, 0.2537, 0.9685},
                                XfoilRow{"0012", 1e6, 12, 1.2454, 0.01936, 0.0133, 0.0194, 1.0},
                                XfoilRow{"0012", 2e5, 4, 0.5353, 0.01176, -0.0144, 0.4165, 1.0},
                                XfoilRow{"4412", 3e6, 0, 0.4865, 0.00597, -0.1036, 0.5196, 0.2581},
                                XfoilRow{"4412", 3e6, 8, 1.3212, 0.01106, -0.0946, 0.0606, 0.9998},
                                XfoilRow{"23012", 6e6, 4, 0.5850, 0.00550, -0.0091, 0.1693, 0.8739}}) {
        const CoupledFlow found = coupled_flows(section_of(row.digits), row.reynolds, {row.alpha_deg}).front();
        SCOPED_TRACE(testing::Message() << row.digits << " at " << row.alpha_deg);
        ASSERT_TRUE(found.converged);
        EXPECT_NEAR(found.forces.lift, row.lift, lift_tolerance * std::max(row.lift, 0.1));
        EXPECT_NEAR(found.forces.drag, row.drag, drag_tolerance * row.drag);
        EXPECT_NEAR(found.forces.moment, row.moment, moment_tolerance);
        EXPECT_NEAR(found.transitions.front().upper, row.upper, place_tolerance);
        EXPECT_NEAR(found.transitions.front().lower, row.lower, place_tolerance);
    }
}

TEST(CoupledFlow, LiftBendsBeyondStallAsThatOfXfoil) {
    const std::vector<CoupledFlow> flows = coupled_flows(section_of("0012"), 1e6, {12, 14, 16, 18});
    for (const CoupledFlow& flow : flows) EXPECT_TRUE(flow.converged);
    EXPECT_NEAR(flows[2].forces.lift, 1.3877, 0.02);
    EXPECT_LT(flows[3].forces.lift, flows[2].forces.lift);
    EXPECT_NEAR(flows[3].forces.drag, 0.08786, 0.008);
    const auto separated = [](const FlowPoint& p) { return p.state == BoundaryLayerState::separated; };
    const std::vector<FlowPoint>& side = flows[3].flow.elements.front().upper;
    EXPECT_TRUE(std::any_of(side.begin(), side.end(), separated));
}

TEST(CoupledFlow, TripsMakeLayersTurbulent) {
    const Geometry section = section_of("0012");
    const CoupledFlow tripped = coupled_flows(section, 3e6, {4}, {.trip = 0.05}).front();
    ASSERT_TRUE(tripped.converged);
    EXPECT_NEAR(tripped.forces.lift, 0.4543, 0.004);
    EXPECT_NEAR(tripped.forces.drag, 0.00929, 0.0001);
    EXPECT_NEAR(tripped.transitions.front().upper, 0.05, 1e-6);
    const CoupledFlow noisy = coupled_flows(section, 3e6, {4}, {.critical_exponent = 4}).front(),
                      quiet = coupled_flows(section, 3e6, {4}).front();
    EXPECT_LT(noisy.transitions.front().upper, quiet.transitions.front().upper);
    EXPECT_GT(noisy.forces.drag, quiet.forces.drag);
}

TEST(CoupledFlow, IsMirroredAndScaledWithTheSection) {
    Geometry section = make_geometry({naca_airfoil("2412", 200)}), flipped = section, large = section;
    std::vector<Point>&mirrored = flipped.elements[0].points, &scaled = large.elements[0].points;
    for (Point& p : mirrored) p.y = -p.y;
    std::reverse(mirrored.begin(), mirrored.end());
    for (Point& p : scaled) p = 4 * p;
    flipped = make_geometry({element_of_points(mirrored, "flipped")});
    large = make_geometry({element_of_points(scaled, "large")});
    const CoupledFlow a = coupled_flows(section, 1e6, {3}).front(), b = coupled_flows(flipped, 1e6, {-3}).front(),
                      c = coupled_flows(large, 1e6, {3}).front();
    ASSERT_TRUE(a.converged && b.converged && c.converged);
    EXPECT_NEAR(a.forces.lift, -b.forces.lift, 1e-3);
    EXPECT_NEAR(a.forces.drag, b.forces.drag, 1e-5);
    EXPECT_NEAR(a.transitions.front().upper, b.transitions.front().lower, 1e-3);
    EXPECT_NEAR(a.forces.lift, c.forces.lift, 1e-9);
    EXPECT_NEAR(a.forces.drag, c.forces.drag, 1e-9);
}

TEST(CoupledFlow, SharpTrailingEdgesHaveNearlyTheLiftOfThinBases) {
    const CoupledFlow sharp = coupled_flows(make_geometry({naca_airfoil("0012", 200)}), 1e6, {2}).front(),
                      blunt = coupled_flows(section_of("0012"), 1e6, {2}).front();
    ASSERT_TRUE(sharp.converged && blunt.converged);
    EXPECT_NEAR(sharp.forces.lift, blunt.forces.lift, 0.04 * blunt.forces.lift);
}

/// Returns NACA 0012 whose sides end at these x.
Geometry with_oblique_base(double upper_end, double lower_end) {
    constexpr int panels = 120;
    std::vector<Point> points;
    for (int i = -panels; i <= panels; ++i) {
        const double share = std::abs(i) / static_cast<double>(panels), root = std::sin(1.5707963267948966 * share);
        const double x = (i < 0 ? upper_end : lower_end) * root * root;
        const double y = 0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - x * 0.1015))));
        points.push_back({x, i < 0 ? y : -y});
    }
    return make_geometry({element_of_points(points, "oblique")});
}

TEST(CoupledFlow, AnObliqueBaseIsAsWideAsTheFlowSeesIt) {
    const Geometry section = with_oblique_base(0.93, 0.95);
    for (const auto& [alpha_deg, lift, drag] : {std::array{0.0, -0.0038, 0.00610}, std::array{2.0, 0.2076, 0.00652}}) {
        const CoupledFlow found =
            solve_coupled_flow(section, std::array{FlowConditions{.alpha_deg = alpha_deg, .reynolds = 1e6, .chord = 1}})
                .front();
        ASSERT_TRUE(found.converged);
        EXPECT_NEAR(found.forces.lift, lift, 0.004);
        EXPECT_NEAR(found.forces.drag, drag, 0.02 * drag);
    }
}

TEST(Coves, AreFairedOnEitherSide) {
    const std::vector<Point> given = section_with_cove(0.6, 0.99, 0.05);
    std::vector<Point> upright = given, flipped;
    std::vector<bool> corners(given.size());
    corners.front() = corners.back() = true;
    for (std::size_t i = given.size() / 2; i + 1 < given.size(); ++i)
        if (given[i].x <= 0.6 && given[i + 1].x > 0.6) corners[i] = true;
    std::vector<bool> flipped_corners = corners;
    for (const Point p : given) flipped.push_back({p.x, -p.y});
    flow::fair_cove(upright, corners, 1, 0.05);
    flow::fair_cove(flipped, flipped_corners, 1, 0.05);
    ASSERT_NE(upright, given);
    ASSERT_EQ(upright.size(), flipped.size());
    ASSERT_EQ(upright.size(), corners.size());
    for (std::size_t i = 0; i < upright.size(); ++i) EXPECT_EQ(upright[i], (Point{flipped[i].x, -flipped[i].y}));
    // All that is ahead of the corner stays, and the trailing edge.
    EXPECT_TRUE(std::equal(given.begin(), given.begin() + 125, upright.begin()));
    EXPECT_EQ(upright.back(), given.back());
    const auto highest_below = [](const std::vector<Point>& points) {
        double highest = -1;
        for (auto p = points.begin() + 81; p != points.end() && p->x < 0.9; ++p) highest = std::max(highest, p->y);
        return highest;
    };
    EXPECT_GT(highest_below(given), 0.03);
    EXPECT_LT(highest_below(upright), 0.015);
}

TEST(Coves, WithoutASlotBehindThemAreNone) {
    std::vector<Point> points = section_with_cove(0.6, 0.99, 0.05);
    const std::vector<Point> given = points;
    std::vector<bool> corners(given.size(), true);
    flow::fair_cove(points, corners, 1, 0.5);
    EXPECT_EQ(points, given);
}

TEST(Coves, SmoothSidesHaveNone) {
    for (const char* digits : {"0012", "4412", "6409"}) {
        const std::vector<Point> given = naca_airfoil(digits, 161).points;
        std::vector<Point> faired = given;
        std::vector<bool> corners(given.size(), true);
        flow::fair_cove(faired, corners, 1, 0.05);
        EXPECT_EQ(faired, given) << digits;
    }
}

namespace coupled = flow::coupled;

/// Compares the derivatives of equations by the numbers of both stations with differences.
template <class F>
void expect_derivatives(const coupled::Station& a, const coupled::Station& b, F&& equations) {
    constexpr double step = 1e-6, tolerance = 2e-4;
    const coupled::Equations exact = equations(a, b);
    const std::array members{&coupled::Station::shear, &coupled::Station::momentum, &coupled::Station::displacement,
                             &coupled::Station::speed};
    for (std::size_t slot = 0; slot < 8; ++slot) {
        const auto value = [&](double sign) {
            coupled::Station p = a, q = b;
            coupled::Station& changed = slot < 4 ? p : q;
            changed.*members[slot % 4] *= 1 + sign * step;
            return equations(p, q);
        };
        const double size = (slot < 4 ? a : b).*members[slot % 4];
        const coupled::Equations more = value(1), less = value(-1);
        for (std::size_t i = 0; i < 3; ++i) {
            const double difference = (more[i].value - less[i].value) / (2 * step);
            EXPECT_NEAR(exact[i].by[slot] * size, difference, tolerance * (1 + std::abs(difference)))
                << "equation " << i << ", slot " << slot;
        }
    }
}

TEST(CoupledFlow, IsForUpToFiveElementsOutsideOfRowsWhoseLayersBecomeTurbulent) {
    Geometry bodies = section_of("0012");
    EXPECT_TRUE(can_be_coupled(bodies, {.reynolds = 1e4}));
    EXPECT_FALSE(can_be_coupled(bodies, {.reynolds = 9999}));
    EXPECT_FALSE(can_be_coupled(bodies, {}));
    EXPECT_TRUE(can_be_coupled(bodies, {.reynolds = 1e6}, {.below = -1, .above = 1}));
    EXPECT_FALSE(can_be_coupled(bodies, {.reynolds = 1e6}, {.pitch = 1}));
    const Element section = bodies.elements.front();
    bodies.elements.assign(5, section);
    EXPECT_TRUE(can_be_coupled(bodies, {.reynolds = 1e6}));
    bodies.elements.push_back(section);
    EXPECT_FALSE(can_be_coupled(bodies, {.reynolds = 1e6}));
    EXPECT_FALSE(can_be_coupled({}, {.reynolds = 1e6}));
}

TEST(CoupledFlow, SectionsFarFromEachOtherAreAsAlone) {
    constexpr double far_away = 2000;
    const Geometry two = make_geometry({placed("2412", 0, 1, {}), placed("4412", 0, 1, {0, far_away})}),
                   first = make_geometry({placed("2412", 0, 1, {})}),
                   second = make_geometry({placed("4412", 0, 1, {})});
    const FlowConditions conditions{.alpha_deg = 3, .reynolds = 1e6, .chord = 1};
    const auto flow = [&](const Geometry& geometry) {
        return solve_coupled_flow(geometry, std::array{conditions}).front();
    };
    const CoupledFlow both = flow(two), a = flow(first), b = flow(second);
    ASSERT_TRUE(both.converged && a.converged && b.converged);
    EXPECT_NEAR(both.flow.elements[0].lift, a.forces.lift, 2e-3);
    EXPECT_NEAR(both.flow.elements[1].lift, b.forces.lift, 2e-3);
    EXPECT_NEAR(both.forces.drag, a.forces.drag + b.forces.drag, 2e-5);
    ASSERT_EQ(both.transitions.size(), 2U);
    EXPECT_NEAR(both.transitions[0].upper, a.transitions[0].upper, 2e-3);
    EXPECT_NEAR(both.transitions[1].lower, b.transitions[0].lower, 2e-3);
}

TEST(CoupledFlow, AWallIsTheLineOfSymmetryOfAMirroredSection) {
    constexpr double height = 0.3;
    Element above = placed("4412", -4, 1, {0, height}), below = above;
    for (Point& p : below.points) p.y = -p.y;
    std::reverse(below.points.begin(), below.points.end());
    const FlowConditions conditions{.reynolds = 1e6, .chord = 1};
    const CoupledFlow mirrored = solve_coupled_flow(make_geometry({above, below}), std::array{conditions}).front(),
                      grounded =
                          solve_coupled_flow(make_geometry({above}), std::array{conditions}, {}, {.below = 0}).front();
    ASSERT_TRUE(mirrored.converged && grounded.converged);
    EXPECT_NEAR(mirrored.forces.lift, 0, 1e-3);
    EXPECT_NEAR(mirrored.flow.elements[0].lift, grounded.forces.lift, 0.005 * std::abs(grounded.forces.lift));
    EXPECT_NEAR(mirrored.forces.drag, 2 * grounded.forces.drag, 0.01 * mirrored.forces.drag);
}

TEST(CoupledFlow, FlapsBehindSlotsAreSolved) {
    for (const double flap_deg : {10.0, 25.0}) {
        const Geometry wing = make_geometry({placed("4412", 0, 1, {}), placed("4412", flap_deg, 0.3, {0.985, -0.028})});
        const FlowConditions conditions{.alpha_deg = 4, .reynolds = 2e6, .chord = 1};
        const CoupledFlow found = solve_coupled_flow(wing, std::array{conditions}).front();
        ASSERT_TRUE(found.converged) << flap_deg;
        const double outer = solve_flow(wing, conditions).lift;
        EXPECT_LT(found.forces.lift, 0.97 * outer) << flap_deg;
        EXPECT_GT(found.forces.lift, 0.75 * outer) << flap_deg;
    }
}

TEST(CoupledFlow, PassesACoveAheadOfAFlap) {
    const Geometry wing = make_geometry(
        {element_of_points(section_with_cove(0.7, 0.99, 0.04), "main"), placed("4412", 25, 0.3, {0.96, -0.025})});
    const CoupledFlow found =
        solve_coupled_flow(wing, std::array{FlowConditions{.alpha_deg = 4, .reynolds = 2e6, .chord = 1}}).front();
    ASSERT_TRUE(found.converged);
    EXPECT_GT(found.forces.lift, 1.5);
    EXPECT_LT(found.forces.drag, 0.04);
}

TEST(LayerEquations, HaveTheDerivativesOfDifferences) {
    const coupled::LayerConditions conditions{1e-6, 9};
    const coupled::Station a{0.30, 5, 4.0e-4, 1.1e-3, 1.15}, b{0.32, 6, 4.2e-4, 1.2e-3, 1.14},
        c{0.30, 8.5, 4.0e-4, 1.3e-3, 1.15}, d{0.32, 0.05, 5.2e-4, 1.4e-3, 1.10}, e{0.60, 0.06, 1.5e-3, 2.6e-3, 1.0},
        f{0.62, 0.07, 1.6e-3, 2.9e-3, 0.98}, g{1.02, 0.07, 3e-3, 4.5e-3, 0.9, 3e-4},
        h{1.04, 0.06, 3.1e-3, 4.3e-3, 0.92, 1e-4};
    const auto in = [&](coupled::Regime regime) {
        return
            [&, regime](const auto& p, const auto& q) { return coupled::interval_equations(p, q, regime, conditions); };
    };
    expect_derivatives(a, b, in(coupled::Regime::laminar));
    expect_derivatives(e, f, in(coupled::Regime::turbulent));
    expect_derivatives(g, h, in(coupled::Regime::wake));
    expect_derivatives(c, d, [&](const auto& p, const auto& q) {
        return coupled::transition_equations(p, q, std::nullopt, conditions);
    });
    expect_derivatives(
        c, d, [&](const auto& p, const auto& q) { return coupled::transition_equations(p, q, 0.305, conditions); });
}

TEST(LayerEquations, ALaminarPlateHasTheFrictionOfBlasius) {
    const coupled::Dual friction = coupled::skin_friction(2.591, 500, coupled::Regime::laminar);
    EXPECT_NEAR(friction.value * 500, 0.441, 0.03 * 0.441);
}

}  // namespace
}  // namespace lamina
