// Recovered second derivatives.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/error.hpp>

#include "adaptation/fields.hpp"
#include "adaptation/hessian.hpp"

namespace lamina::test {
namespace {

/// Whether vertices belong to cells beyond the layer.
std::vector<char> outer_vertices(const Mesh& mesh) {
    std::vector<char> outer(mesh.points.size(), 0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
        for (const VertexId v : mesh.triangles[t].v) outer[v.index()] |= mesh.region[t] == Region::isotropic;
    return outer;
}

TEST(Hessian, LargestCurvatureIsTheLargerEigenvalue) {
    EXPECT_DOUBLE_EQ(adaptation::largest_curvature({2, 0, -3}), 3);
    EXPECT_DOUBLE_EQ(adaptation::largest_curvature({0, 1, 0}), 1);
    EXPECT_DOUBLE_EQ(adaptation::largest_curvature({-4, 0, -1}), 4);
    EXPECT_EQ(adaptation::largest_curvature({}), 0);
    // A rotation by 30 degrees of diag(5, 1).
    EXPECT_NEAR(adaptation::largest_curvature({4, std::sqrt(3.0), 2}), 5, 1e-12);
}

TEST(Hessian, QuadraticsAreExactUpToTheBorders) {
    CaseOptions options = near_options();
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
        options.layer.topology = topology;
        const Mesh mesh = generate_mesh(one_section(), options).mesh;
        const std::vector<char> outer = outer_vertices(mesh);
        const auto quadratic = [](Point p) { return 7 - 3 * p.x + p.y + 2 * p.x * p.x - 5 * p.x * p.y - p.y * p.y; };
        for (const bool at_cells : {false, true}) {
            // The boundary layer must have no influence, whatever it holds.
            SolutionField field = field_of(mesh, quadratic, at_cells);
            for (std::size_t i = 0; i < field.values.size(); ++i)
                if (at_cells ? mesh.region[i] == Region::layer : outer[i] == 0) field.values[i] = 1e6 * double(i % 7);
            const std::vector<adaptation::Hessian> hessians = adaptation::recover_hessians(mesh, field);
            for (std::size_t v = 0; v < hessians.size(); ++v) {
                const bool is_outer = outer[v] != 0;
                ASSERT_NEAR(hessians[v].xx, is_outer ? 4 : 0, 1e-4) << v;
                ASSERT_NEAR(hessians[v].xy, is_outer ? -5 : 0, 1e-4) << v;
                ASSERT_NEAR(hessians[v].yy, is_outer ? -2 : 0, 1e-4) << v;
            }
        }
    }
}

TEST(Hessian, FieldsMustFitTheMesh) {
    const Mesh mesh = generate_mesh(one_section(), near_options()).mesh;
    SolutionField field = field_of(mesh, [](Point p) { return p.x; });
    field.values.pop_back();
    EXPECT_THROW(adaptation::recover_hessians(mesh, field), OptionError);
    field.at_cells = true;
    EXPECT_THROW(adaptation::recover_hessians(mesh, field), OptionError);
}

}  // namespace
}  // namespace lamina::test
