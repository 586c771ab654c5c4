// Sizes from solutions: their places, the number of vertices of the next mesh, and the error in it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <lamina/error.hpp>

#include "adaptation/fields.hpp"

namespace lamina::test {
namespace {

/// A front along x + y = 1 that is about 0.2 wide.
double front(Point p) { return std::tanh(10 * (p.x + p.y - 1)); }

/// A wake that a lifting section leaves: a valley that widens, and the disturbance round the section.
double wake(Point p) {
    const double along = std::max(p.x - 1, 0.0), width = 0.03 + 0.05 * along;
    const double valley = p.x > 1 ? std::exp(-p.y * p.y / (width * width)) : 0.0;
    return -0.5 * valley * std::sqrt(0.03 / width) + 0.1 / (0.3 + (p.x - 0.3) * (p.x - 0.3) + p.y * p.y);
}

Solution solution_on(const Mesh& mesh, const std::vector<Formula>& formulas, bool at_cells = false) {
    Solution solution{mesh, {}};
    for (const Formula& formula : formulas) solution.fields.push_back(field_of(mesh, formula, at_cells));
    return solution;
}

MeshResult next_mesh(const Geometry& geometry, CaseOptions options, const SizedMesh& sizes) {
    options.sizing.background = std::make_shared<const SizedMesh>(sizes);
    MeshResult result = generate_mesh(geometry, options);
    EXPECT_EQ(check_mesh(result.mesh).defect_count, 0u);
    EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
    return result;
}

/// The root of the integral of the squared error of linear interpolation over the isotropic triangles, by the middles
/// of their edges.
double interpolation_error(const Mesh& mesh, const Formula& formula) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.region[t] != Region::isotropic) continue;
        const auto corner = [&](int i) { return mesh.points[mesh.triangles[t].v[i % 3].index()]; };
        const double area = 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
        for (int i = 0; i < 3; ++i) {
            const Point a = corner(i), b = corner(i + 1);
            const double error = 0.5 * (formula(a) + formula(b)) - formula(midpoint(a, b));
            sum += area / 3 * error * error;
        }
    }
    return std::sqrt(sum);
}

