// Which cells are taken for the boundary layer in meshes without regions.
#include <gtest/gtest.h>

#include <lamina/mesh.hpp>

namespace lamina::test {
namespace {

/// A square of side 1 over the wall from (0, 0) to (1, 0), cut at the heights in two triangles each.
Mesh stack(const std::vector<double>& heights) {
    Mesh mesh;
    for (const double y : heights)
        for (const double x : {0.0, 1.0}) mesh.points.push_back({x, y});
    const auto v = [](std::size_t i) { return VertexId(i); };
    Marker wall{"wall", MarkerKind::wall, {{v(0), v(1)}}}, far{"far", MarkerKind::far_field, {}};
    for (std::size_t row = 0; row + 1 < heights.size(); ++row) {
        const std::size_t a = 2 * row;
        mesh.triangles.push_back({{v(a), v(a + 1), v(a + 3)}});
        mesh.triangles.push_back({{v(a), v(a + 3), v(a + 2)}});
        far.edges.push_back({v(a + 1), v(a + 3)});
        far.edges.push_back({v(a + 2), v(a)});
    }
    const std::size_t top = mesh.points.size() - 2;
    far.edges.push_back({v(top + 1), v(top)});
    mesh.markers = {wall, far};
    return mesh;
}

TEST(EstimateRegions, ThinCellsAtAWallAreTheLayer) {
    const std::vector<Region> regions = estimate_regions(stack({0, 0.01, 0.1, 1}));
    ASSERT_EQ(regions.size(), 6u);
    for (std::size_t cell = 0; cell < 6; ++cell)
        EXPECT_EQ(regions[cell], cell < 4 ? Region::layer : Region::isotropic) << cell;
}

TEST(EstimateRegions, CellsAreNoLayerWithoutAWall) {
    Mesh mesh = stack({0, 0.01, 0.1, 1});
    mesh.markers[0].kind = MarkerKind::symmetry;
    EXPECT_TRUE(estimate_regions(mesh).empty());
    mesh.markers[0].kind = MarkerKind::other;  // of a file without kinds
    EXPECT_FALSE(estimate_regions(mesh).empty());
    EXPECT_TRUE(estimate_regions(stack({0, 0.8, 1.6})).empty());
    EXPECT_TRUE(estimate_regions(Mesh{}).empty());
}

// Thin cells beyond a gap of others are slivers rather than layer cells, unless rows of rectangles lead to them.
TEST(EstimateRegions, RowsOfRectanglesLeadOn) {
    const std::vector<Region> regions = estimate_regions(stack({0, 0.01, 1, 1.01}));
    EXPECT_EQ(regions[0], Region::layer);
    EXPECT_EQ(regions[2], Region::isotropic);
    EXPECT_EQ(regions[4], Region::layer);
    // Slanted rows do not lead on, but one of them makes no gap.
    Mesh slanted = stack({0, 0.01, 1, 2, 2.01});
    for (std::size_t i = 4; i < 10; ++i) slanted.points[i].x += i < 6 ? 0.4 : 0.8;
    const std::vector<Region> other = estimate_regions(slanted);
    EXPECT_EQ(other[0], Region::layer);
    EXPECT_EQ(other[6], Region::isotropic);
    slanted = stack({0, 0.01, 1, 1.01});
    for (std::size_t i = 4; i < 8; ++i) slanted.points[i].x += 0.4;
    EXPECT_EQ(estimate_regions(slanted)[4], Region::layer);
}

}  // namespace
}  // namespace lamina::test
