// Curved cells: proved valid over all kinds of layers, and as near to exact walls as their order promises.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/io.hpp>
#include <lamina/stream.hpp>

#include "pipeline/cases.hpp"
#include "surface/spacing_limits.hpp"

namespace lamina::test {
namespace {

using shapes::Outline;

CaseOptions curved_options(unsigned order, LayerTopology topology = LayerTopology::quads) {
    CaseOptions options;
    options.layer = {.first_height = 1e-5, .layers = 25, .topology = topology};
    options.far_field.size = 10;
    options.order = order;
    return options;
}

void expect_proved(const MeshResult& result, unsigned order) {
    const CurvedCheck check = check_curved(result.mesh, result.curved);
    EXPECT_TRUE(check.valid()) << (check.defects.empty() ? "" : check.defects[0].description);
    EXPECT_EQ(result.curved.order, order);
    EXPECT_EQ(check.min_scaled_jacobian, result.curved_check.min_scaled_jacobian);
    EXPECT_GT(check.min_scaled_jacobian, 0);
    EXPECT_GT(result.curving.curved_edges, 0u);
}

std::size_t wall_edges(const Mesh& mesh) {
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers)
        if (marker.kind == MarkerKind::wall) edges += marker.edges.size();
    return edges;
}

/// Returns the largest distance of the curved edges of the walls, sampled between nodes, by a measure of points.
double wall_error(const MeshResult& result, const std::function<double(Point)>& distance_of) {
    const unsigned p = result.curved.order;
    const std::vector<Point>& vertices = result.mesh.points;
    double largest = 0;
    std::size_t first = 0;
    for (const Marker& marker : result.mesh.markers) {
        for (const Segment& edge : marker.edges) {
            std::vector<Point> nodes{vertices[edge.a.index()]};
            for (unsigned k = 0; k + 1 < p; ++k)
                nodes.push_back(result.curved.points[result.curved.marker_nodes[first++].index() - vertices.size()]);
            nodes.push_back(vertices[edge.b.index()]);
            if (marker.kind != MarkerKind::wall) continue;
            for (int s = 1; s < 16; ++s) {
                Point at{0, 0};
                for (unsigned i = 0; i <= p; ++i) {
                    double factor = 1;
                    for (unsigned k = 0; k <= p; ++k)
                        if (k != i) factor *= (p * s / 16.0 - k) / (static_cast<double>(i) - k);
                    at = at + factor * nodes[i];
                }
                largest = std::max(largest, distance_of(at));
            }
        }
    }
    return largest;
}

/// Returns the distance from the sharp NACA 0012, whose half thickness is a polynomial in s = sqrt(x), by a search with
/// ever shorter steps.
double distance_from_naca_0012(Point p) {
    const double y = std::abs(p.y);
    const auto thickness = [](double s) {
        return 0.6 * s * (0.2969 + s * (-0.1260 + s * s * (-0.3516 + s * s * (0.2843 - 0.1036 * s * s))));
    };
    const auto at = [&](double s) { return Point{s * s, thickness(s)}; };
    double best = HUGE_VAL, nearest = 0;
    const double guess = std::sqrt(std::max(p.x, 0.0));
    for (int k = -200; k <= 200; ++k) {
        const double s = std::clamp(guess + 1e-3 * k, 0.0, 1.0);
        if (const double d = distance(at(s), {p.x, y}); d < best) {
            best = d;
            nearest = s;
        }
    }
    double step = 1e-3;
    for (int round = 0; round < 120; ++round) {
        for (const double s : {nearest - step, nearest + step})
            if (s >= 0 && s <= 1 && distance(at(s), {p.x, y}) < best) {
                best = distance(at(s), {p.x, y});
                nearest = s;
            }
        step *= 0.8;
    }
    return best;
}

Outline ellipse(double thickness, std::size_t points) {
    Outline outline;
    for (std::size_t i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
        outline.push_back({0.5 + 0.5 * std::cos(angle), 0.5 * thickness * std::sin(angle)});
    }
    return outline;
}

/// Returns about the distance from that ellipse: its equation over the length of its gradient.
double distance_from_ellipse(double thickness, Point p) {
    const double x = (p.x - 0.5) / 0.5, y = p.y / (0.5 * thickness);
    return std::abs(x * x + y * y - 1) / (2 * std::hypot(x / 0.5, y / (0.5 * thickness)));
}

/// Returns a mesh without layers on a wall with so many edges, which are as short everywhere as a small sag asks for.
MeshResult coarse_mesh(const Geometry& geometry, unsigned order, std::size_t edges) {
    CaseOptions options = curved_options(order);
    options.layer.enabled = false;
    options.surface = {.treatment = SurfaceTreatment::resample,
                       .points = edges,
                       .exact_points = true,
                       .max_ratio = 1.5,
                       .gradation = 0.4,
                       .trailing_edge_spacing = 0.03,
                       .tolerance = 1e-6};
    options.sizing.gradation = 0.4;
    return generate_mesh(geometry, options);
}

/// Returns the curves through the points of an outline.
std::vector<surface::CurvedEdge> curves_of(const Outline& outline) {
    return surface::prepare_with_curves(shapes::geometry({outline}),
                                        {.treatment = SurfaceTreatment::keep, .curve_kept = true},
                                        {.with_curves = true}, {})
        .curves;
}

/// Returns the distance of a point from a curve, by a search with ever shorter steps from the nearest of some samples.
double distance_from_curve(Point p, const surface::CurvedEdge& curve) {
    double nearest = 0, step = 0.05;
    for (int k = 0; k <= 20; ++k)
        if (distance(curve.at(k * step), p) < distance(curve.at(nearest), p)) nearest = k * step;
    for (int round = 0; round < 80; ++round, step *= 0.6)
        for (const double share : {nearest - step, nearest + step})
            if (distance(curve.at(share), p) < distance(curve.at(nearest), p)) nearest = share;
    return distance(curve.at(nearest), p);
}

/// Returns the largest distance of vertices and nodes of the walls from these curves.
double largest_distance_of_nodes(const MeshResult& result, const std::vector<surface::CurvedEdge>& curves) {
    const std::size_t n = result.mesh.points.size();
    double largest = 0;
    std::size_t first = 0;
    for (const Marker& marker : result.mesh.markers)
        for (const Segment& edge : marker.edges) {
            std::vector<Point> places{result.mesh.points[edge.a.index()]};
            for (unsigned k = 0; k + 1 < result.curved.order; ++k)
                places.push_back(result.curved.points[result.curved.marker_nodes[first++].index() - n]);
            if (marker.kind != MarkerKind::wall) continue;
            for (const Point p : places) {
                double least = HUGE_VAL;
                for (const surface::CurvedEdge& curve : curves) least = std::min(least, distance_from_curve(p, curve));
                largest = std::max(largest, least);
            }
        }
    return largest;
}

TEST(CurvedCells, ConvergeToExactWallsWithTheirOrder) {
    const Geometry section = make_geometry(read_inputs(std::vector<std::string>{"naca:0012"}));
    struct Wall {
        Geometry geometry;
        std::function<double(Point)> distance_of;
    };
    const std::vector<Wall> walls{
        {section, distance_from_naca_0012},
        {shapes::geometry({ellipse(0.3, 4000)}), [](Point p) { return distance_from_ellipse(0.3, p); }},
        {shapes::geometry({ellipse(1, 4000)}), [](Point p) { return distance_from_ellipse(1, p); }}};
    for (std::size_t w = 0; w < walls.size(); ++w)
        for (unsigned order = 2; order <= max_cell_order; ++order) {
            SCOPED_TRACE(testing::Message() << "wall " << w << ", order " << order);
            const MeshResult coarse = coarse_mesh(walls[w].geometry, order, 60);
            const MeshResult fine = coarse_mesh(walls[w].geometry, order, 120);
            expect_proved(coarse, order);
            expect_proved(fine, order);
            const double first = wall_error(coarse, walls[w].distance_of),
                         second = wall_error(fine, walls[w].distance_of);
            EXPECT_GE(std::log2(first / second), order + 1 - 0.1) << first << " to " << second;
            if (w == 0 && order == 4) {
                EXPECT_LT(first, 1e-8);
            }
        }
}

TEST(CurvedCells, AreValidOverLayersOfEachTopology) {
    for (const LayerTopology topology : {LayerTopology::quads, LayerTopology::layered})
        for (unsigned order = 2; order <= max_cell_order; ++order) {
            SCOPED_TRACE(testing::Message() << static_cast<int>(topology) << ", order " << order);
            const MeshResult result = generate_mesh({"naca:0012"}, curved_options(order, topology));
            expect_proved(result, order);
            EXPECT_EQ(result.curving.reduced_edges, 0u);
            EXPECT_EQ(result.curving.curved_edges, result.mesh.markers[0].edges.size());
        }
}

TEST(CurvedCells, ChangeNothingOfTheStraightMeshOnResampledWalls) {
    CaseOptions options = curved_options(3);
    options.surface.treatment = SurfaceTreatment::resample;
    const MeshResult curved = generate_mesh({"naca:4412:90:blunt"}, options);
    options.order = 1;
    const MeshResult straight = generate_mesh({"naca:4412:90:blunt"}, options);
    EXPECT_EQ(mesh_hash(curved.mesh), mesh_hash(straight.mesh));
    EXPECT_EQ(curved.mesh.points, straight.mesh.points);
    EXPECT_TRUE(straight.curved.points.empty());
    EXPECT_GT(curved.estimate.memory_bytes, straight.estimate.memory_bytes);
    expect_proved(curved, 3);
}

TEST(CurvedCells, AreTheSameOnAnyNumberOfThreads) {
    CaseOptions options = curved_options(3);
    std::vector<Point> nodes;
    for (const unsigned threads : {1u, 3u}) {
        options.threads = threads;
        const MeshResult result = generate_mesh({"naca:0012"}, options);
        if (threads > 1) {
            EXPECT_EQ(result.curved.points, nodes);
        }
        nodes = result.curved.points;
    }
}

TEST(CurvedCells, OfTurnedAndMirroredWallsAreValidAsWell) {
    const Outline slat = shapes::moved(naca("4412", 80), -0.3, 0.25, {-0.3, -0.05}), main = naca("2412", 140);
    const auto turned = [](Outline outline) {
        for (Point& p : outline) p = {-p.y, p.x};
        return outline;
    };
    const auto mirrored = [](Outline outline) {
        for (Point& p : outline) p.y = -p.y;
        std::reverse(outline.begin() + 1, outline.end());
        return outline;
    };
    for (const auto& change :
         std::vector<std::function<Outline(Outline)>>{[](Outline o) { return o; }, turned, mirrored}) {
        const MeshResult result = mesh_of({change(slat), change(main)}, curved_options(3));
        expect_proved(result, 3);
        EXPECT_EQ(result.curving.reduced_edges, 0u);
        EXPECT_EQ(result.curving.curved_edges, wall_edges(result.mesh));
    }
}

TEST(CurvedCells, FollowWallsThatAreDividedAfterwards) {
    // Edges of walls without layers are longer than the triangles wanted there, and points that are kept turn by more
    // than rays may. Walls with layers need both.
    struct Divided {
        bool has_layer;
        SurfaceOptions surface;
        Outline outline;
    };
    const SurfaceOptions kept{.treatment = SurfaceTreatment::keep, .curve_kept = true};
    for (const Divided& divided : std::vector<Divided>{{false, {}, naca("4412", 60)},
                                                       {false, kept, naca("4412", 60)},
                                                       {true, kept, naca("4412", 60)},
                                                       {true, kept, ellipse(0.4, 24)},
                                                       {true, {}, naca("0012", 160)}})
        for (unsigned order = 2; order <= max_cell_order; ++order) {
            SCOPED_TRACE(testing::Message() << divided.outline.size() << " points, order " << order);
            CaseOptions options = curved_options(order);
            options.layer.enabled = divided.has_layer;
            options.surface = divided.surface;
            const MeshResult result = mesh_of({divided.outline}, options);
            expect_proved(result, order);
            EXPECT_EQ(result.curving.wall_edges, wall_edges(result.mesh));
            EXPECT_EQ(result.curving.curved_edges, wall_edges(result.mesh));
            EXPECT_EQ(result.curving.reduced_edges, 0u);
            EXPECT_EQ(result.curving.reduced_distance, 0);
            if (divided.surface.treatment == SurfaceTreatment::keep) {
                EXPECT_GT(wall_edges(result.mesh), divided.outline.size());
                EXPECT_LT(largest_distance_of_nodes(result, curves_of(divided.outline)), 1e-14);
            }
        }
}

TEST(CurvedCells, OfCoarseWallsFollowThemInThinLayers) {
    // Edges bend by more than the layers are high, whose outer border is divided above.
    for (const LayerTopology topology : {LayerTopology::quads, LayerTopology::layered})
        for (unsigned order = 2; order <= max_cell_order; ++order) {
            CaseOptions options = curved_options(order, topology);
            options.surface = {.treatment = SurfaceTreatment::keep, .curve_kept = true};
            for (const auto& [outline, layers] : {std::pair(ellipse(0.4, 24), 5u), std::pair(naca("0012", 16), 10u)}) {
                options.layer.layers = layers;  // at the nose of 16 points one edge bends more at its one end
                const MeshResult result = mesh_of({outline}, options);
                expect_proved(result, order);
                EXPECT_EQ(result.curving.curved_edges, wall_edges(result.mesh));
                EXPECT_EQ(result.curving.reduced_edges, 0u);
                EXPECT_GT(result.curved_check.min_scaled_jacobian, 0.2);
            }
        }
}

TEST(CurvedCells, OfHalfSectionsHaveNoEdgesBelowTheSymmetry) {
    CaseOptions options = curved_options(2);
    options.far_field.symmetry = 0.0;
    const MeshResult result = generate_mesh({"naca:0012"}, options);
    expect_proved(result, 2);
    EXPECT_EQ(result.curving.reduced_edges, 0u);
    EXPECT_EQ(result.curving.curved_edges, wall_edges(result.mesh));
}

TEST(CurvedCells, KeepCornersAndBasesAndPointsGiven) {
    // All edges of a box are straight, whether points are resampled or kept.
    const Outline box = shapes::refined(Outline{{1, 0}, {1, 0.2}, {0, 0.2}, {0, 0}}, 12);
    CaseOptions options = curved_options(3);
    const MeshResult straight = mesh_of({box}, options);
    EXPECT_LT(straight.curving.wall_distance, 1e-15);
    options.surface.treatment = SurfaceTreatment::keep;
    const MeshResult kept = mesh_of({naca("0012", 200)}, options);
    EXPECT_EQ(kept.curving.curved_edges, 0u);
    EXPECT_TRUE(kept.curved_check.valid());
    options.surface.curve_kept = true;
    const MeshResult curved = mesh_of({naca("0012", 200)}, options);
    EXPECT_EQ(curved.curving.curved_edges, wall_edges(curved.mesh));
    EXPECT_LT(largest_distance_of_nodes(curved, curves_of(naca("0012", 200))), 1e-14);
    EXPECT_LT(wall_error(curved, distance_from_naca_0012), 0.1 * wall_error(kept, distance_from_naca_0012));
}

TEST(CurvedCells, WithNodesOfGaussAndLobattoAreProvedAndOnWalls) {
    for (const auto& [topology, order] : {std::pair(LayerTopology::layered, 3u), std::pair(LayerTopology::quads, 4u)}) {
        CaseOptions options = curved_options(order, topology);
        const MeshResult even = mesh_of({naca("0012", 200)}, options);
        options.node_distribution = NodeDistribution::gauss_lobatto;
        const MeshResult lobatto = mesh_of({naca("0012", 200)}, options);
        expect_proved(lobatto, order);
        EXPECT_EQ(mesh_hash(lobatto.mesh), mesh_hash(even.mesh));
        EXPECT_EQ(lobatto.curving.curved_edges, even.curving.curved_edges);
        EXPECT_LT(largest_distance_of_nodes(lobatto, curves_of(naca("0012", 200))), 1e-14);
        EXPECT_LT(lobatto.curving.wall_distance, 1.5 * even.curving.wall_distance);
        EXPECT_NEAR(lobatto.curved_check.min_scaled_jacobian, even.curved_check.min_scaled_jacobian, 0.05);
        const double straight = even.curving.straight_min_scaled_jacobian;
        // A straight triangle has one Jacobian; a quadrilateral whose sides are not parallel has several.
        EXPECT_EQ(straight > 1 - 1e-9, topology == LayerTopology::layered) << straight;
        EXPECT_GE(even.curved_check.min_scaled_jacobian, 0.95 * straight);
    }
}

TEST(CurvedCells, ThatAreWrongAreFound) {
    MeshResult result = generate_mesh({"naca:0012"}, curved_options(2));
    CurvedNodes nodes = result.curved;
    nodes.points[0] = {-3, 5};
    EXPECT_GT(check_curved(result.mesh, nodes).invalid, 0u);
    nodes = result.curved;
    nodes.quad_nodes.pop_back();
    EXPECT_FALSE(check_curved(result.mesh, nodes).valid());
    nodes = result.curved;
    std::swap(nodes.triangle_nodes[0], nodes.triangle_nodes[1]);
    EXPECT_FALSE(check_curved(result.mesh, nodes).valid());
    nodes = result.curved;
    std::swap(nodes.marker_nodes[0], nodes.marker_nodes[1]);
    EXPECT_FALSE(check_curved(result.mesh, nodes).valid());
}

TEST(CurvedCells, AreRefusedInOneLine) {
    const auto reason = [](const std::function<void()>& f) -> std::string {
        try {
            f();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    const auto of_options = [&](const CaseOptions& options) {
        return reason([&] { generate_mesh({"naca:0012"}, options); });
    };
    EXPECT_NE(of_options(curved_options(5)).find(">= 1 and <= 4"), std::string::npos);
    EXPECT_NE(of_options(curved_options(2, LayerTopology::delaunay)).find("quads or layered"), std::string::npos);
    CaseOptions of_sail = curved_options(2);
    of_sail.geometry.sheets = {{"sail", {{0, 0}, {1, 0}}}};
    EXPECT_NE(of_options(of_sail).find("sheets"), std::string::npos);
    const Geometry sail = read_geometry(std::vector<std::string>{}, of_sail.geometry);
    std::size_t stages = 0;
    EXPECT_NE(
        reason([&] { generate_mesh(sail, curved_options(2), [&](const ProgressEvent&) { ++stages; }); }).find("sheets"),
        std::string::npos);
    EXPECT_EQ(stages, 0u);  // no straight mesh was made before
    EXPECT_NE(reason([] { require_curved_format("mesh.su2"); }).find("msh41"), std::string::npos);
    EXPECT_EQ(reason([] { require_curved_format("mesh.vtu"); }), "");
    EXPECT_NE(reason([] { stream_mesh({"naca:0012"}, curved_options(2), {}); }).find("leave --stream out"),
              std::string::npos);
}

}  // namespace
}  // namespace lamina::test
