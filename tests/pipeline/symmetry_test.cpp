// Bodies and domains that a line of symmetry cuts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/stream.hpp>
#include <lamina/threads.hpp>
#include <lamina/transformation.hpp>

#include "core/reproducible_math.hpp"

namespace lamina {
namespace {

CaseOptions half(double y = 0) {
    CaseOptions options;
    options.far_field.size = 20;
    options.far_field.symmetry = y;
    options.layer.layers = 20;
    options.layer.first_height = Length{1e-4};
    return options;
}

/// Returns the points of a circle from the angle `from` to `to`, in degrees, both included.
std::vector<Point> arc(Point middle, double radius, double from = 0, double to = 360, int edges = 120) {
    std::vector<Point> points;
    for (int i = 0; i <= edges; ++i) {
        const double angle = core::radians(from + (to - from) * i / edges);
        points.push_back(middle + radius * Point{core::cos_reproducible(angle), core::sin_reproducible(angle)});
    }
    return points;
}

Geometry bodies(std::vector<std::vector<Point>> outlines) {
    std::vector<Element> elements;
    for (const std::vector<Point>& outline : outlines)
        elements.push_back(element_of_points(outline, "body" + std::to_string(elements.size()), {.close = true}));
    return make_geometry(std::move(elements));
}

const Marker& existing_marker(const Mesh& mesh, const std::string& name) {
    const auto found =
        std::find_if(mesh.markers.begin(), mesh.markers.end(), [&](const Marker& m) { return m.name == name; });
    if (found == mesh.markers.end()) throw std::runtime_error("no marker " + name);
    return *found;
}

/// Returns a mesh above the line y = 0 and its image below as one mesh.
Mesh both_halves(const Mesh& above) {
    Mesh whole = above;
    std::vector<VertexId> image;
    for (const Point p : above.points) {
        image.push_back(p.y == 0 ? VertexId(image.size()) : VertexId(whole.points.size()));
        if (p.y != 0) whole.points.push_back({p.x, -p.y});
    }
    const auto turned = [&](auto cell) {
        std::reverse(std::begin(cell.v), std::end(cell.v));
        for (VertexId& v : cell.v) v = image[v.index()];
        return cell;
    };
    for (const Triangle& t : above.triangles) whole.triangles.push_back(turned(t));
    for (const Quad& q : above.quads) whole.quads.push_back(turned(q));
    whole.layer.clear();
    whole.region.clear();
    whole.piece.clear();
    whole.constraints.clear();
    std::erase_if(whole.markers, [](const Marker& marker) { return marker.kind == MarkerKind::symmetry; });
    for (Marker& marker : whole.markers) {
        const std::size_t n = marker.edges.size();
        for (std::size_t i = 0; i < n; ++i) {
            const Segment edge = marker.edges[i];
            marker.edges.push_back({image[edge.b.index()], image[edge.a.index()]});
        }
    }
    return whole;
}

/// Checks a mesh above the line y = 0 that cuts bodies.
void expect_half(const MeshResult& result, const std::string& marker = "symmetry") {
    const MeshCheck check = check_mesh(result.mesh);
    EXPECT_TRUE(check.valid());
    EXPECT_EQ(check.isotropic.angles_below_bound, check.isotropic.exempt);
    EXPECT_EQ(check.walls.bare_edges, 0u);
    for (const Segment& edge : existing_marker(result.mesh, marker).edges)
        EXPECT_TRUE(result.mesh.points[edge.a.index()].y == 0 && result.mesh.points[edge.b.index()].y == 0);
    for (const Point p : result.mesh.points) EXPECT_GE(p.y, 0);
    EXPECT_EQ(existing_marker(result.mesh, marker).kind, MarkerKind::symmetry);
    EXPECT_TRUE(check_mesh(both_halves(result.mesh)).valid());
}

TEST(Symmetry, HalvesOfBodiesHaveLayersThatEndOnTheLine) {
    const std::vector<std::vector<std::vector<Point>>> cases{
        {arc({0, 0}, 0.5)},                                    // cut
        {arc({0, -0.2}, 0.5)},                                 // meets the line at an angle
        {arc({0, 0.2}, 0.5)},                                  // leans over the line
        {arc({0, 0}, 0.5, 0, 180, 60)},                        // an upper half without its chord
        {{{1, 0}, {1, 0.3}, {0, 0.3}, {0, 0}, {0.5, 0}}},      // stands on the line
        {{{2, 0}, {2, 0.5}, {0, 0}}},                          // a cone with a base
        {arc({0, 0}, 0.5), arc({1.2, 0}, 0.4)},                // two on the line
        {arc({0, 0}, 0.5), arc({0.602, 0}, 0.1)},              // with a slot between
        {arc({0, 0}, 0.5), arc({1, 0.105}, 0.1, 0, 360, 80)},  // and one near to the line
    };
    for (const auto& outlines : cases)
        for (const bool with_layers : {false, true}) {
            SCOPED_TRACE(testing::Message() << "case " << &outlines - cases.data() << ", layers " << with_layers);
            CaseOptions options = half();
            options.layer.enabled = with_layers;
            const MeshResult result = generate_mesh(bodies(outlines), options);
            expect_half(result);
            EXPECT_EQ(result.check.edges_without_first_layer, 0u);
        }
}

TEST(Symmetry, LinesEndOnTheLineOfSymmetryAndOnBodies) {
    const std::vector<std::vector<Point>> lines{
        {{-1, -0.3}, {-0.8, 0.6}},              // crosses the line of symmetry ahead of the body
        {{-0.515, 0}, {-0.53, 0.4}},            // begins on it, within the layer at the nose
        {{0, -0.2}, {0.1, 1}},                  // from the wall outwards
        {{0.6, 0}, {0.9, 0.3}, {1.2, -0.1}},    // begins and ends on it
        {{-0.9, 0.2}, {0.9, 0.2}, {1.5, 0.4}},  // through the body
    };
    for (const std::vector<Point>& line : lines)
        for (const bool with_layers : {false, true}) {
            SCOPED_TRACE(testing::Message() << "line " << &line - lines.data() << ", layers " << with_layers);
            CaseOptions options = half();
            options.layer.enabled = with_layers;
            options.lines = {{.name = "disc", .points = line}};
            const MeshResult result = generate_mesh(bodies({arc({0, 0}, 0.5)}), options);
            expect_half(result);
            EXPECT_EQ(existing_marker(result.mesh, "disc").kind, MarkerKind::internal);
        }
}

TEST(Symmetry, TwoSidedLinesMayStandOnTheLineAndNotEncloseFlow) {
    CaseOptions options = half();
    options.lines = {{.name = "disc", .points = {{0.8, 0}, {0.8, 0.5}}, .two_sided = true}};
    const MeshResult result = generate_mesh(bodies({arc({0, 0}, 0.5)}), options);
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    EXPECT_EQ(existing_marker(result.mesh, "disc").kind, MarkerKind::wall);
    options.lines[0].points = {{0.8, 0}, {0.8, 0.7}, {0, 0.7}, {0, 0.2}};
    EXPECT_THROW(generate_mesh(bodies({arc({0, 0}, 0.5)}), options), OptionError);
}

TEST(Symmetry, FirstHeightsOfHalvesHold) {
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::delaunay, LayerTopology::quads}) {
        CaseOptions options = half();
        options.layer.topology = topology;
        for (const std::string section : {"naca:0012", "naca:0012:120:blunt", "naca:2412"}) {
            SCOPED_TRACE(section);
            const MeshResult result = generate_mesh(std::vector<std::string>{section}, options);
            expect_half(result);
            ASSERT_EQ(result.check.walls.first_heights.size(), 1u);
            EXPECT_EQ(result.check.walls.first_heights[0].share_of_kept, 1);
            ASSERT_EQ(result.layer_coverage.size(), 1u);
            EXPECT_EQ(result.layer_coverage[0].all.incomplete_rays, 0u);
        }
    }
}

