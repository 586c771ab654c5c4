// The share of the requested layers that was made: everywhere, and where an empty circle three full heights in diameter
// touches the wall.
#include <gtest/gtest.h>

#include <lamina/layers.hpp>

#include "layers/checked_layer.hpp"
#include "layers/layer.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

LayerOptions ten_layers(double full_height) {
    LayerOptions options;
    options.layers = 10;
    options.first_height = 1.0;
    options.first_height = full_height / layer_height(test::growth_of(options), *options.layers);
    return options;
}

std::vector<ElementCoverage> coverage_of(std::initializer_list<shapes::Outline> bodies, const LayerOptions& options) {
    return test::checked_layer(shapes::geometry(bodies), options).coverage;
}

TEST(Coverage, CountsRaysAndTheCellsBetween) {
    const LayerOptions options = ten_layers(0.1);
    const ElementCoverage coverage = coverage_of({shapes::circle(1, 90)}, options)[0];
    const LayerCoverage &all = coverage.all, &open = coverage.open;
    EXPECT_EQ(all.rays, 90u);
    EXPECT_EQ(all.requested_cells, 900u);
    EXPECT_EQ(all.made_cells, 900u);
    EXPECT_EQ(all.incomplete_rays, 0u);
    EXPECT_EQ(open.rays, all.rays);
    EXPECT_EQ(open.requested_cells, all.requested_cells);
    EXPECT_EQ(open.made_cells, all.made_cells);
}

TEST(Coverage, ElementsAddUp) {
    const auto elements =
        coverage_of({shapes::circle(1, 90), shapes::moved(shapes::circle(1, 50), 0, 1, {2.2, 0})}, ten_layers(0.2));
    ElementCoverage total;
    for (const ElementCoverage& element : elements) total += element;
    EXPECT_EQ(total.all.rays, elements[0].all.rays + elements[1].all.rays);
    EXPECT_EQ(total.open.made_cells, elements[0].open.made_cells + elements[1].open.made_cells);
    EXPECT_GT(total.all.incomplete_rays, 0u);
    EXPECT_LT(total.open.rays, total.all.rays);
}

TEST(Coverage, ASlotIsOpenFromThreeHeightsOn) {
    const auto open_rays = [](double gap) {
        const shapes::Outline plate = shapes::refined(shapes::polygon({{0, 0}, {4, 0}, {4, 1}, {0, 1}}), 40);
        const auto elements = coverage_of({plate, shapes::moved(plate, 0, 1, {0, 1 + gap})}, ten_layers(0.1));
        EXPECT_EQ(elements[0].open.rays, elements[1].open.rays);
        return elements[0].all.rays - elements[0].open.rays;
    };
    EXPECT_EQ(open_rays(0.31), 0u);
    EXPECT_GE(open_rays(0.27), 41u);
}

TEST(Coverage, ConcaveCornersAreNotOpenWhereTheirLayersMeet) {
    const double height = 0.05;
    LayerOptions options = ten_layers(height);
    options.max_ray_angle_deg = 90;  // one ray per vertex
    const Layer layer = test::make_layer(shapes::geometry({shapes::refined(shapes::l_shape(), 40)}), options);
    // Wall vertices are 1 / 40 apart. A circle 3 heights in diameter that touches one wall reaches the other one up to
    // its radius away from the corner, and less far where the rays lean out of the corner.
    const std::size_t closed = layer.coverage[0].all.rays - layer.coverage[0].open.rays;
    const double expected = 2 * 1.5 * height * 40;
    EXPECT_GE(double(closed), 0.4 * expected);
    EXPECT_LE(double(closed), 2 * expected);
}

TEST(Coverage, IsEmptyWhereTheLayerIsDisabled) {
    LayerOptions options;
    options.enabled = false;
    EXPECT_TRUE(coverage_of({shapes::circle(1, 50)}, options).empty());
}

}  // namespace
}  // namespace lamina
