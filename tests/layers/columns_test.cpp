// Columns end at the front, which something in the way lowers, and not in steps of a whole layer.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/checked_layer.hpp"
#include "layers/heights/heights.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/room/counts.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

constexpr std::uint32_t requested = 30;

LayerGrowth growth_of_thirty() {
    return {.first_height = 1e-3, .growth = 1.2, .layers = requested, .first_heights = {}, .wakes = {}};
}

/// Returns the heights of all layers that are requested.
std::vector<double> all_heights() {
    std::vector<double> heights;
    for (std::uint32_t n = 0; n <= requested; ++n) heights.push_back(layer_height(growth_of_thirty(), n));
    return heights;
}

/// Returns the column of one ray whose front is at this height.
LayerHeights column_up_to(double front) {
    const RaySet set{{{{0, 0}, {0, 1}}}, {0, 1}};
    const std::vector<double> asked = layers::asked_heights(set, growth_of_thirty());
    return layers::columns_up_to(set, growth_of_thirty(), asked, std::vector{std::min(front, asked[0])});
}

TEST(Columns, EndAtTheFront) {
    const std::vector<double> all = all_heights();
    for (double share = 0.9999; share * all.back() > 0.04; share *= 0.97) {
        const double front = share * all.back();
        const LayerHeights made = column_up_to(front);
        const std::span<const double> column = made.of(0);
        const Stretch& stretch = made.column(0).stretch;
        EXPECT_TRUE(made.column(0).cut);
        EXPECT_LE(std::abs(std::log(stretch.factor)), std::log(max_stretch) + 1e-12);
        EXPECT_NEAR(column.back() / front, 1, 1e-9);
        EXPECT_LE(column.back(), front * (1 + 1e-15));
        EXPECT_EQ(stretch.above, made.column(0).layers / 2) << "the upper half of the layers is stretched";
        for (std::size_t n = 1; n <= stretch.above; ++n) EXPECT_EQ(column[n], all[n]);
        for (std::size_t n = stretch.above + std::size_t{1}; n < column.size(); ++n)
            EXPECT_NEAR((column[n] - column[n - 1]) / (column[n - 1] - column[n - 2]), 1.2 * stretch.factor, 1e-9);
    }
}

TEST(Columns, HaveTheHeightsOfTheLawWhereNothingIsInTheWay) {
    const std::vector<double> all = all_heights();
    const LayerHeights whole = column_up_to(all.back());
    EXPECT_EQ(whole.table(), all);
    EXPECT_EQ(whole.column(0).stretch.factor, 1);
    EXPECT_FALSE(whole.column(0).cut);
}

TEST(Columns, HaveNoLayersBelowTheFirstHeight) {
    for (const double front : {0.5e-3, 0.0}) EXPECT_EQ(column_up_to(front).column(0).layers, 0u);
}

TEST(Columns, OfFewLayersKeepTheirGrowthNearly) {
    const std::vector<double> all = all_heights();
    for (double front = 1e-3; front < 1e-2; front *= 1.03) {
        const LayerHeights made = column_up_to(front);
        EXPECT_GE(made.of(0).back(), *(std::upper_bound(all.begin(), all.end(), front) - 1));
        EXPECT_LE(std::abs(std::log(made.column(0).stretch.factor)), std::log(max_stretch) + 1e-12);
    }
}

/// A ray has fewer layers than requested because those of its neighbour are cut short. They end where all would.
TEST(Columns, WithFewerLayersForTheirNeighboursEndAtTheSameHeight) {
    const std::vector<double> all = all_heights();
    const RaySet set = test::rays_in_a_row(std::vector<double>(4, 1.0));
    const std::vector<double> asked(4, all.back());
    std::vector<double> front = asked;
    front[1] = front[2] = all[requested - 12];
    const LayerHeights made = layers::columns_up_to(set, growth_of_thirty(), asked, front);
    for (const std::size_t i : {1, 2}) EXPECT_NEAR(made.of(i).back() / all[requested - 12], 1, 1e-9);
    for (const std::size_t i : {0, 3}) {
        EXPECT_EQ(made.column(i).layers, made.column(1).layers + 1);
        EXPECT_GT(made.column(i).stretch.factor, 1);
    }
}

