// Compressible flow on meshes that are made for it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <lamina/compressible_flow.hpp>
#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "pipeline/cases.hpp"
#include "pipeline/shock_sizes.hpp"

namespace lamina::test {
namespace {

bool is_finite(const CompressibleFlow& flow) {
    const auto finite = [](double value) { return std::isfinite(value); };
    return finite(flow.lift) && finite(flow.drag) &&
           std::all_of(flow.mach_numbers.begin(), flow.mach_numbers.end(), finite) &&
           std::all_of(flow.pressures.begin(), flow.pressures.end(), finite);
}

// Published: lift coefficients of 0.35 to 0.36, a drag coefficient of 0.0227, shocks near 0.62 to 0.63 and 0.35.
TEST(CompressibleFlow, FindsTheShocksOfNaca0012) {
    const CompressibleFlow flow =
        solve_compressible_flow(read_geometry(std::vector<std::string>{"naca:0012"}), {.alpha_deg = 1.25, .mach = 0.8});
    EXPECT_TRUE(flow.converged);
    EXPECT_NEAR(flow.lift, 0.355, 0.01);
    EXPECT_NEAR(flow.drag, 0.0227, 0.0015);
    EXPECT_NEAR(flow.critical_pressure_coefficient, -0.4346, 1e-4);
    EXPECT_NEAR(flow.largest_mach, 1.38, 0.04);
    ASSERT_EQ(flow.elements.size(), 1u);
    ASSERT_EQ(flow.elements[0].upper.shocks.size(), 1u);
    EXPECT_NEAR(flow.elements[0].upper.shocks[0].position, 0.63, 0.015);
    ASSERT_EQ(flow.elements[0].lower.shocks.size(), 1u);
    EXPECT_NEAR(flow.elements[0].lower.shocks[0].position, 0.35, 0.02);
    EXPECT_GT(flow.triangles.size(), 6000u);
    EXPECT_LT(flow.triangles.size(), 14000u);
    EXPECT_EQ(flow.mach_numbers.size(), flow.points.size());
}

// Reynolds-averaged solutions have the shock at 0.503.
TEST(CompressibleFlow, PutsShocksWhereBoundaryLayersLeaveThem) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    const FlowConditions conditions{.alpha_deg = 2.5, .reynolds = 6e6, .mach = 0.76};
    const CompressibleFlow flow = solve_compressible_flow(geometry, conditions);
    ASSERT_TRUE(flow.converged && flow.has_layers);
    ASSERT_EQ(flow.elements[0].upper.shocks.size(), 1u);
    EXPECT_NEAR(flow.elements[0].upper.shocks[0].position, 0.503, 0.01);
    EXPECT_NEAR(flow.viscous_drag, 0.0115, 0.002);
    EXPECT_EQ(flow.drag, flow.viscous_drag + flow.wave_drag);
    const std::vector<CompressibleWallPoint>& upper = flow.elements[0].upper.points;
    EXPECT_EQ(upper.front().momentum, 0);
    EXPECT_GT(upper.back().displacement, 0.005);
    EXPECT_LT(upper.back().displacement, 0.03);
    CompressibleFlow again;
    with_threads(3, [&] { again = solve_compressible_flow(geometry, conditions); });
    EXPECT_EQ(again.pressures, flow.pressures);
    EXPECT_EQ(again.drag, flow.drag);
    Geometry large = geometry;
    for (Point& p : large.elements[0].points) p = 1024.0 * p;
    const CompressibleFlow scaled = solve_compressible_flow(large, conditions);
    EXPECT_EQ(scaled.lift, flow.lift);
    EXPECT_EQ(scaled.elements[0].upper.points.back().displacement, 1024 * upper.back().displacement);
    EXPECT_FALSE(solve_compressible_flow(geometry, {.alpha_deg = 2.5, .mach = 0.76}).has_layers);
    EXPECT_FALSE(solve_compressible_flow(geometry, {.reynolds = 6e6, .mach = 1.5}).has_layers);
}

TEST(CompressibleFlow, TakesBasesAndSeveralElementsInAnyUnit) {
    const Geometry blunt = read_geometry(std::vector<std::string>{"naca:4412:blunt"});
    Geometry pair = shapes::geometry({naca("2412", 160), shapes::moved(naca("0012", 120), -0.4, 0.3, {0.98, -0.03})});
    const CompressibleFlow flow = solve_compressible_flow(blunt, {.alpha_deg = 1, .mach = 0.72});
    EXPECT_TRUE(flow.converged && is_finite(flow));
    EXPECT_EQ(flow.elements[0].upper.shocks.size(), 1u);
    const CompressibleFlow two = solve_compressible_flow(pair, {.alpha_deg = 2, .mach = 0.5});
    EXPECT_TRUE(is_finite(two));
    ASSERT_EQ(two.elements.size(), 2u);
    EXPECT_GT(two.lift, 0.5);
    Geometry large = blunt;
    for (Point& p : large.elements[0].points) p = 1024.0 * p;
    const CompressibleFlow scaled = solve_compressible_flow(large, {.alpha_deg = 1, .mach = 0.72});
    EXPECT_EQ(scaled.lift, flow.lift);
    EXPECT_EQ(scaled.elements[0].upper.shocks[0].at, 1024.0 * flow.elements[0].upper.shocks[0].at);
}

TEST(CompressibleFlow, DoesNotDependOnTheNumberOfThreads) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    CompressibleFlow one;
    with_threads(1, [&] { one = solve_compressible_flow(geometry, {.mach = 2}); });
    for (const unsigned threads : {2u, 5u})
        with_threads(threads, [&] {
            const CompressibleFlow other = solve_compressible_flow(geometry, {.mach = 2});
            EXPECT_EQ(other.pressures, one.pressures);
            EXPECT_EQ(other.drag, one.drag);
        });
}

