// check_mesh() on good meshes, and on meshes that are broken in one way each.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include <lamina/mesh.hpp>

#include "core/parallel.hpp"
#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

using test::annulus;
using test::box_with_hole;
using test::shuffled;

std::string all_defects(const MeshCheck& check) {
    std::string text;
    for (const MeshDefect& defect : check.defects) text += defect.description + "\n";
    return text;
}

/// Expects the mesh to be invalid, with a defect whose description contains `said`.
void expect_defect(const Mesh& mesh, const std::string& said) {
    const MeshCheck check = check_mesh(mesh);
    EXPECT_FALSE(check.valid());
    EXPECT_NE(all_defects(check).find(said), std::string::npos) << "no '" << said << "' in:\n" << all_defects(check);
    EXPECT_LE(check.defects.size(), 20u);
    EXPECT_GE(check.defect_count, check.defects.size());
}

TEST(CheckMesh, AcceptsGoodMeshesInAnyOrder) {
    for (const Mesh& good : {annulus(), annulus({.quads_in_layer = true}), annulus({.layer_rings = 5}), box_with_hole(),
                             box_with_hole(1 + 2 * 20)}) {
        for (unsigned seed = 0; seed < 4; ++seed) {
            const MeshCheck check = check_mesh(seed == 0 ? good : shuffled(good, seed));
            EXPECT_TRUE(check.valid()) << all_defects(check);
            EXPECT_EQ(check.boundary_loops, 2u);
            EXPECT_EQ(check.euler_characteristic, 0);
        }
    }
}

TEST(CheckMesh, MeasuresTheBox) {
    const MeshCheck check = check_mesh(box_with_hole(5));
    EXPECT_DOUBLE_EQ(check.area, 24);
    EXPECT_EQ(check.isotropic.cells, 48u);
    EXPECT_EQ(check.layer.cells, 0u);
    EXPECT_NEAR(check.isotropic.min_angle_deg, 45, 1e-12);
    EXPECT_NEAR(check.isotropic.mean_min_angle_deg, 45, 1e-12);
    EXPECT_NEAR(check.isotropic.mean_ratio, std::sqrt(3.0) / 2, 1e-12);
    EXPECT_EQ(check.isotropic.share_below_40_deg, 0);
    EXPECT_NEAR(check.isotropic.max_angle_deg, 90, 1e-12);
    EXPECT_NEAR(check.isotropic.max_aspect_ratio, 2, 1e-12);
    EXPECT_EQ(check.isotropic.max_neighbour_area_ratio, 1);
    EXPECT_EQ(check.isotropic.p999_neighbour_area_ratio, 1);
    EXPECT_EQ(check.isotropic.angle_histogram[8] + check.isotropic.angle_histogram[9], 48u);
    EXPECT_EQ(check.isotropic.angles_below_bound, 0u);
    EXPECT_EQ(check_mesh(box_with_hole(5), {.min_angle_deg = 50}).isotropic.angles_below_bound, 48u);
    // 3 triangles = 2 interior edges + boundary edges
    EXPECT_EQ(check.interior_edges, (3u * 48 - 24) / 2);
    EXPECT_EQ(check.delaunay_violations, 0u);  // cocircular points are no violation
}