/// A small body between two rays meets no front, and lies in no cell of another element all the same.
TEST(Columns, EndBelowAnElementBetweenTwoRays) {
    const Point middle{0, 0.9};
    RaySet set;
    for (const Point p : {Point{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) set.lines.push_back({p, unit(p)});
    set.begin.push_back(set.lines.size());
    for (const Point p : {Point{0.01, -0.01}, {0, 0.01}, {-0.01, -0.01}}) set.lines.push_back({middle + p, unit(p)});
    set.begin.push_back(set.lines.size());
    std::vector<double> heights;
    for (int n = 0; n <= 10; ++n) heights.push_back(0.1 * n);
    std::vector<HeightColumn> columns(4, {.layers = 10});
    columns.resize(set.lines.size(), {.layers = 0});
    const std::vector<std::uint32_t> made =
        layers::layer_counts(set, LayerHeights(heights, columns), {10, 10, 10, 10, 0, 0, 0});
    for (const std::size_t i : {2, 3}) {
        EXPECT_GT(made[i], 0u);
        EXPECT_LT(set.lines[i].origin.y + heights[made[i]] * set.lines[i].direction.y, middle.y - 0.01);
    }
}

/// The front is the largest one below what is wanted that rises by no more than a slope: by another route, the least
/// sum of a height that is wanted and of what the slope allows on the way from there.
TEST(Fronts, AreInfConvolutions) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> width(0.5, 2), height(0.1, 6);
    for (int round = 0; round < 50; ++round) {
        std::vector<double> widths(40), wanted(40);
        for (std::size_t i = 0; i < widths.size(); ++i) {
            widths[i] = width(random);
            wanted[i] = height(random);
        }
        const RaySet set = test::rays_in_a_row(widths);
        std::vector<double> front = wanted;
        layers::bound_slopes(set, front);
        const std::size_t n = widths.size();
        for (std::size_t i = 0; i < n; ++i) {
            double least = wanted[i], forward = 0, backward = 0;
            for (std::size_t k = 1; k < n; ++k) {
                const auto between = [&](std::size_t a, std::size_t b) {
                    return distance(set.lines[a % n].origin, set.lines[b % n].origin);
                };
                forward += between(i + k - 1, i + k);
                backward += between(i + n - k + 1, i + n - k);
                least = std::min({least, wanted[(i + k) % n] + layers::max_front_slope * forward,
                                  wanted[(i + n - k) % n] + layers::max_front_slope * backward});
            }
            EXPECT_NEAR(front[i], least, 1e-12);
        }
        std::vector<double> again = front;
        layers::bound_slopes(set, again);
        EXPECT_EQ(again, front) << "a front that is smooth stays";
    }
}

/// Returns thirty rays side by side whose layers are 1.5 times as high along the last twenty.
Rays rays_with_a_step(double lean_deg) {
    Rays rays;
    rays.growth = growth_of_thirty();
    rays.growth.layers.reset();
    for (std::size_t i = 0; i < 30; ++i) {
        rays.set.lines.push_back({{0.01 * double(i), 0}, core::rotated(Point{0, 1}, core::radians(lean_deg))});
        rays.asked.push_back((i < 10 ? 1 : 1.5) * all_heights().back());
    }
    rays.set.begin.push_back(30);
    rays.limits.assign(30, HUGE_VAL);
    return rays;
}

TEST(Fronts, RiseLittleAndOnlyWhereTheyMust) {
    for (const double lean_deg : {-45.0, -30.0, 0.0, 30.0, 45.0}) {
        SCOPED_TRACE(lean_deg);
        const Rays rays = rays_with_a_step(lean_deg);
        const std::vector<double> front = layers::front_heights(rays);
        for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(front[i], rays.asked[i]) << i;
        EXPECT_LT(front[10], rays.asked[10]);
        for (std::size_t i = 0; i + 1 < front.size(); ++i) {
            const auto tip = [&](std::size_t ray) {
                return rays.set.lines[ray].origin + front[i] * rays.set.lines[ray].direction;
            };
            EXPECT_LE(front[i + 1] - front[i], layers::max_front_slope * distance(tip(i), tip(i + 1)) * (1 + 1e-12));
        }
    }
}

TEST(Fronts, LeaveFirstLayersToRaysBesideLowOnes) {
    Rays rays = rays_with_a_step(0);
    rays.limits[15] = 0;
    const std::vector<double> front = layers::front_heights(rays);
    EXPECT_EQ(front[15], 0);
    for (const std::size_t i : {14, 16}) EXPECT_GE(front[i], 1e-3);
}

/// Two plates nearly meet at an acute angle: the layers between them thin evenly.
TEST(Fronts, InAWedgeFallWithoutSteps) {
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

/// Layers of two bodies would meet if nothing limited them. They lose layers until they do not, and no wall is bare.
TEST(Fronts, ThatMeetLoseLayers) {
    const shapes::Outline flat = shapes::refined(shapes::box(), 500);
    const shapes::Outline tooth = shapes::refined(
        shapes::polygon({{0, 1.3}, {0.48, 1.3}, {0.5, 1.16}, {0.52, 1.3}, {1, 1.3}, {1, 2}, {0, 2}}), 500);
    LayerOptions options;
    options.layers = 35;
    options.first_height = Length(1e-4, LengthUnit::input);
    Rays rays = grow_rays(shapes::geometry({flat, tooth}), options, test::growth_of(options));
    rays.limits.assign(rays.limits.size(), HUGE_VAL);  // as if no ray met anything
    layers::fit_and_count_layers(rays);
    for (const std::uint32_t count : rays.counts) EXPECT_GT(count, 0u);
    for (const std::string& finding : check_layer(close_border(rays), options)) ADD_FAILURE() << finding;
}

}  // namespace
}  // namespace lamina