TEST(Symmetry, LayersGoOnAlongWakesOnTheLineAndAboveIt) {
    CaseOptions options;
    options.far_field.size = 20;
    options.far_field.symmetry = 0;
    options.use_flow = true;
    options.conditions.reynolds = 1e6;
    options.layer.wake_layers = true;
    options.layer.first_height = YPlus{1};
    options.layer.layers.reset();
    for (const LayerTopology topology : {LayerTopology::layered, LayerTopology::delaunay, LayerTopology::quads})
        for (const std::string section : {"naca:0012", "naca:0012:120:blunt", "naca:0030:120:blunt"})
            for (const bool two : {false, true}) {
                SCOPED_TRACE(testing::Message() << section << ", topology " << int(topology) << ", two " << two);
                options.layer.topology = topology;
                std::vector<std::string> inputs{section};
                options.geometry.transformations.clear();
                if (two) {
                    inputs.push_back("naca:4412");
                    options.geometry.names = {"strut", "wing"};
                    options.geometry.transformations = {parse_transformation("wing:shift:0.3,0.3")};
                } else {
                    options.geometry.names.clear();
                }
                const MeshResult result = generate_mesh(inputs, options);
                expect_half(result);
                // Two first cells at the corners of the thick base are 4 % lower, as on the whole.
                EXPECT_GE(result.check.walls.first_heights[0].share_of_kept, section == "naca:0012" ? 1 : 0.98);
                ASSERT_EQ(result.decisions.wakes.size(), two ? 2u : 1u);
                for (const auto& wake : result.decisions.wakes) EXPECT_GT(wake.with_layers, 0.5);
                // The layer has vertices on the line all along the wake.
                std::size_t on_line = 0;
                for (std::size_t i = 0; i < result.mesh.points.size(); ++i)
                    on_line += result.mesh.points[i].y == 0 && result.mesh.points[i].x > 1;
                EXPECT_GT(on_line, 40u);
            }
}

