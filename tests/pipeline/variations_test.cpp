// One section with many options and in many positions: properties of each mesh, and likeness between them.
#include <gtest/gtest.h>

#include <lamina/error.hpp>

#include "pipeline/cases.hpp"
#include "support/layers.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

std::size_t triangles_of(const Outline& body, const CaseOptions& options) {
    const MeshResult result = mesh_of({body}, options);
    expect_sound(result, options);
    expect_nothing_left_over(result);
    return result.mesh.triangles.size();
}

TEST(Placement, HardlyChangesTheMesh) {
    const Outline body = naca("0012");
    const double count = double(triangles_of(body, quick_options()));
    const auto expect_alike = [&](const char* placement, const Outline& placed) {
        SCOPED_TRACE(placement);
        EXPECT_NEAR(double(triangles_of(placed, quick_options())), count, 0.03 * count);
    };
    expect_alike("moved", shapes::moved(body, 0, 1, {3, -7}));
    expect_alike("1e-3", shapes::moved(body, 0, 1e-3, {0, 0}));
    expect_alike("1e3", shapes::moved(body, 0, 1e3, {0, 0}));
    expect_alike("1e3 away", shapes::moved(body, 0, 1e3, {1e5, 1e5}));
    expect_alike("mirrored", shapes::mirrored(naca("0012")));
    expect_alike("mirrored", shapes::mirrored(naca("4412")));
    expect_alike("another start", shapes::started_at(body, 37));
}

/// When the section is turned, its extent in x shrinks, and the far field shrinks with it.
TEST(Placement, Turned) {
    const Outline body = naca("2412");
    for (double angle : {0.1, 0.7853981633974483, 1.5707963267948966, 2.0, 3.141592653589793, -0.3}) {
        SCOPED_TRACE(angle);
        triangles_of(shapes::moved(body, angle, 1, {0, 0}), quick_options());
    }
}

TEST(Placement, AnotherStartGivesTheSameTriangles) {
    const Outline body = naca("2412");
    const MeshResult a = mesh_of({body}, quick_options());
    const MeshResult b = mesh_of({shapes::started_at(body, 51)}, quick_options());
    EXPECT_EQ(mesh_hash(a.mesh), mesh_hash(b.mesh));
}

TEST(Sections, SharpBluntAndFiveDigit) {
    for (const char* digits : {"0012", "0006", "0024", "4412", "6409", "23012", "23112"}) {
        for (TrailingEdge tail : {TrailingEdge::sharp, TrailingEdge::blunt}) {
            SCOPED_TRACE(std::string(digits) + (tail == TrailingEdge::sharp ? " sharp" : " blunt"));
            triangles_of(naca(digits, tail == TrailingEdge::sharp ? 100 : 101, tail), quick_options());
        }
    }
}

TEST(Sections, FewAndManyPoints) {
    for (std::size_t points : {12, 40, 1000}) {
        SCOPED_TRACE(points);
        triangles_of(naca("0012", points), quick_options());
    }
}

