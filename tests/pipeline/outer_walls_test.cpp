// Ground and tunnel walls near to bodies, with layers and without.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/threads.hpp>

#include "support/shapes.hpp"

namespace lamina {
namespace {

/// A section above ground, and how the flow meets that.
CaseOptions above_ground(double clearance, OuterWallKind ground = OuterWallKind::moving) {
    CaseOptions options;
    options.far_field.size = 20;
    options.far_field.ground = Length{clearance};
    options.far_field.ground_wall = ground;
    return options;
}

MeshResult mesh_of(const std::vector<std::string>& inputs, const CaseOptions& options) {
    MeshResult result = generate_mesh(inputs, options);
    const MeshCheck check = check_mesh(result.mesh);
    EXPECT_TRUE(check.valid());
    EXPECT_EQ(check.isotropic.angles_below_bound, check.isotropic.exempt);
    return result;
}

/// Returns the number of cells of columns whose origins fulfil a condition.
template <class Condition>
double cells_where(const MeshResult& result, Condition condition) {
    return static_cast<double>(std::count_if(result.columns.begin(), result.columns.end(), [&](std::uint32_t column) {
        return condition(result.mesh.points[result.column_origins[column].index()]);
    }));
}

TEST(OuterWalls, LayersBelowAWingNearTheGroundAreMade) {
    const double lowest = bounding_box(read_geometry(std::vector<std::string>{"naca:0012"})).lower.y;
    for (const double clearance : {0.03, 0.05, 0.15}) {
        const MeshResult result = mesh_of({"naca:0012"}, above_ground(clearance));
        const double ground = lowest - clearance;
        // The section is symmetric, so that its upper side has what the lower one should have.
        const double below = cells_where(result, [&](Point p) { return p.y < 0 && p.y > ground + 1e-9; });
        const double above = cells_where(result, [&](Point p) { return p.y > 0; });
        EXPECT_GT(below / above, clearance < 0.05 ? 0.78 : 0.82) << clearance;
        ASSERT_EQ(result.outer_walls.size(), 1u);
        const LayerCoverage& on_ground = result.outer_walls[0].coverage.all;
        EXPECT_GT(on_ground.made_cells, 0.9 * static_cast<double>(on_ground.requested_cells)) << clearance;
        ASSERT_EQ(result.check.walls.first_heights.size(), 2u);
        for (const FirstHeights& heights : result.check.walls.first_heights)
            EXPECT_EQ(heights.share_of_kept, 1) << heights.marker;
        EXPECT_EQ(result.check.walls.bare_edges, 0u);
        EXPECT_EQ(result.check.edges_without_first_layer, 0u);
    }
}

/// Returns the number of triangles beyond the layers with their middle in a box.
std::size_t triangles_in(const Box& box, const Mesh& mesh) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& [a, b, c] = mesh.triangles[t].v;
        const Point middle = (1.0 / 3) * (mesh.points[a.index()] + mesh.points[b.index()] + mesh.points[c.index()]);
        count += mesh.region[t] == Region::isotropic && box.contains(middle);
    }
    return count;
}

TEST(OuterWalls, AGapAboveTheGroundIsOneBetweenBodies) {
    const Geometry section = read_geometry(std::vector<std::string>{"naca:0012"});
    const double lowest = bounding_box(section).lower.y, clearance = 0.05;
    const MeshResult ground = mesh_of({"naca:0012"}, above_ground(clearance));
    CaseOptions options;
    options.far_field.size = 20;
    std::vector<Point> plate{{4, lowest - clearance - 0.2},
                             {4, lowest - clearance},
                             {-3, lowest - clearance},
                             {-3, lowest - clearance - 0.2}};
    Geometry with_plate =
        make_geometry({section.elements[0], element_of_points(plate, "plate")}, {.names = {"section", "plate"}});
    options.surface.treatment = SurfaceTreatment::resample;
    options.conditions.chord = 1;
    const MeshResult body = generate_mesh(with_plate, options);
    const Box gap{{0.2, lowest - clearance}, {0.8, 0}};
    const auto of_ground = static_cast<double>(triangles_in(gap, ground.mesh)),
               of_body = static_cast<double>(triangles_in(gap, body.mesh));
    EXPECT_GT(of_ground, 0.7 * of_body);
    EXPECT_LT(of_ground, 1.5 * of_body);
}