TEST(CheckMesh, TellsRegionsApart) {
    const Mesh mesh = annulus({.around = 24, .rings = 5, .layer_rings = 2, .quads_in_layer = true});
    const MeshCheck check = check_mesh(mesh);
    EXPECT_EQ(check.layer.cells, 48u);
    EXPECT_EQ(check.isotropic.cells, 144u);
    // Three rings of trapezoids have a diagonal and a side each, and there are two circles between them.
    EXPECT_EQ(check.interior_edges, 24u * (3 + 3 + 2));
    const double trapezoid_growth = 1.2 * 1.2;
    EXPECT_NEAR(check.isotropic.max_neighbour_area_ratio, trapezoid_growth, 0.3);
    // The trapezoid inside the border and the half of the one outside have a common edge.
    EXPECT_NEAR(check.layer.max_neighbour_area_ratio, (1 + 1 / 1.2) / 1.2, 1e-9);
    const Point at = check.layer.max_neighbour_area_ratio_at;
    EXPECT_NEAR(std::hypot(at.x, at.y), 1.2 * 1.2 * std::cos(std::numbers::pi / 24), 1e-9);
    EXPECT_NEAR(check.transition.median_area_ratio, (1 + 1 / 1.2) / 1.2, 1e-9);
    EXPECT_NEAR(check.transition.p90_height_ratio, 1.2, 1e-9);
    // 24 trapezoids make a circle, so their corners are 7.5 degrees off a right angle.
    EXPECT_NEAR(check.layer.mean_max_angle_deg, 97.5, 1e-9);
    EXPECT_EQ(check.edges_without_first_layer, 0u);
}

/// A corner of the outline is pulled out, so that its cells are far larger than those beside it.
TEST(CheckMesh, FindsTheLargestRatioOfAreas) {
    for (const bool quads : {false, true}) {
        Mesh mesh = annulus({.around = 24, .rings = 3, .layer_rings = 3, .quads_in_layer = quads});
        mesh.points[3 * 24] = 100 * mesh.points[3 * 24];
        for (const unsigned seed : {0u, 1u, 2u}) {
            const MeshCheck check = check_mesh(seed == 0 ? mesh : shuffled(mesh, seed));
            EXPECT_EQ(check.isotropic.cells, 0u);
            EXPECT_GT(check.layer.max_neighbour_area_ratio, quads ? 50 : 100);
            // Across the inner edge of one of the cells, or across the side that they have in common with others.
            const Point at = check.layer.max_neighbour_area_ratio_at;
            EXPECT_NEAR(std::hypot(at.x, at.y), 1.4, 0.4);
        }
    }
}

TEST(CheckMesh, CountsEdgesWhoseCellSkipsTheFirstLayer) {
    for (const bool quads : {false, true}) {
        Mesh mesh = annulus({.around = 24, .rings = 5, .layer_rings = 2, .quads_in_layer = quads});
        for (std::size_t cell = 0; cell < mesh.layer.size(); ++cell)
            if (mesh.layer[cell] == 1 && cell % 3 == 0) mesh.layer[cell] = 2;
        const std::size_t on_the_wall = check_mesh(mesh).edges_without_first_layer;
        EXPECT_EQ(on_the_wall, 8u);
        mesh.layer.clear();
        EXPECT_EQ(check_mesh(mesh).edges_without_first_layer, 0u);
    }
}

TEST(CheckMesh, CountsDelaunayViolationsButNotOnConstraintsOrInTheLayer) {
    Mesh mesh = box_with_hole(5);
    mesh.points[7] = {1.0, 1.25};  // makes the diagonal of one of the squares round it a violation
    const MeshCheck check = check_mesh(mesh);
    EXPECT_TRUE(check.valid()) << all_defects(check);
    EXPECT_GT(check.delaunay_violations, 0u);

    Mesh exempt = mesh;
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) {
            const VertexId a = t.v[i], b = t.v[(i + 1) % 3];
            exempt.constraints.push_back({std::min(a, b), std::max(a, b)});
        }
    const MeshCheck without = check_mesh(exempt);
    EXPECT_TRUE(without.valid()) << all_defects(without);
    EXPECT_EQ(without.delaunay_violations, 0u);
    EXPECT_EQ(without.interior_edges, 0u);

    Mesh layered = mesh;
    layered.region.assign(mesh.triangles.size(), Region::layer);
    EXPECT_EQ(check_mesh(layered).delaunay_violations, 0u);
}