TEST(Pieces, AnyTargetGivesASoundMesh) {
    const Outline body = naca("0012", 200);
    std::size_t whole = 0, before = 0;
    for (double target : {1e9, 50'000.0, 5'000.0, 800.0, 100.0}) {
        SCOPED_TRACE(target);
        CaseOptions options = thesis_options();
        options.decoupling.pieces_target = target;
        const MeshResult result = mesh_of({body}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        const std::size_t count = result.mesh.triangles.size();
        if (whole == 0) whole = count;
        EXPECT_LT(double(count), 1.2 * double(whole));
        EXPECT_GE(result.inviscid_pieces, before);
        before = result.inviscid_pieces;
    }
    EXPECT_GT(before, 40u);
}

/// Wright 1903 in pieces smaller than those of the program, which tests/golden has.
TEST(Pieces, SmallOnesKeepTheirHash) {
    CaseOptions options;
    options.layer.enabled = false;
    options.decoupling.pieces_target = 5'000;
    options.refine.min_angle_deg = 28;
    for (const unsigned threads : {1, 2, 5}) {
        options.threads = threads;
        const MeshResult result = generate_mesh({LAMINA_SOURCE_DIR "/examples/thesis/wright1903.dat"}, options);
        EXPECT_EQ(mesh_hash(result.mesh), "ff1805fdddacbcd8a270911e022215a1") << threads << " threads";
    }
}

TEST(Sizes, FewerTrianglesWithMoreGradation) {
    std::size_t before = SIZE_MAX;
    for (double gradation : {0.02, 0.05, 0.1, 0.2, 0.4}) {
        SCOPED_TRACE(gradation);
        CaseOptions options = quick_options();
        options.sizing.gradation = gradation;
        const MeshResult result = mesh_of({naca("0012", 200)}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.refinement.oversized, 0u);
        EXPECT_LT(result.mesh.triangles.size(), before);
        EXPECT_LT(result.check.isotropic.p999_neighbour_area_ratio, 3 + 4 * gradation);
        before = result.mesh.triangles.size();
    }
}

TEST(Sizes, AngleBounds) {
    for (double bound : {15.0, 20.7, 25.0, 28.0, 30.0}) {
        SCOPED_TRACE(bound);
        CaseOptions options = quick_options();
        options.refine.min_angle_deg = bound;
        const MeshResult result = mesh_of({naca("0012", 200)}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.refinement.oversized, 0u);
    }
}

/// Returns the longest edge of isotropic triangles in the window.
double longest_edge(const Mesh& mesh, const Box& window) {
    double longest = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        if (mesh.region[t] != Region::isotropic) continue;
        for (int k = 0; k < 3; ++k) {
            const Point a = mesh.points[mesh.triangles[t].v[k].index()];
            const Point b = mesh.points[mesh.triangles[t].v[(k + 1) % 3].index()];
            if (window.contains(a) && window.contains(b)) longest = std::max(longest, distance(a, b));
        }
    }
    return longest;
}

