// The far field as inlet and outlet.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>

#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

TEST(InletOutlet, EachEdgeIsWhereTheFlowEntersOrNot) {
    for (const double alpha : {0.0, 30.0, -75.0, 90.0}) {
        Mesh mesh = test::annulus({.around = 60});
        const std::size_t edges = mesh.markers[1].edges.size();
        split_far_field(mesh, alpha);
        EXPECT_TRUE(check_mesh(mesh).valid());
        ASSERT_EQ(mesh.markers.size(), 3u);
        EXPECT_EQ(mesh.markers[0].name, "wall");
        EXPECT_EQ(mesh.markers[1].name, "inlet");
        EXPECT_EQ(mesh.markers[2].name, "outlet");
        EXPECT_EQ(mesh.markers[1].edges.size() + mesh.markers[2].edges.size(), edges);
        const double radians = alpha * std::numbers::pi / 180;
        const Point flow{std::cos(radians), std::sin(radians)};
        for (const std::size_t m : {1u, 2u}) {
            EXPECT_EQ(mesh.markers[m].kind, MarkerKind::far_field);
            for (const Segment& edge : mesh.markers[m].edges) {
                // On a circle round the origin the outward normal points to the middle of the edge.
                const Point middle = 0.5 * (mesh.points[edge.a.index()] + mesh.points[edge.b.index()]);
                const double outwards = dot(middle, flow) / length(middle);
                if (m == 1) {
                    EXPECT_LT(outwards, 1e-12);
                } else {
                    EXPECT_GT(outwards, -1e-12);
                }
            }
        }
    }
}

TEST(InletOutlet, NamesOfElementsAreNotTakenTwice) {
    Mesh mesh = test::annulus();
    mesh.markers[0].name = "outlet";
    EXPECT_THROW(split_far_field(mesh, 0), OptionError);
}

TEST(InletOutlet, IsAnOptionOfTheMesh) {
    CaseOptions options;
    options.far_field.size = 5;
    options.layer.enabled = false;
    options.inlet_outlet = true;
    const Mesh mesh = generate_mesh(std::vector<std::string>{"naca:0012:60"}, options).mesh;
    EXPECT_TRUE(check_mesh(mesh).valid());
    ASSERT_EQ(mesh.markers.size(), 3u);
    EXPECT_EQ(mesh.markers[1].name, "inlet");
}

}  // namespace
}  // namespace lamina
