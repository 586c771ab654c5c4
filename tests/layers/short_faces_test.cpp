// Rays on the risers of steps lean with those of the fans above them, and open so that columns become wider.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/rays.hpp"
#include "layers/short_faces.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double layer_height = 0.02;

/// Adds the points from the last one to `end`, `spacing` apart.
void add_straight(Point end, double spacing, Outline& outline) {
    const Point start = outline.back();
    const int parts = static_cast<int>(std::ceil(distance(start, end) / spacing));
    for (int k = 1; k <= parts; ++k) outline.push_back(start + (double(k) / parts) * (end - start));
}

/// Returns a plate from (0, 0) to (1, 0.1) whose upper side has a step of this height in the middle, lower on the right. The
/// riser leans to the right by `lean` times its height.
Outline stepped_plate(double height, double lean) {
    constexpr double spacing = 2e-3, on_riser = 1e-4;
    Outline outline{{0, 0}};
    add_straight({1, 0}, spacing, outline);
    add_straight({1, 0.1 - height}, spacing, outline);
    add_straight({0.5 + lean * height, 0.1 - height}, spacing, outline);
    add_straight({0.5, 0.1}, on_riser, outline);
    add_straight({0, 0.1}, spacing, outline);
    add_straight({0, 0}, spacing, outline);
    outline.pop_back();
    return outline;
}

std::vector<layers::RayVertex> with_least_heights(const Outline& outline) {
    std::vector<layers::RayVertex> vertices = layers::outline_with_wake(outline);
    for (layers::RayVertex& vertex : vertices) vertex.least_height = layer_height;
    return vertices;
}

std::vector<RayLine> rays_round(const Outline& outline, layers::OutlineKind kind = layers::OutlineKind::smooth) {
    LayerOptions options;
    options.layers.reset();
    LayerGrowth growth = test::growth_of(options);
    growth.least_heights = {WallHeight{}};
    return layers::make_rays(with_least_heights(outline), kind, options, growth,
                             std::vector<double>(outline.size(), layer_height));
}

/// Returns whether the edge between two points is a part of the riser; with one point, whether it is the top of it.
bool is_on_riser(Point a, Point b) {
    const bool near = std::abs(a.x - 0.5) < 0.02 && std::abs(b.x - 0.5) < 0.02 && a.y > 0.09 && b.y > 0.09;
    return near && (a == b ? a == Point{0.5, 0.1} : a.y != b.y);
}

TEST(ShortFaces, RaysOfRisersAndTheirFansDoNotMeet) {
    for (const double height : {0.0005, 0.003, 0.008})
        for (const double lean : {0.0, 1.0}) {
            SCOPED_TRACE(testing::Message() << height << " high, leans by " << lean);
            const std::vector<RayLine> rays = rays_round(stepped_plate(height, lean));
            double narrowest = HUGE_VAL;
            for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
                const RayLine &ray = rays[i], &next = rays[i + 1];
                if (!is_on_riser(ray.origin, next.origin)) continue;
                EXPECT_GT(core::degrees(core::angle_between(ray.direction, next.direction)), -1) << ray.origin.y;
                if (ray.origin == next.origin) continue;
                narrowest = std::min(narrowest, distance(ray.origin + layer_height * ray.direction,
                                                         next.origin + layer_height * next.direction));
            }
            // Columns of parallel rays would be cos 45 times as wide as the riser's edges at most.
            EXPECT_GT(narrowest, height < 0.001 ? 3e-4 : 1e-4);
        }
}

