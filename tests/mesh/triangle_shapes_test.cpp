// measure_triangles() against core::measure_triangle(), bit by bit, and its signs against exact arithmetic.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <lamina/predicates.hpp>

#include "core/cell_shape.hpp"
#include "mesh/triangle_shapes.hpp"

namespace lamina {
namespace {

using mesh::TriangleShapes;

/// Returns points in clusters and on lines, so that triangles are of all shapes, flat ones among them.
std::vector<Point> awkward_points(std::size_t n) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Point> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = unit(random), y = unit(random);
        switch (i % 5) {
            case 0:
                points.push_back({x, y});
                break;
            case 1:
                points.push_back({x, 0.5});
                break;
            case 2:
                points.push_back({0.5 + 1e-13 * x, 0.5 + 1e-13 * y});
                break;
            case 3:
                points.push_back({x, 0.1 * x + 1e-17 * y});
                break;
            default:
                points.push_back({std::floor(4 * x), std::floor(4 * y)});
        }
    }
    return points;
}

TEST(TriangleShapes, AreThoseOfSingleTriangles) {
    const std::vector<Point> points = awkward_points(300);
    std::mt19937 random(8);
    std::size_t flat = 0, acute = 0;
    for (const std::size_t count : {1u, 3u, 4u, 7u, 255u, 256u}) {
        for (int round = 0; round < 40; ++round) {
            std::vector<Triangle> triangles(count);
            for (Triangle& t : triangles)
                for (VertexId& v : t.v) v = VertexId{random() % points.size()};
            TriangleShapes shapes;
            mesh::measure_triangles(points.data(), triangles, shapes);
            ASSERT_EQ(shapes.size, count);
            for (std::size_t i = 0; i < count; ++i) {
                const Point a = points[triangles[i].v[0].index()], b = points[triangles[i].v[1].index()],
                            c = points[triangles[i].v[2].index()];
                const core::CellShape one = core::measure_triangle(a, b, c), other = shapes.shape(i);
                const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value); };
                EXPECT_EQ(bits(other.area), bits(one.area));
                EXPECT_EQ(bits(other.min_angle_deg), bits(one.min_angle_deg));
                EXPECT_EQ(bits(other.max_angle_deg), bits(one.max_angle_deg));
                EXPECT_EQ(bits(other.aspect_ratio), bits(one.aspect_ratio));
                EXPECT_EQ(bits(other.mean_ratio), bits(one.mean_ratio));
                const double turn = orient2d(a, b, c);
                if (shapes.turn[i] > 0) {
                    EXPECT_GT(turn, 0);
                }
                flat += turn == 0;
                if (!(shapes.acuteness[i] > 0)) continue;
                ++acute;
                const auto product = [](Point p, Point q, Point r) {
                    return (static_cast<long double>(p.x) - q.x) * (static_cast<long double>(r.x) - q.x) +
                           (static_cast<long double>(p.y) - q.y) * (static_cast<long double>(r.y) - q.y);
                };
                EXPECT_GT(product(a, b, c), 0);
                EXPECT_GT(product(b, c, a), 0);
                EXPECT_GT(product(c, a, b), 0);
            }
        }
    }
    EXPECT_GT(flat, 100u);
    EXPECT_GT(acute, 100u);
}

TEST(TriangleShapes, AddUpToTheirSums) {
    const std::vector<Point> points = awkward_points(300);
    for (const std::size_t count : {1u, 2u, 6u, 250u}) {
        std::vector<Triangle> triangles;
        for (std::size_t i = 0; i < count; ++i)
            triangles.push_back({{VertexId{i}, VertexId{(i + 5) % 300}, VertexId{(i + 10) % 300}}});
        TriangleShapes shapes;
        mesh::measure_triangles(points.data(), triangles, shapes);
        const mesh::ShapeTotals totals = mesh::add_up(shapes);
        double area = 0, least = 180, largest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            area += shapes.area[i];
            least = std::min(least, shapes.min_angle_deg[i]);
            largest = std::max(largest, shapes.max_angle_deg[i]);
        }
        EXPECT_NEAR(totals.area, area, 1e-12);
        EXPECT_EQ(totals.min_angle_deg, least);
        EXPECT_EQ(totals.max_angle_deg, largest);
    }
}

}  // namespace
}  // namespace lamina
