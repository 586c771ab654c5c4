// The transition from layers up to isotropy to the isotropic triangles: cells on both sides have about equal areas.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "mesh/walls.hpp"
#include "pipeline/cases.hpp"

namespace lamina::test {
namespace {

CaseOptions automatic(double growth) {
    CaseOptions options;
    options.layer.first_height = 1e-5;
    options.layer.growth = growth;
    options.layer.layers.reset();
    options.far_field.size = 10;
    return options;
}

/// Returns the options for a layer that follows from the flow.
CaseOptions from_the_flow() {
    CaseOptions options = automatic(1.2);
    options.conditions = {.alpha_deg = 4, .reynolds = 5e6};
    options.layer.first_height = YPlus{1};
    options.use_flow = true;
    return options;
}

/// The ratios at the edges between the regions, each sorted.
struct Ratios {
    std::vector<double> areas;    ///< that of the layer's cell over that of the isotropic cell
    std::vector<double> heights;  ///< of the isotropic cell over that of the layer's cell, over the edge
};

Ratios ratios_of(const Mesh& mesh) {
    struct EdgeSide {
        bool layer;
        double area;
    };
    std::map<Segment, EdgeSide> sides;
    Ratios ratios;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const VertexId* v = mesh.triangles[t].v;
        const Point a = mesh.points[v[0].index()], b = mesh.points[v[1].index()], c = mesh.points[v[2].index()];
        const EdgeSide side{mesh.region[t] == Region::layer, 0.5 * cross(b - a, c - a)};
        for (int i = 0; i < 3; ++i) {
            const VertexId p = v[i], q = v[(i + 1) % 3];
            const auto [other, is_first] = sides.emplace(Segment{std::min(p, q), std::max(p, q)}, side);
            if (is_first || other->second.layer == side.layer) continue;
            const double ratio = side.layer ? side.area / other->second.area : other->second.area / side.area;
            ratios.areas.push_back(ratio);
            ratios.heights.push_back(1 / ratio);  // of two triangles with a common base
        }
    }
    std::sort(ratios.areas.begin(), ratios.areas.end());
    std::sort(ratios.heights.begin(), ratios.heights.end());
    return ratios;
}

/// Expects good area ratios, as every smooth section should have, and equal ones from check_mesh().
void expect_good_transition(std::initializer_list<shapes::Outline> bodies, const CaseOptions& options) {
    const MeshResult result = mesh_of(bodies, options);
    expect_sound(result, options);
    const auto [ratios, heights] = ratios_of(result.mesh);
    const TransitionSummary& summary = result.check.transition;
    ASSERT_GT(ratios.size(), 50u);
    ASSERT_EQ(summary.edges, ratios.size());
    const auto percentile = [&areas = ratios](std::size_t percent) {
        return areas[(areas.size() - 1) * percent / 100];
    };
    EXPECT_NEAR(summary.p01_area_ratio / percentile(1), 1, 1e-9);
    EXPECT_NEAR(summary.median_area_ratio / percentile(50), 1, 1e-9);
    EXPECT_NEAR(summary.p99_area_ratio / percentile(99), 1, 1e-9);
    EXPECT_NEAR(summary.p90_height_ratio / heights[(heights.size() - 1) * 90 / 100], 1, 1e-9);
    EXPECT_LT(summary.p90_height_ratio, 2);
    EXPECT_GT(percentile(50), 0.4);
    EXPECT_LT(percentile(50), 2.5);
    EXPECT_GT(percentile(1), 0.15);
    EXPECT_LT(percentile(99), 6);
}

TEST(Transition, SymmetricCamberedBluntAndCoarseSections) {
    for (const double growth : {1.1, 1.2, 1.3}) {
        SCOPED_TRACE(growth);
        expect_good_transition({naca("0012", 200)}, automatic(growth));
        expect_good_transition({naca("4415", 120)}, automatic(growth));
        expect_good_transition({naca("2412", 141, TrailingEdge::blunt)}, automatic(growth));
        expect_good_transition({naca("23012", 60)}, automatic(growth));
        expect_good_transition({shapes::joukowski(0.1, 0.1, 160)}, automatic(growth));
    }
}

/// What the fewest options give: an even wall, first cells as high as asked for, and a layer that ends without steps
/// and does not thin out at the trailing edge.
TEST(Transition, SectionsOfTheirFormulaHaveEvenWallsAndSmoothBorders) {
    for (const char* name : {"naca:0012", "naca:4412", "naca:23012", "naca:0006", "naca:0012:extended"}) {
        SCOPED_TRACE(name);
        const MeshResult result = generate_mesh({name}, automatic(1.2));
        const WallSummary& walls = result.check.walls;
        EXPECT_LE(walls.max_ratio, mesh::even_wall_ratio);
        EXPECT_EQ(walls.uneven_vertices, 0u);
        EXPECT_EQ(walls.first_cells, walls.edges);
        EXPECT_EQ(walls.share_of_kept_heights, 1);
        EXPECT_LT(result.border_steps.max_step, 0.5);
        EXPECT_EQ(result.border_steps.full_columns, result.border_steps.columns);
        EXPECT_GT(result.check.transition.p01_area_ratio, 0.5);
        EXPECT_LT(result.check.transition.p99_area_ratio, 2.25);
        EXPECT_LT(result.check.layer.max_angle_deg, 100);
        double beyond_tail = 0;  // of cells of the layer behind the trailing edge
        for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
            for (const VertexId v : result.mesh.triangles[t].v)
                if (result.mesh.region[t] == Region::layer)
                    beyond_tail = std::max(beyond_tail, result.mesh.points[v.index()].x - 1);
        EXPECT_GT(beyond_tail, 0.006);
        EXPECT_LT(beyond_tail, 0.02);
    }
}

/// Walls are divided finely at the corners of a base, where columns go far beyond isotropy. Cells on the rest of the
/// section once were a quarter as high as wide for it.
TEST(Transition, NarrowColumnsAtABaseLeaveTheOthersIsotropic) {
    for (const char* name : {"naca:0012:blunt", "naca:4412:blunt", "naca:0006:blunt"}) {
        SCOPED_TRACE(name);
        const CaseOptions options = from_the_flow();
        const MeshResult result = generate_mesh({name}, options);
        expect_sound(result, options);
        const TransitionSummary& transition = result.check.transition;
        EXPECT_GT(transition.p01_area_ratio, 0.5);
        EXPECT_GT(transition.median_area_ratio, 0.8);
        EXPECT_LT(transition.median_area_ratio, 1.25);
        EXPECT_LT(transition.p99_area_ratio, 2);
        EXPECT_LT(result.check.layer.max_angle_deg, 150);
    }
}

/// Tops of flat cells were halved where the border asks for edges a little shorter than they are, and the angle at the
/// middle of a top was 147 degrees.
TEST(Transition, TopsOfFlatCellsStayWhole) {
    const std::filesystem::path folder = LAMINA_SOURCE_DIR "/examples/geometry";
    std::vector<std::string> files;
    for (const char* name : {"slat", "main", "flap"})
        files.push_back((folder / (std::string("crmhl2d_") + name + ".dat")).string());
    CaseOptions options;
    options.layer.first_height = 2e-6;
    options.layer.growth = 1.2;
    options.layer.layers = 25;
    const MeshResult result = generate_mesh(files, options);
    expect_sound(result, options);
    EXPECT_LT(result.check.layer.max_angle_deg, 100);
}

/// Columns at the corners of wide bases remain narrow, though their rays lean. Half of their last cells had 2.7 times
/// the area of the triangles beyond.
TEST(Transition, NarrowColumnsEndInLowCells) {
    const CaseOptions options = from_the_flow();
    const MeshResult result = mesh_of({shapes::polygon({{1, 0.5}, {0, 0}, {1, -0.5}})}, options);
    expect_sound(result, options);
    EXPECT_GT(result.check.transition.p01_area_ratio, 0.5);
    EXPECT_LT(result.check.transition.p99_area_ratio, 1.8);
}

/// A wake leaves the layer between columns that are wider than its triangles. It divided tops of cells twice as high as
/// wide, and half of these cells had nine times the area of the triangles beyond.
TEST(Transition, WakesLeaveTheirLayersWithoutDividingHighCells) {
    const CaseOptions options = from_the_flow();
    shapes::Outline outline;
    for (const Point p : shapes::circle(0.5, 100)) outline.push_back(p + Point{0.5, 0});
    const MeshResult result = mesh_of({outline}, options);
    expect_sound(result, options);
    EXPECT_GT(result.check.transition.p01_area_ratio, 0.5);
    EXPECT_LT(result.check.transition.p99_area_ratio, 2);
}

/// Cells of a fan are as wide as its rays are apart, at any height. With a growth of 1.2 they would be 1.9 times as
/// high.
TEST(Transition, FansEndInLowCells) {
    const CaseOptions options = from_the_flow();
    const shapes::Outline diamond = shapes::polygon({{1, 0}, {0.5, 0.05}, {0, 0}, {0.5, -0.05}});
    const MeshResult result = mesh_of({diamond}, options);
    expect_sound(result, options);
    EXPECT_GT(result.check.transition.p01_area_ratio, 0.5);
    EXPECT_LT(result.check.transition.p99_area_ratio, 1.8);
}

TEST(Transition, TwoElements) {
    const shapes::Outline flap = shapes::moved(naca("2412", 120), -0.5, 0.3, {1.005, -0.03});
    expect_good_transition({naca("4412", 160), flap}, automatic(1.2));
}

}  // namespace
}  // namespace lamina::test
