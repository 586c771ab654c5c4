// Compressible flow without friction against theory and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "flow/euler/euler.hpp"
#include "flow/euler/flux.hpp"
#include "flow/euler/wall_flow.hpp"
#include "flow/euler_meshes.hpp"
#include "flow/potential.hpp"

namespace lamina::test {
namespace {

using namespace flow::euler;

bool is_sound(const EulerSolution& solution) {
    for (std::size_t v = 0; v < solution.densities.size(); ++v)
        if (!(solution.densities[v] > 0 && solution.pressures[v] > 0 && std::isfinite(solution.densities[v]) &&
              std::isfinite(solution.pressures[v]) && std::isfinite(length(solution.velocities[v]))))
            return false;
    return std::isfinite(solution.lift) && std::isfinite(solution.drag) && std::isfinite(solution.residual);
}

/// The error of the total enthalpy that so many of a thousand vertices exceed.
double enthalpy_error(const EulerSolution& solution, double mach, std::size_t of_thousand) {
    const double exact = 2.5 + 0.5 * mach * mach;
    std::vector<double> errors;
    for (std::size_t v = 0; v < solution.densities.size(); ++v) {
        const Four state{solution.densities[v], solution.velocities[v].x, solution.velocities[v].y,
                         solution.pressures[v]};
        errors.push_back(std::abs(total_enthalpy(state) / exact - 1));
    }
    std::sort(errors.begin(), errors.end());
    return errors[errors.size() - 1 - errors.size() * of_thousand / 1000];
}

TEST(Euler, FluxesAreConsistent) {
    for (const Four& state : {Four{1, 0.5, 0.1, 0.7}, Four{0.7, -2, 1, 0.3}, Four{1.2, 0, 0, 2}}) {
        const Point normal{0.3, -0.8};
        const Four exact = flux_of(state, normal), flux = hllc_flux(state, state, normal);
        for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(flux[m], exact[m], 1e-14);
        const Matrix4 jacobian = flux_jacobian(state, normal);
        const Four conserved = conserved_of(state);
        for (std::size_t j = 0; j < 4; ++j) {
            constexpr double step = 1e-6;
            Four up = conserved, down = conserved;
            up[j] += step;
            down[j] -= step;
            const Four change = flux_of(state_of(up), normal) - flux_of(state_of(down), normal);
            for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(jacobian[4 * i + j], change[i] / (2 * step), 1e-8);
        }
    }
}

TEST(Euler, AStationaryShockStaysOneFace) {
    // Rankine and Hugoniot at Mach 2: the density rises by 8 / 3, the pressure by 4.5.
    const Four ahead{1, 2, 0, 1 / 1.4}, behind{8.0 / 3, 0.75, 0, 4.5 / 1.4};
    const Four flux = hllc_flux(ahead, behind, {1, 0}), exact = flux_of(ahead, {1, 0});
    for (std::size_t m = 0; m < 4; ++m) EXPECT_NEAR(flux[m], exact[m], 1e-14);
}

TEST(Euler, TheFreeStreamStays) {
    SectionMesh mesh;
    constexpr std::size_t n = 12;
    const auto vertex = [&](std::size_t i, std::size_t j) { return VertexId(j * n + i); };
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const auto x = static_cast<double>(i), y = static_cast<double>(j);
            mesh.points.push_back({x + 0.3 * std::sin(7 * y), y + 0.2 * std::cos(5 * x)});
        }
    for (std::size_t j = 0; j + 1 < n; ++j)
        for (std::size_t i = 0; i + 1 < n; ++i) {
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)}});
            mesh.triangles.push_back({{vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)}});
        }
    for (std::size_t k = 0; k + 1 < n; ++k) {
        mesh.far.push_back({vertex(k, 0), vertex(k + 1, 0)});
        mesh.far.push_back({vertex(n - 1, k), vertex(n - 1, k + 1)});
        mesh.far.push_back({vertex(k + 1, n - 1), vertex(k, n - 1)});
        mesh.far.push_back({vertex(0, k + 1), vertex(0, k)});
    }
    for (const double mach : {0.3, 0.9, 2.5}) {
        const EulerSolution flow =
            solve_euler({mesh.points, mesh.triangles, {}, mesh.far}, {.mach = mach, .alpha_deg = 7});
        EXPECT_TRUE(flow.converged);
        for (std::size_t v = 0; v < mesh.points.size(); ++v) {
            EXPECT_NEAR(flow.densities[v], 1, 1e-12);
            EXPECT_NEAR(length(flow.velocities[v]), mach, 1e-12);
            EXPECT_NEAR(flow.pressures[v], 1 / 1.4, 1e-12);
        }
    }
}