TEST(CompressibleFlow, KnowsTheCriticalMachNumber) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    const Flow flow = solve_flow(geometry);
    // That of NACA 0012 without lift is 0.72 to 0.73.
    EXPECT_FALSE(is_beyond_critical(flow, {}));
    EXPECT_FALSE(is_beyond_critical(flow, {.mach = 0.7}));
    EXPECT_TRUE(is_beyond_critical(flow, {.mach = 0.75}));
    EXPECT_TRUE(is_beyond_critical(flow, {.mach = 1.5}));
    EXPECT_THROW(solve_compressible_flow(geometry, {}), OptionError);
    // Glauert: about 1 / 0.8 times the lift of incompressible flow.
    const Flow lifting = solve_flow(geometry, {.alpha_deg = 2});
    const double ratio = with_compressed_pressures(lifting, 0.6).lift / lifting.lift;
    EXPECT_GT(ratio, 1.22);
    EXPECT_LT(ratio, 1.36);
}

CaseOptions options_at(std::optional<double> mach) {
    CaseOptions options;
    options.conditions = {.alpha_deg = 1.25, .reynolds = 6.5e6, .mach = mach};
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    options.use_flow = true;
    return options;
}

/// The longest edge of the upper side between two positions in x.
double longest_upper_edge(const MeshResult& result, double from, double to) {
    const std::vector<Point>& points = result.geometry.elements[0].points;
    double longest = 0;
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        if (points[i].y > 0 && std::min(points[i].x, points[i + 1].x) > from &&
            std::max(points[i].x, points[i + 1].x) < to)
            longest = std::max(longest, distance(points[i], points[i + 1]));
    return longest;
}

TEST(SizesAtShocks, FollowTheShock) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    const MeshResult without = generate_mesh(geometry, options_at({})), slow = generate_mesh(geometry, options_at(0.3)),
                     with = generate_mesh(geometry, options_at(0.8));
    EXPECT_EQ(slow.mesh.points.size(), without.mesh.points.size());
    EXPECT_TRUE(slow.decisions.shocks.empty());
    ASSERT_EQ(with.decisions.shocks.size(), 1u);  // the one below is weak
    const FlowShock& shock = with.decisions.shocks[0];
    EXPECT_TRUE(shock.has_layers && with.decisions.knows_shocks);
    EXPECT_FALSE(slow.decisions.knows_shocks);
    EXPECT_FALSE(slow.compressible_flow);
    ASSERT_TRUE(with.compressible_flow && with.flow);
    EXPECT_EQ(with.compressible_flow->mach, 0.8);
    EXPECT_EQ(with.compressible_flow->alpha_deg, with.flow->alpha_deg);
    EXPECT_EQ(with.compressible_flow->elements[0].upper.shocks.size(), 1u);
    EXPECT_NEAR(shock.at.x, 0.56, 0.03);
    EXPECT_NEAR(shock.mach_ahead, 1.38, 0.04);
    EXPECT_GT(shock.height, 0.1);
    EXPECT_LT(shock.height, 0.6);
    EXPECT_LT(longest_upper_edge(with, shock.at.x - 0.05, 0.99), 0.0051);
    EXPECT_GT(longest_upper_edge(without, shock.at.x - 0.05, 0.99), 0.008);
    EXPECT_LT(static_cast<double>(with.mesh.points.size()), 1.2 * static_cast<double>(without.mesh.points.size()));
}

