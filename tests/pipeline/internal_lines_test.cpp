// Lines inside the domain (CaseOptions::lines): valid by the exact check, and where they should be.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/presets.hpp>
#include <lamina/stream.hpp>

#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::marker_of;

double length_of(const Mesh& mesh, const Marker& marker) {
    double sum = 0;
    for (const Segment& edge : marker.edges) sum += distance(mesh.points[edge.a.index()], mesh.points[edge.b.index()]);
    return sum;
}

CaseOptions options_with(std::vector<InternalLine> lines) {
    CaseOptions options;
    options.far_field.size = 10;
    options.lines = std::move(lines);
    return options;
}

TEST(InternalLines, AreEdgesBetweenCells) {
    const MeshResult result =
        generate_mesh({"naca:0012"}, options_with({{.name = "rake", .points = {{1.5, -0.5}, {1.5, 0.5}}}}));
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    const Marker* rake = marker_of(result.mesh, "rake");
    ASSERT_NE(rake, nullptr);
    EXPECT_EQ(rake->kind, MarkerKind::internal);
    EXPECT_NEAR(length_of(result.mesh, *rake), 1, 1e-12);
    for (const Segment& edge : rake->edges) EXPECT_NEAR(result.mesh.points[edge.a.index()].x, 1.5, 1e-15);
}

TEST(InternalLines, WithASizeAreDividedByIt) {
    const Mesh mesh = generate_mesh({"naca:0012"},
                                    options_with({{.name = "disc", .points = {{1.5, -0.5}, {1.5, 0.5}}, .size = 0.02}}))
                          .mesh;
    EXPECT_NEAR(static_cast<double>(marker_of(mesh, "disc")->edges.size()), 50, 10);
}

TEST(InternalLines, EndOnWallsAndLayersGiveWay) {
    const MeshResult result =
        generate_mesh({"naca:0012"}, options_with({{.name = "probe", .points = {{0.5, 0}, {0.5, 0.5}}}}));
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    // It begins at a vertex of the wall, no further than a part of an edge from where the line meets it.
    const Marker* probe = marker_of(result.mesh, "probe");
    ASSERT_NE(probe, nullptr);
    EXPECT_NEAR(length_of(result.mesh, *probe), 0.5 - 0.0529, 1e-3);
    EXPECT_GT(result.check.layer.cells, 10000u);
}

/// Returns the edges of all cells, with their smaller vertices first, sorted.
std::vector<Segment> sorted_edges(const Mesh& mesh) {
    std::vector<Segment> edges;
    const auto add = [&](const auto& cell) {
        const std::size_t n = std::size(cell.v);
        for (std::size_t i = 0; i < n; ++i) {
            const auto [a, b] = std::minmax(cell.v[i], cell.v[(i + 1) % n]);
            edges.push_back({a, b});
        }
    };
    for (const Triangle& t : mesh.triangles) add(t);
    for (const Quad& q : mesh.quads) add(q);
    std::sort(edges.begin(), edges.end());
    return edges;
}

TEST(InternalLines, RunThroughLayersWhichKeepTheirFirstHeights) {
    struct Case {
        std::vector<Point> line;
        double least_coverage;
        bool on_ground = false;
    };
    const std::vector<Case> cases{
        {{{0.3, 0}, {0.3, 0.3}}, 0.99},                        // upright
        {{{0.3, -0.3}, {0.3, 0.3}}, 0.99},                     // through the section
        {{{0.3, 0}, {0.8, 0.3}}, 0.96},                        // leans by 60 degrees
        {{{-0.2, 0}, {0.2, 0}}, 0.99},                         // at the nose
        {{{1, 0}, {1.3, 0.1}}, 0.99},                          // in the fan of the trailing edge
        {{{0.1, 0}, {0.1, 0.07}}, 0.98},                       // hardly longer than the layer is thick
        {{{0.6, 0}, {0.5, -0.2}}, 0.98, true},                 // to the ground
        {{{0.9, 0}, {0.95, 0.3}, {0.1, 0.3}, {0.2, 0}}, 0.98}  // there and back
    };
    for (const Case& c : cases)
        for (const bool two_sided : {false, true})
            for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads}) {
                SCOPED_TRACE(testing::Message() << "case " << &c - cases.data() << ", two-sided " << two_sided
                                                << ", topology " << static_cast<int>(topology));
                if (two_sided && (c.on_ground || c.line.size() > 2)) continue;  // it would part the flow
                CaseOptions options = options_with({{.name = "probe", .points = c.line, .two_sided = two_sided}});
                options.layer.topology = topology;
                options.layer.layers.reset();
                if (c.on_ground) {
                    options.far_field.ground = Length{0.2 - 0.0600173};
                    options.far_field.ground_wall = OuterWallKind::moving;
                    options.lines[0].points[1].y = -10;
                }
                const MeshResult result = generate_mesh({"naca:0012"}, options);
                EXPECT_TRUE(check_mesh(result.mesh).valid());
                EXPECT_EQ(result.check.edges_without_first_layer, 0u);
                for (const auto& wall : result.check.walls.first_heights) EXPECT_EQ(wall.share_of_kept, 1);
                EXPECT_EQ(result.check.isotropic.angles_below_bound, result.check.isotropic.exempt);
                const auto& cells = result.layer_coverage[0].all;
                EXPECT_GE(static_cast<double>(cells.made_cells) / static_cast<double>(cells.requested_cells),
                          c.least_coverage);
                // Walls become no finer for lines that lean.
                EXPECT_LT(marker_of(result.mesh, "airfoil")->edges.size(), 300u);
                const std::vector<Segment> edges = sorted_edges(result.mesh);
                for (const Segment& edge : marker_of(result.mesh, "probe")->edges) {
                    const auto [a, b] = std::minmax(edge.a, edge.b);
                    EXPECT_TRUE(std::binary_search(edges.begin(), edges.end(), Segment{a, b}));
                }
            }
}