TEST(Euler, SymmetryIsKept) {
    const SectionMesh mesh = mesh_round(naca_0012(), 64, 30, 2);
    const EulerSolution level = solve_euler(mesh.view(), {.mach = 0.8});
    ASSERT_TRUE(level.converged);
    EXPECT_NEAR(level.lift, 0, 1e-3);
    EXPECT_GT(level.drag, 0.003);
    const EulerSolution up = solve_euler(mesh.view(), {.mach = 0.75, .alpha_deg = 2}),
                        down = solve_euler(mesh.view(), {.mach = 0.75, .alpha_deg = -2});
    ASSERT_TRUE(up.converged && down.converged);
    EXPECT_GT(up.lift, 0.2);
    EXPECT_NEAR(up.lift, -down.lift, 3e-3 * up.lift);
    EXPECT_NEAR(up.drag, down.drag, 3e-3 * up.drag + 1e-4);
}

// Solutions on fine grids (AGARD AR-211, 1985, and later ones) have lift coefficients of 0.35 to 0.36, a drag
// coefficient of about 0.0227, and shocks near 0.62 to 0.63 of the chord above and 0.35 below. With edges of 0.02
// chords at the shock, this mesh has 0.003 too much drag, and the position of the shock is good to half an edge.
TEST(Euler, HasThePublishedLiftDragAndShocksOfNaca0012) {
    const SectionMesh mesh = mesh_round(naca_0012(), 144, 50, 3);
    const EulerOptions options{.mach = 0.8, .alpha_deg = 1.25};
    const EulerSolution flow = solve_euler(mesh.view(), options);
    ASSERT_TRUE(flow.converged);
    EXPECT_NEAR(flow.lift, 0.355, 0.02);
    EXPECT_NEAR(flow.drag, 0.0227, 0.004);
    const CompressibleElement element = wall_flows(mesh.view(), flow, options)[0];
    ASSERT_EQ(element.upper.shocks.size(), 1u);
    EXPECT_NEAR(element.upper.shocks[0].position, 0.625, 0.025);
    EXPECT_NEAR(element.upper.shocks[0].mach_ahead, 1.4, 0.05);
    EXPECT_LT(element.upper.shocks[0].mach_behind, 0.85);
    ASSERT_LE(element.lower.shocks.size(), 1u);
    for (const WallShock& shock : element.lower.shocks) EXPECT_NEAR(shock.position, 0.34, 0.03);
    EXPECT_LT(enthalpy_error(flow, options.mach, 10), 0.01);
    EXPECT_EQ(element.upper.points.front().at, element.lower.points.front().at);
    EXPECT_EQ(element.upper.points.back().at, element.lower.points.back().at);
}

TEST(Euler, HasTheExactObliqueShocksOfADiamond) {
    // 5 degrees at Mach 2: shock angle 34.302 degrees, pressure ratio 1.3154 (Rankine and Hugoniot).
    constexpr double exact_angle = 34.302, exact_ratio = 1.3154;
    const SectionMesh mesh = mesh_round(diamond(5 * shapes::full_turn / 360), 160, 3);
    const EulerOptions options{.mach = 2};
    const EulerSolution flow = solve_euler(mesh.view(), options);
    ASSERT_TRUE(flow.converged);
    const CompressibleElement element = wall_flows(mesh.view(), flow, options)[0];
    for (const auto& point : element.upper.points) {
        if (point.at.x < 0.1 || point.at.x > 0.4) continue;
        EXPECT_NEAR(1 + 0.7 * 4 * point.pressure_coefficient, exact_ratio, 0.01 * exact_ratio) << point.at.x;
    }
    const double middle = (1 + exact_ratio) / (2 * 1.4);
    double sum = 0, count = 0;
    for (const Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = t.v[k].index(), b = t.v[(k + 1) % 3].index();
            if (!(flow.pressures[a] < middle && flow.pressures[b] >= middle)) continue;
            const double share = (middle - flow.pressures[a]) / (flow.pressures[b] - flow.pressures[a]);
            const Point at = mesh.points[a] + share * (mesh.points[b] - mesh.points[a]);
            // The pressure passes the middle in the expansion of the shoulder, too, which lies further back.
            if (at.y < 0.25 || at.y > 0.6 || at.x > 1.8 * at.y) continue;
            sum += std::atan2(at.y, at.x);
            ++count;
        }
    ASSERT_GT(count, 10);
    EXPECT_NEAR(sum / count * 360 / shapes::full_turn, exact_angle, 1);
}

