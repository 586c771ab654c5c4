// Families of similar meshes: refined().
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <lamina/error.hpp>

#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

/// The growth of these options round a chord of 1.
LayerGrowth growth_of(const CaseOptions& options) { return layer_growth(options.layer, {}); }

CaseOptions options_of_law(GrowthLaw law, std::uint32_t layers) {
    CaseOptions options;
    options.layer.growth_law = law;
    options.layer.layers = layers;
    if (law == GrowthLaw::polynomial) options.layer.growth = 2.2;
    if (law == GrowthLaw::exponential) options.layer.thickness = 0.03;
    return options;
}

TEST(Refined, TwoNewLayersLieInOneOldOne) {
    for (const GrowthLaw law : {GrowthLaw::geometric, GrowthLaw::polynomial, GrowthLaw::exponential}) {
        const CaseOptions options = options_of_law(law, 30);
        const LayerGrowth before = growth_of(options), after = growth_of(refined(options, 2));
        ASSERT_EQ(after.layers, 60u);
        for (std::uint32_t n = 1; n <= 30; ++n)
            EXPECT_NEAR(layer_height(after, 2 * n), layer_height(before, n), 1e-9 * layer_height(before, n))
                << static_cast<int>(law) << ' ' << n;
        // The way back.
        const LayerGrowth again = growth_of(refined(refined(options, 2), 0.5));
        EXPECT_EQ(again.layers, 30u);
        EXPECT_NEAR(again.first_height, before.first_height, 1e-9 * before.first_height);
    }
}

TEST(Refined, KeepsTheHeightOfAllLayersWhereNumbersAreRounded) {
    for (const GrowthLaw law : {GrowthLaw::geometric, GrowthLaw::polynomial, GrowthLaw::exponential})
        for (const std::uint32_t layers : {7u, 20u, 31u})
            for (const double ratio : {0.5, std::sqrt(0.5), std::sqrt(2.0), 1.7}) {
                const CaseOptions options = options_of_law(law, layers);
                const LayerGrowth before = growth_of(options), after = growth_of(refined(options, ratio));
                EXPECT_NEAR(*after.layers, ratio * layers, 0.5);
                const double height = layer_height(before, layers);
                EXPECT_NEAR(layer_height(after, *after.layers), height, 1e-6 * height);
            }
}

TEST(Refined, MultipliesNumbersOfWallEdges) {
    CaseOptions options;
    options.surface.side_edges = {{.upper = 60, .lower = 41, .base = 3}, {.upper = 20, .lower = 20, .element = "flap"}};
    const std::vector<SideEdges> fine = refined(options, 1.5).surface.side_edges;
    ASSERT_EQ(fine.size(), 2u);
    EXPECT_EQ(fine[0].upper, 90u);
    EXPECT_EQ(fine[0].lower, 62u);
    EXPECT_EQ(fine[0].base, std::optional<std::size_t>(5));
    EXPECT_EQ(fine[1].upper, 30u);
    EXPECT_EQ(fine[1].base, std::nullopt);
    EXPECT_EQ(fine[1].element, "flap");
}

TEST(Refined, RefusesWhatHasNoSimilarMesh) {
    CaseOptions options;
    EXPECT_THROW(refined(options, 0), OptionError);
    EXPECT_THROW(refined(options, -1), OptionError);
    options.layer.growth_law = GrowthLaw::aflr;
    EXPECT_THROW(refined(options, 2), OptionError);
    options = {};
    options.surface.treatment = SurfaceTreatment::keep;
    EXPECT_THROW(refined(options, 1), OptionError);
}

TEST(Refined, DividesTheSizesOfABackgroundMesh) {
    CaseOptions options;
    options.sizing.background = std::make_shared<const SizedMesh>(
        SizedMesh{{{0, 0}, {1, 0}, {0, 1}}, {{{VertexId(0u), VertexId(1u), VertexId(2u)}}}, {1, 2, 3}});
    EXPECT_EQ(refined(options, 2).sizing.background->sizes, (std::vector<double>{0.5, 1, 1.5}));
    EXPECT_EQ(options.sizing.background->sizes, (std::vector<double>{1, 2, 3}));
}

