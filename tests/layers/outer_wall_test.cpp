// Walls on the border of the domain, whose rays go on beyond both of its sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/predicates.hpp>

#include "layers/expect_cover.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

constexpr double side = 3, floor_y = -1.2;

/// Returns a plate from x = -5 to 5, whose upper side bounds the domain from the right to the left between both sides.
OuterWall floor_below(double first_height) {
    constexpr int half = 30;
    constexpr double spacing = side / half;
    OuterWall wall{{}, 2 * half + 1, first_height};
    for (int i = half; i >= -half; --i) wall.points.push_back({spacing * i, floor_y});
    wall.points.insert(wall.points.end(), {{-5, floor_y}, {-5, floor_y - 1}, {5, floor_y - 1}, {5, floor_y}});
    return wall;
}

double doubled_area(const Layer& layer, const std::vector<VertexId>& loop) {
    double area = 0;
    for (std::size_t i = 0; i < loop.size(); ++i)
        area += cross(layer.points[loop[i].index()], layer.points[loop[(i + 1) % loop.size()].index()]);
    return area;
}

class OuterWallLayers : public testing::TestWithParam<double> {
protected:
    static Layer layer() {
        const LayerOptions options = test::layers_of(1e-3, 1.2, 14);
        const OuterWall wall = floor_below(GetParam());
        return close_border(
            grow_rays(shapes::geometry({shapes::circle(1, 120)}), options, test::growth_of(options), {&wall, 1}));
    }
};

TEST_P(OuterWallLayers, EndAtTheSidesOfTheDomain) {
    const Layer made = layer();
    ASSERT_EQ(made.outer_walls, 1u);
    ASSERT_EQ(made.walls.size(), 2u);
    EXPECT_FALSE(made.is_outer(0));
    EXPECT_TRUE(made.is_outer(1));
    for (const Point p : made.points) EXPECT_LE(std::abs(p.x), side) << "nothing beyond the sides is left";
    for (const std::vector<VertexId>* chain : {&made.walls[1], &made.borders[1]}) {
        EXPECT_EQ(made.points[chain->front().index()].x, side);
        EXPECT_EQ(made.points[chain->back().index()].x, -side);
    }
    ASSERT_EQ(made.rays[1].size(), 61u);
    std::size_t on_sides = 0;
    for (const std::size_t end : {std::size_t{0}, std::size_t{60}}) on_sides += made.rays[1][end].layers;
    EXPECT_EQ(made.edges.sides.size(), on_sides);
    EXPECT_EQ(on_sides > 0, GetParam() > 0);
    for (const Segment& edge : made.edges.sides) {
        const Point a = made.points[edge.a.index()], b = made.points[edge.b.index()];
        EXPECT_EQ(a.x, b.x);
        EXPECT_EQ(b.y > a.y, a.x > 0) << "the layer lies on the left";
    }
    EXPECT_EQ(made.edges.walls[1].size(), made.walls[1].size() - 1);
}

TEST_P(OuterWallLayers, CellsCoverThem) {
    const Layer made = layer();
    // The border of the floor, back along its wall and the sides, bounds what the circle's layer leaves of all cells.
    std::vector<VertexId> loop = made.borders[1];
    const Ray &first = made.rays[1].front(), &last = made.rays[1].back();
    for (std::uint32_t n = last.layers; n-- > 0;) loop.push_back(last.vertex(n));
    if (last.layers > 0)
        loop.insert(loop.end(), made.walls[1].rbegin() + 1, made.walls[1].rend());
    else
        loop.insert(loop.end(), made.walls[1].rbegin() + 1, made.walls[1].rend() - 1);
    for (std::uint32_t n = 1; n < first.layers; ++n) loop.push_back(first.vertex(n));
    const double expected =
        doubled_area(made, loop) + doubled_area(made, made.borders[0]) - doubled_area(made, made.walls[0]);
    for (const LayerTopology topology : test::topologies) {
        double area = 0;
        test::for_each_cell(fill_layer(made, topology), [&](const std::vector<VertexId>& cell, int) {
            EXPECT_TRUE(test::strictly_convex(made, cell));
            area += doubled_area(made, cell);
        });
        EXPECT_NEAR(area, expected, 1e-12 * expected);
    }
}

INSTANTIATE_TEST_SUITE_P(FirstHeights, OuterWallLayers, testing::Values(0.0, 1e-3, 2e-4));

}  // namespace
}  // namespace lamina
