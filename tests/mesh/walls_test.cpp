// The measures of walls: how even their edges are, and how high the first cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <lamina/error.hpp>
#include <lamina/mesh.hpp>

#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::shuffled;

/// The inner circle of the annulus has radius 1, the next one 1.2.
constexpr std::size_t around = 24;
const double step = 2 * std::numbers::pi / around;

TEST(Walls, OfAnEvenRing) {
    for (const bool quads : {false, true}) {
        // The far corners of a cell lie 1.2 cos(step / 2) from the middle in the direction of the edge's normal, and a
        // single one the same: the normal goes through the middle of both edges.
        const double height = 0.2 * std::cos(step / 2);
        for (unsigned seed = 0; seed < 3; ++seed) {
            const Mesh ring = annulus({.around = around, .quads_in_layer = quads});
            const WallSummary walls = check_mesh(seed == 0 ? ring : shuffled(ring, seed)).walls;
            EXPECT_EQ(walls.edges, around);
            EXPECT_EQ(walls.first_cells, around);
            EXPECT_NEAR(walls.max_ratio, 1, 1e-12);
            EXPECT_EQ(walls.uneven_vertices, 0u);
            EXPECT_NEAR(walls.median_first_height, height, 1e-12);
            EXPECT_EQ(walls.share_of_kept_heights, 1);
        }
    }
}

TEST(Walls, WithOneVertexOutOfPlace) {
    Mesh ring = annulus({.around = around});
    ring.points[3] = {std::cos(3.5 * step), std::sin(3.5 * step)};  // halfway to the next vertex of the wall
    const MeshCheck check = check_mesh(ring);
    ASSERT_TRUE(check.valid());
    const double ratio = std::sin(0.75 * step) / std::sin(0.25 * step);
    EXPECT_NEAR(check.walls.max_ratio, ratio, 1e-12);
    EXPECT_EQ(check.walls.max_ratio_at, ring.points[3]);
    EXPECT_EQ(check.walls.uneven_vertices, 3u);
    EXPECT_LT(check.walls.share_of_kept_heights, 1);
}

TEST(Walls, WithoutALayerSomewhere) {
    Mesh ring = annulus({.around = around});
    EXPECT_EQ(check_mesh(ring).walls.bare_edges, 0u);
    std::size_t bare = 0;
    for (std::size_t t = 0; t < ring.triangles.size(); ++t) {
        const auto& v = ring.triangles[t].v;
        const auto is_on_wall = [&](VertexId id) { return id.index() < around; };
        if (ring.layer[t] != 1 || std::count_if(v, v + 3, is_on_wall) != 2 || bare == 3) continue;
        ring.layer[t] = 0;
        ring.region[t] = Region::isotropic;
        ++bare;
    }
    const WallSummary walls = check_mesh(ring).walls;
    EXPECT_EQ(walls.bare_edges, 3u);
    EXPECT_NEAR(length(walls.bare_at), 1, 1e-12);
    EXPECT_EQ(walls.first_cells, around - 3);
    std::fill(ring.layer.begin(), ring.layer.end(), 0);
    std::fill(ring.region.begin(), ring.region.end(), Region::isotropic);
    EXPECT_EQ(check_mesh(ring).walls.bare_edges, 0u) << "a mesh without a layer";
}

TEST(Walls, CompareFirstHeightsWithTheOneAskedFor) {
    const Mesh ring = annulus({.around = around});
    const double height = 0.2 * std::cos(step / 2);
    EXPECT_EQ(check_mesh(ring, {.first_height = 1.005 * height}).walls.share_of_kept_heights, 1);
    const WallSummary walls = check_mesh(ring, {.first_height = 2 * height}).walls;
    EXPECT_EQ(walls.share_of_kept_heights, 0);
    EXPECT_NEAR(walls.worst_first_height, 0.5, 1e-12);
}

/// Half of the inner circle belongs to another wall.
TEST(Walls, CompareFirstHeightsWithThoseOfTheirMarkers) {
    Mesh ring = annulus({.around = around, .quads_in_layer = true});
    Marker& wall = ring.markers.front();
    ASSERT_TRUE(may_be_wall(wall.kind));
    Marker half{"half", wall.kind, {wall.edges.begin() + around / 2, wall.edges.end()}};
    wall.edges.resize(around / 2);
    ring.markers.push_back(half);
    const std::size_t markers = ring.markers.size();
    const double height = 0.2 * std::cos(step / 2);

    const WallSummary with_medians = check_mesh(ring).walls;
    ASSERT_EQ(with_medians.first_heights.size(), 2u);
    EXPECT_EQ(with_medians.first_heights[1].marker, "half");
    EXPECT_EQ(with_medians.first_heights[1].cells, around / 2);

    std::vector<double> wanted(markers, height);
    wanted.back() = 2 * height;
    const WallSummary walls = check_mesh(ring, {.first_heights = wanted}).walls;
    EXPECT_EQ(walls.first_heights[0].share_of_kept, 1);
    EXPECT_EQ(walls.first_heights[1].share_of_kept, 0);
    EXPECT_NEAR(walls.first_heights[1].median, height, 1e-12);
    EXPECT_NEAR(walls.share_of_kept_heights, 0.5, 1e-12);
    EXPECT_NEAR(walls.worst_first_height, 0.5, 1e-12);

    wanted.pop_back();
    EXPECT_THROW(check_mesh(ring, {.first_heights = wanted}), OptionError);
    EXPECT_THROW(check_mesh(ring, {.first_heights = std::vector<double>(markers, 0.0)}), OptionError);
}

}  // namespace
}  // namespace lamina
