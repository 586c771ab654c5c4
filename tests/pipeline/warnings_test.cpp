// What the pipeline warns of, and that it keeps silent about good meshes.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

std::vector<std::string> names_of(const std::vector<Warning>& warnings) {
    std::vector<std::string> names;
    for (const Warning& warning : warnings) names.push_back(warning_name(warning.code));
    return names;
}

/// Expects a warning of this kind, and returns it.
Warning expect_warning_of(const MeshResult& result, WarningCode code) {
    const auto found = std::find_if(result.warnings.begin(), result.warnings.end(),
                                    [&](const Warning& warning) { return warning.code == code; });
    if (found == result.warnings.end()) {
        ADD_FAILURE() << "no warning " << warning_name(code);
        return {code};
    }
    return *found;
}

/// Expects a warning of this kind with a message and a unit, and returns it.
Warning expect_warning(const MeshResult& result, WarningCode code) {
    Warning warning = expect_warning_of(result, code);
    EXPECT_FALSE(warning.message.empty());
    EXPECT_FALSE(warning.unit.empty());
    return warning;
}

shapes::Outline scaled(shapes::Outline outline, double factor) {
    for (Point& p : outline) p = factor * p;
    return outline;
}

TEST(Warnings, GoodMeshesHaveNone) {
    CaseOptions isotropic = quick_options(), automatic = quick_options();
    isotropic.layer.layers.reset();
    automatic.layer = {};
    automatic.layer.layers.reset();
    automatic.layer.first_height = YPlus{1};
    automatic.conditions.reynolds = 6e6;
    for (const CaseOptions& options : {isotropic, CaseOptions{}, automatic})
        for (const char* digits : {"0012", "4412"})
            EXPECT_EQ(names_of(mesh_of({naca(digits, 200)}, options).warnings), std::vector<std::string>{}) << digits;
}

TEST(Warnings, LostFirstLayer) {
    CaseOptions options = quick_options();
    options.layer = {};
    options.layer.layers = 30;
    options.layer.topology = LayerTopology::delaunay;
    const MeshResult result = mesh_of({naca("4412", 40)}, options);
    const Warning warning = expect_warning(result, WarningCode::first_layer_lost);
    EXPECT_EQ(warning.number, static_cast<double>(result.check.edges_without_first_layer));
    ASSERT_TRUE(warning.at);
    EXPECT_GT(warning.at->x, 0);
    EXPECT_LT(warning.at->x, 1);
    options.layer.topology = LayerTopology::quads;
    const std::vector<std::string> kept = names_of(mesh_of({naca("4412", 40)}, options).warnings);
    EXPECT_EQ(std::count(kept.begin(), kept.end(), "first_layer_lost"), 0);
}

/// First layers are lower in a notch that is narrower than they are to be high.
TEST(Warnings, LowerFirstLayers) {
    CaseOptions options = quick_options();
    options.layer.first_height = 0.05;
    options.surface.treatment = SurfaceTreatment::keep;
    const MeshResult result = mesh_of({shapes::refined(shapes::v_notch(0.1), 10)}, options);
    EXPECT_EQ(result.check.walls.bare_edges, 0u);
    const Warning warning = expect_warning(result, WarningCode::first_layer_lost);
    EXPECT_GT(warning.number, 0);
    ASSERT_TRUE(warning.at);
    EXPECT_NEAR(warning.at->x, 2, 0.3);
    EXPECT_LT(result.check.walls.worst_first_height, 0.5);
}

/// No first layer fits into a notch of 2e-6, however much lower it is than wanted.
TEST(Warnings, WallsWithoutALayer) {
    CaseOptions options = quick_options();
    options.layer.first_height = 0.05;
    options.surface.treatment = SurfaceTreatment::keep;
    const shapes::Outline scratched{{0, 0}, {4, 0}, {4, 1}, {2 + 1e-6, 1}, {2, 1 - 1e-5}, {2 - 1e-6, 1}, {0, 1}};
    const MeshResult result = mesh_of({scratched}, options);
    EXPECT_GT(result.check.walls.bare_edges, 0u);
    const Warning warning = expect_warning(result, WarningCode::first_layer_lost);
    EXPECT_EQ(warning.number, static_cast<double>(result.check.walls.bare_edges));
    ASSERT_TRUE(warning.at);
    EXPECT_NEAR(warning.at->x, 2, 1e-5);
}

