// Layers end where the space for them does, not in steps.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/layers.hpp>

#include "layers/fit_heights.hpp"
#include "layers/growth_laws.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

constexpr std::uint32_t asked = 30;

LayerHeights one_stack() {
    return LayerHeights(layers::growth_law_entry(GrowthLaw::geometric).heights(1e-3, 1.2, asked), {{0, asked, 1.2}});
}

TEST(FitHeights, ALayerEndsAtTheLimit) {
    const LayerHeights heights = one_stack();
    for (double share = 0.9999; share * heights.full_height(0) > 0.04; share *= 0.97) {
        const double limit = share * heights.full_height(0);
        const LayerHeights fitted = layers::fit_heights(heights, std::vector{limit});
        const std::span<const double> stack = fitted.of(0);
        ASSERT_EQ(stack.size(), asked + 1u);
        EXPECT_LE(std::abs(std::log(fitted.column(0).stretch)), std::log(max_stretch) + 1e-12);
        const auto top = std::upper_bound(stack.begin(), stack.end(), limit) - 1;
        EXPECT_NEAR(*top / limit, 1, 1e-9);
        EXPECT_EQ(stack[1], heights.of(0)[1]);
        for (std::size_t n = 2; n <= asked; ++n) {
            EXPECT_NEAR((stack[n] - stack[n - 1]) / (stack[n - 1] - stack[n - 2]), 1.2 * fitted.column(0).stretch,
                        1e-9);
        }
    }
}

TEST(FitHeights, NothingChangesWithoutALimitOrWithoutRoom) {
    const LayerHeights heights = one_stack();
    for (double limit : {HUGE_VAL, heights.full_height(0), 0.5e-3, 0.0}) {
        const LayerHeights fitted = layers::fit_heights(heights, std::vector{limit});
        EXPECT_EQ(fitted.column(0).stretch, 1);
        EXPECT_EQ(fitted.table(), heights.table());
    }
}

TEST(FitHeights, OfFewLayersGrowthStaysNearWhatWasAskedFor) {
    const LayerHeights heights = one_stack();
    for (double limit = 1e-3; limit < 1e-2; limit *= 1.03) {
        const LayerHeights fitted = layers::fit_heights(heights, std::vector{limit});
        const std::span<const double> stack = fitted.of(0), fixed = heights.of(0);
        const auto top = std::upper_bound(stack.begin(), stack.end(), limit) - 1;
        const auto fixed_top = std::upper_bound(fixed.begin(), fixed.end(), limit) - 1;
        EXPECT_GE(*top, *fixed_top);
        EXPECT_LE(std::abs(std::log(fitted.column(0).stretch)), std::log(max_stretch) + 1e-12);
    }
}

/// Two plates that meet at an acute angle but for a gap: the layers between them thin evenly.
TEST(FitHeights, LayersInAWedgeThinWithoutSteps) {
    const shapes::Outline plate = shapes::refined(shapes::polygon({{0, -0.5}, {4, -0.5}, {4, 0}, {0, 0}}), 100);
    const shapes::Outline other = shapes::refined(shapes::polygon({{0, 0.05}, {4, 0.6}, {4, 1.2}, {0, 0.6}}), 100);
    LayerOptions options;
    options.layers = asked;
    options.first_height = 0.4 / layer_height(test::growth_of(options), asked) * test::first_height(options);
    const Layer layer = test::make_layer(shapes::geometry({plate, other}), options);
    EXPECT_EQ(check_layer(layer, options), std::vector<std::string>{});
    const std::vector<Ray>& rays = layer.rays[0];
    std::size_t compared = 0;
    for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
        const auto tip = [&](const Ray& ray) { return layer.points[ray.first_point + ray.layers - 1]; };
        const Ray &ray = rays[i], &next = rays[i + 1];
        const double x = layer.points[ray.origin.index()].x;
        if (x < 0.3 || x > 3.6 || ray.direction.y < 0.999 || next.direction.y < 0.999) continue;
        EXPECT_NEAR(tip(ray).y / tip(next).y, 1, 0.08);
        ++compared;
    }
    EXPECT_GT(compared, 60u);
}

}  // namespace
}  // namespace lamina
