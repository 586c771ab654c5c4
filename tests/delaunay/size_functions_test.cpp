// Refinement to sizes of functions, of background meshes and of areas; refinement of existing triangulations;
// conforming triangulations; limits of points.
#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/delaunay_queries.hpp>
#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "support/planar_graphs.hpp"
#include "support/point_sets.hpp"
#include "support/refinement_checks.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

/// A refinement with all its points.
struct RefinedTo {
    std::vector<Point> points;
    ConstrainedRefinement mesh;
};

RefinedTo refine_square(const SizeFunction& size, const ConstrainedRefineOptions& options = {}) {
    const Border square = square_border(1, 1);
    RefinedTo r{square.points, {}};
    r.mesh = refine(square.points, triangulate(square.points, square.segments), size, options);
    r.points.insert(r.points.end(), r.mesh.steiner_points.begin(), r.mesh.steiner_points.end());
    expect_valid(r.points, r.mesh.triangles, r.mesh.segments);
    EXPECT_NEAR(covered_area(r.points, r.mesh.triangles), 1, 1e-12);
    return r;
}

/// Counts the triangles that exceed their bounds.
std::size_t count_oversized(const RefinedTo& r, const SizeFunction& size, double max_area_ratio) {
    return std::size_t(std::count_if(r.mesh.triangles.begin(), r.mesh.triangles.end(), [&](const Triangle& t) {
        const Point a = r.points[t.v[0].index()], b = r.points[t.v[1].index()], c = r.points[t.v[2].index()];
        return is_oversized(a, b, c, (size(a) + size(b) + size(c)) / 3, max_area_ratio);
    }));
}

TEST(SizeFunctions, AnyFunctionBoundsTriangles) {
    const std::vector<SizeFunction> functions{
        [](Point p) { return 0.02 + 0.1 * length(p); }, [](Point p) { return p.x < 0.5 ? 0.02 : 0.2; },  // jumps
        [](Point p) { return 0.03 + 0.02 * std::sin(40 * p.x) * std::cos(30 * p.y); },                   // waves
        [](Point p) { return p.x + p.y > 1.8 ? 0.01 : HUGE_VAL; },  // a bound in one corner alone
    };
    for (const SizeFunction& size : functions) {
        const RefinedTo r = refine_square(size);
        EXPECT_EQ(r.mesh.stats.oversized, 0u);
        EXPECT_EQ(r.mesh.stats.below_bound, 0u);
        EXPECT_EQ(count_oversized(r, size, RefineOptions{}.max_area_ratio), 0u);
        EXPECT_GT(smallest_angle_deg(r.points, r.mesh.triangles), 20.7 - 1e-6);
        EXPECT_LT(r.mesh.triangles.size(), 30000u);
    }
}

TEST(SizeFunctions, UniformFunctionsMakeAsManyTrianglesAsFields) {
    const RefinedTo by_function = refine_square([](Point) { return 0.03; });
    const Border square = square_border(1, 1);
    const auto by_field = refine(square.points, triangulate(square.points, square.segments), SizeField(0.03),
                                 {.refine = {.lattice = false}});
    EXPECT_NEAR(double(by_function.mesh.triangles.size()), double(by_field.triangles.size()),
                0.03 * double(by_field.triangles.size()));
}

TEST(SizeFunctions, FunctionsThatReturnNoSizeAreErrors) {
    for (const double bad : {0.0, -1.0, std::nan("")}) {
        try {
            refine_square([bad](Point p) { return p.x > 0.5 && p.y > 0.5 && p.x < 0.9 ? bad : 0.1; });
            ADD_FAILURE() << "not refused";
        } catch (const InputError& e) {
            ASSERT_TRUE(e.place().at);
            EXPECT_GT(e.place().at->x, 0.5);
        }
    }
}

