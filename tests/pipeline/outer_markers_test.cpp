// The outer boundary as inlet and outlet, ground and tunnel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/pipeline.hpp>

#include "pipeline/assemble.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using pipeline::mark_slip_walls;
using pipeline::split_far_field;

TEST(InletOutlet, EachEdgeIsWhereTheFlowEntersOrNot) {
    for (const double alpha : {0.0, 30.0, -75.0, 90.0}) {
        Mesh mesh = test::annulus({.around = 60});
        const std::size_t edges = mesh.markers[1].edges.size();
        split_far_field(mesh.points, mesh.markers, alpha);
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
    EXPECT_THROW(split_far_field(mesh.points, mesh.markers, 0), OptionError);
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

const Marker* marker_of(const Mesh& mesh, const std::string& name) {
    for (const Marker& marker : mesh.markers)
        if (marker.name == name) return &marker;
    return nullptr;
}

/// Returns the length of all edges of a marker, which must lie at this y.
double length_at(const Mesh& mesh, const Marker& marker, double y) {
    double sum = 0;
    for (const Segment& edge : marker.edges) {
        const Point a = mesh.points[edge.a.index()], b = mesh.points[edge.b.index()];
        EXPECT_NEAR(a.y, y, 1e-12);
        EXPECT_NEAR(b.y, y, 1e-12);
        sum += distance(a, b);
    }
    return sum;
}

CaseOptions small_case() {
    CaseOptions options;
    options.far_field.size = 5;
    options.layer.enabled = false;
    return options;
}

Mesh mesh_of_section(const CaseOptions& options) {
    Mesh mesh = generate_mesh(std::vector<std::string>{"naca:0012:60"}, options).mesh;
    EXPECT_TRUE(check_mesh(mesh).valid());
    return mesh;
}

TEST(SlipWalls, ATunnelHasFloorAndCeilingInletAndOutlet) {
    CaseOptions options = small_case();
    options.far_field.tunnel = Length{3};
    const Mesh mesh = mesh_of_section(options);
    const Marker *tunnel = marker_of(mesh, "tunnel"), *inlet = marker_of(mesh, "inlet"),
                 *outlet = marker_of(mesh, "outlet");
    ASSERT_TRUE(tunnel && inlet && outlet);
    EXPECT_EQ(mesh.markers.size(), 4u);
    EXPECT_EQ(tunnel->kind, MarkerKind::symmetry);
    double floor = 0, ceiling = 0, longest = 0;
    for (const Segment& edge : tunnel->edges) {
        const Point a = mesh.points[edge.a.index()], b = mesh.points[edge.b.index()];
        EXPECT_NEAR(std::abs(a.y), 1.5, 1e-12);
        EXPECT_EQ(a.y, b.y);
        (a.y < 0 ? floor : ceiling) += distance(a, b);
        longest = std::max(longest, distance(a, b));
    }
    EXPECT_NEAR(floor, 10, 1e-9);
    EXPECT_NEAR(ceiling, 10, 1e-9);
    EXPECT_LT(longest, 2 * 3.0 / 20) << "edges are short enough for a tunnel";
    for (const Segment& edge : inlet->edges) EXPECT_NEAR(mesh.points[edge.a.index()].x, -4.5, 1e-12);
    for (const Segment& edge : outlet->edges) EXPECT_NEAR(mesh.points[edge.a.index()].x, 5.5, 1e-12);
}

TEST(SlipWalls, GroundLiesBelowTheLowestPoint) {
    CaseOptions options = small_case();
    options.far_field.ground = Length{0.25};
    const Mesh mesh = mesh_of_section(options);
    const double lowest = bounding_box(read_geometry(std::vector<std::string>{"naca:0012:60"})).lower.y;
    const Marker *ground = marker_of(mesh, "ground"), *rest = marker_of(mesh, "farfield");
    ASSERT_TRUE(ground && rest);
    EXPECT_EQ(mesh.markers.size(), 3u);
    EXPECT_NEAR(length_at(mesh, *ground, lowest - 0.25), 10, 1e-9);
    double highest = 0;
    for (const Segment& edge : rest->edges) highest = std::max(highest, mesh.points[edge.a.index()].y);
    EXPECT_NEAR(highest, 5, 1e-3);
}

TEST(SlipWalls, GroundMayBeNearerThanAFiftiethOfTheBody) {
    CaseOptions options = small_case();
    options.layer.enabled = true;
    options.layer.first_height = Length{1e-5};
    options.layer.layers = 10;
    for (const double gap : {0.05, 0.0125}) {
        options.far_field.ground = Length{gap};
        const Mesh mesh = mesh_of_section(options);
        EXPECT_GT(check_mesh(mesh).isotropic.min_angle_deg, proved_min_angle_deg) << gap;
    }
    options.far_field.ground = Length{0.001};
    try {
        mesh_of_section(options);
        ADD_FAILURE() << "0.1 % of the chord is too little";
    } catch (const OptionError& error) {
        EXPECT_EQ(error.option(), "ground");
    }
}

TEST(SlipWalls, ATunnelStandsOnTheGround) {
    CaseOptions options = small_case();
    options.far_field.ground = Length{0.5};
    options.far_field.tunnel = Length{2};
    const Mesh mesh = mesh_of_section(options);
    const double lowest = bounding_box(read_geometry(std::vector<std::string>{"naca:0012:60"})).lower.y;
    ASSERT_TRUE(marker_of(mesh, "ground") && marker_of(mesh, "tunnel"));
    EXPECT_NEAR(length_at(mesh, *marker_of(mesh, "ground"), lowest - 0.5), 10, 1e-9);
    EXPECT_NEAR(length_at(mesh, *marker_of(mesh, "tunnel"), lowest + 1.5), 10, 1e-9);
}

TEST(SlipWalls, AreRefusedWhereTheyCannotBe) {
    CaseOptions options = small_case();
    options.far_field.tunnel = Length{0.1};
    EXPECT_THROW(mesh_of_section(options), OptionError) << "the section is higher";
    options.far_field.tunnel = Length{3};
    options.conditions.alpha_deg = 5;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "the flow would cross the walls";
    options.conditions.alpha_deg = 0;
    options.far_field.shape = FarFieldShape::circle;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "a circle has no floor";
    Mesh mesh = test::annulus();
    mesh.markers[0].name = "tunnel";
    EXPECT_THROW(mark_slip_walls(mesh.points, mesh.markers, {}, false), OptionError);
}

}  // namespace
}  // namespace lamina
