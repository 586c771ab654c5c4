// Walls with an exact number of vertices.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/surface.hpp>

#include "support/outline_measures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

SurfaceOptions exactly(std::size_t points, std::optional<std::size_t> base_edges = {}) {
    SurfaceOptions options;
    options.points = points;
    options.exact_points = true;
    options.base_edges = base_edges;
    return options;
}

/// Returns sections with a sharp trailing edge, with a base, without a corner, and with corners all round.
std::vector<Outline> sections_of_all_kinds() {
    return {shapes::section(0.12, 0, 40),     shapes::section(0.12, 0.003, 20),
            shapes::section(0.2, 0.02, 12),   shapes::joukowski(0.1, 0.08, 40),
            naca_airfoil("23012", 40).points, naca_airfoil("0006", 31, TrailingEdge::blunt).points,
            shapes::ellipse(1, 0.2, 30),      shapes::circle(1, 16),
            shapes::plate(0.05, 8),           shapes::refined(shapes::box(), 2)};
}

TEST(ExactPoints, AreAsManyAsAskedFor) {
    for (const Outline& outline : sections_of_all_kinds())
        for (const std::size_t points : {20, 57, 200, 201, 333, 1000}) {
            SCOPED_TRACE(std::to_string(outline.size()) + " " + std::to_string(points));
            const Element e = prepared(outline, exactly(points));
            EXPECT_EQ(e.points.size(), points);
            EXPECT_EQ(prepared(shapes::moved(outline, 0.7, 3, {5, 2}), exactly(points)).points.size(), points);
            // Few points must stand where spacings cannot be kept, beside short bases.
            if (points >= 200) {
                EXPECT_LE(max_spacing_ratio(e.points), exactly(points).max_ratio);
            }
        }
}

TEST(ExactPoints, KeepCorners) {
    for (const Outline& outline : sections_of_all_kinds()) {
        Element given = shapes::geometry({outline}).elements[0];
        const Element e = prepared(outline, exactly(57)), all = prepared(outline, resampling());
        ASSERT_EQ(e.features.corners.size(), all.features.corners.size());
        for (std::size_t k = 0; k < e.features.corners.size(); ++k)
            EXPECT_EQ(e.points[e.features.corners[k]], all.points[all.features.corners[k]]);
    }
}

TEST(ExactPoints, StandInTheProportionsOfOtherNumbers) {
    // Each edge of a wall with N points has the place of two edges of a wall with 2 N, where corners set no bounds.
    const Outline outline = shapes::ellipse(1, 0.2, 200);
    const Outline coarse = prepared(outline, exactly(300)).points, fine = prepared(outline, exactly(600)).points;
    for (std::size_t i = 0; i < coarse.size(); ++i)
        EXPECT_LT(distance(coarse[i], fine[2 * i]), 0.02 * distance(coarse[i], coarse[(i + 1) % coarse.size()])) << i;
}

TEST(ExactPoints, MirroredInputGivesMirroredPoints) {
    for (const Outline& outline : {shapes::joukowski(0.1, 0.08, 40), shapes::section(0.2, 0.02, 12)}) {
        const Outline given = prepared(outline, exactly(150)).points;
        const Outline made = prepared(shapes::mirrored(outline), exactly(150)).points;
        for (const Point p : shapes::mirrored(given)) {
            double nearest = HUGE_VAL;
            for (const Point q : made) nearest = std::min(nearest, distance(p, q));
            EXPECT_LT(nearest, 1e-9) << p.x << ' ' << p.y;
        }
    }
}

TEST(ExactPoints, OfTheBase) {
    for (const double base : {0.001, 0.003, 0.02})
        for (const std::size_t edges : {1, 4, 9}) {
            SCOPED_TRACE(std::to_string(base) + " " + std::to_string(edges));
            const Element e = prepared(shapes::section(0.12, base, 40), exactly(220, edges));
            EXPECT_EQ(e.points.size(), 220u);
            ASSERT_TRUE(e.features.base.has_value());
            EXPECT_EQ((e.features.base->last + 220 - e.features.base->first) % 220, edges);
            // Edges of 2 % are longer than any other may be.
            if (base < 0.02 * static_cast<double>(edges)) {
                EXPECT_LE(max_spacing_ratio(e.points), exactly(220).max_ratio);
            }
        }
    EXPECT_EQ(prepared(shapes::section(0.12, 0, 40), exactly(220, 4)).points.size(), 220u) << "no base";
    // Without their number, the edges are a fiftieth of the points, whatever the base.
    for (const double base : {0.001, 0.003, 0.02})
        for (const auto& [points, edges] : {std::pair{20u, 1u}, {60u, 1u}, {100u, 2u}, {220u, 4u}, {400u, 8u}}) {
            const Element e = prepared(shapes::section(0.12, base, 40), exactly(points));
            ASSERT_TRUE(e.features.base.has_value());
            EXPECT_EQ((e.features.base->last + points - e.features.base->first) % points, edges) << base;
        }
}

TEST(ExactPoints, OfEachElement) {
    const Outline wing = shapes::section(0.12, 0.003, 40);
    const Geometry result =
        prepare_surfaces(shapes::geometry({wing, shapes::moved(wing, -0.5, 0.3, {1.01, -0.02})}), exactly(180, 3));
    for (const Element& e : result.elements) EXPECT_EQ(e.points.size(), 180u);
}

TEST(ExactPoints, AreRefusedWhereTheyCannotBe) {
    const auto refused_option = [](const Outline& outline, const SurfaceOptions& options) {
        try {
            prepare_surfaces(shapes::geometry({outline}), options);
        } catch (const OptionError& error) {
            return error.option();
        }
        return std::string();
    };
    const Outline wing = shapes::section(0.12, 0.003, 40);
    SurfaceOptions wrong = exactly(200);
    wrong.treatment = SurfaceTreatment::keep;
    EXPECT_EQ(refused_option(wing, wrong), "exact_points");
    wrong = exactly(200);
    wrong.points.reset();
    EXPECT_EQ(refused_option(wing, wrong), "exact_points");
    EXPECT_EQ(refused_option(wing, exactly(200, 0)), "exact_points");
    EXPECT_EQ(refused_option(wing, exactly(6, 9)), "exact_points");
    EXPECT_EQ(refused_option(shapes::comb(5, 0.1), exactly(12)), "exact_points");
    EXPECT_EQ(refused_option(wing, exactly(200)), "");
}

}  // namespace
}  // namespace lamina
