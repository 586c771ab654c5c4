// Points out of place or out of order, where the outline folds back on itself, are mended or named.
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"

namespace lamina {
namespace {

/// Returns a section of 61 points, of which the first is the last, as most files have it.
std::vector<Point> section() {
    std::vector<Point> points;
    constexpr int n = 30;
    for (int i = -n; i <= n; ++i) {
        const double x = 0.5 * (1 + std::cos((n - std::abs(i)) * 3.14159265358979 / n));
        const double half = i == -n || i == n ? 0
                                              : 0.6 * (0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x +
                                                       0.2843 * x * x * x - 0.1036 * x * x * x * x);
        points.push_back({x, 0.02 * x * (1 - x) + (i < 0 ? half : -half)});
    }
    return points;
}

Element read_points(const std::vector<Point>& points) { return fixtures::read(fixtures::as_file(points)).elements[0]; }

void expect_warning(const Element& e, Point at, double share) {
    ASSERT_EQ(e.warnings.size(), 1u);
    EXPECT_EQ(e.warnings[0].code, WarningCode::folded_outline);
    ASSERT_TRUE(e.warnings[0].at.has_value());
    EXPECT_EQ(*e.warnings[0].at, at);
    EXPECT_NEAR(e.warnings[0].number, share, 0.01);
}

TEST(Folds, APointWithAWrongDigitIsLeftOut) {
    // Both directions of the outline, a point near the tail, one in the middle, and the neighbour of the trailing edge.
    for (const bool clockwise : {false, true})
        for (const auto& [i, x] :
             std::vector<std::pair<std::size_t, double>>{{55, 0.8}, {50, 0.94}, {8, 0.93}, {59, 0.0973}}) {
            std::vector<Point> points = section();
            points[i].x = x;
            const Point wrong = points[i];
            std::vector<Point> right = section();
            right.erase(right.begin() + static_cast<std::ptrdiff_t>(i));
            if (clockwise) std::reverse(points.begin(), points.end());
            SCOPED_TRACE(fmt::format("point {}, clockwise {}", i, clockwise));
            const Element e = read_points(points);
            EXPECT_EQ(e.points, read_points(right).points);
            ASSERT_EQ(e.warnings.size(), 1u);
            EXPECT_EQ(e.warnings[0].at, wrong);
            const std::string line = fmt::format("line {}: the point ", 2 + (clockwise ? 60 - i : i));
            EXPECT_TRUE(std::any_of(e.repairs.begin(), e.repairs.end(), [&](const std::string& repair) {
                return repair.starts_with(line) && repair.find("left out") != std::string::npos;
            }));
        }
}

TEST(Folds, APointBetweenTwoEqualOnesIsLeftOutWithOneOfThem) {
    // A nose whose third point has the wrong sign: (0, 0.00095), (0, 0), (0, 0.00095), as in EH 3012.
    std::vector<Point> points = section();
    const std::size_t nose = 30;
    points[nose] = {0, 0.00095};
    std::vector<Point> right = points;
    points.insert(points.begin() + nose + 1, {{0, 0}, {0, 0.00095}});
    const Element e = read_points(points);
    EXPECT_EQ(e.points, read_points(right).points);
    expect_warning(e, {0, 0}, 0.00095);
}

TEST(Folds, PointsOutOfOrderAreExchanged) {
    for (const std::size_t i : {2u, 10u, 20u, 45u, 57u}) {
        std::vector<Point> points = section();
        std::swap(points[i], points[i + 1]);
        SCOPED_TRACE(i);
        const Element e = read_points(points);
        EXPECT_EQ(e.points, read_points(section()).points);
        expect_warning(e, points[i], distance(points[i], points[i + 1]));
    }
}

TEST(Folds, TheEndsOfAnOpenOutlineStay) {
    const Element e =
        fixtures::read(
            "base\n1 .032\n.99893 .02975\n.99572 .06893\n.99039 .08322\n.97 .11\n.9 .15\n.5 .2\n"
            ".2 .15\n.05 .09\n0 0\n.05 -.09\n.2 -.15\n.5 -.2\n.9 -.15\n.97 -.11\n.99039 -.07675\n.99572 -.06441\n"
            ".99893 -.03854\n1 -.032\n")
            .elements[0];
    ASSERT_EQ(e.warnings.size(), 1u);
    EXPECT_EQ(e.warnings[0].at, (Point{0.99893, 0.02975})) << e.warnings[0].message;
    EXPECT_EQ(e.points[0], (Point{1, 0.032}));
}

TEST(Folds, OthersAreNamedAndStay) {
    const Element e = fixtures::read(
                          "three points run back\n1 0\n.97 .01\n.9 .03\n.85 .031\n.8 .032\n.82 .033\n.84 .0335\n"
                          ".86 .034\n.83 .035\n.8 .036\n.75 .039\n.5 .06\n.2 .05\n0 0\n.2 -.04\n.5 -.05\n.8 -.03\n")
                          .elements[0];
    expect_warning(e, {0.8, 0.032}, 0.06);
    EXPECT_NE(e.warnings[0].message.find("lines 6 and 9: the outline runs back on itself"), std::string::npos);
    EXPECT_NE(std::find(e.points.begin(), e.points.end(), Point{0.82, 0.033}), e.points.end());
}

TEST(Folds, WallsDrawnOnPurposeGiveNoWarning) {
    // A plate whose flap is split at the tail: a notch of 20 degrees between two sharp edges.
    const Element split = fixtures::read(
                              "split flap\n1 0\n0.9 0.02\n0.7 0.05\n0.4 0.07\n0.1 0.05\n0 0\n0.1 -0.03\n0.4 -0.04\n0.6 "
                              "-0.045\n0.95 -0.16\n"
                              "0.7 -0.02\n0.9 -0.005\n1 0\n")
                              .elements[0];
    EXPECT_TRUE(split.warnings.empty());
    // Many folds are noise, which nobody wants to be guessed away.
    std::vector<Point> noisy = section();
    for (std::size_t i = 3; i < 27; i += 2) std::swap(noisy[i], noisy[i + 1]);
    EXPECT_ANY_THROW(read_points(noisy));
}

}  // namespace
}  // namespace lamina
