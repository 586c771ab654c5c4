// The case of the thesis (Figs. 24 to 28) through the library: NACA 0012, 30 layers, far field 50 chords away.
#include <gtest/gtest.h>

#include <lamina/io.hpp>
#include <lamina/predicates.hpp>

#include "pipeline/cases.hpp"
#include "support/layers.hpp"
#include "support/point_sets.hpp"
#include "support/temporary_folder.hpp"

namespace lamina::test {
namespace {

class ThesisCase : public testing::Test {
protected:
    static void SetUpTestSuite() { result_ = new MeshResult(generate_mesh({"naca:0012"}, thesis_options())); }
    static void TearDownTestSuite() { delete result_; }
    static const MeshResult& result() { return *result_; }
    static const Mesh& mesh() { return result_->mesh; }

private:
    static inline const MeshResult* result_ = nullptr;
};

TEST_F(ThesisCase, IsSoundAndLeavesNothingOver) {
    expect_sound(result(), thesis_options());
    expect_nothing_left_over(result());
    EXPECT_GE(result().check.isotropic.min_angle_deg, 20.7);
    EXPECT_EQ(mesh().markers[0].name, "airfoil");
    EXPECT_EQ(mesh().markers[1].name, "farfield");
}

TEST_F(ThesisCase, NoCellIsInvertedOrFlat) {
    for (const Triangle& t : mesh().triangles)
        ASSERT_GT(orient2d(mesh().points[t.v[0].index()], mesh().points[t.v[1].index()], mesh().points[t.v[2].index()]),
                  0);
}

TEST_F(ThesisCase, WallPointsComeFirstInTheOrderOfTheInput) {
    std::size_t next = 0;
    for (std::size_t v = 0; v < result().surface_vertices && next < 200; ++v)
        next += mesh().points[v] == result().geometry.elements[0].points[next];
    EXPECT_EQ(next, 200u);
}

TEST_F(ThesisCase, FarFieldIsTheSquareAskedFor) {
    Box box;
    for (const Segment& edge : mesh().markers.back().edges) box.include(mesh().points[edge.a.index()]);
    const Box body{{0, -0.1}, {1, 0.1}};
    EXPECT_NEAR(box.lower.x, body.center().x - 50, 1e-9);
    EXPECT_NEAR(box.upper.x, body.center().x + 50, 1e-9);
    EXPECT_NEAR(box.lower.y, -50, 1e-9);
    EXPECT_NEAR(box.upper.y, 50, 1e-9);
}

TEST_F(ThesisCase, HeightsAreTheRequestedOnesOnFullRays) {
    const LayerOptions options = thesis_options().layer;
    const std::set<Point, PointLess> vertices(mesh().points.begin(), mesh().points.end());
    const Layer layer = test::make_layer(result().geometry, options);
    EXPECT_EQ(layer.coverage[0].all.incomplete_rays, result().layer_coverage[0].all.incomplete_rays);
    std::size_t full = 0;
    for (const Ray& ray : layer.rays[0]) {
        if (ray.layers < options.layers) continue;
        ++full;
        Point below = layer.points[ray.origin.index()];
        double expected = test::first_height(options);
        for (std::size_t n = 0; n < ray.layers; ++n) {
            const Point p = layer.points[ray.first_point + n];
            EXPECT_TRUE(vertices.contains(p));
            EXPECT_NEAR(distance(below, p), expected, 0.01 * expected);
            expected = options.growth * distance(below, p);
            below = p;
        }
    }
    EXPECT_EQ(full, layer.rays[0].size());  // nothing is in the way of the rays of a convex section
}

TEST_F(ThesisCase, LayerCellsKnowTheirLayer) {
    std::vector<std::size_t> cells(31, 0);
    for (std::size_t t = 0; t < mesh().triangles.size(); ++t) {
        ASSERT_EQ(mesh().region[t] == Region::layer, mesh().layer[t] > 0);
        ASSERT_LE(mesh().layer[t], 30);
        ++cells[mesh().layer[t]];
    }
    for (std::size_t n = 2; n <= 30; ++n) EXPECT_GT(cells[n], 300u) << n;
}

TEST_F(ThesisCase, NeighboursDifferLittleInSize) {
    EXPECT_LT(result().check.isotropic.p999_neighbour_area_ratio, 3);
    EXPECT_LT(result().check.isotropic.max_neighbour_area_ratio, 4);
}

TEST_F(ThesisCase, ThreadsDoNotChangeAByte) {
    const TemporaryFolder folder;
    const auto bytes = [&](unsigned threads) {
        CaseOptions options = thesis_options();
        options.threads = threads;
        const MeshResult again = generate_mesh({"naca:0012"}, options);
        std::vector<std::string> files;
        for (const char* name : {"n.su2", "n.vtu"}) {
            write_mesh(again.mesh, folder / name);
            files.push_back(folder.read(name));
        }
        return files;
    };
    const auto one = bytes(1);
    EXPECT_TRUE(bytes(2) == one);
    EXPECT_TRUE(bytes(4) == one);
}

/// Fig. 23: at depths of 3 to 7 the layer is cut into 8 to 128 pieces, which do not change the mesh.
TEST(ThesisLayer, IsTheSameInPiecesOfAnyDepth) {
    CaseOptions options = thesis_options();
    options.layer.topology = LayerTopology::delaunay;
    options.sizing.gradation = 0.3;
    const auto in_pieces = [&](unsigned depth) {
        options.decomposition = {.depth = depth, .leaf_vertices = 10};
        return generate_mesh({"naca:0012:5000"}, options);
    };
    const auto whole = canonical(in_pieces(0).mesh.triangles);
    for (const unsigned depth : {3, 6, 7}) {
        SCOPED_TRACE(depth);
        const MeshResult result = in_pieces(depth);
        expect_sound(result, options);
        const DecompositionStats& stats = result.decomposition;
        EXPECT_EQ(stats.pieces, std::size_t{1} << depth);
        EXPECT_EQ(stats.fallbacks, 0u);
        EXPECT_LE(double(stats.largest_piece) * double(stats.pieces), 1.25 * double(stats.piece_vertices));
        EXPECT_TRUE(canonical(result.mesh.triangles) == whole);
    }
}

}  // namespace
}  // namespace lamina::test
