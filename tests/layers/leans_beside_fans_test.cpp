// Rays beside fans lean towards them so that columns widen with the height, and numbers of layers stay the same across
// narrow columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/directions/corners.hpp"
#include "layers/directions/rays.hpp"
#include "layers/growth.hpp"
#include "layers/heights/heights.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double front_height = 0.05;

/// Returns a section whose edges at the trailing edge are 1 / 10,000 chords long.
Outline finely_divided_section(double base) {
    Outline outline = shapes::section(0.12, base, 160);
    if (base == 0) return outline;
    const Point lower = outline.back(), upper = outline.front();
    const int parts = static_cast<int>(std::ceil(base / 1e-4));
    for (int k = 1; k < parts; ++k) outline.push_back(lower + (double(k) / parts) * (upper - lower));
    return outline;
}

std::vector<RayLine> spread_rays(const Outline& outline, bool spread) {
    const LayerOptions options;
    const std::vector<double> heights(spread ? outline.size() : 0, front_height);
    return layers::make_rays(layers::outline_with_wake(outline), layers::OutlineKind::smooth, options,
                             test::growth_of(options), heights);
}

TEST(LeansBesideFans, KeepsOriginsAndTheOrderOfDirections) {
    const LayerOptions options;
    for (const double base : {0.0, 0.0005, 0.003, 0.02}) {
        SCOPED_TRACE(base);
        const Outline outline = finely_divided_section(base);
        const std::vector<RayLine> rays = spread_rays(outline, true);
        std::size_t vertex = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayLine &ray = rays[i], &next = rays[(i + 1) % rays.size()];
            vertex += vertex + 1 < outline.size() && ray.origin == outline[vertex + 1];
            // The nose, which is coarse, has refining rays, and the base, whose rays lean apart.
            if (ray.origin.x > 0.5 && ray.origin.x < 1) {
                EXPECT_EQ(ray.origin, outline[vertex]) << "no ray is added, and none is left out";
            }
            const double turning = core::degrees(core::angle_between(ray.direction, next.direction));
            // Rays of wide columns may converge, but stay apart up to the front and beyond.
            const double edge = distance(ray.origin, next.origin);
            EXPECT_GE(edge + front_height * core::radians(turning), 0.5 * edge) << ray.origin.x << " " << ray.origin.y;
            EXPECT_LT(turning, options.max_ray_angle_deg + 1e-9) << ray.origin.x << " " << ray.origin.y;
            if (ray.origin != next.origin) {
                const Point normal = -perpendicular(unit(next.origin - ray.origin));
                EXPECT_LT(std::abs(core::degrees(core::angle_between(normal, ray.direction))), 52) << ray.origin.x;
            }
        }
        EXPECT_EQ(vertex + 1, outline.size());
    }
}

/// Returns a plate from which the corner at the origin, its first vertex, cuts off an angle. The corner turns by so
/// many degrees, and the edges beside it are short.
Outline plate_with_corner(double turning_deg) {
    const double angle = core::radians(turning_deg);
    const Point before{0, 1}, after = core::rotated(before, angle);
    Outline outline{{0, 0}};
    const auto lengths = [](int k) { return 1e-4 * k * (1 + 0.05 * k); };
    for (int k = 1; k <= 60; ++k) outline.push_back(lengths(k) * after);
    for (int k = 60; k >= 1; --k) outline.push_back(-lengths(k) * before);
    return outline;
}

/// Long cells on both sides of one ray at which rows turn by 90 degrees have a skewness of 2.5. Fans of corners keep a
/// column for that, and rays beside them lean by no more than 35 degrees.
TEST(LeansBesideFans, CornersKeepAColumn) {
    const LayerOptions options;
    for (const double turning : {40.0, 60.0, 75.0, 90.0, 100.0, 115.0}) {
        SCOPED_TRACE(turning);
        const Outline outline = plate_with_corner(turning);
        std::vector<Point> at_corner;
        for (const RayLine& ray : spread_rays(outline, true))
            if (ray.origin == outline[0]) at_corner.push_back(ray.direction);
        ASSERT_GE(at_corner.size(), 2u);
        const auto turned = [](Point a, Point b) { return core::degrees(core::angle_between(a, b)); };
        const double kept = turned(at_corner.front(), at_corner.back());
        EXPECT_GT(kept, 0.99 * options.max_ray_angle_deg);
        const Point before = -perpendicular(unit(outline[0] - outline.back())),
                    after = -perpendicular(unit(outline[1] - outline[0]));
        EXPECT_LT(turned(before, at_corner.front()), 35.01);
        EXPECT_LT(turned(at_corner.back(), after), 35.01);
        EXPECT_NEAR(turned(before, at_corner.front()), turned(at_corner.back(), after), 0.01) << "round the bisector";
    }
}