// A wedge of 5 degrees at Mach 2 has an oblique shock at 34.30 degrees (NACA Report 1135, equation 150a).
TEST(SizesAtShocks, FollowObliqueShocks) {
    const double half_thickness = 0.5 * std::tan(5 * std::numbers::pi / 180);
    const Geometry diamond = shapes::geometry({{{1, 0}, {0.5, half_thickness}, {0, 0}, {0.5, -half_thickness}}});
    const CompressibleFlow flow = solve_compressible_flow(diamond, {.mach = 2});
    ASSERT_TRUE(flow.converged);
    const double angle = 34.30, tangent = std::tan(angle * std::numbers::pi / 180);
    double sum = 0, count = 0;
    const auto sizes = pipeline::sizes_at_shocks(flow, 1);
    EXPECT_TRUE(sizes.knows_shocks);
    for (const SizeSource& source : sizes.sources) {
        const double slope = source.a.y / source.a.x;
        if (source.a.x < 0.2 || source.a.x > 1 || slope < 0.8 * tangent || slope > 1.2 * tangent) continue;
        sum += std::atan(slope) * 180 / std::numbers::pi;
        ++count;
    }
    ASSERT_GT(count, 10);
    EXPECT_NEAR(sum / count, angle, 1);

    CaseOptions options = options_at(2);
    options.conditions.alpha_deg = 0;
    options.far_field.size = 30;
    const MeshResult with = generate_mesh(diamond, options);
    options.conditions.mach.reset();
    const MeshResult without = generate_mesh(diamond, options);
    const auto triangles_at_shock = [&](const Mesh& mesh) {
        return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            const Point middle =
                (1.0 / 3) * (mesh.points[t.v[0].index()] + mesh.points[t.v[1].index()] + mesh.points[t.v[2].index()]);
            return middle.x > 0.2 && middle.x < 1 && std::abs(middle.y - tangent * middle.x) < 0.02;
        });
    };
    EXPECT_GT(triangles_at_shock(with.mesh), 3 * triangles_at_shock(without.mesh));
    EXPECT_TRUE(check_mesh(with.mesh).valid());
}

TEST(SizesAtShocks, FirstHeightsFollowFrictionAndDensityOfTheWall) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    const MeshResult with = generate_mesh(geometry, options_at(0.8)), without = generate_mesh(geometry, options_at({}));
    ASSERT_EQ(with.decisions.frictions.size(), 1u);
    EXPECT_TRUE(without.decisions.frictions.empty());
    EXPECT_NEAR(with.first_heights[0], 1 / (6.5e6 * std::sqrt(0.5 * with.decisions.frictions[0])), 1e-12);
    // The gas at the wall is thinner than the free stream, and faster flow is less so at the nose.
    EXPECT_GT(with.first_heights[0], 1.05 * without.first_heights[0]);
    EXPECT_LT(with.first_heights[0], 1.5 * without.first_heights[0]);
}

TEST(SizesAtShocks, FrontsLeaveTheWallAndEnd) {
    const Geometry geometry = read_geometry(std::vector<std::string>{"naca:0012"});
    const CompressibleFlow flow = solve_compressible_flow(geometry, {.alpha_deg = 1.25, .mach = 0.8});
    const CompressibleSide& upper = flow.elements[0].upper;
    const std::vector<Point>& front = upper.shocks.at(0).front;
    ASSERT_GT(front.size(), 10u);
    EXPECT_LT(distance(front.front(), upper.shocks[0].at), 1e-12);
    for (const Point p : front) EXPECT_NEAR(p.x, front.front().x, 0.15);
    EXPECT_GT(front.back().y, 0.2);
    CompressibleFlow unsteady = flow;
    unsteady.converged = false;
    EXPECT_TRUE(pipeline::sizes_at_shocks(unsteady, 1).spacings.empty());
    EXPECT_EQ(pipeline::sizes_at_shocks(flow, 2).sources.at(0).size,
              pipeline::sizes_at_shocks(flow, 1).sources.at(0).size / 2);
}

}  // namespace
}  // namespace lamina::test
