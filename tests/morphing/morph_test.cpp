// The same mesh round changed walls: what stays, what is valid, and where motions end.
#include <lamina/morph.hpp>

#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "morphing/morphing_fixtures.hpp"

namespace lamina::test {

namespace {

bool have_same_bits(const std::vector<Point>& a, const std::vector<Point>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Point)) == 0;
}

TEST(Morph, WallsThatStayLeaveEveryBit) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
        Mesh mesh = mesh_to_morph({"naca:0012:100"}, topology);
        mesh.points.back().y = std::copysign(mesh.points.back().y, -1.0);  // -0 as well, where it is 0
        const MorphMap map(mesh);
        const MorphResult result = morph(map, map.wall_points());
        EXPECT_TRUE(have_same_bits(result.points, mesh.points));
        EXPECT_EQ(result.fraction, 1);
    }
    const Mesh slot = mesh_with_slot();
    const MorphMap map(slot);
    EXPECT_TRUE(have_same_bits(morph(map, map.wall_points()).points, slot.points));
}

TEST(Morph, LayersMoveAsRigidBodies) {
    const Mesh mesh = mesh_to_morph();
    const MorphMap map(mesh);
    const double c = 0.96, s = 0.28;  // 16 degrees
    const auto turn = [&](Point p) { return Point{c * p.x - s * p.y + 0.1, s * p.x + c * p.y - 0.05}; };
    const MorphResult result = morph(map, moved_walls(map, turn));
    expect_valid(map, result.points);
    // All but the vertices that divide the layer's border between two rays, where it ends early.
    std::size_t corners = 0, turned = 0;
    for (std::size_t cell = 0; cell < mesh.triangles.size(); ++cell) {
        if (mesh.region[cell] != Region::layer) continue;
        for (const VertexId v : mesh.triangles[cell].v) {
            const double off = distance(result.points[v.index()], turn(mesh.points[v.index()]));
            EXPECT_LT(off, 2e-3);
            ++corners;
            turned += off < 1e-14 ? 1 : 0;
        }
    }
    EXPECT_GT(turned, 0.98 * corners);
    EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 1e-9);
}

TEST(Morph, FirstHeightsAndAnglesStay) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::quads, LayerTopology::delaunay}) {
        const Mesh mesh = mesh_to_morph({"naca:0012:100"}, topology);
        const MorphMap map(mesh);
        for (const auto& [thickness, camber] : {std::pair{1.2, 0.0}, {0.8, 0.0}, {1.0, 0.02}, {1.0, -0.02}}) {
            const MorphResult result = morph(map, deformed_walls(map, thickness, camber));
            expect_valid(map, result.points);
            const MorphReport report = compare_morphed(map, result.points);
            EXPECT_LT(report.max_first_height_change, 0.01) << thickness << " " << camber;
            EXPECT_GT(report.after.mean_min_angle_deg, report.before.mean_min_angle_deg - 1);
            EXPECT_GT(report.after.min_scaled_jacobian, 0);
        }
    }
}

TEST(Morph, MeshesOfOthersHaveTheirRaysFound) {
    Mesh mesh = mesh_to_morph({"naca:0012:100"}, LayerTopology::quads);
    mesh.piece.clear();
    mesh.region.clear();
    mesh.layer.clear();
    mesh.constraints.clear();
    const MorphMap map(mesh);
    const MorphResult result = morph(map, deformed_walls(map, 1.2, 0.01));
    expect_valid(map, result.points);
    EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 0.01);
}

TEST(Morph, OnlyMeshesWithTheSameWallsAreCompared) {
    const Mesh mesh = mesh_to_morph();
    const MorphMap map(mesh);
    Mesh other = mesh;
    other.points.pop_back();
    EXPECT_THROW(compare_morphed(map, other), InputError);
    other = mesh;
    for (Marker& marker : other.markers) marker.kind = MarkerKind::other;
    EXPECT_THROW(compare_morphed(map, other), InputError);
}

