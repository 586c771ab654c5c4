// Compressible flow on meshes that are made for it.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/compressible_flow.hpp>
#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "pipeline/cases.hpp"

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

}  // namespace
}  // namespace lamina::test
