// Cases for the tests of the whole pipeline, and the properties that every mesh must have.
#pragma once

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/pipeline.hpp>

#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina::test {

/// Returns the options of the case of the thesis (Figs. 24 to 28): the points as given, 30 layers, growth 1.15, a far
/// field 50 chords away.
inline CaseOptions thesis_options() {
    CaseOptions options;
    options.surface.treatment = SurfaceTreatment::keep;
    options.layer = thesis_layer();
    options.far_field.size = 50;
    return options;
}

/// Returns these options with a nearer far field, which takes less time.
inline CaseOptions quick_options(double far_field = 10) {
    CaseOptions options = thesis_options();
    options.far_field.size = far_field;
    return options;
}

inline shapes::Outline naca(const std::string& digits, std::size_t points = 120,
                            TrailingEdge tail = TrailingEdge::sharp) {
    return naca_airfoil(digits, points, tail).points;
}

inline MeshResult mesh_of(std::initializer_list<shapes::Outline> bodies, const CaseOptions& options) {
    return generate_mesh(shapes::geometry(bodies), options);
}

/// The lexicographic order, for sets of points.
struct PointLess {
    bool operator()(Point a, Point b) const { return lexicographically_less(a, b); }
};

inline double enclosed_area(std::span<const Point> loop) {
    double doubled = 0;
    for (std::size_t i = 0; i < loop.size(); ++i) doubled += cross(loop[i], loop[(i + 1) % loop.size()]);
    return 0.5 * doubled;
}

/// Expects that the edges of a marker make one loop. They may stand in any order.
inline void expect_one_loop(const Marker& marker) {
    std::vector<Segment> by_start = marker.edges;
    std::sort(by_start.begin(), by_start.end());
    ASSERT_FALSE(by_start.empty()) << marker.name;
    std::size_t steps = 0;
    Segment at = by_start.front();
    do {
        const auto next = std::lower_bound(by_start.begin(), by_start.end(), Segment{at.b, VertexId{0}});
        ASSERT_TRUE(next != by_start.end() && next->a == at.b) << marker.name;
        at = *next;
        ASSERT_LE(++steps, by_start.size()) << marker.name;
    } while (!(at == by_start.front()));
    EXPECT_EQ(steps, by_start.size()) << marker.name;
}

/// Expects that the mesh is valid and covers the domain, that its markers are complete, that every wall point of the
/// input is exactly a vertex of its wall, that all edges are Delaunay, also between pieces, and that no angle is below
/// the bound but at sharp corners of frozen edges.
inline void expect_sound(const MeshResult& result, const CaseOptions& options) {
    const Mesh& mesh = result.mesh;
    const MeshCheck check = check_mesh(mesh, {.min_angle_deg = options.refine.min_angle_deg});
    EXPECT_EQ(check.defect_count, 0u) << check.defects.front().description;
    EXPECT_EQ(check.boundary_loops, result.geometry.elements.size() + 1);
    EXPECT_EQ(check.delaunay_violations, 0u);
    EXPECT_EQ(check.isotropic.angles_below_bound, check.isotropic.exempt);
    EXPECT_LT(double(check.isotropic.exempt), 0.001 * double(check.isotropic.cells));
    // The refinement and the check count the same triangles.
    EXPECT_EQ(check.isotropic.exempt, result.refinement.exempt);
    EXPECT_EQ(check.isotropic.angles_below_bound, result.refinement.below_bound);

    ASSERT_EQ(mesh.markers.size(), result.geometry.elements.size() + 1);
    Box box;
    for (std::size_t e = 0; e < result.geometry.elements.size(); ++e) {
        const Element& element = result.geometry.elements[e];
        const Marker& marker = mesh.markers[e];
        EXPECT_EQ(marker.name, element.name);
        EXPECT_EQ(marker.kind, MarkerKind::wall);
        expect_one_loop(marker);
        std::set<Point, PointLess> wall;
        for (const Segment& edge : marker.edges) wall.insert(mesh.points[edge.a.index()]);
        for (const Point p : element.points) {
            EXPECT_TRUE(wall.contains(p)) << p.x << ' ' << p.y;
            box.include(p);
        }
    }
    EXPECT_EQ(mesh.markers.back().kind, MarkerKind::far_field);
    expect_one_loop(mesh.markers.back());

    const double side = 2 * in_units(options.far_field.size, result.conditions.chord);
    double area = side * side;
    if (options.far_field.shape != FarFieldShape::box) {
        area = 0;
        for (const Segment& edge : mesh.markers.back().edges)
            area += 0.5 * cross(mesh.points[edge.a.index()], mesh.points[edge.b.index()]);
    }
    for (const Element& element : result.geometry.elements) area -= enclosed_area(element.points);
    EXPECT_NEAR(check.area, area, 1e-9 * side * side);
}

/// Expects that refinement refused no point and left no triangle too large or too narrow.
inline void expect_nothing_left_over(const MeshResult& result) {
    EXPECT_EQ(result.refinement.refused, 0u);
    EXPECT_EQ(result.refinement.oversized, 0u);
    EXPECT_EQ(result.refinement.below_bound, 0u);
}

}  // namespace lamina::test