TEST(SizeFunctions, BackgroundMeshesGiveLinearSizes) {
    const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<Triangle> triangles = triangulate(corners).triangles;
    const SizeFunction size = sizes_of_mesh(corners, triangles, std::vector{0.02, 0.1, 0.18, 0.1});
    EXPECT_NEAR(size({0.25, 0.75}), 0.1, 1e-15);
    EXPECT_NEAR(size({0.5, 0.5}), 0.1, 1e-15);
    EXPECT_EQ(size({2, 2}), HUGE_VAL);
    const RefinedTo r = refine_square(size);
    EXPECT_EQ(count_oversized(r, size, RefineOptions{}.max_area_ratio), 0u);
    EXPECT_THROW(sizes_of_mesh(corners, triangles, std::vector{0.1, 0.1, 0.1}), InputError);
    try {
        sizes_of_mesh(corners, triangles, std::vector{0.1, 0.1, 0.0, 0.1});
        ADD_FAILURE() << "not refused";
    } catch (const InputError& e) {
        EXPECT_EQ(e.place().points, std::vector<std::size_t>{2});
    }
}

TEST(SizeFunctions, AreasBoundTheTrianglesInsideEachTriangle) {
    const std::vector<Point> points = random_points(30, 4);
    std::vector<Point> corners = square_border(1, 1).points;
    corners.insert(corners.end(), points.begin(), points.end());
    const ConstrainedTriangulation old = constrain_triangles(corners, triangulate(corners).triangles);
    Random random(5);
    std::vector<double> areas;
    for (std::size_t t = 0; t < old.triangles.size(); ++t)
        areas.push_back(t % 3 == 0 ? 0 : 1e-4 * std::pow(100, random.real()));
    constexpr double ratio = 1.2;
    const auto mesh = refine(corners, old, sizes_of_areas(corners, old.triangles, areas, ratio),
                             {.refine = {.max_area_ratio = ratio}});
    EXPECT_EQ(mesh.stats.oversized, 0u);
    std::vector<Point> all = corners;
    all.insert(all.end(), mesh.steiner_points.begin(), mesh.steiner_points.end());
    expect_valid(all, mesh.triangles, mesh.segments);
    std::size_t inside_one = 0;
    for (const Triangle& t : mesh.triangles) {
        const Point corner[3] = {all[t.v[0].index()], all[t.v[1].index()], all[t.v[2].index()]};
        for (std::size_t s = 0; s < old.triangles.size(); ++s) {
            const auto holds = [&](Point p) {
                const auto at = [&](int i) { return corners[old.triangles[s].v[i].index()]; };
                return orient2d(at(0), at(1), p) >= 0 && orient2d(at(1), at(2), p) >= 0 &&
                       orient2d(at(2), at(0), p) >= 0;
            };
            if (areas[s] <= 0 || !std::all_of(corner, corner + 3, holds)) continue;
            ++inside_one;
            EXPECT_LE(0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]), areas[s] * (1 + 1e-5));
        }
    }
    EXPECT_GT(inside_one, mesh.triangles.size() / 3);
}

TEST(ConstrainTriangles, FlipsAnyTriangulationToTheUniqueOne) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto points = seed % 2 ? random_grid_points(60, 9, seed) : random_points(80, seed);
        // The triangles of stretched points are a triangulation of the points that is far from Delaunay.
        std::vector<Point> stretched = points;
        for (Point& p : stretched) p.y *= 64;
        const std::vector<Triangle> skewed = triangulate(stretched).triangles;
        EXPECT_EQ(canonical(constrain_triangles(points, skewed).triangles), canonical(triangulate(points).triangles));
        std::vector<Segment> segments;
        for (std::size_t t = 0; t < skewed.size(); t += 3) segments.push_back({skewed[t].v[1], skewed[t].v[0]});
        segments.push_back(segments[0]);
        segments.push_back({VertexId{3u}, VertexId{3u}});
        const ConstrainedTriangulation flipped = constrain_triangles(points, skewed, segments);
        const ConstrainedTriangulation expected = triangulate(points, segments);
        EXPECT_EQ(canonical(flipped.triangles), canonical(expected.triangles));
        EXPECT_EQ(flipped.parents, expected.parents);
        EXPECT_EQ(flipped.segments, expected.segments);
        EXPECT_EQ(flipped.repeated_segments, expected.repeated_segments);
        EXPECT_EQ(flipped.zero_length_segments, 1u);
    }
    const std::vector<Point> square = square_border(1, 1).points;
    const std::vector<Triangle> triangles = triangulate(square).triangles;
    const std::vector<Segment> both_diagonals{{VertexId{0u}, VertexId{2u}}, {VertexId{1u}, VertexId{3u}}};
    EXPECT_THROW(constrain_triangles(square, triangles, both_diagonals), InputError);
}

