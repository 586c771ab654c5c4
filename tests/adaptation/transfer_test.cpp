// The flow of one mesh on another one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>
#include <lamina/transfer.hpp>

#include "adaptation/fields.hpp"

namespace lamina::test {
namespace {

double linear(Point p) { return 3 + 2 * p.x - 5 * p.y; }

/// A mesh of one square cut into n x n squares, each a quad in the lower half and two triangles in the upper one.
Mesh square(std::size_t n) {
    Mesh mesh;
    for (std::size_t j = 0; j <= n; ++j)
        for (std::size_t i = 0; i <= n; ++i)
            mesh.points.push_back({double(i) / double(n), std::pow(double(j) / double(n), 2)});
    const auto vertex = [&](std::size_t i, std::size_t j) { return VertexId(j * (n + 1) + i); };
    for (std::size_t j = 0; j < n; ++j)
        for (std::size_t i = 0; i < n; ++i) {
            const VertexId a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
            if (2 * j < n) {
                mesh.quads.push_back({{a, b, c, d}});
            } else {
                mesh.triangles.push_back({{a, b, c}});
                mesh.triangles.push_back({{a, c, d}});
            }
        }
    return mesh;
}

Mesh section_mesh(double wall_spacing) {
    CaseOptions options = near_options();
    options.layer.topology = LayerTopology::quads;
    options.surface.max_spacing = wall_spacing;
    return generate_mesh(one_section(), options).mesh;
}

TEST(Transfer, LinearFieldsStayAsTheyAre) {
    const Mesh from = square(7), to = square(12);
    for (const bool at_cells : {false, true}) {
        const auto fields = transfer({from, {field_of(from, linear, at_cells)}}, to);
        const SolutionField expected = field_of(to, linear, at_cells);
        ASSERT_EQ(fields.size(), 1u);
        EXPECT_EQ(fields[0].at_cells, at_cells);
        ASSERT_EQ(fields[0].values.size(), expected.values.size());
        for (std::size_t i = 0; i < expected.values.size(); ++i)
            EXPECT_NEAR(fields[0].values[i], expected.values[i], 1e-12) << (at_cells ? "cell " : "vertex ") << i;
    }
}

TEST(Transfer, TheSameMeshKeepsEveryValue) {
    const Mesh mesh = section_mesh(0.05);
    const Formula formula = [](Point p) { return std::sin(3 * p.x) * std::cos(2 * p.y); };
    for (const bool at_cells : {false, true}) {
        const SolutionField field = field_of(mesh, formula, at_cells);
        const auto fields = transfer({mesh, {field}}, mesh);
        for (std::size_t i = 0; i < field.values.size(); ++i) EXPECT_NEAR(fields[0].values[i], field.values[i], 1e-9);
    }
}

TEST(Transfer, KeepsSigns) {
    const Mesh from = square(9), to = square(14);
    const Formula steep = [](Point p) { return p.x > 0.5 ? 1.0 : 1e-9; };
    const Formula bump = [](Point p) { return std::max(0.0, 1 - 30 * std::abs(p.x - 0.5)); };
    for (const bool at_cells : {false, true}) {
        const auto fields = transfer({from, {field_of(from, steep, at_cells), field_of(from, bump, at_cells)}}, to);
        EXPECT_GT(*std::min_element(fields[0].values.begin(), fields[0].values.end()), 0);
        EXPECT_GE(*std::min_element(fields[1].values.begin(), fields[1].values.end()), 0);
    }
}

TEST(Transfer, ABoundaryLayerStaysOnAWallThatIsDividedOtherwise) {
    const Mesh from = section_mesh(0.06), to = section_mesh(0.02);
    const auto profile = [](const Mesh& mesh) {
        SolutionField field{"u", false, wall_distances(mesh)};
        for (double& value : field.values) value = std::tanh(value / 1e-3);
        return field;
    };
    const SolutionField expected = profile(to);
    const auto fields = transfer({from, {profile(from)}}, to);
    double worst = 0;
    for (std::size_t i = 0; i < expected.values.size(); ++i)
        worst = std::max(worst, std::abs(fields[0].values[i] - expected.values[i]));
    EXPECT_LT(worst, 0.05);
    for (const Marker& marker : to.markers) {
        if (marker.kind != MarkerKind::wall) continue;
        for (const Segment& edge : marker.edges) EXPECT_LT(fields[0].values[edge.a.index()], 1e-6);
    }
}

TEST(Transfer, RefusesFieldsOfAnotherMesh) {
    const Mesh from = square(4);
    EXPECT_THROW(transfer({from, {{"p", false, {1, 2, 3}}}}, from), OptionError);
    EXPECT_THROW(transfer({from, {{"p", true, {1, 2, 3}}}}, from), OptionError);
}

}  // namespace
}  // namespace lamina::test