TEST(OuterWalls, EveryClearanceIsMeshed) {
    for (const double clearance : {1e-4, 1e-3, 0.05}) {
        for (const OuterWallKind kind : {OuterWallKind::slip, OuterWallKind::no_slip}) {
            CaseOptions options = above_ground(clearance, kind);
            const MeshResult result = mesh_of({"naca:4412"}, options);
            const Marker& ground = result.mesh.markers.back();
            EXPECT_EQ(ground.name, "ground");
            EXPECT_EQ(ground.kind, kind == OuterWallKind::slip ? MarkerKind::symmetry : MarkerKind::wall);
        }
        CaseOptions options = above_ground(clearance, OuterWallKind::slip);
        options.layer.enabled = false;
        mesh_of({"naca:0012"}, options);
    }
    CaseOptions tunnel;
    tunnel.far_field.tunnel = Length{0.3};
    tunnel.layer.enabled = false;
    mesh_of({"naca:0012"}, tunnel);
    tunnel.layer.enabled = true;
    tunnel.far_field.tunnel_walls = OuterWallKind::no_slip;
    EXPECT_EQ(mesh_of({"naca:0012"}, tunnel).outer_walls.size(), 2u);
}

TEST(OuterWalls, LayersHaveAFirstHeightOfTheirOwn) {
    CaseOptions options = above_ground(0.2);
    options.far_field.ground_layers = Length{1e-4};
    options.far_field.tunnel = Length{2};
    options.far_field.tunnel_walls = OuterWallKind::no_slip;
    options.far_field.tunnel_layers = YPlus{30};
    options.conditions.reynolds = 1e6;
    const MeshResult result = mesh_of({"naca:0012"}, options);
    ASSERT_EQ(result.outer_walls.size(), 2u);
    EXPECT_EQ(result.outer_walls[0].name, "ground");
    EXPECT_EQ(result.outer_walls[0].first_height, 1e-4);
    EXPECT_EQ(result.outer_walls[1].name, "ceiling");
    EXPECT_NEAR(result.outer_walls[1].first_height, 7e-4, 1e-4);
    for (const FirstHeights& heights : result.check.walls.first_heights)
        EXPECT_EQ(heights.share_of_kept, 1) << heights.marker;
}

TEST(OuterWalls, LayersFarFromTheBodyAreNoThickerThanTwoBoundaryLayers) {
    for (const double size : {40.0, 100.0}) {
        CaseOptions options = above_ground(0.1);
        options.far_field.size = size;
        options.conditions.reynolds = 1e6;
        const MeshResult result = mesh_of({"naca:0012"}, options);
        double lowest = 0;
        for (const Point p : result.mesh.points) lowest = std::min(lowest, p.y);
        double highest = 0;  // point of a cell of the layer on the ground, above it
        for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t)
            for (const VertexId v : result.mesh.triangles[t].v)
                if (const Point p = result.mesh.points[v.index()];
                    result.mesh.region[t] == Region::layer && std::abs(p.x) > 5)
                    highest = std::max(highest, p.y - lowest);
        const double domain = 2 * size + 1;
        EXPECT_NEAR(highest, 2 * 0.37 * domain * std::pow(1e6 * domain, -0.2), 0.02 * highest) << size;
        EXPECT_GE(result.check.transition.p01_area_ratio, 0.4);
        for (const FirstHeights& heights : result.check.walls.first_heights)
            EXPECT_EQ(heights.share_of_kept, 1) << heights.marker;
    }
}

TEST(OuterWalls, EveryTopologyHasThem) {
    for (const LayerTopology topology : {LayerTopology::delaunay, LayerTopology::quads}) {
        CaseOptions options = above_ground(0.05);
        options.layer.topology = topology;
        if (topology == LayerTopology::delaunay) options.layer.layers = 20;
        mesh_of({"naca:0012"}, options);
    }
}

TEST(OuterWalls, DoNotDependOnThreads) {
    CaseOptions options = above_ground(0.05);
    options.threads = 1;
    const std::string hash = mesh_hash(generate_mesh({"naca:0012"}, options).mesh);
    options.threads = 3;
    EXPECT_EQ(mesh_hash(generate_mesh({"naca:0012"}, options).mesh), hash);
}

/// Layers and wakes that the flow asks for have room above the ground, too.
TEST(OuterWalls, LayersGoOnAlongAWakeAboveGround) {
    CaseOptions options = above_ground(0.1, OuterWallKind::no_slip);
    options.conditions.reynolds = 1e6;
    options.layer.first_height = YPlus{1};
    options.layer.wake_layers = true;
    options.use_flow = true;
    const MeshResult result = mesh_of({"naca:4412"}, options);
    ASSERT_EQ(result.decisions.wakes.size(), 1u);
    EXPECT_GT(result.decisions.wakes[0].with_layers, 0.1);
}

}  // namespace
}  // namespace lamina