TEST(Warnings, LayersThickerThanTheRoomRoundTheWall) {
    CaseOptions options = quick_options(20);
    options.layer.topology = LayerTopology::delaunay;
    options.layer.first_height = 1e-2;
    options.layer.growth = 1.2;
    const MeshResult result = mesh_of({naca("9909")}, options);
    const Warning cut = expect_warning(result, WarningCode::rays_cut_in_the_open);
    EXPECT_EQ(cut.element, result.geometry.elements[0].name);
    EXPECT_EQ(cut.number, static_cast<double>(result.layer_coverage[0].open.incomplete_rays));
    ASSERT_TRUE(cut.at);
    const auto& wall = result.geometry.elements[0].points;
    EXPECT_LE(std::abs(cut.at->y), 0.15);
    EXPECT_TRUE(std::find(wall.begin(), wall.end(), *cut.at) != wall.end() || cut.at->x <= 1);
    const MeshResult thick = mesh_of({naca("4412")}, options);
    EXPECT_GT(expect_warning(thick, WarningCode::transition_out_of_range).number, 5);
    EXPECT_GT(expect_warning(thick, WarningCode::large_angle).number, 175);
}

/// The triangles beyond 30 layers are many times as high as the last of them; layers up to isotropy are the remedy.
TEST(Warnings, HeightsThatJumpAtTheEndOfTheLayer) {
    CaseOptions options = quick_options();
    const Warning warning = expect_warning(mesh_of({naca("0012", 200)}, options), WarningCode::transition_out_of_range);
    EXPECT_EQ(warning.unit, "height ratio");
    EXPECT_GT(warning.number, 2);
    EXPECT_NE(warning.message.find("--layers auto"), std::string::npos) << warning.message;
    options.layer.thickness = 1e-3;
    const Warning thin = expect_warning(mesh_of({naca("0012", 200)}, options), WarningCode::transition_out_of_range);
    EXPECT_NE(thin.message.find("--thickness"), std::string::npos) << thin.message;
    options.layer.thickness.reset();
    options.layer.layers.reset();
    const MeshResult mended = mesh_of({naca("0012", 200)}, options);
    EXPECT_LT(mended.check.transition.p90_height_ratio, 1.5);
    EXPECT_EQ(names_of(mended.warnings), std::vector<std::string>{});
}

/// The first cells of a fan are as small as a first height is beside the wall's edge. Fewer layers than up to isotropy
/// join divided borders to flat cells.
TEST(Warnings, AreasOfNeighboursThatJump) {
    CaseOptions options;
    options.surface.treatment = SurfaceTreatment::keep;
    const auto jump_of = [&](double first_height) {
        options.layer.first_height = first_height;
        return mesh_of({naca("0012", 200, TrailingEdge::blunt)}, options);
    };
    const std::vector<std::string> names = names_of(jump_of(1e-6).warnings);
    EXPECT_EQ(std::count(names.begin(), names.end(), "area_jump"), 0);
    const MeshResult low = jump_of(1e-9);
    const Warning warning = expect_warning(low, WarningCode::area_jump);
    EXPECT_GT(warning.number, 2e4);
    EXPECT_EQ(warning.number, low.check.layer.max_neighbour_area_ratio);
    ASSERT_TRUE(warning.at);
    EXPECT_NEAR(warning.at->x, 1, 1e-3);
    options.layer.layers = 12;
    options.layer.first_height = 1e-6;
    shapes::Outline thick_base;
    for (const Point p : naca("0012", 200, TrailingEdge::blunt))
        thick_base.push_back({p.x, p.y + (p.y > 0 ? 0.01 : -0.01) * p.x});
    const Warning flat = expect_warning(mesh_of({thick_base}, options), WarningCode::area_jump);
    EXPECT_GT(flat.number, 50);
    EXPECT_NE(flat.message.find("--layers auto"), std::string::npos) << flat.message;
}

/// Angles between the largest that is aimed at and 180 degrees are not kept quiet. Few points that are kept make some,
/// where the border is divided above long edges.
TEST(Warnings, LargeAnglesOfTheLayer) {
    CaseOptions options = quick_options();
    options.layer = {};
    options.layer.first_height = 1e-5;
    options.layer.layers = 30;
    const std::vector<std::string> names = names_of(mesh_of({naca("0012", 200)}, options).warnings);
    EXPECT_EQ(std::count(names.begin(), names.end(), "large_angle"), 0);
    const double angle = expect_warning(mesh_of({naca("0012")}, options), WarningCode::large_angle).number;
    EXPECT_GT(angle, 150);
    EXPECT_LT(angle, 175);
}

