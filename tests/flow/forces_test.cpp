// Forces of a flow: drag by Squire and Young, moments.
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/flow.hpp>
#include <lamina/geometry.hpp>

namespace lamina {
namespace {

Flow flow_round(const char* digits, double alpha_deg, double reynolds) {
    return solve_flow(make_geometry({naca_airfoil(digits, 200)}), {.alpha_deg = alpha_deg, .reynolds = reynolds});
}

/// XFOIL 6.99 with trips at 0.02 chords, a Reynolds number of 3e6 and 160 panels.
TEST(FlowForces, DragIsThatOfXfoilWithTripsWhereTheFlowIsAttached) {
    struct Row {
        const char* digits;
        double alpha_deg, drag, moment;
    };
    constexpr double drag_tolerance = 0.035, moment_tolerance = 0.02;
    for (const Row& row : {Row{"0012", 0, 0.00911, 0}, Row{"0012", 4, 0.00963, -0.0003}, Row{"0012", 6, 0.01031, 0},
                           Row{"4412", 0, 0.00963, -0.0992}, Row{"4412", 4, 0.01085, -0.0984}}) {
        const FlowForces forces = flow_forces(flow_round(row.digits, row.alpha_deg, 3e6));
        EXPECT_NEAR(forces.drag, row.drag, drag_tolerance * row.drag) << row.digits << " at " << row.alpha_deg;
        EXPECT_NEAR(forces.moment, row.moment, moment_tolerance) << row.digits << " at " << row.alpha_deg;
    }
}

TEST(FlowForces, AreMirroredWithTheSection) {
    const FlowForces up = flow_forces(flow_round("0012", 5, 1e6)), down = flow_forces(flow_round("0012", -5, 1e6));
    EXPECT_NEAR(up.lift, -down.lift, 1e-4);
    EXPECT_NEAR(up.moment, -down.moment, 1e-4);
    EXPECT_NEAR(up.drag, down.drag, 1e-5);
    EXPECT_LT(up.friction_drag, up.drag);
    EXPECT_GT(up.friction_drag, 0.3 * up.drag);
}

TEST(FlowForces, HaveNoDragWithoutAReynoldsNumber) {
    const FlowForces forces = flow_forces(solve_flow(make_geometry({naca_airfoil("0012", 200)}), {.alpha_deg = 4}));
    EXPECT_EQ(forces.drag, 0);
    EXPECT_GT(forces.lift, 0.4);
}

TEST(FlowForces, AreFiniteAcrossTheStream) {
    for (const double alpha_deg : {-90.0, 90.0}) {
        const FlowForces forces = flow_forces(flow_round("0012", alpha_deg, 1e6));
        EXPECT_GE(forces.drag, 0);
        EXPECT_TRUE(std::isfinite(forces.drag) && std::isfinite(forces.moment)) << alpha_deg;
    }
    const Flow estimate = flow_round("0012", -90, 1e6);
    ASSERT_TRUE(estimate.estimated);
    EXPECT_EQ(flow_forces(estimate).drag, 0);
    EXPECT_EQ(flow_forces(solve_flow(make_geometry({naca_airfoil("0012", 200)}), {.alpha_deg = 90})).drag, 0);
}

}  // namespace
}  // namespace lamina
