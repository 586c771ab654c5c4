// Stretched meshes from solutions: their shape, what stays, the number of vertices, and the error in them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/solution_metric.hpp>
#include <lamina/transfer.hpp>

#include "adaptation/fields.hpp"

namespace lamina::test {
namespace {

/// A shock above the section, and the disturbance round it.
double shock(Point p) {
    return std::tanh(40 * (p.x - 0.6 - 0.2 * p.y)) * std::exp(-p.y * p.y) + 0.1 / (0.3 + squared_length(p));
}

Mesh section_mesh() { return generate_mesh(one_section(), near_options()).mesh; }

Solution shocked(const Mesh& mesh, bool at_cells = false) { return {mesh, {field_of(mesh, shock, at_cells)}}; }

/// The root of the mean square of the errors of linear interpolation, at the middles of edges beyond the layer.
double error_beyond_layer(const Mesh& mesh) {
    double sum = 0, area = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.region[t] != Region::isotropic) continue;
        const auto corner = [&](int i) { return mesh.points[mesh.triangles[t].v[i % 3].index()]; };
        const double twice_area = cross(corner(1) - corner(0), corner(2) - corner(0));
        area += twice_area;
        for (int i = 0; i < 3; ++i) {
            const double error =
                0.5 * (shock(corner(i)) + shock(corner(i + 1))) - shock(midpoint(corner(i), corner(i + 1)));
            sum += twice_area / 3 * error * error;
        }
    }
    return std::sqrt(sum / area);
}

/// The corners of the cells of the layer.
std::multiset<std::array<double, 6>> layer_cells(const Mesh& mesh) {
    std::multiset<std::array<double, 6>> cells;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.region[t] != Region::layer) continue;
        const auto corner = [&](int i) { return mesh.points[mesh.triangles[t].v[i].index()]; };
        cells.insert({corner(0).x, corner(0).y, corner(1).x, corner(1).y, corner(2).x, corner(2).y});
    }
    return cells;
}

TEST(SolutionMetric, MeshesAreValidHaveTheNumberOfVerticesAndKeepTheLayer) {
    const Mesh first = section_mesh();
    const auto vertices = static_cast<double>(first.points.size());
    for (const bool at_cells : {false, true})
        for (const double ratio : {1.0, 4.0, 1000.0}) {
            SCOPED_TRACE(testing::Message() << at_cells << " " << ratio);
            const double wanted = (at_cells ? 0.9 : 1.2) * vertices;
            const SolutionSizeOptions options{.vertices = wanted};
            const Solution solution = shocked(first, at_cells);
            const RemeshedMesh made = remesh_to_solution(first, solution, options, ratio);
            EXPECT_EQ(check_mesh(made.mesh).defect_count, 0u);
            EXPECT_NEAR(static_cast<double>(made.mesh.points.size()), wanted, 0.02 * wanted);
            EXPECT_EQ(layer_cells(made.mesh), layer_cells(first));
            EXPECT_EQ(mesh_hash(remesh_to_solution(first, solution, options, ratio).mesh), mesh_hash(made.mesh));
        }
}

TEST(SolutionMetric, StretchedTrianglesLowerTheErrorRoundByRound) {
    const Mesh first = section_mesh();
    const SolutionSizeOptions options{.vertices = static_cast<double>(first.points.size())};
    const auto after_rounds = [&](double ratio) {
        Mesh mesh = first;
        for (int round = 0; round < 3; ++round) mesh = remesh_to_solution(first, shocked(mesh), options, ratio).mesh;
        return error_beyond_layer(mesh);
    };
    const double isotropic = after_rounds(1), stretched = after_rounds(1000);
    EXPECT_LT(isotropic, 0.5 * error_beyond_layer(first));
    EXPECT_LT(stretched, 0.6 * isotropic);
}

/// The mesh of the solution may have another layer than that which is remeshed.
TEST(SolutionMetric, SolutionsOnOtherMeshesCount) {
    CaseOptions options = near_options();
    options.layer.layers = 12;
    const Mesh first = section_mesh(), other = generate_mesh(one_section(), options).mesh;
    const SolutionSizeOptions sizes{.vertices = static_cast<double>(first.points.size())};
    const RemeshedMesh made = remesh_to_solution(first, shocked(other), sizes, 100);
    EXPECT_EQ(check_mesh(made.mesh).defect_count, 0u);
    EXPECT_LT(error_beyond_layer(made.mesh), error_beyond_layer(first));
}

TEST(SolutionMetric, SolutionsGoOnToStretchedMeshes) {
    const Mesh first = section_mesh();
    const SolutionSizeOptions options{.vertices = static_cast<double>(first.points.size())};
    const Mesh next = remesh_to_solution(first, shocked(first), options, 1000).mesh;
    const auto plane = [](Point p) { return 3 + p.x - 2 * p.y; };
    for (const bool at_cells : {false, true}) {
        const std::vector<double> expected = field_of(first, plane, at_cells).values;
        const Solution on_next{next, {field_of(next, plane, at_cells)}};
        const std::vector<double> carried = transfer(on_next, first).front().values;
        for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(carried[i], expected[i], 1e-9) << at_cells << i;
    }
}

TEST(SolutionMetric, LinearFieldsAndBadOptionsAreRefused) {
    const Mesh mesh = section_mesh();
    const Solution linear{mesh, {field_of(mesh, [](Point p) { return p.x; })}};
    EXPECT_THROW(remesh_to_solution(mesh, linear, {.vertices = 5000}, 10), OptionError);
    EXPECT_THROW(remesh_to_solution(mesh, {mesh, {}}, {.vertices = 5000}, 10), OptionError);
    EXPECT_THROW(remesh_to_solution(mesh, shocked(mesh), {.vertices = 5000}, 0.5), OptionError);
    EXPECT_THROW(remesh_to_solution(mesh, shocked(mesh), {.vertices = 100}, 10), OptionError);
}

}  // namespace
}  // namespace lamina::test
