// Bodies without thickness in meshes (GeometryOptions::sheets): closed, valid, with layers on both sides.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/stream.hpp>

#include "core/lexicographic_order.hpp"
#include "support/sample_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace lamina {
namespace {

using test::marker_of;

CaseOptions options_with_sheets(std::vector<Sheet> sheets) {
    CaseOptions options;
    options.far_field.size = 10;
    options.layer.first_height = 1e-4;
    options.geometry.sheets = std::move(sheets);
    return options;
}

/// Expects a valid mesh in which the vertices of a sheet are double, but for its tips.
void expect_closed(const MeshResult& result, const std::string& name) {
    EXPECT_TRUE(check_mesh(result.mesh).valid()) << name;
    const Marker* marker = marker_of(result.mesh, name);
    ASSERT_NE(marker, nullptr) << name;
    EXPECT_EQ(marker->kind, MarkerKind::wall);
    std::map<Point, std::size_t, core::LexicographicOrder> vertices;
    for (const Segment& edge : marker->edges) ++vertices[result.mesh.points[edge.a.index()]];
    std::size_t single = 0;
    for (const auto& [at, count] : vertices) {
        EXPECT_LE(count, 2u);
        single += count == 1 ? 1 : 0;
    }
    // The two vertices at the foot of one on a wall begin one of its edges.
    EXPECT_EQ(single, 2u) << name;
}

TEST(CloseSheets, PlatesHaveLayersOnBothSides) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
        CaseOptions options = options_with_sheets({{"plate", {{0, 0}, {1, 0}}}});
        options.layer.topology = topology;
        const MeshResult result = generate_mesh(std::vector<std::string>{}, options);
        expect_closed(result, "plate");
        EXPECT_EQ(result.check.walls.share_of_kept_heights, 1);
        EXPECT_EQ(result.check.walls.bare_edges, 0u);
        EXPECT_EQ(result.layer_coverage[0].all.made_cells, result.layer_coverage[0].all.requested_cells);
        EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
    }
}

TEST(CloseSheets, StripsAreMarkersOnTheWallsOfBodies) {
    const std::vector<Sheet> strips{{"gurney", {{1, 0}, {1, -0.01}}}, {"fence", {{0.4, 0}, {0.4, 0.1}, {0.45, 0.2}}}};
    CaseOptions options = options_with_sheets(strips);
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    for (const Sheet& strip : strips) expect_closed(result, strip.name);
    EXPECT_NE(marker_of(result.mesh, "airfoil"), nullptr);
    EXPECT_GT(result.check.walls.share_of_kept_heights, 0.99);
    options.threads = 1;
    EXPECT_EQ(mesh_hash(generate_mesh({"naca:0012"}, options).mesh), mesh_hash(result.mesh));
}

TEST(CloseSheets, MayStandOnHalvesOfBodies) {
    for (const bool with_layers : {true, false}) {
        CaseOptions options =
            options_with_sheets({{"fence", {{0.4, 0}, {0.4, 0.1}, {0.45, 0.2}}}, {"vane", {{0.2, 0.4}, {0.8, 0.4}}}});
        options.far_field.symmetry = 0;
        options.layer.enabled = with_layers;
        const MeshResult result = generate_mesh({"naca:0020"}, options);
        for (const char* name : {"fence", "vane"}) expect_closed(result, name);
        for (const Point p : result.mesh.points) EXPECT_GE(p.y, 0);
    }
    CaseOptions options = options_with_sheets({{"strip", {{0.4, 0.2}, {0.4, -0.2}}}});
    options.far_field.symmetry = 0;
    EXPECT_THROW(generate_mesh({"naca:0020"}, options), InputError);
    options.geometry.sheets = {{"plate", {{1.5, 0}, {2, 0}}}};
    EXPECT_THROW(generate_mesh({"naca:0020"}, options), InputError);
}

TEST(CloseSheets, TheFlowDecidesOnBothSides) {
    CaseOptions options = options_with_sheets({{"sail", {{0, 0}, {0.3, 0.06}, {0.6, 0.07}, {1, 0}}}});
    options.layer = {};
    options.layer.first_height = YPlus{1};
    options.conditions = {.alpha_deg = 5, .reynolds = 1e6};
    options.use_flow = true;
    const MeshResult result = generate_mesh(std::vector<std::string>{}, options);
    expect_closed(result, "sail");
    ASSERT_TRUE(result.flow && !result.flow->estimated);
    EXPECT_EQ(result.conditions.chord, 1);
    // Thin sections of this camber have a lift coefficient of about 2 pi (sin alpha + 2 f).
    EXPECT_NEAR(result.flow->lift, 1.4, 0.3);
}

