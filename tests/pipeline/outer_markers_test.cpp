// The outer boundary as inlet and outlet, and where ground and tunnel lie.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/option.hpp>
#include <lamina/pipeline.hpp>

#include "pipeline/assemble.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using pipeline::add_outer_walls;
using pipeline::split_far_field;
using test::marker_of;

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
    options.assemble.inlet_outlet = true;
    const Mesh mesh = generate_mesh(std::vector<std::string>{"naca:0012:60"}, options).mesh;
    EXPECT_TRUE(check_mesh(mesh).valid());
    ASSERT_EQ(mesh.markers.size(), 3u);
    EXPECT_EQ(mesh.markers[1].name, "inlet");
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

Box bounding_box_of(const Mesh& mesh) {
    Box box;
    for (const Point p : mesh.points) box.include(p);
    return box;
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

TEST(OuterWalls, ATunnelHasFloorAndCeilingInletAndOutlet) {
    CaseOptions options = small_case();
    options.far_field.tunnel = Length{3};
    const Mesh mesh = mesh_of_section(options);
    const Marker *floor = marker_of(mesh, "floor"), *ceiling = marker_of(mesh, "ceiling"),
                 *inlet = marker_of(mesh, "inlet"), *outlet = marker_of(mesh, "outlet");
    ASSERT_TRUE(floor && ceiling && inlet && outlet);
    EXPECT_EQ(mesh.markers.size(), 5u);
    for (const Marker* wall : {floor, ceiling}) {
        EXPECT_EQ(wall->kind, MarkerKind::symmetry);
        EXPECT_NEAR(length_at(mesh, *wall, wall == floor ? -1.5 : 1.5), 10, 1e-9);
        double longest = 0;
        for (const Segment& edge : wall->edges)
            longest = std::max(longest, distance(mesh.points[edge.a.index()], mesh.points[edge.b.index()]));
        EXPECT_LT(longest, 2 * 3.0 / 20) << "edges are short enough for a tunnel";
    }
    for (const Segment& edge : inlet->edges) EXPECT_NEAR(mesh.points[edge.a.index()].x, -4.5, 1e-12);
    for (const Segment& edge : outlet->edges) EXPECT_NEAR(mesh.points[edge.a.index()].x, 5.5, 1e-12);
}

TEST(OuterWalls, ATunnelEndsWhereTheFlowIsEvenOrWhereItIsTold) {
    CaseOptions options = small_case();
    options.far_field.size = FarFieldOptions{}.size;
    for (const double height : {1.0, 6.0}) {
        options.far_field.tunnel = Length{height};
        const Box box = bounding_box_of(mesh_of_section(options));
        EXPECT_NEAR(box.lower.x, -std::max(10.0, 3 * height), 1e-9);
        EXPECT_NEAR(box.upper.x, 1 + std::max(15.0, 4 * height), 1e-9);
    }
    const Option<FarFieldOptions>& tunnel = find_row(option_table<FarFieldOptions>(), "tunnel");
    tunnel.set(options.far_field, std::string("1:2:3u"));
    const Box box = bounding_box_of(mesh_of_section(options));
    EXPECT_NEAR(box.lower.x, -2, 1e-9);
    EXPECT_NEAR(box.upper.x, 4, 1e-9);
    EXPECT_NEAR(box.height(), 1, 1e-12);
    for (const char* wrong : {"1:2", "1:2:3:4", "1:-2:3", "0"})
        EXPECT_THROW(tunnel.set(options.far_field, std::string(wrong)), OptionError) << wrong;
}

TEST(OuterWalls, GroundLiesBelowTheLowestPoint) {
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

TEST(OuterWalls, ATunnelStandsOnTheGround) {
    CaseOptions options = small_case();
    options.far_field.ground = Length{0.5};
    options.far_field.tunnel = Length{2};
    const Mesh mesh = mesh_of_section(options);
    const double lowest = bounding_box(read_geometry(std::vector<std::string>{"naca:0012:60"})).lower.y;
    ASSERT_TRUE(marker_of(mesh, "ground") && marker_of(mesh, "ceiling") && !marker_of(mesh, "floor"));
    EXPECT_NEAR(length_at(mesh, *marker_of(mesh, "ground"), lowest - 0.5), 10, 1e-9);
    EXPECT_NEAR(length_at(mesh, *marker_of(mesh, "ceiling"), lowest + 1.5), 10, 1e-9);
}

TEST(OuterWalls, AreRefusedWhereTheyCannotBe) {
    CaseOptions options = small_case();
    options.far_field.tunnel = Length{0.1};
    EXPECT_THROW(mesh_of_section(options), OptionError) << "the section is higher";
    options.far_field.tunnel = Length{3};
    options.conditions.alpha_deg = 5;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "the flow would cross the walls";
    options.conditions.alpha_deg = 0;
    options.far_field.shape = FarFieldShape::circle;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "a circle has no floor";
    options = small_case();
    options.far_field.ground_wall = OuterWallKind::moving;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "there is no ground";
    options.far_field.ground = Length{0.5};
    options.far_field.ground_layers = YPlus{1};
    options.layer.enabled = true;
    EXPECT_THROW(mesh_of_section(options), OptionError) << "a y+ needs a Reynolds number";
    Mesh mesh = test::annulus();
    mesh.markers[0].name = "floor";
    const std::vector<pipeline::OuterWallFacts> walls{{.name = "floor"}};
    const std::vector<std::vector<Segment>> edges(1);
    EXPECT_THROW(add_outer_walls(walls, edges, mesh.markers), OptionError);
}

}  // namespace
}  // namespace lamina