TEST(CheckMesh, FindsOneUlpOfDelaunayViolation) {
    // A square is split along its diagonal, and one corner is moved inwards by one unit in the last place.
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}, {{VertexId(0), VertexId(2), VertexId(3)}}};
    mesh.markers = {{"all", MarkerKind::other, {}}};
    for (std::size_t i = 0; i < 4; ++i) mesh.markers[0].edges.push_back({VertexId(i), VertexId((i + 1) % 4)});
    EXPECT_EQ(check_mesh(mesh).delaunay_violations, 0u);
    mesh.points[1].x = std::nextafter(1.0, 0.0);
    EXPECT_EQ(check_mesh(mesh).delaunay_violations, 1u);
    mesh.points[1].x = std::nextafter(1.0, 2.0);
    EXPECT_EQ(check_mesh(mesh).delaunay_violations, 0u);
    EXPECT_TRUE(check_mesh(mesh).valid());
}

TEST(CheckMesh, DoesNotDependOnThreads) {
    const Mesh mesh = shuffled(annulus({.around = 400, .rings = 60, .layer_rings = 20, .quads_in_layer = true}), 3);
    MeshCheck one, four;
    with_threads(1, [&] { one = check_mesh(mesh); });
    with_threads(4, [&] { four = check_mesh(mesh); });
    EXPECT_TRUE(one.valid()) << all_defects(one);
    EXPECT_EQ(one.area, four.area);
    EXPECT_EQ(one.isotropic.mean_min_angle_deg, four.isotropic.mean_min_angle_deg);
    EXPECT_EQ(one.isotropic.mean_ratio, four.isotropic.mean_ratio);
    EXPECT_EQ(one.isotropic.p999_neighbour_area_ratio, four.isotropic.p999_neighbour_area_ratio);
    EXPECT_EQ(one.delaunay_violations, four.delaunay_violations);
    EXPECT_EQ(one.interior_edges, four.interior_edges);
    Mesh broken = mesh;
    for (std::size_t i = 0; i < broken.triangles.size(); i += 7)
        std::swap(broken.triangles[i].v[0], broken.triangles[i].v[1]);
    with_threads(1, [&] { one = check_mesh(broken); });
    with_threads(4, [&] { four = check_mesh(broken); });
    EXPECT_EQ(one.defect_count, four.defect_count);
    EXPECT_EQ(all_defects(one), all_defects(four));
}

TEST(CheckMeshDefects, Cells) {
    Mesh mesh = annulus();
    std::swap(mesh.triangles[60].v[0], mesh.triangles[60].v[1]);
    expect_defect(mesh, "clockwise or folded triangle 60");
    expect_defect(mesh, "more than one cell or with one on the same side");

    mesh = box_with_hole();
    mesh.points[7] = {2, 2};  // on its diagonal neighbour
    expect_defect(mesh, "flat triangle");

    mesh = annulus();
    mesh.triangles.push_back(mesh.triangles[3]);
    mesh.piece.push_back(0);
    mesh.region.push_back(Region::layer);
    mesh.layer.push_back(1);
    expect_defect(mesh, "shares its edge");

    mesh = box_with_hole();
    mesh.triangles.erase(mesh.triangles.begin() + 2);
    expect_defect(mesh, "is in no marker");

    mesh = annulus({.quads_in_layer = true});
    std::swap(mesh.quads[5].v[1], mesh.quads[5].v[2]);
    expect_defect(mesh, "quad 5");
    mesh = annulus({.quads_in_layer = true});
    std::swap(mesh.quads[5].v[1], mesh.quads[5].v[3]);
    expect_defect(mesh, "clockwise or folded quad 5");
}

