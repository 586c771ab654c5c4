// Meshes of several elements, of concavities and of measured sections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include <lamina/error.hpp>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

CaseOptions options_with(std::uint32_t layers) {
    CaseOptions options = thesis_options();
    options.far_field.size = 15;
    options.layer.layers = layers;
    return options;
}

/// Returns a flap below and behind a main element of unit chord. The slot between them is about `gap` wide.
Outline flap(double gap) { return shapes::moved(naca("0012", 80), -0.4, 0.3, {1.0 - 0.02, -0.01 - gap}); }
/// Returns a slat in front of the main element.
Outline slat(double gap) { return shapes::moved(naca("0010", 60), 0.5, 0.15, {-0.13 - gap, -0.1}); }

TEST(SeveralBodies, FarApart) {
    const CaseOptions options = options_with(30);
    const MeshResult two = mesh_of({naca("0012"), shapes::moved(naca("4412"), 0.1, 0.7, {2, 0.6})}, options);
    expect_sound(two, options);
    expect_nothing_left_over(two);
    for (const ElementCoverage& coverage : two.layer_coverage) EXPECT_EQ(coverage.all.incomplete_rays, 0u);
    const MeshResult three = mesh_of({naca("0012"), shapes::moved(naca("4412"), 0.1, 0.7, {2, 0.6}),
                                      shapes::moved(shapes::circle(0.1, 60), 0, 1, {0, 1})},
                                     options);
    expect_sound(three, options);
    expect_nothing_left_over(three);
}

TEST(SeveralBodies, CloseTogether) {
    for (double gap : {0.1, 0.03, 0.01, 0.003}) {
        SCOPED_TRACE(gap);
        const CaseOptions options = options_with(30);
        const MeshResult two = mesh_of({naca("0012"), flap(gap)}, options);
        expect_sound(two, options);
        expect_nothing_left_over(two);
        const MeshResult three = mesh_of({naca("0012"), flap(gap), slat(gap)}, options);
        expect_sound(three, options);
        expect_nothing_left_over(three);
    }
}

TEST(SeveralBodies, WithoutLayers) {
    CaseOptions options = options_with(30);
    options.layer.enabled = false;
    for (double gap : {0.1, 0.01, 0.003}) {
        SCOPED_TRACE(gap);
        const MeshResult result = mesh_of({naca("0012"), flap(gap), slat(gap)}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.refinement.oversized, 0u);
    }
}

TEST(SeveralBodies, InSmallPieces) {
    CaseOptions options = options_with(30);
    options.decoupling.pieces_target = 1000;
    const MeshResult result = mesh_of({naca("0012"), flap(0.02), slat(0.02)}, options);
    expect_sound(result, options);
    EXPECT_EQ(result.refinement.oversized, 0u);
    EXPECT_GT(result.inviscid_pieces, 10u);
}

TEST(Concavities, LayersThatFillThem) {
    const std::map<const char*, Outline> outlines{{"L", shapes::refined(shapes::l_shape(), 20)},
                                                  {"C", shapes::refined(shapes::c_shape(0.3), 10)},
                                                  {"V", shapes::refined(shapes::v_notch(0.6), 20)},
                                                  {"comb", shapes::refined(shapes::comb(3, 0.2), 20)}};
    for (const auto& [name, outline] : outlines)
        for (std::uint32_t layers : {10u, 50u, 70u}) {
            SCOPED_TRACE(name + std::to_string(layers));
            const CaseOptions options = options_with(layers);
            const MeshResult result = mesh_of({outline}, options);
            expect_sound(result, options);
            EXPECT_EQ(result.check.isotropic.angles_below_bound, result.check.isotropic.exempt);
        }
}

/// A plate with a slit of 3 degrees. Triangles keep the bound, beside layers that are hardly thinned.
TEST(Concavities, LayersInASlitLeaveRoomForTheAnglesBeyond) {
    const Outline plate{{0, 0}, {1, 0}, {1, 0.1}, {0.62, 0.1}, {0.276, 0.0283}, {0.6, 0.1}, {0, 0.1}};
    CaseOptions options;
    options.far_field.size = 15;
    for (const bool mirrored : {false, true}) {
        const MeshResult result = mesh_of({mirrored ? shapes::mirrored(plate) : plate}, options);
        EXPECT_EQ(result.check.isotropic.unexcused(), 0u);
        EXPECT_EQ(result.check.isotropic.exempt, 0u);
        EXPECT_LT(result.thinned_rays, result.layer_coverage[0].all.rays / 10);
    }
}

std::filesystem::path shared_geometry() {
    const char* shared = std::getenv("LAMINA_SHARED");
    return std::filesystem::path(shared != nullptr ? shared : LAMINA_SOURCE_DIR "/../shared") / "geometry";
}

TEST(MeasuredSections, OfVariousThickness) {
    const auto folder = shared_geometry() / "uiuc/selig";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no collection of sections";
    for (const char* name : {"rae2822.dat", "e387.dat", "s1223.dat", "naca63a210.dat", "n0012.dat", "goe417a.dat"}) {
        SCOPED_TRACE(name);
        const MeshResult result = generate_mesh({(folder / name).string()}, thesis_options());
        expect_sound(result, thesis_options());
        expect_nothing_left_over(result);
        EXPECT_LT(result.check.isotropic.p999_neighbour_area_ratio, 3.5);
    }
}

TEST(MeasuredSections, SeveralElementsAreMeshedOrRefusedWithAReason) {
    const auto folder = shared_geometry() / "multielement";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no collection of sections";
    std::size_t meshed = 0;
    for (const std::vector<std::string>& names : std::initializer_list<std::vector<std::string>>{
             {"30p30n_main_raw.dat", "30p30n_slat_raw.dat", "30p30n_flap_raw.dat"},
             {"30p30n_uiuc.dat"},
             {"crmhl2d_main.dat", "crmhl2d_slat.dat", "crmhl2d_flap.dat"},
             {"nlr7301_clean_main.dat", "nlr7301_clean_flap.dat"},
             {"nlr7301_main_sharp.dat", "nlr7301_flap_sharp.dat"},
             {"nrl071_inverted_two_element.txt"},
             {"r1145ms_main.dat", "r1145ms_flap.dat"},
             {"s1210_base.dat", "s1210_slat.dat"},
             {"s414_main.dat", "s414_aft.dat"},
             {"ua79sf187_main_open.dat", "ua79sf187_flap.dat"},
             {"williams_two_element.dat"}}) {
        SCOPED_TRACE(names.front());
        std::vector<std::string> files;
        for (const std::string& name : names) files.push_back((folder / name).string());
        try {
            CaseOptions options = options_with(30);
            const Geometry geometry = read_geometry(files);
            options.layer.first_height = 2.5e-5;
            const MeshResult result = generate_mesh(geometry, options);
            expect_sound(result, options);
            expect_nothing_left_over(result);
            ++meshed;
        } catch (const Error& error) {
            std::printf("%s: %s\n", names.front().c_str(), error.what());
        }
    }
    EXPECT_GE(meshed, 8u);
}

}  // namespace
}  // namespace lamina::test
