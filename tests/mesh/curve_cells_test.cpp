// Cells that follow curved walls: columns over an arc, which need no pipeline.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>
#include <vector>

#include "core/random.hpp"
#include "mesh/curve_cells.hpp"

namespace lamina::mesh {
namespace {

/// A ring of columns round a circle of radius 1, whose first cells are far thinner than its edges bend, and a row of
/// triangles round it.
struct Ring {
    Mesh mesh;
    std::vector<std::uint32_t> columns;
    std::vector<WallCurve> walls;
};

constexpr std::size_t columns_of_ring = 16;

Point on_circle(double radius, double share) {
    const double angle = 2 * std::numbers::pi * share / static_cast<double>(columns_of_ring);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Makes a ring of quadrilaterals, or of triangles with diagonals that go either way at random.
Ring make_ring(bool of_quads, unsigned order, std::size_t layers) {
    constexpr std::size_t n = columns_of_ring;
    Ring ring;
    Mesh& mesh = ring.mesh;
    double radius = 1, height = 1e-4;
    for (std::size_t layer = 0; layer <= layers; ++layer, radius += height, height *= 1.6)
        for (std::size_t i = 0; i < n; ++i) mesh.points.push_back(on_circle(radius, static_cast<double>(i)));
    const auto vertex = [&](std::size_t layer, std::size_t i) { return VertexId(layer * n + i % n); };
    core::Random random(5);
    std::vector<std::uint32_t> of_quads_alone;
    for (std::size_t layer = 0; layer < layers; ++layer)
        for (std::size_t i = 0; i < n; ++i) {
            const VertexId a = vertex(layer, i + 1), b = vertex(layer, i), c = vertex(layer + 1, i),
                           d = vertex(layer + 1, i + 1);
            const auto column = static_cast<std::uint32_t>(i);
            if (of_quads) {
                mesh.quads.push_back({{a, b, c, d}});
                of_quads_alone.push_back(column);
                continue;
            }
            const bool way = random.below(2) == 0;
            mesh.triangles.push_back(way ? Triangle{{a, b, c}} : Triangle{{a, b, d}});
            mesh.triangles.push_back(way ? Triangle{{a, c, d}} : Triangle{{b, c, d}});
            ring.columns.insert(ring.columns.end(), 2, column);
        }
    const double outer = radius + 0.5;
    const std::size_t first = mesh.points.size();
    for (std::size_t i = 0; i < n; ++i) mesh.points.push_back(on_circle(outer, static_cast<double>(i) + 0.5));
    mesh.markers = {{"wall", MarkerKind::wall, {}}, {"farfield", MarkerKind::far_field, {}}};
    for (std::size_t i = 0; i < n; ++i) {
        const VertexId a = vertex(layers, i), b = vertex(layers, i + 1), c = VertexId(first + i),
                       d = VertexId(first + (i + 1) % n);
        mesh.triangles.push_back({{b, a, c}});
        mesh.triangles.push_back({{b, c, d}});
        mesh.markers[0].edges.push_back({vertex(0, i + 1), vertex(0, i)});
        mesh.markers[1].edges.push_back({c, d});
        WallCurve& wall = ring.walls.emplace_back(WallCurve{mesh.markers[0].edges.back(), {}});
        for (unsigned k = 1; k < 2 * order; ++k)
            wall.between.push_back(on_circle(1, static_cast<double>(i + 1) - static_cast<double>(k) / (2.0 * order)));
    }
    ring.columns.insert(ring.columns.end(), of_quads_alone.begin(), of_quads_alone.end());
    return ring;
}

TEST(CurveCells, OfThinColumnsFollowTheWall) {
    for (const bool of_quads : {true, false})
        for (unsigned order = 2; order <= max_cell_order; ++order)
            for (const std::size_t layers : {0u, 1u, 12u}) {
                SCOPED_TRACE(testing::Message() << of_quads << ", order " << order << ", layers " << layers);
                const Ring ring = make_ring(of_quads, order, layers);
                ASSERT_TRUE(check_mesh(ring.mesh).valid());
                const CurvedCells curved = curve_cells(ring.mesh, {order}, ring.walls, {ring.columns});
                EXPECT_EQ(curved.summary.reduced_edges, 0u);
                EXPECT_EQ(curved.summary.curved_edges, columns_of_ring);
                const CurvedCheck check = check_curved(ring.mesh, curved.nodes);
                EXPECT_TRUE(check.valid());
                EXPECT_GT(check.min_scaled_jacobian, 0.3);
                for (std::size_t i = 0; i < columns_of_ring * (order - 1); ++i) {
                    const std::size_t node = curved.nodes.marker_nodes[i].index() - ring.mesh.points.size();
                    EXPECT_NEAR(length(curved.nodes.points[node]), 1, 1e-15);
                }
                const Marker& far_field = ring.mesh.markers[1];
                auto node = curved.nodes.marker_nodes.begin() + columns_of_ring * (order - 1);
                for (const Segment& edge : far_field.edges)
                    for (unsigned k = 1; k < order; ++k, ++node) {
                        const Point a = ring.mesh.points[edge.a.index()], b = ring.mesh.points[edge.b.index()];
                        const Point on_chord = a + (static_cast<double>(k) / order) * (b - a);
                        EXPECT_LT(distance(curved.nodes.points[node->index() - ring.mesh.points.size()], on_chord),
                                  1e-15);
                    }
                // Every node belongs to a cell.
                std::set<VertexId> used(curved.nodes.triangle_nodes.begin(), curved.nodes.triangle_nodes.end());
                used.insert(curved.nodes.quad_nodes.begin(), curved.nodes.quad_nodes.end());
                EXPECT_EQ(used.size(), curved.nodes.points.size());
            }
}

/// Makes the curve of the first edge of a ring bend by so much.
void bend_first_wall(Ring& ring, double height) {
    double share = 0;
    for (Point& p : ring.walls[0].between) {
        share += 1.0 / static_cast<double>(ring.walls[0].between.size() + 1);
        p = (1 + 4 * height * share * (1 - share)) * p;
    }
}

TEST(CurveCells, BendLessWhereTheyWouldFold) {
    // The curve of one edge is as high as five columns.
    Ring ring = make_ring(true, 3, 3);
    bend_first_wall(ring, 1);
    const CurvedCells curved = curve_cells(ring.mesh, {3}, ring.walls, {ring.columns});
    EXPECT_TRUE(check_curved(ring.mesh, curved.nodes).valid());
    EXPECT_EQ(curved.summary.reduced_edges, 1u);
    EXPECT_EQ(curved.summary.curved_edges, columns_of_ring - 1);
    EXPECT_GT(curved.summary.reduced_distance, 0.1);
    EXPECT_LT(curved.summary.wall_distance, 1e-4);
}

TEST(CurveCells, BendLessWhereTheyWouldBeSqueezed) {
    std::size_t reduced = 0;
    for (const bool of_quads : {true, false})
        for (int step = 0; step <= 60; ++step) {
            Ring ring = make_ring(of_quads, 2, 3);
            bend_first_wall(ring, 0.01 * step);
            const CurvedCells curved = curve_cells(ring.mesh, {2}, ring.walls, {ring.columns});
            EXPECT_GE(curved.check.min_scaled_jacobian, 0.02) << step;
            reduced += curved.summary.reduced_edges;
        }
    EXPECT_GT(reduced, 20u);
    EXPECT_LT(reduced, 100u);
}

}  // namespace
}  // namespace lamina::mesh