TEST(CheckMeshDefects, ConcaveQuadsAreSimpleButBowTiesAreNot) {
    Mesh mesh;
    mesh.points = {{0, 0}, {2, 0}, {0.5, 0.5}, {0, 2}};
    mesh.quads = {{{VertexId(0), VertexId(1), VertexId(2), VertexId(3)}}};
    mesh.markers = {{"all", MarkerKind::other, {}}};
    for (std::size_t i = 0; i < 4; ++i) mesh.markers[0].edges.push_back({VertexId(i), VertexId((i + 1) % 4)});
    EXPECT_TRUE(check_mesh(mesh).valid()) << all_defects(check_mesh(mesh));
    EXPECT_GT(check_mesh(mesh).isotropic.max_angle_deg, 180);
    mesh.points[2] = {-1, -1};
    expect_defect(mesh, "quad 0");
    mesh.points[2] = {2, 2};
    std::swap(mesh.points[1], mesh.points[2]);
    expect_defect(mesh, "quad 0");
}

TEST(CheckMeshDefects, Arrays) {
    expect_defect(Mesh{}, "no cells");
    Mesh mesh = annulus();
    mesh.triangles[9].v[2] = VertexId(mesh.points.size());
    expect_defect(mesh, "triangle 9 (");
    mesh = annulus({.quads_in_layer = true});
    mesh.quads[9].v[3] = VertexId();
    expect_defect(mesh, "index out of range");
    mesh = annulus();
    mesh.markers[1].edges[2].b = VertexId(100'000);
    expect_defect(mesh, "marker 'farfield' has an index out of range");
    mesh = annulus();
    mesh.constraints[0].a = VertexId(100'000);
    expect_defect(mesh, "constraint 100000");
    mesh = annulus();
    mesh.layer.pop_back();
    expect_defect(mesh, "'layer'");
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, 1e200, 1e-200}) {
        mesh = annulus();
        mesh.points[40].y = bad;
        expect_defect(mesh, "vertex 40 (");
    }
}

TEST(CheckMeshDefects, Vertices) {
    Mesh mesh = annulus();
    mesh.points.push_back({0.1, 0.1});
    expect_defect(mesh, "vertex 144 belongs to no cell");

    // A hanging node: one of two neighbours is split at the middle of their common edge.
    mesh = box_with_hole();
    const Triangle t = mesh.triangles[20];
    const VertexId hanging(mesh.points.size());
    mesh.points.push_back(midpoint(mesh.points[t.v[2].index()], mesh.points[t.v[0].index()]));
    mesh.triangles[20] = {{t.v[0], t.v[1], hanging}};
    mesh.triangles.push_back({{hanging, t.v[1], t.v[2]}});
    expect_defect(mesh, "is in no marker");
    // The mesh stays invalid when the edges of the crack are put into a marker.
    mesh.markers.push_back({"crack", MarkerKind::other, {{t.v[2], hanging}, {hanging, t.v[0]}, {t.v[0], t.v[2]}}});
    expect_defect(mesh, "passes twice through vertex");

    // Two squares meet at one vertex only.
    mesh = {};
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 1}, {2, 2}, {1, 2}};
    const std::size_t squares[2][4] = {{0, 1, 2, 3}, {2, 4, 5, 6}};
    mesh.markers = {{"all", MarkerKind::other, {}}};
    for (const auto& s : squares) {
        mesh.quads.push_back({{VertexId(s[0]), VertexId(s[1]), VertexId(s[2]), VertexId(s[3])}});
        for (int i = 0; i < 4; ++i) mesh.markers[0].edges.push_back({VertexId(s[i]), VertexId(s[(i + 1) % 4])});
    }
    expect_defect(mesh, "the boundary passes twice through vertex 2");
}

TEST(CheckMeshDefects, Markers) {
    Mesh mesh = annulus();
    mesh.markers[0].edges.pop_back();
    expect_defect(mesh, "is in no marker");
    mesh = annulus();
    mesh.markers[1].edges.push_back(mesh.markers[0].edges[0]);
    expect_defect(mesh, "marked twice, once as 'farfield'");
    mesh = annulus();
    mesh.markers[0].edges[4] = {VertexId(30), VertexId(31)};
    expect_defect(mesh, "edge 30-31 of marker 'wall' is not on the boundary");
    mesh = annulus();
    std::swap(mesh.markers[0].edges[4].a, mesh.markers[0].edges[4].b);
    expect_defect(mesh, "has the mesh on its right");
    mesh = annulus();
    mesh.markers[1].name = "wall";
    expect_defect(mesh, "two markers are named 'wall'");
    mesh = annulus();
    mesh.constraints.push_back({VertexId(0), VertexId(12)});
    expect_defect(mesh, "constraint 0-12 is no edge of the mesh");
}

