// Wakes behind walls that the flow has left: both shear layers lie in fine triangles.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "flow/separation.hpp"
#include "pipeline/cases.hpp"
#include "pipeline/flow_guidance.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

CaseOptions guided_by_flow(double reynolds) {
    CaseOptions options;
    options.conditions.reynolds = reynolds;
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.far_field.size = 30;
    options.use_flow = true;
    return options;
}

/// Returns the size that the envelope behind the first element asks for at a point, without growth around it.
double size_in(const pipeline::ElementWake& wake, Point p) {
    double least = HUGE_VAL;
    for (const pipeline::WakeSource& part : wake.outer)
        if (distance_to(part.source, p) == 0) least = std::min(least, part.source.size);
    return least;
}

struct OpenCase {
    Outline outline;
    double alpha_deg, reynolds;
};

std::vector<OpenCase> open_cases() {
    return {{shapes::circle(1, 200), 0, 1e5},
            {naca("0012", 200), 18, 6e6},
            {naca("0012", 200), -30, 6e6},
            {shapes::refined(shapes::box(), 20), 0, 1e5},
            {shapes::section(0.3, 0.2, 100), 2, 3e6}};
}

TEST(OpenWakes, HoldBothShearLayers) {
    for (const OpenCase& each : open_cases()) {
        SCOPED_TRACE(testing::Message() << each.alpha_deg << " degrees, Reynolds number " << each.reynolds);
        const Flow flow =
            solve_flow(shapes::geometry({each.outline}), {.alpha_deg = each.alpha_deg, .reynolds = each.reynolds});
        const auto open = flow::find_open_wake(flow, flow.elements[0]);
        ASSERT_TRUE(open);
        EXPECT_EQ(flow.warnings.size(), 1u);
        const pipeline::ElementWake wake = pipeline::wakes_of_flow(flow)[0], fine = pipeline::wakes_of_flow(flow, 2)[0];
        EXPECT_TRUE(wake.wake.separated);
        EXPECT_TRUE(wake.line.empty() && wake.inner.empty() && wake.mixing.empty());
        const double d = open->width;
        EXPECT_NEAR(wake.wake.length, 20 * d, 1e-9 * d);
        const Point across = perpendicular(open->stream), middle = midpoint(open->above, open->below);
        for (const double along : {0.5, 1.0, 3.0, 5.0, 10.0, 19.0})
            for (const double y : {-0.5, 0.0, 0.5}) {
                const double size = size_in(wake, middle + along * d * open->stream + y * d * across);
                EXPECT_LE(size, (along <= 4 ? 0.03 : 0.1) * d) << along << ' ' << y;
                EXPECT_GE(size, 0.02 * d) << along << ' ' << y;
            }
        for (const Point place : {open->above, open->below})
            EXPECT_LE(size_in(wake, place + 0.3 * d * open->stream), 0.03 * d);
        EXPECT_EQ(fine.outer.front().source.size, 0.5 * wake.outer.front().source.size);
    }
}

TEST(OpenWakes, AreThoseOfTheMirrorImage) {
    const auto wake_at = [](double alpha_deg) {
        const Flow flow = solve_flow(shapes::geometry({naca("0012", 200)}), {.alpha_deg = alpha_deg, .reynolds = 6e6});
        return pipeline::wakes_of_flow(flow)[0];
    };
    const pipeline::ElementWake up = wake_at(25), down = wake_at(-25);
    ASSERT_EQ(up.outer.size(), down.outer.size());
    for (std::size_t i = 0; i < up.outer.size(); ++i) {
        const SizeSource &a = up.outer[i].source, &b = down.outer[i].source;
        EXPECT_NEAR(a.size, b.size, 1e-6);
        EXPECT_NEAR(a.radius, b.radius, 1e-5);
        EXPECT_LT(distance(a.b, {b.b.x, -b.b.y}), 1e-5);
    }
}

/// An envelope ends where it meets another element, and attached flow has none.
TEST(OpenWakes, EndAtOtherElements) {
    const Geometry geometry =
        shapes::geometry({shapes::circle(0.5, 100), shapes::moved(naca("0012", 100), 0, 1, {3, -0.01})});
    const Flow flow = solve_flow(geometry, {.reynolds = 1e5});
    ASSERT_FALSE(flow.estimated);
    const std::vector<pipeline::ElementWake> wakes = pipeline::wakes_of_flow(flow);
    ASSERT_TRUE(wakes[0].wake.separated);
    EXPECT_LT(wakes[0].wake.length, 3.1);
    EXPECT_GT(wakes[0].wake.length, 2.4);
    EXPECT_FALSE(wakes[1].wake.separated);
}

TEST(OpenWakes, MakeValidMeshesWithSuchEdges) {
    CaseOptions options = guided_by_flow(1e5);
    const MeshResult result = mesh_of({shapes::circle(1, 200)}, options);
    expect_sound(result, options);
    const auto open = flow::find_open_wake(*result.flow, result.flow->elements[0]);
    ASSERT_TRUE(open);
    const Point middle = midpoint(open->above, open->below);
    double longest = 0;
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
        const auto [a, b, c] = result.mesh.triangles[t].v;
        const Point pa = result.mesh.points[a.index()], pb = result.mesh.points[b.index()];
        const Point from = midpoint(pa, pb) - middle;
        if (result.mesh.region[t] != Region::isotropic) continue;
        if (from.x < 0.5 * open->width || from.x > 4 * open->width || std::abs(from.y) > 0.5 * open->width) continue;
        longest = std::max(longest, distance(pa, pb));
    }
    EXPECT_GT(longest, 0);
    EXPECT_LT(longest, 0.045 * open->width);
    ASSERT_EQ(result.decisions.wakes.size(), 1u);
    EXPECT_TRUE(result.decisions.wakes[0].separated);
}

}  // namespace
}  // namespace lamina::test