TEST(InternalLines, SeveralAtOneVertexOfAWallHaveRaysOfTheirOwn) {
    struct Case {
        std::vector<Point> first, second;
        std::optional<double> symmetry{};
        bool on_ground = false;
    };
    const Point at{0.6, 0.0456408};  // beside the wall
    const std::vector<Case> cases{
        {{at, {0.5, 0.3}}, {at, {0.75, 0.3}}},                              // on either side of the normal
        {{at, {0.75, 0.3}}, {at, {0.7, 0.3}}},                              // on one side
        {{{1, 0}, {1.3, 0.1}}, {{1, 0}, {1.3, 0.12}}},                      // nearer to each other than rays of a fan
        {{{1, 0}, {0.9, 0.3}}, {{1, 0}, {1.3, -0.1}}},                      // before the fan, and in it
        {{{0, 0}, {-0.3, 0.1}}, {{0, 0}, {-0.3, 0.02}}, 0},                 // at the nose of a half model
        {{{0.6, -10}, {0.58, -0.1}}, {{0.6, -10}, {0.63, -0.1}}, {}, true}  // on the ground
    };
    for (const Case& c : cases)
        for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
            SCOPED_TRACE(testing::Message() << "case " << &c - cases.data() << ", " << static_cast<int>(topology));
            CaseOptions options = options_with(
                {{.name = "first", .points = c.first, .two_sided = true}, {.name = "second", .points = c.second}});
            options.layer.topology = topology;
            options.layer.first_height = Length{1e-4};
            options.far_field.symmetry = c.symmetry;
            if (c.on_ground) {
                options.far_field.ground = Length{0.2 - 0.0600173};
                options.far_field.ground_wall = OuterWallKind::moving;
                for (InternalLine& line : options.lines) line.points[0].y = -0.2;
            }
            const MeshResult result = generate_mesh({"naca:0012"}, options);
            EXPECT_TRUE(check_mesh(result.mesh).valid());
            EXPECT_EQ(result.check.walls.bare_edges, 0u);
            for (const auto& wall : result.check.walls.first_heights) EXPECT_EQ(wall.share_of_kept, 1);
            EXPECT_EQ(marker_of(result.mesh, "first")->kind, MarkerKind::wall);
            const std::vector<Segment> edges = sorted_edges(result.mesh);
            for (const char* name : {"first", "second"}) {
                const InternalLine& line = options.lines[name == std::string("second")];
                const double length = length_of(result.mesh, *marker_of(result.mesh, name));
                EXPECT_NEAR(length, (line.two_sided ? 2 : 1) * distance(line.points[0], line.points[1]), 1e-3);
                for (const Segment& edge : marker_of(result.mesh, name)->edges) {
                    const auto [a, b] = std::minmax(edge.a, edge.b);
                    EXPECT_TRUE(std::binary_search(edges.begin(), edges.end(), Segment{a, b}));
                }
            }
        }
}

/// Walls become finer beside lines that lean, and half of their edges shorter than the way to an end.
TEST(InternalLines, StayOnWallsThatBecomeFiner) {
    const Point at{0.40398952666429994, 0.05787444763447987};
    CaseOptions options = preset_options("rans", true);
    options.far_field.size = 10;
    options.lines = {{.name = "first", .points = {at, {0.14357199983608138, 0.23523009269309453}}},
                     {.name = "second", .points = {at, {0.09506667364432747, 0.1724294619541118}}}};
    options.layer.first_height = Length{1e-4};
    options.conditions = {.alpha_deg = 4, .reynolds = 1e6};
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    const Marker* first = marker_of(result.mesh, "first");
    ASSERT_NE(first, nullptr);
    const Marker* wall = marker_of(result.mesh, "airfoil");
    EXPECT_TRUE(std::any_of(wall->edges.begin(), wall->edges.end(), [&](const Segment& edge) {
        return std::any_of(first->edges.begin(), first->edges.end(),
                           [&](const Segment& s) { return s.a == edge.a || s.b == edge.a; });
    }));
}