TEST(Warnings, FirstHeightsOutOfProportion) {
    CaseOptions options = quick_options();
    options.layer = {};
    options.layer.layers = 8;
    const auto warns = [&](double chord) {
        const std::vector<std::string> names = names_of(mesh_of({scaled(naca("0012"), chord)}, options).warnings);
        return std::count(names.begin(), names.end(), "first_height_implausible") == 1;
    };
    for (const double chord : {5e-4, 1.0, 300.0}) EXPECT_FALSE(warns(chord)) << "heights count chords";
    options.layer.first_height = input_units(1e-5);
    EXPECT_TRUE(warns(300));
    EXPECT_FALSE(warns(1));
    EXPECT_TRUE(warns(5e-4));
    options.layer.first_height = 5e-8;
    EXPECT_TRUE(warns(300));
    options.layer.first_height = YPlus{1};
    options.conditions.reynolds = 1e6;
    EXPECT_FALSE(warns(300)) << "a height that follows from the flow suits the chord";
}

TEST(Warnings, SurfacesThatAreNotAsAsked) {
    CaseOptions options = quick_options();
    options.surface = {};
    const auto warns = [&] {
        const std::vector<std::string> names = names_of(mesh_of({naca("0012")}, options).warnings);
        return std::count(names.begin(), names.end(), "surface_not_as_asked") == 1;
    };
    options.surface.points = 300;
    EXPECT_FALSE(warns());
    options.surface.treatment = SurfaceTreatment::keep;
    EXPECT_TRUE(warns());
    options.surface.points.reset();
    EXPECT_FALSE(warns());
}

TEST(Warnings, ThoseOfTheReaderNameTheElement) {
    Geometry geometry = shapes::geometry({naca("0012")});
    geometry.elements[0].name = "wing";
    geometry.elements[0].warnings.push_back({.code = WarningCode::reversed_flow, .message = "its nose is behind"});
    const Warning warning = expect_warning_of(generate_mesh(geometry, quick_options()), WarningCode::reversed_flow);
    EXPECT_EQ(warning.element, "wing");
    EXPECT_EQ(warning.message, "wing: its nose is behind");
}

TEST(Limits, RunsBeyondThemAreRefusedBeforeTheWork) {
    CaseOptions options = quick_options();
    const MeshResult whole = mesh_of({naca("0012")}, options);
    const auto made = whole.mesh.triangles.size();
    EXPECT_NEAR(whole.estimate.triangles / static_cast<double>(made), 1, 0.1);
    options.limits.max_triangles = made + made / 5;
    EXPECT_EQ(mesh_hash(mesh_of({naca("0012")}, options).mesh), mesh_hash(whole.mesh));

    options.limits.max_triangles = made / 2;
    std::vector<std::string> stages;
    try {
        generate_mesh(shapes::geometry({naca("0012")}), options,
                      [&](const ProgressEvent& event) { stages.push_back(event.stage); });
        ADD_FAILURE();
    } catch (const LimitError& error) {
        EXPECT_EQ(error.estimate().triangles, whole.estimate.triangles);
        EXPECT_EQ(error.option(), "gradation");
    }
    EXPECT_EQ(stages.back(), "sizing");

    options.limits = {};
    options.limits.max_memory_bytes = std::size_t{1} << 20;
    EXPECT_THROW(mesh_of({naca("0012")}, options), LimitError);
}

TEST(Limits, SpikesAcrossNineOrdersOfMagnitudeAreNotOverestimated) {
    shapes::Outline spike = naca("0012", 28);
    for (Point& p : spike)
        if (p.x >= 1) p = {1e9, 0};
    CaseOptions options = quick_options();
    options.surface = {};
    options.layer.first_height = 0.05;
    options.layer.layers = 2;
    options.layer.max_ray_angle_deg = 40;
    options.sizing.gradation = 0.9;
    const MeshResult result = mesh_of({spike}, options);
    EXPECT_LT(result.estimate.triangles, 10 * static_cast<double>(result.mesh.triangles.size()));
    expect_warning(result, WarningCode::first_height_implausible);
}

TEST(Limits, SingleOptionsAreRefusedByName) {
    CaseOptions options = quick_options(20);
    options.limits.max_memory_bytes = std::size_t{16} << 30;
    const auto refused_option = [&] {
        try {
            mesh_of({naca("0012")}, options);
        } catch (const LimitError& error) {
            return error.option();
        }
        return std::string();
    };
    options.sizing.far_size = 1e-3;
    EXPECT_EQ(refused_option(), "far_size");
    options.sizing.far_size.reset();
    options.surface.points = 10'000'000;
    for (const auto& [treatment, option] : {std::pair{SurfaceTreatment::keep, ""},  // has no use for the number
                                            std::pair{SurfaceTreatment::resample, "surface_points"},
                                            std::pair{SurfaceTreatment::automatic, "surface_points"}}) {
        options.surface.treatment = treatment;
        EXPECT_EQ(refused_option(), option);
    }
    options.surface = quick_options(20).surface;
    options.limits = {};
    options.limits.max_triangles = 1000;
    EXPECT_EQ(refused_option(), "layers");
}

}  // namespace
}  // namespace lamina::test