TEST(Symmetry, HalfASectionIsLikeTheWhole) {
    CaseOptions options = half();
    const MeshResult above = generate_mesh(std::vector<std::string>{"naca:0012"}, options);
    options.far_field.symmetry.reset();
    const MeshResult whole = generate_mesh(std::vector<std::string>{"naca:0012"}, options);
    const auto cells = [](const MeshResult& result) { return static_cast<double>(result.mesh.triangles.size()); };
    EXPECT_NEAR(cells(above) / cells(whole), 0.5, 0.03);
    EXPECT_EQ(existing_marker(above.mesh, "airfoil").edges.size(),
              existing_marker(whole.mesh, "airfoil").edges.size() / 2);
}

TEST(Symmetry, ALineBelowAllBodiesIsASlipWall) {
    CaseOptions options = half(-0.5);
    const MeshResult result = generate_mesh(std::vector<std::string>{"naca:0012"}, options);
    EXPECT_TRUE(result.check.valid());
    for (const Segment& edge : existing_marker(result.mesh, "symmetry").edges)
        EXPECT_EQ(result.mesh.points[edge.a.index()].y, -0.5);
    options.far_field.symmetry.reset();
    const double lowest = bounding_box(read_geometry(std::vector<std::string>{"naca:0012"})).lower.y;
    options.far_field.ground = Length{lowest + 0.5};
    const MeshResult above_ground = generate_mesh(std::vector<std::string>{"naca:0012"}, options);
    EXPECT_NEAR(static_cast<double>(result.mesh.triangles.size()),
                static_cast<double>(above_ground.mesh.triangles.size()), 200);
}

TEST(Symmetry, ATunnelHasTheLineInItsMiddle) {
    for (const OuterWallKind walls : {OuterWallKind::slip, OuterWallKind::no_slip})
        for (const double y : {0.0, 0.25}) {
            SCOPED_TRACE(testing::Message() << "no slip: " << (walls == OuterWallKind::no_slip) << ", line " << y);
            CaseOptions options = half(y);
            options.far_field.size = 100;
            options.far_field.tunnel = Length{3};
            options.far_field.tunnel_walls = walls;
            // A circle that the line cuts, and one above it.
            const MeshResult result = generate_mesh(bodies({arc({0, y}, 0.5), arc({1, y + 0.4}, 0.1)}), options);
            EXPECT_TRUE(check_mesh(result.mesh).valid());
            EXPECT_EQ(result.check.edges_without_first_layer, 0u);
            const double chord = 1.6;
            for (const Segment& edge : existing_marker(result.mesh, "ceiling").edges)
                EXPECT_EQ(result.mesh.points[edge.a.index()].y, y + 1.5 * chord);
            for (const Segment& edge : existing_marker(result.mesh, "symmetry").edges)
                EXPECT_EQ(result.mesh.points[edge.a.index()].y, y);
            EXPECT_EQ(result.mesh.markers.size(), 6u) << "two bodies, inlet, outlet, ceiling and line";
            EXPECT_EQ(result.outer_walls.size(), walls == OuterWallKind::no_slip ? 1u : 0u);
        }
    // A line that cuts no body is a slip wall.
    CaseOptions options = half(-0.5);
    options.far_field.tunnel = Length{3};
    const MeshResult result = generate_mesh(std::vector<std::string>{"naca:0012"}, options);
    EXPECT_TRUE(check_mesh(result.mesh).valid());
    EXPECT_EQ(existing_marker(result.mesh, "symmetry").kind, MarkerKind::symmetry);
    EXPECT_EQ(result.mesh.points[existing_marker(result.mesh, "ceiling").edges[0].a.index()].y, 1);
}

/// Returns the mesh above the line y = 0, and that of the whole configuration, with the flow that decides on both.
std::pair<MeshResult, MeshResult> half_and_whole(std::vector<std::vector<Point>> above, const CaseOptions& given) {
    CaseOptions options = given;
    const MeshResult of_half = generate_mesh(bodies(above), options);
    const std::size_t n = above.size();
    for (std::size_t e = 1; e < n; ++e) {
        std::vector<Point> image(above[e].rbegin(), above[e].rend());
        for (Point& p : image) p.y = -p.y;
        above.push_back(std::move(image));
    }
    options.far_field.symmetry.reset();
    options.conditions.chord = of_half.conditions.chord;
    return {of_half, generate_mesh(bodies(above), options)};
}

