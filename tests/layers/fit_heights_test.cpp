// Layers that are cut short end at the limits of their rays, not in steps of a whole layer.
#include <gtest/gtest.h>

#include <cmath>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/checked_layer.hpp"
#include "layers/fit_heights.hpp"
#include "layers/growth_laws.hpp"
#include "layers/layered_rays.hpp"
#include "layers/truncation.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

constexpr std::uint32_t requested = 30;

LayerHeights one_column() {
    return LayerHeights(layers::growth_law_entry(GrowthLaw::geometric).heights(1e-3, 1.2, requested),
                        {{0, requested, 1.2}});
}

RaySet one_ray() { return {{{{0, 0}, {0, 1}}}, {0, 1}}; }

TEST(FitHeights, ALayerEndsAtTheLimit) {
    const LayerHeights heights = one_column();
    for (double share = 0.9999; share * heights.full_height(0) > 0.04; share *= 0.97) {
        const double limit = share * heights.full_height(0);
        const LayerHeights fitted = layers::fit_heights(one_ray(), heights, std::vector{limit});
        const std::span<const double> column = fitted.of(0);
        ASSERT_EQ(column.size(), requested + 1u);
        EXPECT_LE(std::abs(std::log(fitted.column(0).stretch.factor)), std::log(max_stretch) + 1e-12);
        const auto top = std::upper_bound(column.begin(), column.end(), limit) - 1;
        EXPECT_NEAR(*top / limit, 1, 1e-9);
        const Stretch& stretch = fitted.column(0).stretch;
        const auto layers = static_cast<std::size_t>(top - column.begin());
        EXPECT_EQ(stretch.above, layers / 2) << "the upper half of the layers is stretched";
        for (std::size_t n = 1; n <= stretch.above; ++n) EXPECT_EQ(column[n], heights.of(0)[n]);
        for (std::size_t n = stretch.above + 1; n <= requested; ++n)
            EXPECT_NEAR((column[n] - column[n - 1]) / (column[n - 1] - column[n - 2]), 1.2 * stretch.factor, 1e-9);
    }
}

TEST(FitHeights, NothingChangesWithoutALimitOrBelowTheFirstLayer) {
    const LayerHeights heights = one_column();
    for (double limit : {HUGE_VAL, heights.full_height(0), 0.5e-3, 0.0}) {
        const LayerHeights fitted = layers::fit_heights(one_ray(), heights, std::vector{limit});
        EXPECT_EQ(fitted.column(0).stretch.factor, 1);
        EXPECT_EQ(fitted.table(), heights.table());
    }
}

/// Rows that rise towards the side to which rays lean are sheared by both.
TEST(FitHeights, EndsOfRaysThatLeanMakeNoSteepRows) {
    const std::size_t count = 60;
    for (const double lean_deg : {-45.0, -30.0, 0.0, 30.0, 45.0}) {
        SCOPED_TRACE(lean_deg);
        RaySet set;
        for (std::size_t i = 0; i < count; ++i)
            set.lines.push_back({{0.02 * double(i), 0}, core::rotated(Point{0, 1}, core::radians(lean_deg))});
        set.begin.push_back(count);
        const LayerHeights heights(one_column().table(), std::vector<HeightColumn>(count, {0, requested, 1.2}));
        std::vector<double> limits(count, HUGE_VAL);
        for (std::size_t i = 25; i < 35; ++i) limits[i] = 0.1;
        layers::smooth_limits(set, heights, limits);
        for (std::size_t i = 0; i + 1 < count; ++i) {
            const auto tip = [&](std::size_t ray) {
                const double height = std::min(limits[ray], heights.full_height(ray));
                return set.lines[ray].origin + height * set.lines[ray].direction;
            };
            const Point row = tip(i + 1) - tip(i), along = set.lines[i].direction;
            EXPECT_LT(std::abs(dot(row, along)), 1.351 * std::abs(cross(row, along))) << i;
        }
    }
}

TEST(FitHeights, FewLayersKeepTheirGrowthNearly) {
    const LayerHeights heights = one_column();
    for (double limit = 1e-3; limit < 1e-2; limit *= 1.03) {
        const LayerHeights fitted = layers::fit_heights(one_ray(), heights, std::vector{limit});
        const std::span<const double> column = fitted.of(0), fixed = heights.of(0);
        const auto top = std::upper_bound(column.begin(), column.end(), limit) - 1;
        const auto fixed_top = std::upper_bound(fixed.begin(), fixed.end(), limit) - 1;
        EXPECT_GE(*top, *fixed_top);
        EXPECT_LE(std::abs(std::log(fitted.column(0).stretch.factor)), std::log(max_stretch) + 1e-12);
    }
}

