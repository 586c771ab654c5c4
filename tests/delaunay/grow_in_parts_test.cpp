// Compares the triangulation of points that grows in parts with that of all points one by one. The points lie on few
// lines or circles, and are many enough for several parts.
#include "delaunay/pieces/grow_in_parts.hpp"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/threads.hpp>

#include "delaunay/triangulate/triangulate_points.hpp"
#include "support/point_sets.hpp"
#include "support/triangulation_families.hpp"

namespace lamina::test {
namespace {

using delaunay::pieces::triangulate_in_parts;

constexpr std::size_t points_for_parts = 150'000;

/// Returns random points on rays from the origin, which itself is among them.
std::vector<Point> star_of_points(std::size_t n, unsigned rays) {
    Random random(31);
    std::vector<Point> points(n);
    for (std::size_t i = 1; i < n; ++i) {
        const double angle = 6.28 * static_cast<double>(i % rays) / rays, radius = random.real();
        points[i] = {radius * std::cos(angle), radius * std::sin(angle)};
    }
    return points;
}

/// Returns random points on a circle, and its centre.
std::vector<Point> wheel_of_points(std::size_t n) {
    Random random(32);
    std::vector<Point> points(n);
    for (std::size_t i = 1; i < n; ++i) {
        const double angle = random.real(0, 6.2831853);
        points[i] = {std::cos(angle), std::sin(angle)};
    }
    return points;
}

/// Returns the points turned by a right angle.
std::vector<Point> turned(std::vector<Point> points) {
    for (Point& p : points) p = {-p.y, p.x};
    return points;
}

struct PartsCase {
    std::string name;
    std::vector<Point> points;
};

std::vector<PartsCase> cases_for_parts() {
    return {{"two lines", points_on_two_lines(points_for_parts, 0)},
            {"upright lines", turned(points_on_two_lines(points_for_parts, 0))},
            {"slanted lines", points_on_two_lines(points_for_parts, 0.3)},
            {"steep lines", turned(points_on_two_lines(points_for_parts, 0.3))},
            {"cross", points_on_a_cross(points_for_parts)},
            {"star", star_of_points(points_for_parts, 7)},
            {"wheel", wheel_of_points(points_for_parts)},
            {"uniform", random_points(points_for_parts, 33)}};
}

TEST(GrowthInParts, EqualsGrowthOfTheWhole) {
    for (const auto& [name, points] : cases_for_parts())
        EXPECT_TRUE(canonical(triangulate_in_parts(points)) ==
                    canonical(delaunay::without_ghosts(delaunay::triangulate_points(points)).triangles))
            << name;
}

TEST(GrowthInParts, DependsOnNoThread) {
    // So many points are sorted on all threads, too.
    const std::vector<Point> points = points_on_a_cross(300'000);
    std::vector<Triangle> one, three;
    with_threads(1, [&] { one = triangulate_in_parts(points); });
    with_threads(3, [&] { three = triangulate_in_parts(points); });
    EXPECT_TRUE(one == three);
}

TEST(GrowthInParts, NamesEqualPoints) {
    for (auto [name, points] : cases_for_parts()) {
        points[100'000] = points[50'000];
        try {
            triangulate_in_parts(points);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("points 50000 and 100000 are the same"), std::string::npos)
                << name << ": " << error.what();
        }
    }
}

TEST(GrowthInParts, HasNoTrianglesOnOneLine) {
    std::vector<Point> points;
    for (std::size_t i = 0; i < points_for_parts; ++i) points.push_back({static_cast<double>(i), 1});
    EXPECT_TRUE(triangulate_in_parts(points).empty());
}

}  // namespace
}  // namespace lamina::test
