// Points that scatter about an outline, as those of a scan do.
#include "geometry/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/surface.hpp>

#include "core/segments.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

/// Returns points at equal distances on a section of 12 % with a base, from its upper corner to its lower one.
Outline even_section(std::size_t points, double base) {
    Outline fine;
    for (int k = 0; k <= 20000; ++k) {
        const double x = 0.5 + 0.5 * std::cos(shapes::full_turn * k / 20000);
        const double half =
            0.6 * (0.2969 * std::sqrt(x) + x * (-0.1260 + x * (-0.3516 + x * (0.2843 - 0.1036 * x)))) + 0.5 * base * x;
        fine.push_back({x, (k <= 10000 ? half : -half) + 0.08 * x * (1 - x)});
    }
    return shapes::even_points(fine, points);
}

Outline scattered(Outline points, double noise, unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
    for (Point& p : points) {
        // Box and Muller's normal numbers.
        const double radius = noise * std::sqrt(-2 * std::log(uniform())), angle = shapes::full_turn * uniform();
        p = p + radius * Point{std::cos(angle), std::sin(angle)};
    }
    return points;
}

double largest_distance(const Outline& points, const Outline& from) {
    double largest = 0;
    for (const Point p : points) {
        double nearest = HUGE_VAL;
        for (std::size_t i = 0; i < from.size(); ++i)
            nearest = std::min(nearest, core::distance_to_segment(p, from[i], from[(i + 1) % from.size()]));
        largest = std::max(largest, nearest);
    }
    return largest;
}

TEST(Scatter, IsMeasuredRemovedAndSaid) {
    for (const auto& [points, noise] : {std::pair{5000u, 1e-5}, {5000u, 5e-5}, {5000u, 2e-4}, {1500u, 2e-4}})
        for (const double base : {0.0025, 0.01}) {
            const Outline exact = even_section(points, base);
            const Element e = element_of_points(scattered(exact, noise, 3), "scan");
            ASSERT_EQ(e.warnings.size(), 1u) << points << ' ' << noise << ' ' << base;
            EXPECT_EQ(e.warnings[0].code, WarningCode::noise_smoothed);
            EXPECT_NEAR(e.warnings[0].number, noise, 0.1 * noise);
            const Element wall = prepare_surfaces(make_geometry({e})).elements[0];
            EXPECT_EQ(wall.features.corners.size(), 2u) << points << ' ' << noise << ' ' << base;
            const Element clean = prepare_surfaces(make_geometry({element_of_points(exact, "exact")}),
                                                   {.treatment = SurfaceTreatment::resample})
                                      .elements[0];
            EXPECT_LT(static_cast<double>(wall.points.size()), 1.15 * static_cast<double>(clean.points.size()));
            EXPECT_LT(largest_distance(wall.points, exact), 3 * noise) << points << ' ' << base;
        }
}

TEST(Scatter, OfRingsIsRemovedRoundThem) {
    const Outline circle = shapes::circle(1, 2000);
    Outline ring = scattered(circle, 3e-4, 5);
    ring.push_back(ring.front());
    const Element e = element_of_points(ring, "ring");
    ASSERT_EQ(e.warnings.size(), 1u);
    for (const Point p : e.points) EXPECT_NEAR(length(p), 1, 3e-4);
    // A square whose points start in the middle of a side keeps its four corners.
    Outline square;
    for (int side = 0; side < 4; ++side)
        for (int k = 0; k < 400; ++k)
            square.push_back(shapes::moved({{1, -1 + k / 200.0}}, shapes::full_turn * side / 4, 1, {0, 0})[0]);
    std::rotate(square.begin(), square.begin() + 170, square.end());
    ring = scattered(square, 5e-4, 7);
    ring.push_back(ring.front());
    const Element box = prepare_surfaces(make_geometry({element_of_points(ring, "box")})).elements[0];
    EXPECT_EQ(box.features.corners.size(), 4u);
    EXPECT_LT(largest_distance(box.points, square), 1.5e-3);
}

/// What is rough by its shape is not smoothed: vertices that turn independently of each other, regular teeth, rounding
/// of few points.
TEST(Scatter, IsNoShape) {
    std::mt19937 random(3);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    Outline rough, toothed = shapes::circle(1, 1500);
    double radius = 1;
    for (int k = 0; k < 1500; ++k) {
        const double angle = shapes::full_turn * k / 1500;
        radius = 1 + 0.98 * (radius - 1) + 1e-3 * uniform();
        rough.push_back({radius * std::cos(angle), radius * std::sin(angle)});
        if (k % 2 == 0) toothed[static_cast<std::size_t>(k)] = 1.002 * toothed[static_cast<std::size_t>(k)];
    }
    for (const Outline& outline : {rough, toothed, shapes::circle(1, 1500), scattered(shapes::circle(1, 60), 1e-3, 1)})
        EXPECT_FALSE(geometry::white_noise({outline, true}));
}

}  // namespace
}  // namespace lamina
