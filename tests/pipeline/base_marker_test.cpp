// The option that gives the base of a blunt trailing edge a marker of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "support/temporary_folder.hpp"
#include "support/wall_data.hpp"

namespace lamina {
namespace {

using test::TemporaryFolder;

TEST(BaseMarkers, OnlyForABluntTrailingEdge) {
    CaseOptions options;
    options.far_field.size = 5;
    options.layer.layers = 8;
    options.layer.first_height = 1e-4;
    for (const bool blunt : {true, false}) {
        const std::vector<std::string> input{blunt ? "naca:0012:61:blunt" : "naca:0012:60"};
        options.assemble.base_marker = false;
        const std::size_t edges = generate_mesh(input, options).mesh.markers[0].edges.size();
        options.assemble.base_marker = true;
        const Mesh mesh = generate_mesh(input, options).mesh;
        EXPECT_TRUE(check_mesh(mesh).valid());
        ASSERT_EQ(mesh.markers.size(), blunt ? 3u : 2u);
        EXPECT_EQ(mesh.markers[0].name, "airfoil");
        if (!blunt) continue;
        EXPECT_EQ(mesh.markers[1].name, "airfoil_base");
        EXPECT_EQ(mesh.markers[1].kind, MarkerKind::wall);
        EXPECT_EQ(mesh.markers[0].edges.size() + mesh.markers[1].edges.size(), edges);
        for (const Segment& edge : mesh.markers[1].edges) EXPECT_EQ(mesh.points[edge.a.index()].x, 1);
        double length_of_base = 0;
        for (const Segment& edge : mesh.markers[1].edges)
            length_of_base += distance(mesh.points[edge.a.index()], mesh.points[edge.b.index()]);
        EXPECT_NEAR(length_of_base, 0.00252, 1e-12);  // the thickness of the section at x = 1

        // The table of the walls still follows the whole outline.
        const TemporaryFolder folder;
        write_wall_data(mesh, folder / "w.csv");
        const auto rows = test::read_wall_rows(folder.read("w.csv"));
        ASSERT_EQ(rows.size(), edges);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].vertex, i);
            EXPECT_NEAR(length(rows[i].normal), 1, 1e-14);
            EXPECT_GT(rows[i].first_height, 0);
            const test::WallRow& before = rows[i == 0 ? 0 : i - 1];
            EXPECT_NEAR(rows[i].arc_length - before.arc_length, distance(rows[i].at, before.at), 1e-14);
        }
    }
}

TEST(BaseMarkers, HaveNamesThatNoElementHas) {
    CaseOptions options;
    options.far_field.size = 5;
    options.layer.layers = 8;
    options.layer.first_height = 1e-4;
    options.assemble.base_marker = true;
    const std::string longest(32, 'x');
    options.geometry.names = {"a", "a_base", longest};
    for (const char* shift : {"a_base:shift:0,1", "a_base:shift:0,1", "xxx:shift:0,-2"})
        options.geometry.transformations.push_back(parse_transformation(shift));
    options.geometry.transformations.back().element = longest;
    const std::vector<std::string> inputs(3, "naca:0012:61:blunt");
    const MeshResult result = generate_mesh(inputs, options);
    std::vector<std::string> names;
    for (const Marker& marker : result.mesh.markers) names.push_back(marker.name);
    EXPECT_EQ(names, (std::vector<std::string>{"a", "a_base_2", "a_base", "a_base_base", longest,
                                               longest.substr(5) + "_base", "farfield"}));
    const auto renamed = std::count_if(result.warnings.begin(), result.warnings.end(), [](const Warning& warning) {
        return warning.code == WarningCode::marker_renamed;
    });
    EXPECT_EQ(renamed, 1);
}

TEST(JoinedBodies, KeepTheirMarkersAndAreValid) {
    // A section, a Gurney flap at its tail that overlaps it, and a strut through it.
    const auto plate = [](double x0, double y0, double x1, double y1) {
        return element_of_points(std::vector<Point>{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}, {x0, y0}}, "plate");
    };
    const std::vector<std::string> section{"naca:0012"};
    std::vector<Element> bodies = read_inputs(section);
    bodies.push_back(plate(0.97, -0.03, 0.985, 0));
    bodies.push_back(plate(0.3, -0.2, 0.4, 0.15));
    const Geometry geometry = make_geometry(std::move(bodies), {.names = {"wing", "tab", "strut"}, .unite = true});
    ASSERT_EQ(geometry.elements.size(), 1u);
    for (const std::optional<double> symmetry : {std::optional<double>(), std::optional(0.0)}) {
        CaseOptions options;
        options.far_field.size = 10;
        options.far_field.symmetry = symmetry;
        const MeshResult result = generate_mesh(geometry, options);
        EXPECT_TRUE(check_mesh(result.mesh).valid());
        std::vector<std::string> names;
        std::size_t edges = 0;
        for (const Marker& marker : result.mesh.markers) {
            if (marker.kind != MarkerKind::wall) continue;
            names.push_back(marker.name);
            edges += marker.edges.size();
            for (const Segment& edge : marker.edges) {
                const Point at = midpoint(result.mesh.points[edge.a.index()], result.mesh.points[edge.b.index()]);
                const double tiny = 1e-12;  // crossings are rounded
                if (marker.name == "strut") {
                    EXPECT_LE(std::abs(at.x - 0.35), 0.05 + tiny);
                }
                if (marker.name == "tab") {
                    EXPECT_LE(std::abs(at.x - 0.9775), 0.0075 + tiny);
                }
                if (marker.name == "tab") {
                    EXPECT_LT(at.y, 0);
                }
                if (marker.name == "wing") {
                    EXPECT_LE(std::abs(at.y), 0.0601);
                }
            }
        }
        std::sort(names.begin(), names.end());
        EXPECT_EQ(names, symmetry ? (std::vector<std::string>{"strut", "wing"})
                                  : (std::vector<std::string>{"strut", "tab", "wing"}));
        EXPECT_EQ(edges, result.check.walls.edges);
    }
}

}  // namespace
}  // namespace lamina