TEST(Morph, MeshesWithoutLayersMoveToo) {
    CaseOptions options = options_to_morph();
    options.layer.enabled = false;
    const Mesh mesh = generate_mesh({"naca:0012:100"}, options).mesh;
    const MorphMap map(mesh);
    expect_valid(map, morph(map, deformed_walls(map, 0.8, 0.02)).points);
}

TEST(Morph, LayersGiveWayInSlots) {
    const Mesh mesh = mesh_with_slot();
    const MorphMap map(mesh);
    const auto raised = [&](double by) {
        return moved_walls(map, [&](Point p) { return p.x < 1.005 ? p : Point{p.x - 0.005, p.y + by}; });
    };
    for (const double by : {0.006, -0.02}) {
        const MorphResult result = morph(map, raised(by));
        expect_valid(map, result.points);
        EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 1e-9);
    }
}

// The border of a layer that ends early is divided between its rays: these vertices are on no ray.
TEST(Morph, BordersBetweenRaysAreDivided) {
    CaseOptions options = options_to_morph();
    options.layer.layers = 8;
    const Mesh mesh = generate_mesh({"naca:0012:80"}, options).mesh;
    const MorphMap map(mesh);
    for (const double thickness : {0.8, 1.2}) expect_valid(map, morph(map, deformed_walls(map, thickness, 0)).points);
}

TEST(Morph, WakesFollow) {
    CaseOptions options = options_to_morph();
    options.layer = {.first_height = 3e-6, .layers = std::nullopt, .wake_layers = true};
    options.conditions.reynolds = 6e6;
    options.use_flow = true;
    const Mesh mesh = generate_mesh({"naca:0012"}, options).mesh;
    const MorphMap map(mesh);
    for (const double thickness : {0.8, 1.2}) {
        const MorphResult result = morph(map, deformed_walls(map, thickness, 0));
        expect_valid(map, result.points);
        EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 0.01);
    }
}

// Slip ground stays a line between its ends, along which its vertices go with the section.
TEST(Morph, VerticesSlideAlongGround) {
    const Mesh mesh = mesh_over_ground();
    const MorphMap map(mesh);
    const MorphResult result = morph(map, moved_walls(map, [](Point p) { return Point{p.x + 0.1, p.y}; }));
    expect_valid(map, result.points);
    const MorphReport report = compare_morphed(map, result.points);
    EXPECT_GT(report.after.mean_min_angle_deg, report.before.mean_min_angle_deg - 0.1);
    ASSERT_EQ(mesh.markers.back().name, "ground");
    double farthest = 0;
    for (const Segment& edge : mesh.markers.back().edges) {
        const Point before = mesh.points[edge.a.index()], after = result.points[edge.a.index()];
        EXPECT_EQ(after.y, before.y);
        farthest = std::max(farthest, after.x - before.x);
        if (std::abs(before.x) > 9) {
            EXPECT_NEAR(after.x, before.x, 0.02);
        }
    }
    EXPECT_GT(farthest, 0.08);
}

TEST(Morph, ScalesWithTheMesh) {
    const Mesh mesh = mesh_to_morph();
    Mesh large = mesh;
    for (Point& p : large.points) p = 8 * p;
    const MorphMap map(mesh), large_map(large);
    const std::vector<Point> wall = deformed_walls(map, 1.1, 0.01);
    std::vector<Point> large_wall, expected;
    for (const Point p : wall) large_wall.push_back(8 * p);
    for (const Point p : map.positions(wall)) expected.push_back(8 * p);
    EXPECT_TRUE(have_same_bits(large_map.positions(large_wall), expected));
}

TEST(Morph, ThreadsDoNotChangeTheResult) {
    const Mesh mesh = mesh_to_morph();
    std::vector<std::vector<Point>> results;
    for (const unsigned threads : {1U, 3U})
        with_threads(threads, [&] {
            const MorphMap map(mesh);
            results.push_back(morph(map, deformed_walls(map, 0.9, 0.02)).points);
        });
    EXPECT_TRUE(have_same_bits(results[0], results[1]));
}

