// Markers of bases, and tables of walls.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::TemporaryFolder;

struct Row {
    std::string marker;
    std::size_t vertex = 0;
    Point at, normal;
    double arc_length = 0, first_height = 0;
};

std::vector<Row> read_rows(const std::string& text) {
    std::istringstream in(text);
    std::string line, comma;
    std::getline(in, line);
    EXPECT_EQ(line, "marker,vertex,x,y,arc_length,normal_x,normal_y,first_height");
    std::vector<Row> rows;
    while (std::getline(in, line)) {
        Row row;
        std::istringstream cells(line);
        std::getline(cells, row.marker, ',');
        char c;
        cells >> row.vertex >> c >> row.at.x >> c >> row.at.y >> c >> row.arc_length >> c >> row.normal.x >> c >>
            row.normal.y >> c >> row.first_height;
        EXPECT_FALSE(cells.fail()) << line;
        rows.push_back(row);
    }
    return rows;
}

TEST(WallData, OfACircle) {
    const TemporaryFolder folder;
    for (const bool quads : {false, true}) {
        const std::size_t n = 24;
        write_wall_data(annulus({.around = n, .quads_in_layer = quads}), folder / "w.csv");
        const auto rows = read_rows(folder.read("w.csv"));
        ASSERT_EQ(rows.size(), n);
        const double edge = 2 * std::sin(M_PI / n), gap = 0.2 * std::cos(M_PI / n);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_EQ(rows[i].marker, "wall");
            EXPECT_EQ(rows[i].vertex, i);
            EXPECT_NEAR(rows[i].arc_length, edge * static_cast<double>(i), 1e-14);
            EXPECT_NEAR(distance(rows[i].normal, rows[i].at), 0, 1e-14);  // radius 1
            EXPECT_NEAR(rows[i].first_height, gap, 1e-14);
        }
    }
}

TEST(BaseMarkers, OnlyForABluntTrailingEdge) {
    CaseOptions options;
    options.far_field = 5;
    options.layer.layers = 8;
    options.layer.first_height = 1e-4;
    for (const bool blunt : {true, false}) {
        Mesh mesh = generate_mesh({blunt ? "naca:0012:61:blunt" : "naca:0012:60"}, options).mesh;
        const std::size_t edges = mesh.markers[0].edges.size();
        EXPECT_EQ(add_base_markers(mesh), blunt ? 1u : 0u);
        EXPECT_TRUE(check_mesh(mesh).valid());
        if (!blunt) continue;
        ASSERT_EQ(mesh.markers.size(), 3u);
        EXPECT_EQ(mesh.markers[0].name, "airfoil");
        EXPECT_EQ(mesh.markers[1].name, "airfoil_base");
        EXPECT_EQ(mesh.markers[1].kind, MarkerKind::wall);
        EXPECT_EQ(mesh.markers[0].edges.size() + mesh.markers[1].edges.size(), edges);
        for (const Segment& edge : mesh.markers[1].edges) EXPECT_EQ(mesh.points[edge.a.index()].x, 1);
        double length_of_base = 0;
        for (const Segment& edge : mesh.markers[1].edges)
            length_of_base += distance(mesh.points[edge.a.index()], mesh.points[edge.b.index()]);
        EXPECT_NEAR(length_of_base, 0.00252, 1e-12);  // NACA 4-digit thickness at x = 1
        EXPECT_EQ(add_base_markers(mesh), 0u);        // nothing is left to split

        // The table follows the whole outline nevertheless.
        const TemporaryFolder folder;
        write_wall_data(mesh, folder / "w.csv");
        const auto rows = read_rows(folder.read("w.csv"));
        ASSERT_EQ(rows.size(), edges);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            EXPECT_EQ(rows[i].vertex, i);
            EXPECT_NEAR(length(rows[i].normal), 1, 1e-14);
            EXPECT_GT(rows[i].first_height, 0);
            const Row& before = rows[i == 0 ? 0 : i - 1];
            EXPECT_NEAR(rows[i].arc_length - before.arc_length, distance(rows[i].at, before.at), 1e-14);
        }
    }
}

}  // namespace
}  // namespace lamina