TEST(SolutionSizes, AFrontGetsSmallTriangles) {
    const MeshResult first = generate_mesh(one_section(), near_options());
    const SolutionSizes made = solution_sizes(solution_on(first.mesh, {front}), {.vertices = 12'000});
    double on_front = 0, away = 0, count_on_front = 0, count_away = 0;
    for (std::size_t i = 0; i < made.sizes.points.size(); ++i) {
        const Point p = made.sizes.points[i];
        if (p.y < 1 || p.y > 3) continue;
        if (std::abs(p.x + p.y - 1) < 0.1) {
            on_front += made.sizes.sizes[i];
            ++count_on_front;
        } else if (std::abs(p.x + p.y - 1) > 1) {
            away += made.sizes.sizes[i];
            ++count_away;
        }
    }
    ASSERT_GT(count_on_front, 0);
    EXPECT_LT(3 * on_front / count_on_front, away / count_away);
}

/// Where second derivatives are 10 times as large, sizes are smaller by 10^(p / (2 p + 2)).
TEST(SolutionSizes, LargerNormsSeeLargeErrorsMore) {
    const MeshResult first = generate_mesh(one_section(), near_options());
    const Point strong{0.5, 2}, weak{0.5, -2};
    const auto hill = [](Point p) { return std::exp(-2 * squared_length(p)); };
    const Solution solution =
        solution_on(first.mesh, {[&](Point p) { return 10 * hill(p - strong) + hill(p - weak); }});
    for (const double norm : {1.0, 2.0, 5.0}) {
        const SizedMesh sizes = solution_sizes(solution, {.vertices = 12'000, .norm = norm, .max_change = 20}).sizes;
        const auto mean_near = [&](Point middle) {
            double sum = 0, count = 0;
            for (std::size_t i = 0; i < sizes.points.size(); ++i) {
                if (distance(sizes.points[i], middle) > 0.3) continue;
                sum += sizes.sizes[i];
                ++count;
            }
            return sum / count;
        };
        const double ratio = std::pow(10, norm / (2 * norm + 2));
        EXPECT_NEAR(mean_near(weak) / mean_near(strong), ratio, 0.1 * ratio) << norm;
    }
}

TEST(SolutionSizes, TheNextMeshHasTheNumberOfVerticesAskedFor) {
    CaseOptions guided = near_options();
    guided.conditions = {.alpha_deg = 4, .reynolds = 1e6};
    guided.layer.first_height = YPlus{2};
    guided.layer.layers.reset();
    guided.use_flow = true;
    const std::pair<Geometry, CaseOptions> cases[] = {
        {one_section(), near_options()},
        {shapes::geometry({naca_airfoil("2412", 300).points,
                           shapes::moved(naca_airfoil("0012", 300).points, -0.4, 0.3, {0.98, -0.03})}),
         guided}};
    for (const auto& [geometry, options] : cases) {
        const MeshResult first = generate_mesh(geometry, options);
        const auto vertices = static_cast<double>(first.mesh.points.size());
        for (const double share : geometry.elements.size() == 1 ? std::vector{0.85, 1.5} : std::vector{1.3}) {
            SCOPED_TRACE(testing::Message() << geometry.elements.size() << " elements, " << share);
            const SolutionSizes made = solution_sizes(solution_on(first.mesh, {wake}), {.vertices = share * vertices});
            const MeshResult second = next_mesh(geometry, options, made.sizes);
            EXPECT_NEAR(double(second.mesh.points.size()), share * vertices, 0.04 * share * vertices);
        }
    }
}

TEST(SolutionSizes, RegionsAreEstimatedWhereTheSolutionHasNone) {
    CaseOptions options = near_options();
    options.layer.topology = LayerTopology::quads;
    const MeshResult first = generate_mesh(one_section(), options);
    Solution solution = solution_on(first.mesh, {wake}, true);
    solution.mesh.region.clear();
    solution.mesh.markers.clear();
    const double vertices = 1.2 * static_cast<double>(first.mesh.points.size());
    const MeshResult second = next_mesh(one_section(), options, solution_sizes(solution, {.vertices = vertices}).sizes);
    EXPECT_NEAR(double(second.mesh.points.size()), vertices, 0.05 * vertices);
}

TEST(SolutionSizes, ACaseThatIsMeshedGivesTheNumberNearlyExactly) {
    const Geometry geometry = one_section();
    const CaseOptions options = near_options();
    const MeshResult first = generate_mesh(geometry, options);
    const VertexCount count = [&](const SizedMesh& sizes) {
        return next_mesh(geometry, options, sizes).mesh.points.size();
    };
    const SolutionSizes made = solution_sizes(solution_on(first.mesh, {wake}),
                                              {.vertices = 15'000, .max_change = 8, .keep_borders = false}, count);
    EXPECT_NEAR(double(count(made.sizes)), 15'000, 0.02 * 15'000);
    EXPECT_EQ(count(made.sizes), made.vertices);
}

TEST(SolutionSizes, RoundsOfTheLoopLowerTheErrorAtEqualNumbers) {
    const Geometry geometry = one_section();
    for (const bool at_cells : {false, true}) {
        const Formula formula = at_cells ? Formula(wake) : Formula(front);
        const double gain = at_cells ? 0.8 : 0.5;
        const CaseOptions options = near_options();
        MeshResult mesh = generate_mesh(geometry, options);
        const auto vertices = static_cast<double>(mesh.mesh.points.size());
        const double error = interpolation_error(mesh.mesh, formula);
        double before = error;
        for (int round = 0; round < 2; ++round) {
            const SolutionSizes made =
                solution_sizes(solution_on(mesh.mesh, {formula}, at_cells), {.vertices = vertices});
            mesh = next_mesh(geometry, options, made.sizes);
            EXPECT_NEAR(double(mesh.mesh.points.size()), vertices, 0.05 * vertices);
            const double after = interpolation_error(mesh.mesh, formula);
            EXPECT_LT(after, 1.05 * before) << "round " << round;
            before = after;
        }
        EXPECT_LT(before, gain * error);
    }
}

TEST(SolutionSizes, TheErrorIsEstimatedWhereTheMeshResolvesTheField) {
    const auto ridges = [](Point p) { return std::sin(2 * p.x + p.y); };
    CaseOptions options = near_options();
    options.sizing.far_size = 0.3;
    const MeshResult mesh = generate_mesh(one_section(), options);
    const SolutionSizes made = solution_sizes(solution_on(mesh.mesh, {ridges, front}),
                                              {.vertices = 1.3 * static_cast<double>(mesh.mesh.points.size())});
    ASSERT_EQ(made.errors.size(), 2u);
    const double error = interpolation_error(mesh.mesh, ridges);
    EXPECT_NEAR(made.errors[0], error, 0.3 * error);
}

TEST(SolutionSizes, UnitsOfFieldsDoNotMatter) {
    const MeshResult first = generate_mesh(one_section(), near_options());
    const SolutionSizeOptions options{.vertices = 12'000};
    const SolutionSizes one = solution_sizes(solution_on(first.mesh, {front, wake}), options),
                        other = solution_sizes(solution_on(first.mesh, {[](Point p) { return 1024 * front(p); },
                                                                        [](Point p) { return 3 + 0.25 * wake(p); }}),
                                               options);
    ASSERT_EQ(one.sizes.sizes.size(), other.sizes.sizes.size());
    for (std::size_t i = 0; i < one.sizes.sizes.size(); ++i)
        ASSERT_NEAR(other.sizes.sizes[i], one.sizes.sizes[i], 1e-3 * one.sizes.sizes[i]);
}

// The next mesh divides such layers and periodic borders anew, and has more vertices for that: the more the coarser it
// is.
TEST(SolutionSizes, LayersOnTheBorderOfTheDomainStay) {
    CaseOptions coarse = near_options();
    coarse.sizing.gradation = 0.25;
    coarse.layer.layers = 8;
    CaseOptions ground = coarse, half = coarse, row = coarse;
    ground.far_field.ground = Length{0.2};
    ground.far_field.ground_wall = OuterWallKind::no_slip;
    half.far_field.symmetry = 0;
    row.far_field.pitch = Length{1};
    for (const CaseOptions& options : {ground, half, row}) {
        const MeshResult first = generate_mesh(one_section(), options);
        const double wanted = 1.2 * static_cast<double>(first.mesh.points.size());
        const SolutionSizes made = solution_sizes(solution_on(first.mesh, {wake}), {.vertices = wanted});
        EXPECT_NEAR(static_cast<double>(made.vertices), wanted, 0.02 * wanted);
        const MeshResult next = next_mesh(one_section(), options, made.sizes);
        EXPECT_GT(static_cast<double>(next.mesh.points.size()), 0.95 * wanted);
        EXPECT_LT(static_cast<double>(next.mesh.points.size()), 1.3 * wanted);
    }
}

TEST(SolutionSizes, RefusesWhatCannotBe) {
    const MeshResult first = generate_mesh(one_section(), near_options());
    const Solution solution = solution_on(first.mesh, {front});
    EXPECT_THROW(solution_sizes(solution, {.vertices = 3000}), OptionError);
    EXPECT_THROW(solution_sizes(solution, {.vertices = 12'000, .gradation = 0}), OptionError);
    EXPECT_THROW(solution_sizes(solution, {.vertices = 12'000, .norm = 0.5}), OptionError);
    EXPECT_THROW(solution_sizes({first.mesh, {}}, {.vertices = 12'000}), OptionError);
    EXPECT_THROW(solution_sizes(solution_on(first.mesh, {[](Point) { return 3.0; }}), {.vertices = 12'000}),
                 OptionError);
}

}  // namespace
}  // namespace lamina::test