TEST(Symmetry, TheFlowKnowsTheImagesOfAllBodies) {
    std::vector<Point> wing = naca_airfoil("2412", 120).points;
    for (Point& p : wing) p = p + Point{0.3, 0.25};
    CaseOptions options = half();
    options.layer = {.first_height = YPlus{1}};
    options.conditions.reynolds = 1e6;
    options.use_flow = true;
    options.far_field.size = 100;
    options.far_field.tunnel = Length{2};
    const auto [above, whole] = half_and_whole({naca_airfoil("0012", 120).points, wing}, options);
    ASSERT_EQ(above.flow->elements.size(), 2u);
    EXPECT_NEAR(above.flow->elements[1].lift, whole.flow->elements[1].lift, 1e-3);
    EXPECT_LT(std::abs(above.flow->elements[0].lift), 1e-3);
    ASSERT_EQ(above.first_heights.size(), 2u);
    for (std::size_t e = 0; e < 2; ++e) EXPECT_NEAR(above.first_heights[e] / whole.first_heights[e], 1, 1e-3);
    EXPECT_EQ(above.decisions.wakes.size(), 2u);
}

TEST(Symmetry, HalvesAreFineAtShocks) {
    CaseOptions options = half();
    options.layer = {.first_height = YPlus{1}};
    options.conditions.reynolds = 1e6;
    options.conditions.mach = 0.85;
    options.use_flow = true;
    const MeshResult above = generate_mesh(bodies({naca_airfoil("0012", 120).points}), options);
    EXPECT_TRUE(above.decisions.knows_shocks);
    ASSERT_FALSE(above.decisions.shocks.empty());
    // Euler solutions of the whole section have it at 0.757; without boundary layers it counts 0.04 further forward.
    EXPECT_NEAR(above.decisions.shocks[0].at.x, 0.717, 0.02);
    ASSERT_TRUE(above.compressible_flow);
    EXPECT_EQ(above.compressible_flow->elements.size(), 1u);
}

TEST(Symmetry, TheMeshDependsOnNeitherThreadsNorTheLine) {
    CaseOptions options = half(0.1);
    std::vector<Mesh> meshes;
    for (const unsigned threads : {1u, 4u})
        with_threads(threads, [&] { meshes.push_back(generate_mesh(bodies({arc({0, 0}, 0.5)}), options).mesh); });
    EXPECT_EQ(mesh_hash(meshes[0]), mesh_hash(meshes[1]));
    EXPECT_TRUE(check_mesh(meshes[0]).valid());
    for (const Segment& edge : existing_marker(meshes[0], "symmetry").edges)
        EXPECT_EQ(meshes[0].points[edge.a.index()].y, 0.1);
}

/// Returns the message of the error that these bodies cause.
std::string refusal(const std::vector<std::vector<Point>>& outlines, CaseOptions options = half()) {
    try {
        generate_mesh(bodies(outlines), options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Symmetry, WhatCannotBeCutIsRefusedInOneLine) {
    EXPECT_NE(refusal({arc({0, -2}, 0.5)}).find("lies below the line of symmetry"), std::string::npos);
    EXPECT_NE(refusal({{{1, 0.5}, {0, 0.5}, {0.5, 0}}}).find("at a single point"), std::string::npos);
    const std::vector<Point> arch{{1, -0.1},   {1, 0.5},   {0, 0.5},   {0, -0.1},
                                  {0.2, -0.1}, {0.2, 0.2}, {0.8, 0.2}, {0.8, -0.1}};
    EXPECT_NE(refusal({arch}).find("encloses a part of the flow"), std::string::npos);
    CaseOptions options = half();
    options.conditions.alpha_deg = 2;
    EXPECT_NE(refusal({arc({0, 0}, 0.5)}, options).find("alpha"), std::string::npos);
    options = half();
    options.far_field.ground = Length{1};
    EXPECT_NE(refusal({arc({0, 0}, 0.5)}, options).find("symmetry"), std::string::npos);
}

TEST(Symmetry, ABodyThatTheLineCutsInTwoBecomesTwo) {
    const Geometry cut =
        cut_at_symmetry(bodies({{{1, 0.1}, {0.9, 0.1}, {0.5, -0.1}, {0.1, 0.1}, {0, 0.1}, {0, -0.3}, {1, -0.3}}}), 0);
    ASSERT_EQ(cut.elements.size(), 2u);
    EXPECT_NE(cut.elements[0].name, cut.elements[1].name);
    for (const Element& element : cut.elements) {
        EXPECT_TRUE(element.is_mirrored);
        EXPECT_EQ(element.points.front().y, 0);
        EXPECT_EQ(element.points[element.points.size() / 2].y, 0);
    }
}

}  // namespace
}  // namespace lamina
