// The curves of walls, found by points on them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/shapes.hpp"
#include "surface/spacing_limits.hpp"
#include "surface/wall_curves.hpp"

namespace lamina::test {
namespace {

/// Returns the curves through the points of an outline.
surface::WallCurves curves_through(const shapes::Outline& outline) {
    return surface::WallCurves(surface::prepare_with_curves(shapes::geometry({outline}),
                                                            {.treatment = SurfaceTreatment::keep, .curve_kept = true},
                                                            {.with_curves = true}, {})
                                   .curves);
}

shapes::Outline circle(std::size_t points) {
    shapes::Outline outline;
    for (std::size_t i = 0; i < points; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(points);
        outline.push_back({std::cos(angle), std::sin(angle)});
    }
    return outline;
}

TEST(WallCurves, FindTheStretchBetweenTwoOfTheirPoints) {
    const surface::WallCurves curves = curves_through(circle(16));
    ASSERT_EQ(curves.edges().size(), 16u);
    for (const surface::CurvedEdge& edge : curves.edges())
        for (const double from : {0.0, 0.125, 0.6})
            for (const double to : {0.7, 0.999, 1.0}) {
                const auto stretch = curves.between(edge.at(from), edge.at(to));
                ASSERT_TRUE(stretch);
                EXPECT_EQ(stretch->edge, &edge);
                EXPECT_NEAR(stretch->from, from, 1e-14);
                EXPECT_NEAR(stretch->to, to, 1e-14);
                EXPECT_FALSE(curves.between(edge.at(to), edge.at(from)));
                const auto place = curves.place(edge.at(from), edge.at(to), 0.5);
                ASSERT_TRUE(place);
                EXPECT_LT(distance(*place, edge.at(0.5 * (from + to))), 1e-14);
            }
}

TEST(WallCurves, FindNothingBesideThem) {
    const surface::WallCurves curves = curves_through(circle(16));
    const surface::CurvedEdge &edge = curves.edges()[3], &other = curves.edges()[5];
    const Point middle = midpoint(edge.begin, edge.end);
    EXPECT_FALSE(curves.between(edge.begin, middle));
    EXPECT_FALSE(curves.between(middle, edge.end));
    EXPECT_FALSE(curves.between(edge.begin, 1.0000001 * edge.at(0.5)));
    EXPECT_FALSE(curves.between(edge.at(0.5), other.at(0.5)));
    EXPECT_FALSE(curves.place({5, 5}, {6, 6}, 0.5));
    EXPECT_FALSE(surface::WallCurves({}).between(edge.begin, edge.end));
}

TEST(WallCurves, PlaceNothingOnStraightEdges) {
    const surface::WallCurves curves = curves_through({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
    for (std::size_t e = 0; e < curves.edges().size(); ++e) {
        const surface::CurvedEdge& edge = curves.edges()[e];
        EXPECT_EQ(curves.bend(e), 0);
        EXPECT_TRUE(curves.between(edge.begin, edge.at(0.3)));
        EXPECT_FALSE(curves.place(edge.begin, edge.at(0.3), 0.5));
    }
}

}  // namespace
}  // namespace lamina::test