TEST(Euler, ConvergesFromSubsonicToSupersonicSpeeds) {
    const std::array sections{naca_0012(), blunt_0012(), cambered(), diamond(5 * shapes::full_turn / 360)};
    for (std::size_t s = 0; s < sections.size(); ++s) {
        const SectionMesh mesh = mesh_round(sections[s], 64, 20, 2);
        for (const double mach : {0.5, 0.75, 0.85, 1.0, 1.3, 2.5}) {
            const EulerSolution flow = solve_euler(mesh.view(), {.mach = mach, .alpha_deg = 2});
            EXPECT_TRUE(is_sound(flow)) << s << ' ' << mach;
            EXPECT_TRUE(flow.converged) << s << ' ' << mach << ' ' << flow.residual;
            EXPECT_GT(flow.lift, 0) << s << ' ' << mach;
        }
    }
}

TEST(Euler, BowShocksSettleInFewSteps) {
    for (const auto& section : {naca_0012(), cambered()}) {
        const SectionMesh mesh = mesh_round(section, 144, 30, 3);
        for (const double mach : {1.2, 2.0, 2.5}) {
            const EulerSolution flow = solve_euler(mesh.view(), {.mach = mach, .alpha_deg = 2});
            EXPECT_TRUE(flow.converged) << mach;
            EXPECT_LT(flow.iterations, 60) << mach;
        }
    }
}

TEST(Euler, SaysWhereItIsNotSteady) {
    const SectionMesh mesh = mesh_round(naca_0012(), 32, 10, 2);
    const EulerSolution flow = solve_euler(mesh.view(), {.mach = 0.8, .alpha_deg = 2, .max_iterations = 15});
    EXPECT_FALSE(flow.converged);
    EXPECT_EQ(flow.iterations, 15);
    EXPECT_TRUE(is_sound(flow));
    // No steady flow is known here; all numbers stay finite.
    EXPECT_TRUE(is_sound(solve_euler(mesh.view(), {.mach = 0.8, .alpha_deg = 80})));
    EXPECT_TRUE(is_sound(solve_euler(mesh.view(), {.mach = 10, .alpha_deg = 30})));
    for (const double mach : {0.0, -1.0, 11.0, std::nan("")})
        EXPECT_THROW(solve_euler(mesh.view(), {.mach = mach}), OptionError);
}

TEST(Euler, DoesNotDependOnTheNumberOfThreads) {
    const SectionMesh mesh = mesh_round(cambered(), 48, 20, 2);
    EulerSolution one;
    with_threads(1, [&] { one = solve_euler(mesh.view(), {.mach = 0.8, .alpha_deg = 1}); });
    for (const unsigned threads : {2u, 5u})
        with_threads(threads, [&] {
            const EulerSolution other = solve_euler(mesh.view(), {.mach = 0.8, .alpha_deg = 1});
            EXPECT_EQ(other.densities, one.densities);
            EXPECT_EQ(other.pressures, one.pressures);
            EXPECT_EQ(other.lift, one.lift);
        });
}

TEST(Euler, RefusesVerticesApart) {
    SectionMesh mesh = mesh_round(naca_0012(), 32, 10, 2);
    mesh.points.push_back({100, 100});
    EXPECT_THROW(solve_euler(mesh.view(), {.mach = 0.8}), MeshError);
}

TEST(Euler, PressuresOfSubsonicFlow) {
    EXPECT_NEAR(critical_pressure_coefficient(0.8), -0.4346, 1e-4);
    EXPECT_NEAR(critical_pressure_coefficient(1), 0, 1e-15);
    EXPECT_EQ(flow::compressed_pressure_coefficient(-0.5, 0), -0.5);
    EXPECT_NEAR(flow::compressed_pressure_coefficient(-0.1, 0.6), -0.1 / (0.8 - 0.01), 1e-12);
    EXPECT_LT(flow::compressed_pressure_coefficient(-1e3, 0.8), -1e3);
}

TEST(Euler, FindsShocksAndNoGentleSlopes) {
    std::vector<CompressibleWallPoint> side;
    for (int k = 0; k <= 100; ++k) side.push_back({{0.01 * k, 0}, 0, 1.04 - 0.001 * k});
    EXPECT_TRUE(find_shocks(side, 0, 1).empty());
    for (int k = 0; k <= 100; ++k) side[static_cast<std::size_t>(k)].mach = k <= 60 ? 1.2 : 0.8;
    const std::vector<WallShock> shocks = find_shocks(side, 0, 1);
    ASSERT_EQ(shocks.size(), 1u);
    EXPECT_NEAR(shocks[0].position, 0.605, 1e-9);
    EXPECT_EQ(shocks[0].mach_ahead, 1.2);
    EXPECT_EQ(shocks[0].mach_behind, 0.8);
}

}  // namespace
}  // namespace lamina::test