/// Returns separate parts, each of which has its own points and one of these outlines. All edges are in one marker.
Mesh islands(const std::vector<std::vector<Point>>& outlines) {
    Mesh mesh;
    mesh.markers = {{"all", MarkerKind::other, {}}};
    for (const auto& outline : outlines) {
        const std::size_t first = mesh.points.size(), n = outline.size();
        mesh.points.insert(mesh.points.end(), outline.begin(), outline.end());
        for (std::size_t i = 0; i < n; ++i)
            mesh.markers[0].edges.push_back({VertexId(first + i), VertexId(first + (i + 1) % n)});
        for (std::size_t i = 1; i + 1 < n; ++i)
            mesh.triangles.push_back({{VertexId(first), VertexId(first + i), VertexId(first + i + 1)}});
    }
    return mesh;
}

TEST(CheckMeshDefects, OverlappingBoundaryLoops) {
    const std::vector<Point> square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
    const auto moved = [&](double x, double y, double scale) {
        std::vector<Point> result;
        for (const Point p : square) result.push_back(Point{x, y} + scale * p);
        return result;
    };
    EXPECT_TRUE(check_mesh(islands({square, moved(5, 0, 1)})).valid());
    EXPECT_EQ(check_mesh(islands({square, moved(5, 0, 1)})).euler_characteristic, 2);
    expect_defect(islands({square, moved(3, 3, 1)}), "cross, touch or overlap");   // corners overlap
    expect_defect(islands({square, moved(4, 0, 1)}), "cross, touch or overlap");   // a seam of doubled points
    expect_defect(islands({square, moved(4, 1, .5)}), "cross, touch or overlap");  // collinear, no common point
    expect_defect(islands({square, moved(4, 4, 1)}), "cross, touch or overlap");   // a doubled point
    expect_defect(islands({square, moved(1, 1, .5)}), "overlap others");           // one lies within the other
    expect_defect(islands({moved(1, 1, .5), square}), "overlap others");
    // An island may lie in the hole of another mesh, but not beside the hole.
    const auto with_island = [&](Point at) {
        Mesh mesh = box_with_hole(5);
        const Mesh island = islands({{at, at + Point{.25, 0}, at + Point{0, .25}}});
        const std::size_t first = mesh.points.size();
        mesh.points.insert(mesh.points.end(), island.points.begin(), island.points.end());
        const auto shifted = [&](VertexId v) { return VertexId(first + v.index()); };
        for (const Triangle& t : island.triangles)
            mesh.triangles.push_back({{shifted(t.v[0]), shifted(t.v[1]), shifted(t.v[2])}});
        mesh.markers.push_back({"island", MarkerKind::other, {}});
        for (const Segment& e : island.markers[0].edges)
            mesh.markers.back().edges.push_back({shifted(e.a), shifted(e.b)});
        return mesh;
    };
    EXPECT_TRUE(check_mesh(with_island({2.3, 2.3})).valid()) << all_defects(check_mesh(with_island({2.3, 2.3})));
    expect_defect(with_island({3.3, 3.1}), "overlap others");
}