TEST(Sizes, WallSizeBoundsTheEdgesAtTheBorder) {
    for (double size : {0.002, 0.005, 0.02, 0.1, 10.0}) {
        SCOPED_TRACE(size);
        CaseOptions options = quick_options();
        options.sizing.wall_size = size;
        const MeshResult result = mesh_of({naca("0012", 200)}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        EXPECT_LT(longest_edge(result.mesh, {{0, -0.08}, {1, 0.08}}), 1.8 * (size + options.sizing.gradation * 0.1));
        EXPECT_LT(result.check.isotropic.max_neighbour_area_ratio, 4.5);
    }
}

TEST(Sizes, FarSizeBoundsAllAreas) {
    for (double size : {0.2, 1.0, 100.0}) {
        SCOPED_TRACE(size);
        CaseOptions options = quick_options();
        options.sizing.far_size = size;
        const MeshResult result = mesh_of({naca("0012", 200)}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        const double largest = options.refine.max_area_ratio * equilateral_area * size * size;
        for (const Triangle& t : result.mesh.triangles) {
            const auto& points = result.mesh.points;
            const Point a = points[t.v[0].index()];
            ASSERT_LE(0.5 * cross(points[t.v[1].index()] - a, points[t.v[2].index()] - a), largest * (1 + 1e-9));
        }
    }
}

TEST(FarField, AnyDistanceWithRoom) {
    for (double chords : {0.7, 1.0, 5.0, 50.0, 500.0}) {
        SCOPED_TRACE(chords);
        CaseOptions options = thesis_options();
        options.far_field.size = chords;
        const MeshResult result = mesh_of({naca("0012")}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
    }
}

TEST(FarField, Circle) {
    for (double chords : {0.8, 1.5, 5.0, 50.0, 500.0})
        for (double target : {50'000.0, 1'000.0}) {
            SCOPED_TRACE(chords);
            CaseOptions options = thesis_options();
            options.far_field.size = chords;
            options.far_field.shape = FarFieldShape::circle;
            options.decoupling.pieces_target = target;
            const MeshResult result = mesh_of({naca("0012")}, options);
            expect_sound(result, options);
            expect_nothing_left_over(result);
            EXPECT_LT(double(result.largest_inviscid_piece), 2 * target);
            double turned = 0;
            for (const Segment& edge : result.mesh.markers.back().edges) {
                const Point a = result.mesh.points[edge.a.index()] - Point{0.5, 0};
                const Point b = result.mesh.points[edge.b.index()] - Point{0.5, 0};
                ASSERT_NEAR(length(a), chords, 1e-6 * chords);
                turned += std::atan2(cross(a, b), dot(a, b));
            }
            EXPECT_NEAR(turned, 2 * M_PI, 1e-9);
        }
}

TEST(FarField, AnyConvexOutline) {
    const std::vector<std::vector<Point>> outlines{{{-20, -10}, {40, -10}, {30, 25}},
                                                   {{-2, -1}, {3, -1.5}, {4, 0.3}, {1, 2}, {-1.5, 1}},
                                                   {{-5, 0}, {0, -5}, {30, -5}, {30, 5}, {0, 5}}};
    for (const auto& outline : outlines)
        for (double target : {50'000.0, 1'000.0}) {
            SCOPED_TRACE(outline.size());
            CaseOptions options = thesis_options();
            options.far_field.shape = FarFieldShape::outline;
            options.far_field.outline = outline;
            options.decoupling.pieces_target = target;
            const MeshResult result = mesh_of({naca("0012")}, options);
            expect_sound(result, options);
            EXPECT_EQ(result.refinement.oversized, 0u);
            EXPECT_NEAR(result.check.area, enclosed_area(outline) - enclosed_area(naca("0012")), 1e-9 * 3600);
            EXPECT_LT(double(result.largest_inviscid_piece), 2 * target);
        }
    CaseOptions options = thesis_options();
    options.far_field.shape = FarFieldShape::outline;
    options.far_field.outline = {{-5, -5}, {5, -5}, {1, 0.5}, {5, 5}, {-5, 5}};
    EXPECT_THROW(mesh_of({naca("0012")}, options), UsageError);
    options.far_field.outline = {{5, 5}, {9, 5}, {9, 9}};
    EXPECT_THROW(mesh_of({naca("0012")}, options), UsageError);
}

TEST(FarField, WithoutRoomIsRefused) {
    for (double chords : {0.0, -1.0, 0.1, 0.5, 0.505}) {
        CaseOptions options = thesis_options();
        options.far_field.size = chords;
        EXPECT_THROW(mesh_of({naca("0012")}, options), UsageError) << chords;
    }
}

TEST(LayerOptionsInThePipeline, WithoutLayers) {
    CaseOptions options = quick_options();
    options.layer.enabled = false;
    for (const Outline& body : {naca("0012", 200), naca("23012", 101, TrailingEdge::blunt)}) {
        const MeshResult result = mesh_of({body}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.refinement.oversized, 0u);
        EXPECT_EQ(result.check.layer.cells, 0u);
        EXPECT_EQ(result.layer_pieces, 0u);
        EXPECT_TRUE(result.mesh.constraints.empty());
    }
}

TEST(LayerOptionsInThePipeline, RefinedCorners) {
    CaseOptions options = quick_options();
    options.layer.corners = CornerRays::refine;
    triangles_of(naca("0012"), options);
    triangles_of(naca("4412", 101, TrailingEdge::blunt), options);
}

TEST(LayerOptionsInThePipeline, ThinThickAndSingle) {
    const auto with = [](double first_height, double growth, std::uint32_t layers) {
        CaseOptions options = quick_options();
        options.layer.first_height = first_height;
        options.layer.growth = growth;
        options.layer.layers = layers;
        return options;
    };
    for (const CaseOptions& options :
         {with(1e-7, 1.2, 20), with(1e-6, 1.2, 60), with(1e-3, 1.1, 1), with(2e-3, 1.2, 20), with(1e-5, 1.01, 100)}) {
        SCOPED_TRACE(test::first_height(options.layer));
        const MeshResult result = mesh_of({naca("0012")}, options);
        expect_sound(result, options);
        EXPECT_EQ(result.refinement.oversized, 0u);
    }
}

}  // namespace
}  // namespace lamina::test