TEST(ConstrainTriangles, RefinesWhatItWasGivenAndOnly) {
    // A mesh with a hole, refined once, and then again to smaller sizes.
    Border plate = square_border(3, 0.5);
    plate.add_loop({{1, 1}, {1, 2}, {2, 2}, {2, 1}}, 0.5);
    const auto first =
        refine(plate.points, triangulate(plate.points, plate.segments, {.keep = KeptRegion::even_odd}), SizeField(0.4));
    std::vector<Point> points = plate.points;
    points.insert(points.end(), first.steiner_points.begin(), first.steiner_points.end());
    const auto second = refine(points, constrain_triangles(points, first.triangles, first.segments), SizeField(0.1));
    std::vector<Point> all = points;
    all.insert(all.end(), second.steiner_points.begin(), second.steiner_points.end());
    expect_valid(all, second.triangles, second.segments);
    EXPECT_NEAR(covered_area(all, second.triangles), 8, 1e-12);
    EXPECT_EQ(second.stats.oversized, 0u);
    EXPECT_GT(second.triangles.size(), 10 * first.triangles.size());
}

TEST(Conforming, NoVertexLiesInTheCircleOfATriangle) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const PlanarGraph graph = random_planar_graph(seed).graph;
        const auto t = triangulate(graph.points, graph.segments, {.keep = KeptRegion::inside_segments});
        const auto mesh =
            refine(graph.points, t, SizeFunction([](Point) { return HUGE_VAL; }),
                   {.refine = {.min_angle_deg = 0, .smoothing = 0, .lattice = false}, .conforming = true});
        std::vector<Point> all = graph.points;
        all.insert(all.end(), mesh.steiner_points.begin(), mesh.steiner_points.end());
        expect_valid(all, mesh.triangles, mesh.segments);
        EXPECT_EQ(mesh.steiner_points.size(), mesh.on_segments);
        std::map<std::pair<std::size_t, std::size_t>, std::size_t> apex;
        for (const Triangle& triangle : mesh.triangles)
            for (int e = 0; e < 3; ++e)
                apex[{triangle.v[(e + 1) % 3].index(), triangle.v[(e + 2) % 3].index()}] = triangle.v[e].index();
        for (const auto& [ends, c] : apex) {
            const auto other = apex.find({ends.second, ends.first});
            if (other == apex.end()) continue;
            EXPECT_LE(incircle(all[ends.first], all[ends.second], all[c], all[other->second]), 0) << "seed " << seed;
        }
    }
}

TEST(MaxPoints, StopsWithAStatus) {
    const SizeFunction size = [](Point) { return 0.01; };
    for (const std::size_t max_points : {0u, 1u, 10u, 500u}) {
        const RefinedTo r =
            refine_square(size, {.refine = {.max_points = max_points, .stop_at_max_points = true, .lattice = false}});
        EXPECT_TRUE(r.mesh.stats.stopped);
        EXPECT_EQ(r.mesh.steiner_points.size(), max_points);
        EXPECT_GT(r.mesh.stats.oversized, 0u);
        EXPECT_THROW(refine_square(size, {.refine = {.max_points = max_points}}), MeshError);
    }
    const RefinedTo enough = refine_square(size, {.refine = {.max_points = 100000, .stop_at_max_points = true}});
    EXPECT_FALSE(enough.mesh.stats.stopped);
    const Border square = square_border(1, 0.02);
    for (const bool lattice : {false, true}) {
        const Refinement r = refine(square.points, square.segments, SizeField(0.02),
                                    {.max_points = 300, .stop_at_max_points = true, .lattice = lattice});
        EXPECT_TRUE(r.stats.stopped);
        EXPECT_EQ(r.steiner_points.size(), 300u);
        std::vector<Point> all = square.points;
        all.insert(all.end(), r.steiner_points.begin(), r.steiner_points.end());
        expect_valid(all, r.triangles, square.segments);
        EXPECT_GT(r.stats.oversized, 0u);
    }
}

}  // namespace
}  // namespace lamina::test