/// The border of the layer runs along a line between a ray with one layer and one without, and is divided there.
TEST(InternalLines, TakeTheVerticesOfBordersAlongThem) {
    const Point at{0.5127934989278096, 0.052054051803331454};
    for (const double up : {1.0, -1.0})
        for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
            SCOPED_TRACE(testing::Message() << up << ", topology " << static_cast<int>(topology));
            const auto line = [&](const char* name, Point end) {
                return InternalLine{.name = name, .points = {{at.x, up * at.y}, {end.x, up * end.y}}};
            };
            CaseOptions options = options_with({line("first", {0.4063092149104569, 0.12118016579396967}),
                                                line("second", {0.2340400061640232, 0.19000523194615682}),
                                                line("third", {0.5552565724388647, 0.13405713009801634})});
            options.far_field.pitch = Length{1.7973916327551889};
            options.conditions.alpha_deg = up * 10;
            options.layer.first_height = Length{1e-4};
            options.layer.topology = topology;
            const Mesh mesh = generate_mesh({"naca:0012"}, options).mesh;
            EXPECT_TRUE(check_mesh(mesh).valid());
            const std::vector<Segment> edges = sorted_edges(mesh);
            for (const InternalLine& given : options.lines)
                for (const Segment& edge : marker_of(mesh, given.name)->edges) {
                    const auto [a, b] = std::minmax(edge.a, edge.b);
                    EXPECT_TRUE(std::binary_search(edges.begin(), edges.end(), Segment{a, b}));
                }
        }
}

TEST(InternalLines, EndOnWallsOfTheDomain) {
    for (const OuterWallKind walls : {OuterWallKind::slip, OuterWallKind::no_slip})
        for (const bool two_sided : {false, true}) {
            SCOPED_TRACE(testing::Message() << "two-sided " << two_sided);
            CaseOptions options = options_with({{.name = "rake",  // the upper end is typed with few digits
                                                 .points = {{-0.7, -3}, {-0.5, 0.9999}},
                                                 .two_sided = two_sided}});
            options.far_field.tunnel = Length{2};
            options.far_field.tunnel_walls = walls;
            options.layer.first_height = Length{1e-4};
            // A two-sided line from wall to wall would part the flow.
            if (two_sided) options.lines[0].points[1].y = 0.8;
            const MeshResult result = generate_mesh({"naca:0012"}, options);
            const MeshCheck check = check_mesh(result.mesh);
            EXPECT_TRUE(check.valid());
            EXPECT_TRUE(two_sided || check.walls.bare_edges == 0);
            double lowest = 0, highest = 0;
            for (const Segment& edge : marker_of(result.mesh, "rake")->edges)
                for (const VertexId v : {edge.a, edge.b}) {
                    lowest = std::min(lowest, result.mesh.points[v.index()].y);
                    highest = std::max(highest, result.mesh.points[v.index()].y);
                }
            EXPECT_EQ(lowest, -1);
            EXPECT_EQ(highest, two_sided ? 0.8 : 1);
        }
}

TEST(InternalLines, TwoSidedOnesAreWallsWithoutThickness) {
    const Point tip{1.5, 0.5};
    const MeshResult result =
        generate_mesh({"naca:0012"}, options_with({{.name = "baffle", .points = {{1.5, -0.5}, tip}, .two_sided = true},
                                                   {.name = "rake", .points = {{1.2, 0}, {1.8, 0.1}}}}));
    const Mesh& mesh = result.mesh;
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.valid());
    EXPECT_EQ(check.boundary_loops, 3u);
    const Marker* baffle = marker_of(mesh, "baffle");
    ASSERT_NE(baffle, nullptr);
    EXPECT_EQ(baffle->kind, MarkerKind::wall);
    EXPECT_NEAR(length_of(mesh, *baffle), 2, 1e-12);
    EXPECT_EQ(std::count(mesh.points.begin(), mesh.points.end(), tip), 1);
    EXPECT_EQ(marker_of(mesh, "rake")->kind, MarkerKind::internal);

    // The same two rows of edges in two markers are a crack, and so is a row that is marked on one side.
    Mesh cracked = mesh;
    auto& edges = cracked.markers[static_cast<std::size_t>(baffle - mesh.markers.data())].edges;
    Marker other{"other", MarkerKind::wall, {}};
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (i % 2 == 1) other.edges.push_back(edges[i]);
    std::erase_if(edges,
                  [&](Segment s) { return std::find(other.edges.begin(), other.edges.end(), s) != other.edges.end(); });
    cracked.markers.push_back(other);
    EXPECT_FALSE(check_mesh(cracked).valid());
}