TEST(Morph, StopsBeforeACellTurnsOver) {
    const Mesh mesh = mesh_to_morph({"naca:0012:100"});
    const MorphMap map(mesh);
    const auto far = moved_walls(map, [](Point p) { return Point{p.x + 9, p.y}; });  // beyond the far field
    try {
        morph(map, far);
        FAIL() << "the motion is too large";
    } catch (const MeshError& error) {
        EXPECT_TRUE(error.at().has_value());
        EXPECT_NE(std::string(error.what()).find("triangle"), std::string::npos) << error.what();
    }
    const MorphResult result = morph(map, far, {.as_far_as_possible = true});
    expect_valid(map, result.points);
    EXPECT_GT(result.fraction, 0);
    EXPECT_LT(result.fraction, 1);
    EXPECT_EQ(64 * result.fraction, std::floor(64 * result.fraction));
    ASSERT_TRUE(result.stop.has_value());
}

TEST(Morph, GoesOnByFurtherMaps) {
    const Mesh mesh = mesh_with_slot();
    const MorphMap map(mesh);
    const std::vector<Point> wall = moved_wall_points(map, std::vector{parse_transformation("flap:rotate:20:1.3,0")});
    EXPECT_THROW(morph(map, wall), MeshError);
    const MorphResult result = morph(map, wall, {.incremental = true});
    EXPECT_EQ(result.fraction, 1);
    EXPECT_GT(result.maps, 1);
    expect_valid(map, result.points);
    for (std::size_t i = 0; i < wall.size(); ++i) EXPECT_EQ(result.points[map.walls().vertex[i].index()], wall[i]);
    // A long way is made of short ones.
    const std::vector<Point> far = moved_wall_points(map, std::vector{parse_transformation("flap:shift:0.3,-0.6")});
    EXPECT_EQ(morph(map, far, {.incremental = true}).fraction, 1);
    // Where bodies meet no number of maps gets through.
    const std::vector<Point> into = moved_wall_points(map, std::vector{parse_transformation("flap:shift:-0.2,0.03")});
    EXPECT_THROW(morph(map, into, {.incremental = true}), InputError);
    const MorphResult part = morph(map, into, {.as_far_as_possible = true, .incremental = true});
    EXPECT_LT(part.fraction, 1);
    expect_valid(map, part.points);
    // One map is enough for small motions.
    const std::vector<Point> near = moved_wall_points(map, std::vector{parse_transformation("flap:rotate:2:1.3,0")});
    EXPECT_EQ(morph(map, near, {.incremental = true}).points, map.positions(near));
}

TEST(Morph, RefusesOtherNumbersOfPoints) {
    const Mesh mesh = mesh_to_morph();
    const MorphMap map(mesh);
    const std::vector<Point> wall = map.wall_points(), less(wall.begin() + 1, wall.end());
    EXPECT_THROW(map.positions(less), InputError);
    EXPECT_THROW(map.jacobian_vector(less, wall), InputError);
    EXPECT_THROW(map.jacobian_vector(wall, less), InputError);
    EXPECT_THROW(map.vector_jacobian(wall, wall), InputError);
    EXPECT_THROW(map.vector_jacobian(less, mesh.points), InputError);
    EXPECT_THROW(compare_morphed(map, wall), InputError);
}

TEST(Morph, RefusesWallsThatAreNone) {
    const Mesh mesh = mesh_to_morph();
    const MorphMap map(mesh);
    std::vector<Point> wall = map.wall_points();
    wall[3].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(morph(map, wall), InputError);
    wall[3] = wall[4];
    EXPECT_THROW(morph(map, wall), InputError);
    wall.pop_back();
    EXPECT_THROW(morph(map, wall), InputError);
    // Both sides exchanged: the outline crosses itself.
    const auto crossed = moved_walls(map, [](Point p) { return Point{p.x, p.x > 0.5 ? -p.y : p.y}; });
    EXPECT_THROW(morph(map, crossed), InputError);
}

}  // namespace

}  // namespace lamina::test
