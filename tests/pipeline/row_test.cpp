// Rows of blades, of which the domain holds one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "mesh/periodic.hpp"

namespace lamina {
namespace {

CaseOptions row(double pitch, double stagger_deg = 0, double alpha_deg = 0) {
    CaseOptions options;
    options.far_field.pitch = Length{pitch};
    options.far_field.stagger_deg = stagger_deg;
    options.conditions.alpha_deg = alpha_deg;
    options.layer.layers = 20;
    options.layer.first_height = Length{1e-4};
    return options;
}

/// Expects that borders are exact copies, and that three copies of the mesh are one valid mesh.
void expect_periodic(const Mesh& mesh, double pitch) {
    ASSERT_TRUE(check_mesh(mesh).valid());
    const auto [pair, mismatch] = mesh::find_periodic_pair(mesh.points, mesh.markers);
    ASSERT_TRUE(pair) << (mismatch ? mismatch->reason : "no pair");
    EXPECT_EQ(mesh.markers[pair->first].name, "periodic_lower");
    EXPECT_EQ(mesh.markers[pair->second].name, "periodic_upper");
    EXPECT_EQ(pair->translation.x, 0);
    EXPECT_NEAR(pair->translation.y, pitch, 1e-12 * pitch);
    const Mesh three = mesh::joined_copies(mesh, 3);
    const MeshCheck check = check_mesh(three);
    EXPECT_TRUE(check.valid()) << check.defects.front().description;
    EXPECT_EQ(three.triangles.size(), 3 * mesh.triangles.size());
    EXPECT_EQ(three.points.size(), 3 * mesh.points.size() - 2 * pair->vertices.size());
}

/// Expects inlet and outlet to be upright.
void expect_upright(const Mesh& mesh) {
    std::size_t found = 0;
    for (const Marker& marker : mesh.markers) {
        if (marker.name != "inlet" && marker.name != "outlet") continue;
        ++found;
        for (const Segment& edge : marker.edges)
            EXPECT_EQ(mesh.points[edge.a.index()].x, mesh.points[marker.edges.front().a.index()].x);
    }
    EXPECT_EQ(found, 2u);
}

TEST(BladeRow, BordersAreExactCopies) {
    struct Sample {
        std::string section;
        double pitch, stagger_deg;
    };
    for (const auto& [section, pitch, stagger_deg] :
         {Sample{"naca:0012", 1, 0}, Sample{"naca:6512", 0.8, 40}, Sample{"naca:4415:blunt", 0.5, -55},
          Sample{"naca:0024", 0.35, 20}, Sample{"naca:2412", 30, 10}}) {
        CaseOptions options = row(pitch, stagger_deg);
        options.conditions.chord = 1;
        for (const auto topology : {LayerTopology::layered, LayerTopology::quads}) {
            options.layer.topology = topology;
            const Mesh mesh = generate_mesh({section}, options).mesh;
            expect_periodic(mesh, pitch);
            expect_upright(mesh);
        }
        options.layer.enabled = false;
        expect_periodic(generate_mesh({section}, options).mesh, pitch);
    }
}

/// Layers up to isotropy meet in the middle of the channel, where neighbours share the room.
TEST(BladeRow, NeighboursShareTheRoom) {
    CaseOptions options = row(0.3, 50);
    options.conditions.chord = 1;
    options.layer.layers.reset();
    const MeshResult result = generate_mesh({"naca:3410"}, options);
    expect_periodic(result.mesh, 0.3);
    EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
    const LayerCoverage& layer = result.layer_coverage.front().all;
    EXPECT_GT(static_cast<double>(layer.made_cells), 0.7 * static_cast<double>(layer.requested_cells));
}

/// Copies need the layers that the flow asks for, too, or they would take them from the blade.
TEST(BladeRow, DistantNeighboursTakeNoLayers) {
    CaseOptions options = row(5, 30, 42);
    options.layer.layers.reset();
    options.layer.first_height = YPlus{1};
    options.conditions.reynolds = 5e5;
    options.use_flow = true;
    const MeshResult result = generate_mesh({"naca:6512"}, options);
    EXPECT_EQ(result.layer_coverage.front().all.incomplete_rays, 0u);
}

TEST(BladeRow, HoldsSeveralElements) {
    const std::string folder = LAMINA_SOURCE_DIR "/examples/geometry/";
    CaseOptions options = row(0.9, 20);
    options.conditions.chord = 1;
    const Mesh mesh =
        generate_mesh({folder + "crmhl2d_slat.dat", folder + "crmhl2d_main.dat", folder + "crmhl2d_flap.dat"}, options)
            .mesh;
    expect_periodic(mesh, 0.9);
}

/// Lines of any kind: the border runs between them and their copies, and the layers of neighbours give way to the
/// copies.
TEST(BladeRow, HoldsLines) {
    std::mt19937 random(20261129);
    const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
    std::size_t made = 0;
    for (int trial = 0; trial < 24; ++trial) {
        SCOPED_TRACE(trial);
        const double pitch = in(0.5, 2);
        CaseOptions options = row(pitch, in(-50, 50));
        options.conditions.chord = 1;
        options.layer.topology = trial % 2 ? LayerTopology::quads : LayerTopology::layered;
        options.layer.enabled = trial % 5 != 0;
        for (int k = 0; k < 1 + trial % 2; ++k) {
            const Point a{in(-0.5, 1.5), in(-0.5, 0.5)};
            options.lines.push_back({.name = std::string(1, static_cast<char>('a' + k)),
                                     .points = {a, a + Point{in(-0.4, 0.4), in(-0.4, 0.4)}},
                                     .two_sided = trial % 3 == 0});
        }
        try {
            expect_periodic(generate_mesh({"naca:6412"}, options).mesh, pitch);
            ++made;
        } catch (const OptionError& error) {
            EXPECT_EQ(error.option(), "line") << error.what();
        }
    }
    EXPECT_GE(made, 16u);
}

/// The border neither swings from column to column behind an end of the configuration nor touches the tip that the end
/// of an element in front of another one is.
TEST(BladeRow, BordersKeepTheirDistanceFromTips) {
    const auto expect_good = [](const std::vector<std::string>& files, CaseOptions options, Sheet sheet) {
        options.conditions.chord = 1;
        options.layer.enabled = false;
        options.geometry.sheets = {std::move(sheet)};
        const MeshResult result = generate_mesh(files, options);
        expect_periodic(result.mesh, options.far_field.pitch->value);
        EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
        EXPECT_LT(result.mesh.triangles.size(), 40'000u);
    };
    expect_good({LAMINA_SOURCE_DIR "/examples/geometry/rae2822.dat"}, row(0.47, -14.3, 16.4),
                {"behind", {{1.093, 0.153}, {0.969, 0.505}}});
    expect_good({"naca:6412"}, row(0.638, 37.2, 42.2), {"above", {{0.823, 0.059}, {0.951, 0.253}}});
}

TEST(BladeRow, LinesLeaveAGap) {
    CaseOptions options = row(1);
    options.lines = {{.name = "rake", .points = {{1.5, -0.2}, {1.5, 0.9}}}};
    try {
        generate_mesh({"naca:0012"}, options);
        FAIL() << "no room is left between the line and its copy";
    } catch (const OptionError& error) {
        EXPECT_NE(std::string(error.what()).find("leave a gap there"), std::string::npos) << error.what();
    }
}

/// Sizes of wakes and of the user go on at the other border.
TEST(BladeRow, SizesRepeat) {
    CaseOptions options = row(0.7, 30, 50);
    options.conditions.chord = 1;
    options.sizing.wakes = {{.length = 2, .size = Length{0.005}}};
    options.sizing.sources = {{.a = {0.2, 1.5}, .b = {0.6, 1.5}, .size = 0.004}};
    const Mesh mesh = generate_mesh({"naca:6510"}, options).mesh;
    expect_periodic(mesh, 0.7);
    EXPECT_GT(mesh.triangles.size(), 30'000u);
}

TEST(BladeRow, IsTheSameOnAnyNumberOfThreads) {
    CaseOptions options = row(0.6, 35);
    const std::string alone = mesh_hash(generate_mesh({"naca:6512"}, options).mesh);
    options.threads = 3;
    EXPECT_EQ(mesh_hash(generate_mesh({"naca:6512"}, options).mesh), alone);
}

TEST(BladeRow, FitsAnyPitchAndStagger) {
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / static_cast<double>(std::mt19937::max());
    };
    for (int i = 0; i < 12; ++i) {
        const double pitch = between(0.4, 2), stagger_deg = between(-60, 60);
        const std::string section = "naca:" + std::to_string(2000 + 100 * (2 + random() % 4) + 6 + random() % 12) +
                                    (random() % 2 ? "" : ":blunt");
        CaseOptions options = row(pitch, stagger_deg, between(-50, 50));
        options.conditions.chord = 1;
        options.layer.enabled = random() % 4 > 0;
        SCOPED_TRACE(section + " " + std::to_string(pitch) + " " + std::to_string(stagger_deg));
        try {
            expect_periodic(generate_mesh({section}, options).mesh, pitch);
        } catch (const OptionError& error) {
            EXPECT_EQ(error.option(), "periodic");  // neighbours overlap
        }
    }
}

TEST(BladeRow, RefusesWhatCannotBe) {
    const auto refused = [](CaseOptions options) -> std::string {
        try {
            generate_mesh({"naca:0012"}, options);
        } catch (const OptionError& error) {
            return error.option();
        }
        return "";
    };
    EXPECT_EQ(refused(row(0.1)), "periodic");
    EXPECT_EQ(refused(row(0.2, 70)), "periodic");
    EXPECT_EQ(refused(row(1e-5)), "periodic");
    CaseOptions options = row(1);
    options.far_field.ground = Length{1};
    EXPECT_EQ(refused(options), "periodic");
    options = row(1);
    options.far_field.shape = FarFieldShape::circle;
    EXPECT_EQ(refused(options), "periodic");
    options = {};
    options.far_field.stagger_deg = 10;
    EXPECT_EQ(refused(options), "periodic");
    options = row(1);
    options.layer.layers.reset();
    options.layer.wake_layers = options.use_flow = true;
    options.conditions.reynolds = 1e6;
    EXPECT_EQ(refused(options), "wake_layers");
}

TEST(BladeRow, StaggerTurnsTheBladeAndKeepsTheChord) {
    const Geometry row = blade_row(make_geometry({naca_airfoil("0012", 100)}), 1.5, 90);
    EXPECT_NEAR(bounding_box(row).height(), 1, 1e-3);
    EXPECT_NEAR(reference_box(row).width(), 1, 1e-3);
    EXPECT_EQ(*row.pitch, 1.5);
}

}  // namespace
}  // namespace lamina