TEST(CheckMeshDefects, FoldedStripAndDoubleCover) {
    // A strip of counter-clockwise quads runs one and a half times round an annulus and overlaps itself. Its cells and
    // interior edges are all correct; only the boundary crosses itself.
    Mesh mesh;
    mesh.markers = {{"all", MarkerKind::other, {}}};
    const std::size_t n = 24, cells = 36;
    for (std::size_t i = 0; i <= cells; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        const double shift = 0.01 * static_cast<double>(i);
        for (const double radius : {1 + shift, 2 + shift})
            mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    auto& edges = mesh.markers[0].edges;
    for (std::size_t i = 0; i < cells; ++i) {
        mesh.quads.push_back({{VertexId(2 * i), VertexId(2 * i + 1), VertexId(2 * i + 3), VertexId(2 * i + 2)}});
        edges.push_back({VertexId(2 * i + 1), VertexId(2 * i + 3)});
        edges.push_back({VertexId(2 * i + 2), VertexId(2 * i)});
    }
    edges.push_back({VertexId(0), VertexId(1)});
    edges.push_back({VertexId(2 * cells + 1), VertexId(2 * cells)});
    expect_defect(mesh, "cross, touch or overlap");

    // A fan of triangles runs twice round a vertex. Cells and interior edges are correct; the one loop winds twice.
    mesh = {};
    mesh.markers = {{"all", MarkerKind::other, {}}};
    mesh.points.push_back({0, 0});
    const std::size_t fan = 16;
    for (std::size_t i = 0; i < fan; ++i) {
        const double angle = 4 * std::numbers::pi * static_cast<double>(i) / fan;
        const double radius = i < fan / 2 ? 1 : 1.5;
        mesh.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        const VertexId a(1 + i), b(1 + (i + 1) % fan);
        mesh.triangles.push_back({{VertexId(0), a, b}});
        mesh.markers[0].edges.push_back({a, b});
    }
    expect_defect(mesh, "cross, touch or overlap");
}

TEST(CheckMesh, ManySmallLoops) {
    std::vector<std::vector<Point>> outlines;
    for (int i = 0; i < 60; ++i)
        for (int j = 0; j < 60; ++j) {
            const Point p{1.0 * i, 1.0 * j};
            outlines.push_back({p, p + Point{0.5, 0}, p + Point{0.25, 0.5}});
        }
    const MeshCheck check = check_mesh(islands(outlines));
    EXPECT_TRUE(check.valid()) << all_defects(check);
    EXPECT_EQ(check.boundary_loops, 3600u);
    EXPECT_EQ(check.euler_characteristic, 3600);
}

/// Returns a square of two triangles. The diagonal makes corners of 45 degrees at vertices 0 and 2.
Mesh halved_square() {
    Mesh mesh;
    mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}, {{VertexId(0), VertexId(2), VertexId(3)}}};
    Marker& box = mesh.markers.emplace_back(Marker{"box", MarkerKind::far_field, {}});
    for (std::uint32_t i = 0; i < 4; ++i) box.edges.push_back({VertexId(i), VertexId((i + 1) % 4)});
    return mesh;
}

TEST(CheckExempt, SharpCornersBetweenFrozenEdgesAlone) {
    const auto exempt = [](const Mesh& mesh, double bound = 50) {
        const MeshCheck check = check_mesh(mesh, {.min_angle_deg = bound});
        EXPECT_TRUE(check.valid());
        EXPECT_EQ(check.isotropic.angles_below_bound, bound > 45 ? check.isotropic.cells : 0);
        return check.isotropic.exempt;
    };
    Mesh mesh = halved_square();
    EXPECT_EQ(exempt(mesh), 0u);  // the corners of the boundary are right angles
    mesh.piece = {1, 2};
    EXPECT_EQ(exempt(mesh), 2u);
    EXPECT_EQ(exempt(mesh, 40), 0u);
    mesh.piece = {1, 1};
    EXPECT_EQ(exempt(mesh), 0u);
    mesh.constraints = {{VertexId(0), VertexId(2)}};
    EXPECT_EQ(exempt(mesh), 2u);
    mesh.constraints.clear();
    mesh.region = {Region::layer, Region::isotropic};
    EXPECT_EQ(exempt(mesh), 1u);
}

