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

TEST(Hessian, AbsoluteValuesSquareToTheSameAndArePositive) {
    for (const adaptation::Hessian h :
         {adaptation::Hessian{2, 1, -3}, {-4, 0.5, -1}, {3, 0, 3}, {0, 2, 0}, {1, 1, 1}, {0, 0, 0}, {-1e-9, 3, 1e9}}) {
        const adaptation::Hessian a = adaptation::absolute(h);
        const double scale = h.xx * h.xx + h.yy * h.yy + h.xy * h.xy;
        EXPECT_NEAR(a.xx * a.xx + a.xy * a.xy, h.xx * h.xx + h.xy * h.xy, 1e-14 * scale);
        EXPECT_NEAR(a.xy * (a.xx + a.yy), h.xy * (h.xx + h.yy), 1e-14 * scale);
        EXPECT_NEAR(a.yy * a.yy + a.xy * a.xy, h.yy * h.yy + h.xy * h.xy, 1e-14 * scale);
        EXPECT_GE(a.xx + a.yy, 0);
        EXPECT_GE(a.xx * a.yy - a.xy * a.xy, -1e-14 * scale);
    }
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
            const auto derivatives = adaptation::recover_derivatives(mesh, field);
            for (std::size_t v = 0; v < derivatives.size(); ++v) {
                const double is_outer = outer[v] != 0 ? 1 : 0;
                const Point p = mesh.points[v];
                const auto& [gradient, hessian] = derivatives[v];
                ASSERT_NEAR(gradient.x, is_outer * (-3 + 4 * p.x - 5 * p.y), 1e-4) << v;
                ASSERT_NEAR(gradient.y, is_outer * (1 - 5 * p.x - 2 * p.y), 1e-4) << v;
                ASSERT_NEAR(hessian.xx, is_outer * 4, 1e-4) << v;
                ASSERT_NEAR(hessian.xy, is_outer * -5, 1e-4) << v;
                ASSERT_NEAR(hessian.yy, is_outer * -2, 1e-4) << v;
            }
        }
    }
}

TEST(Hessian, FieldsMustFitTheMesh) {
    const Mesh mesh = generate_mesh(one_section(), near_options()).mesh;
    SolutionField field = field_of(mesh, [](Point p) { return p.x; });
    field.values.pop_back();
    EXPECT_THROW(adaptation::recover_derivatives(mesh, field), OptionError);
    field.at_cells = true;
    EXPECT_THROW(adaptation::recover_derivatives(mesh, field), OptionError);
}

}  // namespace
}  // namespace lamina::test