double layer_area(const Mesh& mesh) {
    double area = 0;
    const auto at = [&](VertexId v) { return mesh.points[v.index()]; };
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto& v = mesh.triangles[i].v;
        if (mesh.region[i] == Region::layer) area += 0.5 * cross(at(v[1]) - at(v[0]), at(v[2]) - at(v[0]));
    }
    return area;
}

/// Makes meshes with lengths divided by 1, sqrt 2 and 2, and expects that they are similar.
void expect_family(const Geometry& geometry, const CaseOptions& options) {
    std::vector<MeshResult> members;
    const double ratio = std::sqrt(2.0);
    const ReferenceConditions conditions = reference_conditions(options.conditions, bounding_box(geometry));
    for (const double divisor : {1.0, ratio, 2.0}) {
        members.push_back(generate_mesh(geometry, refined(options, divisor, conditions)));
        const MeshCheck check = check_mesh(members.back().mesh);
        EXPECT_EQ(check.defect_count, 0u);
        EXPECT_EQ(check.isotropic.unexcused(), 0u);
    }
    for (std::size_t k = 1; k < members.size(); ++k) {
        const MeshResult &coarse = members[k - 1], &fine = members[k];
        const auto quotient = [](std::size_t a, std::size_t b) {
            return static_cast<double>(a) / static_cast<double>(b);
        };
        EXPECT_NEAR(quotient(fine.mesh.points.size(), coarse.mesh.points.size()), 2, 0.2);
        EXPECT_NEAR(quotient(fine.surface_vertices, coarse.surface_vertices), ratio, 0.08);
        const double h = std::sqrt(quotient(coarse.mesh.triangles.size(), fine.mesh.triangles.size()));
        EXPECT_NEAR(h, 1 / ratio, 0.04);
        EXPECT_NEAR(layer_area(fine.mesh) / layer_area(coarse.mesh), 1, 0.06);
        ASSERT_EQ(fine.first_heights.size(), geometry.elements.size());
        // H(1 / ratio) / H(1) of geometric growth, where the number of layers may be rounded.
        const double growth = options.layer.growth;
        const double share = (std::pow(growth, std::pow(ratio, -double(k))) - 1) /
                             (std::pow(growth, std::pow(ratio, -double(k - 1))) - 1);
        for (std::size_t e = 0; e < fine.first_heights.size(); ++e) {
            EXPECT_NEAR(fine.first_heights[e] / coarse.first_heights[e], share, 0.025);
        }
        EXPECT_DOUBLE_EQ(fine.decisions.least_thickness, coarse.decisions.least_thickness);
    }
}

std::vector<Geometry> family_geometries() {
    return {shapes::geometry({naca("0012", 400)}), shapes::geometry({naca("4412", 400, TrailingEdge::blunt)}),
            shapes::geometry({naca("2412", 300), shapes::moved(naca("0012", 300), -0.4, 0.3, {0.98, -0.03})})};
}

TEST(Refined, MakesSimilarMeshes) {
    for (const Geometry& geometry : family_geometries()) {
        SCOPED_TRACE(geometry.elements.size());
        CaseOptions options;
        options.far_field.size = 20;
        expect_family(geometry, options);
    }
}

TEST(Refined, MakesSimilarMeshesWhereTheFlowDecides) {
    for (const Geometry& geometry : family_geometries()) {
        SCOPED_TRACE(geometry.elements.size());
        CaseOptions options;
        options.conditions = {.alpha_deg = 4, .reynolds = 5e6};
        options.far_field.size = 20;
        options.layer.first_height = YPlus{2};
        options.layer.layers.reset();
        options.surface.max_spacing = 0.015;
        options.use_flow = true;
        expect_family(geometry, options);
    }
}

}  // namespace
}  // namespace lamina::test