TEST(CheckExempt, SharpCornerOfTheBoundarySharedByTwoTriangles) {
    Mesh mesh;  // has a corner of 45 degrees at the origin, which is divided in two
    mesh.points = {{0, 0}, {2, 0}, {2, 1}, {2, 2}};
    mesh.triangles = {{{VertexId(0), VertexId(1), VertexId(2)}}, {{VertexId(0), VertexId(2), VertexId(3)}}};
    mesh.markers = {{"all", MarkerKind::other, {}}};
    for (std::uint32_t i = 0; i < 4; ++i) mesh.markers[0].edges.push_back({VertexId(i), VertexId((i + 1) % 4)});
    const MeshCheck check = check_mesh(mesh, {.min_angle_deg = 30});
    EXPECT_TRUE(check.valid());
    EXPECT_EQ(check.isotropic.angles_below_bound, 2u);
    EXPECT_EQ(check.isotropic.exempt, 2u);
}

/// Returns a wedge with its tip at the origin, between two straight sides of `parts` edges of length 1: strips of two
/// triangles behind the one at the tip.
Mesh wedge(std::uint32_t parts, double height) {
    Mesh mesh;
    mesh.points = {{0, 0}};
    for (std::uint32_t i = 1; i <= parts; ++i) {
        mesh.points.push_back({1.0 * i, 0});
        mesh.points.push_back({1.0 * i, height * i});
    }
    const auto lower = [](std::uint32_t i) { return VertexId(i == 0 ? 0 : 2 * i - 1); };
    const auto upper = [](std::uint32_t i) { return VertexId(2 * i); };
    mesh.triangles.push_back({{lower(0), lower(1), upper(1)}});
    for (std::uint32_t i = 1; i < parts; ++i) {
        mesh.triangles.push_back({{lower(i), lower(i + 1), upper(i)}});
        mesh.triangles.push_back({{lower(i + 1), upper(i + 1), upper(i)}});
    }
    Marker& wall = mesh.markers.emplace_back(Marker{"wall", MarkerKind::wall, {}});
    for (std::uint32_t i = 0; i < parts; ++i) {
        wall.edges.push_back({lower(i), lower(i + 1)});
        wall.edges.push_back({upper(i + 1), upper(i)});
    }
    wall.edges.push_back({lower(parts), upper(parts)});
    return mesh;
}

TEST(CheckExempt, TrianglesWhoseShortestEdgeLeadsAcrossASharpCorner) {
    const MeshCheck check = check_mesh(wedge(3, 0.1), {.min_angle_deg = 20});
    ASSERT_TRUE(check.valid());
    EXPECT_EQ(check.isotropic.angles_below_bound, 5u);
    EXPECT_EQ(check.isotropic.exempt, 4u);  // the shortest edge of the last triangle is an edge of the wall
    EXPECT_EQ(check.unexcused_cells, std::vector<std::uint32_t>{4});
}

TEST(CheckExempt, NotFarFromTheCornerAndNotInAStripWithoutOne) {
    const MeshCheck far = check_mesh(wedge(40, 0.001), {.min_angle_deg = 2});
    ASSERT_TRUE(far.valid());
    EXPECT_GT(far.isotropic.unexcused(), 20u);
    EXPECT_LT(far.isotropic.unexcused(), far.isotropic.cells - 20);
    EXPECT_EQ(far.unexcused_cells.size(), far.isotropic.unexcused());

    Mesh strip = wedge(3, 0.1);  // its tip is cut off, so that no two sides enclose a sharp corner
    for (std::uint32_t i = 1; i <= 3; ++i) strip.points[2 * i].y = 0.1;
    strip.points[0] = {0.97, 0.05};
    const MeshCheck check = check_mesh(strip, {.min_angle_deg = 20});
    ASSERT_TRUE(check.valid());
    EXPECT_EQ(check.isotropic.exempt, 0u);
}

}  // namespace
}  // namespace lamina