/// Returns a wedge whose finely divided tail bulges: its walls are concave first, and then convex.
Outline bulging_tail() {
    const auto half_thickness = [](double x) {
        const double u = std::min(1.0, std::abs(x - 0.985) / 0.015);
        return 0.05 * (1 - x) + 0.003 * (1 - u * u) * (1 - u * u);
    };
    Outline upper{{1, 0}};
    for (double x = 1, step = 1e-4; x - step > 0; step *= x < 0.95 ? 1.1 : 1) {
        x -= step;
        upper.push_back({x, half_thickness(x)});
    }
    Outline outline = upper;
    outline.push_back({0, 0});
    for (std::size_t k = upper.size() - 1; k > 0; --k) outline.push_back({upper[k].x, -upper[k].y});
    return outline;
}

/// Rays lean for several reasons, but first layers are as high above both edges where the wall bends.
TEST(LeansBesideFans, KeepsFirstHeightsInConcaveWalls) {
    for (const double radius : {0.01, 0.02, 0.04, 0.08})
        for (const int parts : {20, 30, 45}) {
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", " << parts << " parts");
            // An L with arms of unequal length, whose inner corner is round.
            const double step = 0.5 * core::pi / parts, edge = step * radius;
            Outline outline{{0.5, -0.3}, {0.5, 0}};
            for (double x = 0.5 - edge; x > radius; x -= edge) outline.push_back({x, 0});
            for (int k = 0; k <= parts; ++k)
                outline.push_back(Point{radius, radius} - radius * Point{std::sin(k * step), std::cos(k * step)});
            for (double y = radius + edge; y < 1; y += edge) outline.push_back({0, y});
            outline.insert(outline.end(), {{0, 1}, {-0.3, 1}, {-0.3, -0.3}});
            RaySet set{spread_rays(outline, true), {}};
            set.begin = {0, set.lines.size()};
            const LayerGrowth growth = test::growth_of({});
            layers::set_slants(set);
            layers::shift_rays_of_corners(growth, set);
            const std::vector<RayLine>& rays = set.lines;
            for (std::size_t i = 1; i + 1 < rays.size(); ++i) {
                const RayLine &before = rays[i - 1], &ray = rays[i], &next = rays[i + 1];
                if (ray.origin.x < 0 || ray.origin.y < 0 || length(ray.origin) > 0.4) continue;
                const Point top = ray.at(layers::first_height_along(ray, growth.first_height)) - ray.origin;
                for (const Point side : {ray.origin - before.origin, next.origin - ray.origin})
                    EXPECT_NEAR(dot(-perpendicular(unit(side)), top) / growth.first_height, 1, 0.0095)
                        << ray.origin.x << " " << ray.origin.y;
            }
        }
}

/// Expects a mirrored outline to have mirrored rays.
void expect_mirrored(const Outline& outline) {
    Outline mirrored;
    for (const Point p : outline) mirrored.insert(mirrored.begin(), {p.x, -p.y});
    const std::vector<RayLine> rays = spread_rays(outline, true);
    std::vector<RayLine> others = spread_rays(mirrored, true);
    std::reverse(others.begin(), others.end());
    ASSERT_EQ(rays.size(), others.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(rays[i].origin.x, others[i].origin.x);
        EXPECT_NEAR(rays[i].direction.x, others[i].direction.x, 1e-12);
        EXPECT_NEAR(rays[i].direction.y, -others[i].direction.y, 1e-12);
    }
}

TEST(LeansBesideFans, MirroredOutlinesHaveMirroredRays) {
    expect_mirrored(finely_divided_section(0.003));
    expect_mirrored(bulging_tail());
}

}  // namespace
}  // namespace lamina
