// Sizes for a goal: flows and adjoints whose derivatives are known.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include <lamina/error.hpp>

#include "adaptation/error_norm.hpp"
#include "adaptation/fields.hpp"
#include "adaptation/goal.hpp"
#include "adaptation/wall_flow.hpp"

namespace lamina::test {
namespace {

/// The six fields of a goal, each by its formula.
struct GoalFlow {
    Formula u, v, p, adjoint_u, adjoint_v, adjoint_p;
};

Solution goal_solution(const Mesh& mesh, const GoalFlow& flow, bool at_cells) {
    Solution solution{mesh, {}};
    const std::vector<std::string> names = GoalOptions{}.fields();
    std::size_t next = 0;
    for (const Formula& formula : {flow.u, flow.v, flow.p, flow.adjoint_u, flow.adjoint_v, flow.adjoint_p}) {
        solution.fields.push_back(field_of(mesh, formula, at_cells));
        solution.fields.back().name = names[next++];
    }
    return solution;
}

double zero(Point) { return 0; }

std::vector<char> is_outer_vertex(const Mesh& mesh) {
    std::vector<char> outer(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        if (mesh.region[t] == Region::isotropic)
            for (const VertexId v : mesh.triangles[t].v) outer[v.index()] = 1;
    return outer;
}

/// By hand: the pressure is the flux of one momentum in x and of the other in y. In a flow of u = x and v = -y the
/// fluxes are x^2, -x y and y^2, and the largest eigenvalues of their Hessians 2, 1 and 2.
TEST(Goal, CurvaturesAreGradientsOfTheAdjointTimesThoseOfTheFluxes) {
    const Mesh mesh = generate_mesh(one_section(), near_options()).mesh;
    const std::vector<char> outer = is_outer_vertex(mesh);
    const auto x = [](double scale) { return [scale](Point p) { return scale * p.x; }; };
    const auto y = [](double scale) { return [scale](Point p) { return scale * p.y; }; };
    const auto squared = [](Point p) { return p.x * p.x; };
    const std::pair<GoalFlow, double> flows[] = {
        {{zero, zero, squared, x(3), zero, zero}, 6}, {{zero, zero, squared, x(3), y(-5), zero}, 16},
        {{zero, zero, squared, y(3), x(5), x(7)}, 0}, {{x(1), y(-1), zero, x(2), zero, x(9)}, 4},
        {{x(1), y(-1), zero, y(4), zero, zero}, 4},   {{squared, zero, zero, zero, zero, x(0.5)}, 1},
    };
    for (const auto& [flow, expected] : flows)
        for (const bool at_cells : {false, true}) {
            const std::vector<adaptation::Hessian> hessians =
                adaptation::goal_hessians(goal_solution(mesh, flow, at_cells), GoalOptions{});
            ASSERT_EQ(hessians.size(), mesh.points.size());
            // Products of linear fields are no values of a polynomial at the middles of cells but to rounding.
            for (std::size_t v = 0; v < hessians.size(); ++v)
                ASSERT_NEAR(adaptation::largest_curvature(hessians[v]), outer[v] != 0 ? expected : 0, 1e-3)
                    << v << " " << expected;
        }
}

/// Along a wall that is nearly straight, x is the distance along it.
TEST(Goal, CurvaturesOfWallsAreThoseAlongThem) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
        CaseOptions options = near_options();
        options.layer.topology = topology;
        const Mesh mesh = generate_mesh(one_section(), options).mesh;
        const GoalFlow flow{[](Point p) { return 1 + 0 * p.x; }, zero, [](Point p) { return p.x * p.x; },
                            [](Point p) { return 3 * p.x; },     zero, zero};
        for (const bool at_cells : {false, true}) {
            const Solution solution = goal_solution(mesh, flow, at_cells);
            const auto walls = adaptation::find_wall_flow(solution, {"U", 1e-6});
            const auto curvatures = adaptation::goal_curvatures_of_walls(solution, GoalOptions{}, walls, 0.5);
            ASSERT_EQ(curvatures.size(), 1u);
            ASSERT_EQ(curvatures[0].size(), walls[0].size());
            for (std::size_t i = 0; i < walls[0].size(); ++i) {
                const double x = walls[0][i].at.x;
                if (x > 0.2 && x < 0.8) {
                    ASSERT_NEAR(curvatures[0][i], 3, 0.3) << x;
                }
            }
        }
    }
}

TEST(Goal, SizesAreSmallWhereTheGoalNeedsThem) {
    const MeshResult first = generate_mesh(one_section(), near_options());
    // The flow bends everywhere; the adjoint does so above the section alone.
    const GoalFlow flow{[](Point) { return 1.0; },
                        zero,
                        [](Point p) { return std::sin(3 * p.x) * std::sin(3 * p.y); },
                        [](Point p) { return std::exp(-4 * ((p.x - 0.5) * (p.x - 0.5) + (p.y - 2) * (p.y - 2))); },
                        zero,
                        zero};
    SolutionSizeOptions options{.vertices = 12'000};
    options.goal.emplace();
    const SolutionSizes made = solution_sizes(goal_solution(first.mesh, flow, false), options);
    ASSERT_EQ(made.errors.size(), 1u);
    EXPECT_GT(made.errors[0], 0);
    double above = 0, below = 0;
    int count_above = 0, count_below = 0;
    for (std::size_t i = 0; i < made.sizes.points.size(); ++i) {
        const Point p = made.sizes.points[i];
        if (distance(p, {0.5, 2}) < 0.7) above += made.sizes.sizes[i], ++count_above;
        if (distance(p, {0.5, -2}) < 0.7) below += made.sizes.sizes[i], ++count_below;
    }
    EXPECT_LT(2 * above / count_above, below / count_below);
}

TEST(Goal, RefusesFieldsThatAreMissingOrElsewhere) {
    const Mesh mesh = generate_mesh(one_section(), near_options()).mesh;
    const GoalFlow flow{zero, zero, zero, zero, zero, zero};
    Solution solution = goal_solution(mesh, flow, false);
    solution.fields[3] = goal_solution(mesh, flow, true).fields[3];
    EXPECT_THROW(adaptation::goal_hessians(solution, {}), OptionError);
    solution.fields.erase(solution.fields.begin() + 3);
    EXPECT_THROW(adaptation::goal_hessians(solution, {}), OptionError);
    EXPECT_THROW(adaptation::goal_hessians(goal_solution(mesh, flow, false), {.pressure = "P"}), OptionError);
}

/// By hand for the powers 1 and 2.
TEST(ErrorNorm, MeanErrorsAreThoseOfInterpolation) {
    const adaptation::ErrorNorm one(1), two(2);
    EXPECT_NEAR(one.power_on_line(), 1.0 / 12, 1e-5);
    EXPECT_NEAR(two.power_on_line(), 1.0 / 120, 1e-6);
    EXPECT_NEAR(one.power_on_triangle(), 1.0 / 16, 1e-4);
    EXPECT_NEAR(two.power_on_triangle(), 3.375 / 720, 1e-5);
    EXPECT_NEAR(one.size(16), 0.5, 1e-15);
    EXPECT_NEAR(two.size(27), 1.0 / 3, 1e-15);
}

}  // namespace
}  // namespace lamina::test