TEST(InternalLines, RandomOnesRoundRandomSectionsAreValid) {
    std::mt19937 random(3);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    int made = 0;
    for (std::size_t trial = 0; trial < 12; ++trial) {
        std::vector<InternalLine> lines;
        for (int k = 0; k < 3; ++k)
            lines.push_back(
                {.name = "line" + std::to_string(k),
                 .points = {{uniform(-0.5, 1.5), uniform(-0.5, 0.5)}, {uniform(-0.5, 1.5), uniform(-0.5, 0.5)}},
                 .two_sided = k == 0});
        const char* const section = std::array{"naca:0012", "naca:4412", "naca:0012:blunt", "naca:2424"}[trial % 4];
        try {
            const MeshResult result = generate_mesh({section}, options_with(lines));
            EXPECT_TRUE(check_mesh(result.mesh).valid()) << trial;
            ++made;
        } catch (const OptionError& error) {
            EXPECT_NE(std::string(error.what()).find("encloses a part of the flow"), std::string::npos) << error.what();
        }
    }
    EXPECT_GE(made, 8);
}

/// A line shorter than the triangles there has two edges, since its ends are no double vertices.
TEST(InternalLines, ShortTwoSidedOnesAreWallsToo) {
    CaseOptions options = options_with({{.name = "vane", .points = {{2, 1}, {2.01, 1}}, .two_sided = true}});
    options.layer.enabled = false;
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    ASSERT_NE(marker_of(result.mesh, "vane"), nullptr);
    EXPECT_EQ(marker_of(result.mesh, "vane")->edges.size(), 4u);
}

TEST(InternalLines, MeshesAreTheSameOnAnyNumberOfThreads) {
    CaseOptions options = options_with({{.name = "rake", .points = {{1.1, -0.2}, {0.9, 0.5}}}});
    options.threads = 1;
    const std::string hash = mesh_hash(generate_mesh({"naca:0012"}, options).mesh);
    options.threads = 4;
    EXPECT_EQ(mesh_hash(generate_mesh({"naca:0012"}, options).mesh), hash);
}

TEST(InternalLines, AreReadBackFromFormatsThatHoldThem) {
    const test::TemporaryFolder folder;
    const Mesh mesh =
        generate_mesh({"naca:0012"}, options_with({{.name = "rake", .points = {{1.5, -0.5}, {1.5, 0.5}}},
                                                   {.name = "baffle", .points = {{2, 0}, {2, 1}}, .two_sided = true}}))
            .mesh;
    for (const char* file : {"a.vtu", "a.msh"}) {
        write_mesh(mesh, folder / file);
        const Mesh read = read_mesh(folder / file);
        EXPECT_TRUE(check_mesh(read).valid()) << file;
        ASSERT_NE(marker_of(read, "rake"), nullptr) << file;
        EXPECT_EQ(marker_of(read, "rake")->kind, MarkerKind::internal) << file;
        EXPECT_TRUE(lost_marker_warnings(mesh.markers, folder / file).empty()) << file;
    }
    for (const char* file : {"a.su2", "a.ugrid"}) {
        write_mesh(mesh, folder / file);
        const Mesh read = read_mesh(folder / file);
        EXPECT_TRUE(check_mesh(read).valid()) << file;
        EXPECT_EQ(marker_of(read, "rake"), nullptr) << file;
        EXPECT_EQ(lost_marker_warnings(mesh.markers, folder / file).size(), 1u) << file;
    }
}

TEST(InternalLines, RefusalsSayWhy) {
    const auto message = [](InternalLine line) {
        try {
            generate_mesh({"naca:0012"}, options_with({std::move(line)}));
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(message({.name = "0", .points = {{2, 0}, {3, 0}}}).find("no name"), std::string::npos);
    EXPECT_NE(message({.name = "a", .points = {{2, 0}, {30, 0}}}).find("not inside the far field"), std::string::npos);
    EXPECT_NE(message({.name = "a", .points = {{2, 0}, {3, 0}, {2.5, 0}}}).find("runs back"), std::string::npos);
    EXPECT_NE(message({.name = "a", .points = {{2, 0}, {30, 0}}}).find("make --far-field larger"), std::string::npos);
    EXPECT_NE(message({.name = "airfoil", .points = {{2, 0}, {3, 0}}}).find("this name already"), std::string::npos);
}

}  // namespace
}  // namespace lamina
