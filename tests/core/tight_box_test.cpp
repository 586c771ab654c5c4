// The box of least area round points.
#include "core/tight_box.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace lamina {
namespace {

Point turned(Point p, double angle) {
    return {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y};
}

TEST(TightBox, OfShapesThatAreKnown) {
    const std::vector<Point> rectangle{{0, 0}, {3, 0}, {3, 2}, {0, 2}, {1, 1}, {1.5, 0}};
    for (double angle = 0; angle < 3.2; angle += 0.1) {
        std::vector<Point> points;
        for (const Point p : rectangle) points.push_back(turned(p, angle));
        EXPECT_NEAR(core::longer_side_of_tight_box(points), 3, 1e-14) << angle;
    }
    EXPECT_EQ(core::longer_side_of_tight_box({}), 0);
    EXPECT_EQ(core::longer_side_of_tight_box(std::vector<Point>{{1, 2}}), 0);
    EXPECT_EQ(core::longer_side_of_tight_box(std::vector<Point>{{1, 2}, {4, 6}, {2.5, 4}}), 5);
}

/// Compares with all boxes that have a side in common with the hull, tried one by one.
TEST(TightBox, IsTheBoxOfLeastAreaOfRandomPoints) {
    std::mt19937 random(5);
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    for (int round = 0; round < 200; ++round) {
        std::vector<Point> points(3 + random() % 30);
        for (Point& p : points) p = {uniform(), 0.3 * uniform()};
        const std::vector<Point> hull = core::convex_hull(points);
        std::vector<Box> boxes(hull.size());
        double least_area = HUGE_VAL, longest = 0;
        for (std::size_t i = 0; i < hull.size(); ++i) {
            const Point along = unit(hull[(i + 1) % hull.size()] - hull[i]);
            for (const Point p : points) boxes[i].include({dot(p, along), cross(along, p)});
            least_area = std::min(least_area, boxes[i].width() * boxes[i].height());
        }
        for (const Box& box : boxes)
            if (box.width() * box.height() <= (1 + 1e-9) * least_area)
                longest = std::max({longest, box.width(), box.height()});
        EXPECT_NEAR(core::longer_side_of_tight_box(points), longest, 1e-12) << round;
    }
}

}  // namespace
}  // namespace lamina