/// Two plates nearly meet at an acute angle: the layers between them thin evenly.
TEST(FitHeights, LayersInAWedgeThinWithoutSteps) {
    const shapes::Outline plate = shapes::refined(shapes::polygon({{0, -0.5}, {4, -0.5}, {4, 0}, {0, 0}}), 100);
    const shapes::Outline other = shapes::refined(shapes::polygon({{0, 0.05}, {4, 0.6}, {4, 1.2}, {0, 0.6}}), 100);
    LayerOptions options;
    options.layers = requested;
    options.first_height = 0.4 / layer_height(test::growth_of(options), requested) * test::first_height(options);
    const Layer layer = test::checked_layer(shapes::geometry({plate, other}), options);
    const std::vector<Ray>& rays = layer.rays[0];
    std::size_t compared = 0;
    for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
        const auto tip = [&](const Ray& ray) { return layer.points[ray.tip().index()]; };
        const Ray &ray = rays[i], &next = rays[i + 1];
        const double x = layer.points[ray.origin.index()].x;
        if (x < 0.3 || x > 3.6 || ray.direction.y < 0.999 || next.direction.y < 0.999) continue;
        EXPECT_NEAR(tip(ray).y / tip(next).y, 1, 0.08);
        ++compared;
    }
    EXPECT_GT(compared, 60u);
}

/// A ray has fewer layers than requested because those of its neighbour are cut short. They end where all would.
TEST(FitHeights, WholeColumnsThatHaveFewerLayersEndAtTheSameHeight) {
    const LayerHeights one = one_column();
    const std::size_t rays = 4;
    RaySet set;
    for (std::size_t i = 0; i < rays; ++i) set.lines.push_back({{double(i), 0}, {0, 1}});
    set.begin.push_back(rays);
    const LayerHeights heights(one.table(), std::vector<HeightColumn>(rays, one.column(0)));
    const double limit = one.of(0)[requested - 2];
    const LayerHeights fitted = layers::fit_heights(set, heights, std::vector{HUGE_VAL, limit, limit, HUGE_VAL});
    for (const std::size_t i : {1, 2}) EXPECT_EQ(fitted.of(i)[requested - 2], limit);
    for (const std::size_t i : {0, 3}) {
        EXPECT_NEAR(fitted.of(i)[requested - 1] / one.full_height(0), 1, 1e-9);
        EXPECT_GT(fitted.column(i).stretch.factor, 1);
    }
}

/// Heights along rays grow with the slant of the rays. Where something cuts rays short, ends of neighbours that are near
/// each other do not differ by much.
TEST(FitHeights, EndsOfRaysDoNotRiseSteeply) {
    const std::size_t rays = 30;
    const double apart = 0.01, max_rise = 0.6 * apart;
    const LayerHeights one = one_column();
    const std::span<const double> column = one.of(0);
    std::vector<double> table;
    std::vector<HeightColumn> columns;
    RaySet set;
    for (std::size_t i = 0; i < rays; ++i) {
        set.lines.push_back({{apart * double(i), 0}, {0, 1}});
        columns.push_back({table.size(), requested, 1.2});
        columns.back().slant = i < 10 ? 1 : 1.5;
        for (const double h : column) table.push_back(columns.back().slant * h);
    }
    set.begin.push_back(rays);
    const LayerHeights heights(table, columns);
    std::vector<double> limits(rays, HUGE_VAL);
    layers::smooth_limits(set, heights, limits);
    const auto end = [&](std::size_t i) { return std::min(limits[i], heights.full_height(i)); };
    for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(limits[i], HUGE_VAL) << i;
    EXPECT_LT(limits[10], heights.full_height(10));
    for (std::size_t i = 0; i + 1 < rays; ++i) EXPECT_LE(end(i + 1) - end(i), max_rise * (1 + 1e-12)) << i;
}

/// Layers of two bodies meet. Where they lose layers for that, their ends are no cliffs.
TEST(FitHeights, LayersThatMeetEndWithoutCliffs) {
    const shapes::Outline flat = shapes::refined(shapes::box(), 500);
    const shapes::Outline tooth = shapes::refined(
        shapes::polygon({{0, 1.3}, {0.48, 1.3}, {0.5, 1.16}, {0.52, 1.3}, {1, 1.3}, {1, 2}, {0, 2}}), 500);
    LayerOptions options;
    options.layers = 35;
    options.first_height = Length(1e-4, LengthUnit::input);
    Rays rays = grow_rays(shapes::geometry({flat, tooth}), options, test::growth_of(options));
    rays.limits.assign(rays.limits.size(), HUGE_VAL);  // as if no ray met anything
    layers::fit_and_count_layers(rays);
    const layers::LayeredRays layered = layers::layered_rays(rays);
    const std::vector<std::size_t> next = rays.set.following();
    double steepest = 0;
    std::size_t empty = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
        const RayLine &a = rays.set.lines[i], &b = rays.set.lines[next[i]];
        empty += rays.counts[i] == 0;
        if (a.direction != b.direction) continue;
        const Point step = layered.tip(next[i]) - layered.tip(i);
        steepest = std::max(steepest, std::abs(dot(step, a.direction) / cross(step, a.direction)));
    }
    EXPECT_LE(steepest, 0.3);
    EXPECT_EQ(empty, 0u);
}

}  // namespace
}  // namespace lamina