TEST(ShortFaces, OnlyRisersOpenAndNoFurtherThanTheirEndsAllow) {
    for (const double lean : {0.0, 1.0}) {
        const Outline outline = stepped_plate(0.003, lean);
        const std::size_t n = outline.size();
        std::vector<layers::WallVertex> vertices(n);
        for (std::size_t i = 0; i < n; ++i) {
            vertices[i].turning =
                core::angle_between(outline[i] - outline[(i + n - 1) % n], outline[(i + 1) % n] - outline[i]);
            vertices[i].fan = vertices[i].turning > core::radians(30);
        }
        std::vector<layers::RayVertex> ray_vertices = with_least_heights(outline);
        const std::vector<double> openings = layers::openings_on_short_faces(ray_vertices, vertices);
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const bool on_riser = is_on_riser(outline[i], outline[(i + 1) % n]);
            EXPECT_EQ(openings[i] > 0, on_riser) << outline[i].x << " " << outline[i].y;
            sum += openings[i];
        }
        // 50 degrees from the normals at both ends of a foot of 90 degrees, and 0.27 of a fan of 45.
        EXPECT_NEAR(core::degrees(sum), lean == 0 ? 10 : 0.27 * 45, 1e-6);

        for (layers::RayVertex& vertex : ray_vertices) vertex.least_height = 0.0029;
        const std::vector<double> low = layers::openings_on_short_faces(ray_vertices, vertices);
        EXPECT_EQ(std::count(low.begin(), low.end(), 0.0), std::ptrdiff_t(n)) << "the riser is higher than the layer";
    }
}

/// Returns a plate from (0, 0) to (1, 0.1) with a tooth on its upper side between two that are alike: their sides lean by 45
/// degrees, and 0.003 deep feet are between them.
Outline plate_with_teeth() {
    constexpr double spacing = 2e-3, on_teeth = 1e-4, depth = 0.003;
    Outline outline{{0, 0}};
    add_straight({1, 0}, spacing, outline);
    add_straight({1, 0.1}, spacing, outline);
    add_straight({0.5 + 3 * depth, 0.1}, spacing, outline);
    for (int k = 2; k >= -3; --k) {
        const double y = k % 2 == 0 ? 0.1 - depth : 0.1;
        add_straight({0.5 + k * depth, y}, on_teeth, outline);
    }
    add_straight({0, 0.1}, spacing, outline);
    add_straight({0, 0}, spacing, outline);
    outline.pop_back();
    return outline;
}

/// Rays of both sides of a horn of ice lean out of the feet beside it, towards its tip.
TEST(ShortFaces, RaysOfHornsDoNotMeetThoseOfTheirFans) {
    const std::vector<RayLine> rays = rays_round(plate_with_teeth(), layers::OutlineKind::jagged);
    std::size_t at_tips = 0;
    for (std::size_t i = 0; i + 1 < rays.size(); ++i) {
        const RayLine &ray = rays[i], &next = rays[i + 1];
        if (ray.origin == next.origin) continue;
        const auto is_tip = [](Point p) { return p.y == 0.1 && p.x > 0.495 && p.x < 0.505; };
        if (!is_tip(ray.origin) && !is_tip(next.origin)) continue;
        ++at_tips;
        // Beside each tip they turned inwards by 15 degrees when a fan gave half of its angle at most.
        EXPECT_GT(core::degrees(core::angle_between(ray.direction, next.direction)), -8) << ray.origin.x;
    }
    EXPECT_EQ(at_tips, 4u);
}

TEST(ShortFaces, MirroredOutlinesHaveMirroredRays) {
    const Outline outline = stepped_plate(0.003, 0.5);
    Outline mirrored(outline.rbegin(), outline.rend());
    for (Point& p : mirrored) p.y = -p.y;
    const std::vector<RayLine> rays = rays_round(outline), others = rays_round(mirrored);
    ASSERT_EQ(rays.size(), others.size());
    std::vector<Point> tips, other_tips;
    for (const RayLine& ray : rays) tips.push_back(ray.origin + layer_height * ray.direction);
    for (const RayLine& ray : others) {
        const Point tip = ray.origin + layer_height * ray.direction;
        other_tips.push_back({tip.x, -tip.y});
    }
    for (const Point tip : tips) {
        const auto is_near = [&](Point other) { return distance(tip, other) < 1e-12; };
        EXPECT_TRUE(std::any_of(other_tips.begin(), other_tips.end(), is_near)) << tip.x << " " << tip.y;
    }
}

}  // namespace
}  // namespace lamina