TEST(CloseSheets, WallsWithoutLayersAreDividedAlike) {
    // At feet that lean, walls beside corners are divided where nothing else asks for it.
    CaseOptions options =
        options_with_sheets({{"fence", {{0.7704, 0}, {0.7389, -0.0576}}}, {"plate", {{1.5, 0}, {2, 0.2}}}});
    options.layer.enabled = false;
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    expect_closed(result, "fence");
    expect_closed(result, "plate");
    EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
}

TEST(CloseSheets, RandomOnesAreValid) {
    std::mt19937 random(11);
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    for (std::size_t trial = 0; trial < 12; ++trial) {
        const double x = uniform(0.1, 0.9), lean = uniform(-0.1, 0.1), side = trial % 2 == 0 ? 1 : -1;
        const std::vector<Sheet> sheets{
            {"standing", {{x, 0}, {x + lean, side * uniform(0.14, 0.2)}}},
            {"free", {{uniform(1.1, 1.3), -0.2}, {1.4, uniform(-0.2, 0.2)}, {uniform(1.5, 2), 0.1}}}};
        const char* const section = std::array{"naca:0012", "naca:4412", "naca:0012:blunt", "naca:2424"}[trial % 4];
        const MeshResult result = generate_mesh({section}, options_with_sheets(sheets));
        expect_closed(result, "standing");
        expect_closed(result, "free");
    }
}

TEST(CloseSheets, AreReadBackFromFormats) {
    const test::TemporaryFolder folder;
    const Mesh mesh = generate_mesh({"naca:0012"}, options_with_sheets({{"fence", {{0.5, 0}, {0.5, 0.2}}}})).mesh;
    for (const char* file : {"a.vtu", "a.msh", "a.su2", "a.cas"}) {
        write_mesh(mesh, folder / file);
        const Mesh read = read_mesh(folder / file);
        EXPECT_TRUE(check_mesh(read).valid()) << file;
        ASSERT_NE(marker_of(read, "fence"), nullptr) << file;
        EXPECT_EQ(marker_of(read, "fence")->edges.size(), marker_of(mesh, "fence")->edges.size()) << file;
    }
}

TEST(CloseSheets, LinesMayMeetThem) {
    const std::vector<Point> crossing{{0.4, -0.3}, {0.6, 0.3}}, ending{{0.3, 0}, {0.2, 0.3}},
        from_tip{{1, 0}, {1.3, 0.1}};
    for (const bool with_layers : {true, false})
        for (const bool two_sided : {false, true}) {
            SCOPED_TRACE(testing::Message() << "with layers " << with_layers << ", two-sided " << two_sided);
            CaseOptions options = options_with_sheets({{"plate", {{0, 0}, {1, 0}}}});
            options.layer.enabled = with_layers;
            options.lines = {{.name = "crossing", .points = crossing, .two_sided = two_sided},
                             {.name = "ending", .points = ending, .two_sided = two_sided},
                             {.name = "from_tip", .points = from_tip, .two_sided = two_sided}};
            const MeshResult result = generate_mesh(std::vector<std::string>{}, options);
            expect_closed(result, "plate");
            // A line on both sides of a tiny gap asks for no tiny edges.
            EXPECT_LT(result.mesh.points.size(), 40'000u);
            EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
            if (with_layers) {
                EXPECT_EQ(result.check.walls.share_of_kept_heights, 1);
            }
            for (const InternalLine& line : options.lines) {
                double length = 0;
                for (const Segment& edge : marker_of(result.mesh, line.name)->edges)
                    length += distance(result.mesh.points[edge.a.index()], result.mesh.points[edge.b.index()]);
                EXPECT_NEAR(length, (two_sided ? 2 : 1) * distance(line.points[0], line.points[1]), 1e-3) << line.name;
            }
        }
}

/// The line ends on the wall beside the strip, and would run along the wall to the strip's foot.
TEST(CloseSheets, LinesMayEndBesideFeet) {
    CaseOptions options = options_with_sheets(
        {{"strip", {{0.9252275846351461, 0.009329335542654249}, {0.9218397828242526, 0.20064228780204424}}}});
    options.lines = {
        {.name = "rake",
         .points = {{0.9252275846351461, 0.010365928380726943}, {0.8535747465129407, 0.057511233455572235}}}};
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    expect_closed(result, "strip");
    EXPECT_NE(marker_of(result.mesh, "rake"), nullptr);
}

TEST(CloseSheets, RefusalsSayWhy) {
    CaseOptions options = options_with_sheets({{"plate", {{0, 0}, {1, 0}}}});
    EXPECT_THROW(stream_mesh({}, options, [] { return std::unique_ptr<MeshSink>(); }), OptionError);
    options = options_with_sheets({{"plate", {{0, 0}, {0, 1}}}});
    EXPECT_THROW(generate_mesh(std::vector<std::string>{}, options), OptionError);  // no chord
}

}  // namespace
}  // namespace lamina
