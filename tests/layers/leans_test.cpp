// On jagged outlines the angle of each corner spreads over the columns beside it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/directions/rays.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double height_of_front = 0.05;

/// Returns a regular polygon with edges of about 1 / 800 of its radius.
Outline divided_polygon(std::size_t corners) { return shapes::refined(shapes::circle(1, corners), 4992 / corners); }

std::vector<RayLine> jagged_rays(const Outline& outline, bool even, double first_height = 1e-6) {
    const LayerOptions options = test::layers_of(first_height, 1.2, 30);
    const std::vector<double> heights(even ? outline.size() : 0, height_of_front);
    return layers::make_rays(layers::outline_with_wake(outline), layers::OutlineKind::jagged, options,
                             test::growth_of(options), heights);
}

/// Returns the column_widths of the columns at the front.
std::vector<double> column_widths(const std::vector<RayLine>& rays) {
    std::vector<double> result;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const RayLine &a = rays[i], &b = rays[(i + 1) % rays.size()];
        result.push_back(dot(b.origin - a.origin + height_of_front * (b.direction - a.direction),
                             perpendicular(unit(a.direction + b.direction))));
    }
    return result;
}

/// Returns the largest ratio of the column_widths of neighbouring columns.
double largest_width_step(const std::vector<double>& column_widths) {
    double largest = 1;
    for (std::size_t i = 0; i < column_widths.size(); ++i) {
        const double a = column_widths[i], b = column_widths[(i + 1) % column_widths.size()];
        largest = std::max({largest, a / b, b / a});
    }
    return largest;
}

/// Returns the angle from the normal of the edge after it, or before it, to a ray, whichever is larger, in degrees.
double lean_from_normals_deg(const std::vector<RayLine>& rays, std::size_t i) {
    const Point before = rays[(i + rays.size() - 1) % rays.size()].origin, after = rays[(i + 1) % rays.size()].origin;
    const auto off = [&](Point edge) {
        return std::abs(core::degrees(core::angle_between(-perpendicular(unit(edge)), rays[i].direction)));
    };
    return std::max(off(rays[i].origin - before), off(after - rays[i].origin));
}

TEST(Leans, CornersOpenTheColumnsBesideThem) {
    const Outline outline = divided_polygon(18);
    const std::vector<double> before = column_widths(jagged_rays(outline, false)),
                              after = column_widths(jagged_rays(outline, true));
    ASSERT_EQ(before.size(), outline.size());
    ASSERT_EQ(after.size(), outline.size()) << "no ray is added";
    EXPECT_GT(largest_width_step(before), 7);
    EXPECT_LT(largest_width_step(after), 1.05);
    EXPECT_GE(*std::min_element(after.begin(), after.end()), 0.999 * *std::min_element(before.begin(), before.end()));
    EXPECT_LT(*std::max_element(after.begin(), after.end()), 0.25 * *std::max_element(before.begin(), before.end()));
}

TEST(Leans, BothDirectionsOfTheWallAreTreatedAlike) {
    const Outline outline = divided_polygon(18);
    const std::vector<RayLine> rays = jagged_rays(outline, true), others = jagged_rays(shapes::mirrored(outline), true);
    for (const RayLine& ray : rays) {
        const auto twin = std::min_element(others.begin(), others.end(), [&](const RayLine& a, const RayLine& b) {
            const auto away = [&](const RayLine& r) {
                return squared_length(Point{r.origin.x, -r.origin.y} - ray.origin);
            };
            return away(a) < away(b);
        });
        EXPECT_LT(distance(Point{twin->direction.x, -twin->direction.y}, ray.direction), 1e-12);
    }
}

/// Where the wall turns, a ray that leans is higher above one edge than above the other. It is shifted where there is
/// room.
TEST(Leans, RaysLeanNoFartherThanFirstHeightsAllow) {
    constexpr std::size_t corners = 8, parts = 4992 / corners;
    Outline outline = divided_polygon(corners);
    // Between corners the wall turns by 12 degrees at every vertex, to either side in turns.
    for (std::size_t i = 0; i < outline.size(); i += 2)
        if (i % parts != 0) outline[i] = (1 + 6.5e-5) * outline[i];
    const auto largest_lean = [&](double first_height) {
        const std::vector<RayLine> rays = jagged_rays(outline, true, first_height);
        double largest = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (i % parts != 0) largest = std::max(largest, lean_from_normals_deg(rays, i));
        return largest;
    };
    EXPECT_GT(largest_lean(1e-6), 20);
    EXPECT_LT(largest_lean(5e-3), 18) << "shifts would be longer than a fifth of the edges";
}

/// In a bay whose wall has small corners each ray leans as far as its neighbours do, or they would meet at once.
TEST(Leans, SmallCornersLeanWithTheirNeighbours) {
    Outline bay{{-1, 0}, {1, 0}, {1, 1}};
    constexpr int steps = 10;
    for (int k = 0; k <= 2 * steps; ++k) {
        const double x = 0.5 - 0.5 * k / steps, bump = k % 2 ? 0.001 : -0.001;
        bay.push_back({x, 1 - 0.6 * (1 - 4 * x * x) + bump});
    }
    bay.push_back({-1, 1});
    const Outline outline = shapes::refined(bay, 6);
    const auto most_converging_deg = [&](bool even) {
        const std::vector<RayLine> rays = jagged_rays(outline, even, 4e-4);
        double least = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayLine &a = rays[i], &b = rays[(i + 1) % rays.size()];
            if (std::abs(a.origin.x) > 0.45 || a.origin.y < 0.1) continue;
            least = std::min(least, core::degrees(core::angle_between(a.direction, b.direction)));
        }
        return least;
    };
    EXPECT_LT(most_converging_deg(false), -9);
    EXPECT_GT(most_converging_deg(true), -5);
}

}  // namespace
}  // namespace lamina
