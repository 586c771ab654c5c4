// The surface stage decides stretch by stretch what becomes of the given points, and follows requested spacings.
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/surface.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/outline_measures.hpp"
#include "support/shapes.hpp"
#include "surface/spacing_limits.hpp"
#include "surface/summary.hpp"

namespace lamina {
namespace {

/// Returns a circle of 12 points with a vertical edge at its right.
Outline twelve_sided_circle() { return shapes::moved(shapes::circle(1, 12), 0.2617993877991494, 1, {0, 0}); }

/// Returns how many notes of an element contain a text.
std::size_t count_notes(const Element& e, const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(e.surface_notes.begin(), e.surface_notes.end(),
                      [&](const std::string& note) { return note.find(text) != std::string::npos; }));
}

TEST(Crossings, MakeOnlyTheEdgesStraightThatCross) {
    // The spline through the coarse arc crosses the plate, which its chords just miss.
    const Outline arc = twelve_sided_circle();
    const double reach = std::cos(0.2617993877991494);
    const Outline plate{{reach + 0.005, -0.3}, {1.5, -0.3}, {1.5, 0.3}, {reach + 0.005, 0.3}};
    const Geometry given = shapes::geometry({arc, plate});
    ASSERT_NO_THROW(check_simple(given));
    for (const SurfaceOptions& options : {resampling(), SurfaceOptions{}}) {
        const Geometry result = prepare_surfaces(given, options);
        EXPECT_NO_THROW(check_simple(result));
        const Element& e = result.elements[0];
        EXPECT_FALSE(e.surface_restored);
        EXPECT_EQ(count_notes(e, "1 given edge stay"), 1u) << e.surface_notes.back();
        for (Point p : e.points) {
            EXPECT_LT(p.x, reach + 1e-12);
            if (p.x < 0.9 * reach) {
                EXPECT_NEAR(length(p), 1, 2e-3);
            }
        }
        EXPECT_LE(max_spacing_ratio(e.points), 1.25);
    }
}

TEST(Crossings, OfTwoSplinesInASlotAreResolvedOnBothSides) {
    const Outline left = twelve_sided_circle();
    const double reach = std::cos(0.2617993877991494), gap = 0.02;
    const Outline right = shapes::moved(left, 0, 1, {2 * reach + gap, 0});
    const Geometry result = prepare_surfaces(shapes::geometry({left, right}), {});
    EXPECT_NO_THROW(check_simple(result));
    for (const Element& e : result.elements) {
        EXPECT_EQ(count_notes(e, "stay straight"), 1u);
        EXPECT_GT(e.points.size(), 100u);
        EXPECT_LE(max_spacing_ratio(e.points), 1.25);
        EXPECT_LE(max_turning_deg(e.points, 14), SurfaceOptions{}.max_turning_deg);
    }
    EXPECT_TRUE(std::all_of(result.elements[0].points.begin(), result.elements[0].points.end(),
                            [&](Point p) { return p.x < reach + 1e-12; }));
}

TEST(Crossings, OfAnOutlineWithItselfLeaveTheRestOnTheSpline) {
    // The walls of a slot bulge towards each other between their samples.
    const Outline given{{-1, 0},     {1, 0},       {1, 2},        {0.24, 2},     {0.018, 1.4}, {0.018, 0.8},
                        {0.24, 0.2}, {-0.24, 0.2}, {-0.018, 0.8}, {-0.018, 1.4}, {-0.24, 2},   {-1, 2}};
    const Element e = prepared(given, {});
    EXPECT_FALSE(e.surface_restored);
    EXPECT_EQ(count_notes(e, "2 given edges stay straight"), 1u) << e.surface_notes.back();
    for (Point p : {given[4], given[5], given[8], given[9]}) EXPECT_TRUE(contains(e.points, p));
    EXPECT_GT(max_distance_from(given, e.points), 1e-3) << "the rest of the walls is bent";
    EXPECT_LE(max_spacing_ratio(e.points), 1.25);
    expect_equal_loops(shapes::mirrored(e.points), prepared(shapes::mirrored(given), {}).points);
}

/// Returns a plate of unit length with a round nose, whose sides have one point each.
Outline round_nosed_plate(double thickness) {
    const double r = 0.5 * thickness;
    Outline outline{{1, r}, {0.5, r}};
    for (int k = 0; k <= 8; ++k) {
        const double t = 3.14159265358979323846 * (0.5 + k / 8.0);
        outline.push_back({r + r * std::cos(t), r * std::sin(t)});
    }
    outline.push_back({0.5, -r});
    outline.push_back({1, -r});
    return outline;
}

TEST(Resampling, AThinPlateWithASmallRoundNoseStaysThin) {
    const Outline plate = round_nosed_plate(4e-4);
    const Element e = prepared(plate, {});
    EXPECT_FALSE(e.surface_restored);
    EXPECT_LE(max_spacing_ratio(e.points), 1.25);
    EXPECT_LE(max_edge_length(e.points), 0.021);
    EXPECT_LT(max_distance_from(plate, e.points), 1e-4);
    expect_equal_loops(e.points, shapes::mirrored(e.points));
}

/// Returns a coarse section, with the points of its nose replaced by ice: fine points, of which every other one stands
/// off the section.
Outline iced_section(double ice_up_to = 0.06) {
    const Outline coarse = naca_airfoil("0012", 40).points, fine = naca_airfoil("0012", 300).points;
    Outline outline;
    bool is_iced = false, is_off = false;
    for (Point p : coarse) {
        if (p.x > ice_up_to) {
            outline.push_back(p);
        } else if (!is_iced) {
            is_iced = true;
            for (Point q : fine) {
                if (q.x > ice_up_to) continue;
                is_off = !is_off;
                outline.push_back(is_off ? q : q + Point{-0.003, q.y > 0 ? 0.003 : -0.003});
            }
        }
    }
    return outline;
}

TEST(AutomaticSurface, KeepsIceAndResamplesTheSmoothRearBehindIt) {
    const Outline iced = iced_section();
    const Element e = prepared(iced, {});
    EXPECT_TRUE(e.resampled);
    EXPECT_FALSE(e.smooth);
    EXPECT_NE(e.surface_notes.back().find("corners they"), std::string::npos) << e.surface_notes.back();
    for (Point p : iced) {
        if (p.x < 0.055) {
            EXPECT_TRUE(contains(e.points, p)) << p.x << ' ' << p.y;
        }
    }
    for (Point p : e.points) {
        if (p.x < 0.05) {
            EXPECT_LT(distance_to(iced, p), 1e-12);
        }
        if (p.x > 0.1) {
            EXPECT_NEAR(std::abs(p.y), naca_half_thickness(0.12, p.x, -0.1036), 1e-3);
        }
    }
    EXPECT_LE(max_edge_length(e.points), 0.0215);
    // Given points may stand as they do; wherever one of three is new, their spacings are graded.
    const std::size_t n = e.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Outline three{e.points[i], e.points[(i + 1) % n], e.points[(i + 2) % n]};
        if (std::all_of(three.begin(), three.end(), [&](Point p) { return contains(iced, p); })) continue;
        const double before = distance(three[0], three[1]), after = distance(three[1], three[2]);
        EXPECT_LE(std::max(before / after, after / before), 1.25) << three[1].x << ' ' << three[1].y;
    }
    const Outline mirrored = prepared(shapes::mirrored(iced), {}).points;
    expect_equal_loops(shapes::mirrored(e.points), mirrored);
}

TEST(AutomaticSurface, ResamplesDensePointsThatAreRandomOrFarTooClose) {
    std::mt19937 random(11);
    std::vector<double> angles;
    for (int i = 0; i < 1200; ++i) angles.push_back(shapes::full_turn * static_cast<double>(random()) / 4294967296.0);
    std::sort(angles.begin(), angles.end());
    Outline scattered, clustered = shapes::ellipse(1, 0.2, 1200);
    for (double t : angles) scattered.push_back({std::cos(t), 0.2 * std::sin(t)});
    // Each edge beside the first vertex is half as long as the one before it.
    for (double t = shapes::full_turn / 2400; t > 1e-8; t *= 0.5)
        clustered.insert(clustered.begin() + 1, {std::cos(t), 0.2 * std::sin(t)});
    for (const Outline& outline : {scattered, clustered}) {
        const Element e = prepared(outline, {});
        EXPECT_TRUE(e.resampled && e.smooth);
        EXPECT_NEAR(static_cast<double>(e.points.size()), static_cast<double>(outline.size()), 4);
        EXPECT_LE(max_spacing_ratio(e.points), 1.25);
        EXPECT_LT(max_distance_from(shapes::ellipse(1, 0.2, 4000), e.points), 1e-4);
    }
}

TEST(AutomaticSurface, KeepsEvenPointsAndKnowsThatTheyAreSmooth) {
    const Outline dense = shapes::ellipse(1, 0.2, 1200);
    const Element kept = prepared(dense, {});
    EXPECT_EQ(kept.points, dense);
    EXPECT_FALSE(kept.resampled);
    EXPECT_TRUE(kept.smooth);
    SurfaceOptions keep;
    keep.treatment = SurfaceTreatment::keep;
    EXPECT_FALSE(prepared(dense, keep).smooth) << "they might be anything";
}

/// Returns an arc of a circle, with points `spacing` apart, closed by two sides of two edges that meet in a corner.
Outline cone(double spacing) {
    constexpr double half_gap = 1.0471975511965976;
    const Point apex{0.815, 0}, start{std::cos(half_gap), std::sin(half_gap)}, end{start.x, -start.y};
    const auto edges = static_cast<std::size_t>(std::ceil(2 * (3.14159265358979323846 - half_gap) / spacing));
    Outline outline{apex, midpoint(apex, start)};
    for (std::size_t k = 0; k <= edges; ++k) {
        const double t =
            half_gap + 2 * (3.14159265358979323846 - half_gap) * static_cast<double>(k) / static_cast<double>(edges);
        outline.push_back(k == edges ? end : Point{std::cos(t), std::sin(t)});
    }
    outline.push_back(midpoint(apex, end));
    return outline;
}

TEST(Resampling, KeepsTheCornerOfAFlapThatIsHardlyDeflected) {
    for (const double angle_deg : {1.0, 5.0, 9.0})
        for (const std::string section : {"naca:0012", "naca:4412", "naca:0012:60"}) {
            const std::vector<std::string> inputs{section};
            GeometryOptions options;
            options.transformations = {{"all", FlapDeflection{angle_deg, {0.75, 0.01}}}};
            const Element given = read_geometry(inputs, options).elements[0];
            const Element result = prepare_surfaces({{given}}, resampling()).elements[0];
            ASSERT_FALSE(given.given_corners.empty());
            ASSERT_EQ(result.given_corners.size(), given.given_corners.size());
            for (std::size_t k = 0; k < given.given_corners.size(); ++k)
                EXPECT_EQ(result.points[result.given_corners[k]], given.points[given.given_corners[k]]);
            EXPECT_LE(max_spacing_ratio(result.points), 1.25) << section << ' ' << angle_deg;
        }
}

TEST(AutomaticSurface, KeepsAStretchThatIsFineBesideOneThatIsCoarse) {
    const Outline given = cone(0.009);
    const Element e = prepared(given, {});
    for (std::size_t i = 2; i + 1 < given.size(); ++i) EXPECT_TRUE(contains(e.points, given[i])) << i;
    EXPECT_EQ(count_notes(e, "given edges kept"), 1u) << e.surface_notes.back();
    EXPECT_GT(e.points.size(), given.size() + 40);
    EXPECT_LE(max_spacing_ratio(e.points), 1.25);
}

/// Returns a section with a base of this height, whose `points` points stand equally far apart on its surfaces.
Outline section_with_base(double base, std::size_t points) {
    Outline fine;
    for (int k = 0; k <= 4000; ++k) {
        const double x = 0.5 + 0.5 * std::cos(shapes::full_turn * k / 4000);
        const double half = naca_half_thickness(0.24, x, -0.1036) + 0.5 * base * x;
        fine.push_back({x, k <= 2000 ? half : -half});
    }
    return shapes::even_points(fine, points);
}

/// Returns the length of the longest edge at a corner of the base of an element.
double longest_at_base(const Element& e) {
    const std::size_t n = e.points.size();
    double longest = 0;
    for (const std::size_t corner : {e.features.base->first, e.features.base->last})
        for (const std::size_t i : {corner, (corner + n - 1) % n})
            longest = std::max(longest, distance(e.points[i], e.points[(i + 1) % n]));
    return longest;
}

/// A base of one edge as long as its neighbours was kept, and areas of neighbouring cells differed by 187,408 there,
/// while the next section of the blade was resampled.
TEST(AutomaticSurface, JudgesBasesAsWellAsNoses) {
    for (const double base : {0.0035, 0.011, 0.0125, 0.016, 0.0213})
        for (const std::size_t points : {200u, 300u, 1500u}) {
            const Element e = prepared(section_with_base(base, points), {});
            ASSERT_TRUE(e.features.base) << base;
            EXPECT_LE(longest_at_base(e), 0.00125) << base << ' ' << points << ' ' << e.surface_notes.back();
            EXPECT_LE(max_spacing_ratio(e.points), 1.25);
            EXPECT_GE(e.points.size(), points == 1500 ? points : 0) << "so many points are a choice";
        }
}

TEST(AutomaticSurface, HoldsTheSpacingsThatTheLayerAsksFor) {
    const Outline fine = shapes::circle(0.5, 400), dense = shapes::circle(0.5, 2000);
    for (const Outline& outline : {fine, dense}) {
        const Geometry given = shapes::geometry({outline});
        ASSERT_EQ(prepare_surfaces(given, {}).elements[0].points, outline);
        surface::SpacingLimits limits;
        limits.walls = {{0, {0.5, 0}, {0.5, 0}, 4e-4}};
        const Outline points = surface::prepare_within(given, {}, limits, {}).elements[0].points;
        double shortest = HUGE_VAL;
        for (std::size_t i = 0; i < points.size(); ++i)
            shortest = std::min(shortest, distance(points[i], points[(i + 1) % points.size()]));
        EXPECT_LE(shortest, 5e-4);
        EXPECT_LE(max_spacing_ratio(points), 1.25);
        if (outline.size() == dense.size()) {
            for (const Point p : dense) EXPECT_TRUE(p.x > 0.4 || contains(points, p)) << p.x << ' ' << p.y;
        }
    }
}

TEST(AutomaticSurface, TakesAsManyPointsAsTheWallNeedsWhereItReplacesThem) {
    Outline cosine = naca_airfoil("0012", 800).points;
    const Element e = prepared(cosine, {});
    EXPECT_TRUE(e.resampled);
    EXPECT_LT(e.points.size(), 250u) << e.surface_notes.back();
}

/// Sides of 1, 2 and 8 edges, of up to 9.6 % of the body, in spite of the largest spacing of 2 %.
TEST(AutomaticSurface, DividesTheSidesOfASnowflakeAlike) {
    for (const int level : {2, 3})
        for (const double max_spacing : {0.02, 0.005}) {
            const Outline given = shapes::snowflake(level);
            SurfaceOptions options;
            options.max_spacing = max_spacing;
            const Element e = prepared(given, options);
            ASSERT_EQ(e.features.corners.size(), given.size());
            EXPECT_LE(max_edge_length(e.points), 2 * max_spacing * (1 + 1e-9));
            // A side between two tips and notches has as many edges as each other one between such.
            std::map<std::pair<bool, bool>, std::size_t> edges;
            const std::vector<double> turning = surface::turning_angles(given);
            for (std::size_t k = 0; k < given.size(); ++k) {
                const std::size_t next = (k + 1) % given.size();
                const std::size_t end = next == 0 ? e.points.size() : e.features.corners[next];
                const bool a = turning[k] > 0, b = turning[next] > 0;
                const std::size_t count = end - e.features.corners[k];
                EXPECT_EQ(edges.emplace(std::pair{std::min(a, b), std::max(a, b)}, count).first->second, count) << k;
            }
        }
}

/// The shares were of the longer side of the box along the axes, so that a section turned by 45 degrees had 300 edges
/// instead of 276.
TEST(AutomaticSurface, TurnsWithTheSection) {
    for (const std::string digits : {"0012", "2412", "0030"}) {
        const Outline given = naca_airfoil(digits, 60).points;
        const std::size_t points = prepared(given, {}).points.size();
        for (double angle_deg = 5; angle_deg < 90; angle_deg += 10) {
            const Outline turned = shapes::moved(given, shapes::full_turn * angle_deg / 360, 1, {0, 0});
            EXPECT_NEAR(static_cast<double>(prepared(turned, {}).points.size()), static_cast<double>(points), 2)
                << digits << ' ' << angle_deg;
        }
    }
}

TEST(AutomaticSurface, BendsTheCurvedSideOfAPolygonOnly) {
    const Outline given = cone(0.3);
    const Element e = prepared(given, {});
    for (Point p : e.points) {
        if (p.x > 0.5 + 1e-12) {
            EXPECT_LT(distance_to(given, p), 1e-12) << "a straight side";
        } else {
            EXPECT_NEAR(length(p), 1, 2e-3) << "the arc";
        }
    }
    EXPECT_LE(max_spacing_ratio(e.points), 1.25);
}

/// Returns a section with an inclined base of a thousandth of its chord that has many samples, with so many digits.
Outline section_with_sampled_base(int digits) {
    Outline outline;
    const int sides = 80, base = 16;
    const auto side = [&](int i, double sign) {
        const double x = 0.5 * (1 + std::cos(3.14159265358979323846 * i / sides));
        outline.push_back({x, sign * naca_half_thickness(0.12, x, -0.1036) + sign * 0.0005 * x});
    };
    for (int i = 0; i < sides; ++i) side(i, 1);
    for (int i = sides; i >= 0; --i) side(i, -1);
    const Point lower = outline.back(), upper = outline.front();
    for (int i = 1; i < base; ++i)
        outline.push_back(lower + 0.5 * (1 - std::cos(3.14159265358979323846 * i / base)) * (upper - lower));
    outline = shapes::moved(outline, -0.35, 1, {0, 0});
    const double unit = std::pow(10, -digits);
    for (Point& p : outline) p = {std::round(p.x / unit) * unit, std::round(p.y / unit) * unit};
    return outline;
}

TEST(AutomaticSurface, TakesNoRoundingForTheCurvatureOfABase) {
    const auto shortest_edge = [](const Outline& p) {
        double shortest = HUGE_VAL;
        for (std::size_t i = 0; i < p.size(); ++i) shortest = std::min(shortest, distance(p[i], p[(i + 1) % p.size()]));
        return shortest;
    };
    const Element exact = prepared(section_with_sampled_base(12), resampling()),
                  rounded = prepared(section_with_sampled_base(6), resampling());
    ASSERT_EQ(exact.features.corners.size(), 2u);
    EXPECT_EQ(rounded.features.corners.size(), 2u);
    EXPECT_NEAR(shortest_edge(rounded.points), shortest_edge(exact.points), 0.05 * shortest_edge(exact.points));
    EXPECT_NEAR(static_cast<double>(rounded.points.size()), static_cast<double>(exact.points.size()), 4);
}

TEST(AutomaticSurface, TakesNoSectionForTheRoundingOfALongSpike) {
    Outline given = section_with_sampled_base(6);
    const Point tail = given.front();
    given.front() = {1e6, tail.y};
    const Element e = prepared(given, resampling());
    for (std::size_t i = 10; i < 150; i += 10) EXPECT_LT(distance_to(e.points, given[i]), 0.1) << i;
}

/// Returns the length of the edges of an outline at its vertex that is nearest to a point.
double spacing_at(const Outline& p, Point at) {
    const auto nearer = [&](Point a, Point b) { return distance(a, at) < distance(b, at); };
    const auto i = static_cast<std::size_t>(std::min_element(p.begin(), p.end(), nearer) - p.begin());
    return std::max(distance(p[i], p[(i + 1) % p.size()]), distance(p[(i + p.size() - 1) % p.size()], p[i]));
}

TEST(RequestedSpacings, AreFollowedAtBothEndsOfTheChord) {
    const Outline fine = naca_airfoil("0012", 300).points, blunt = shapes::section(0.12, 0.004, 20);
    SurfaceOptions options;
    options.leading_edge_spacing = 2e-4;
    options.trailing_edge_spacing = 3e-4;
    options.max_spacing = 0.01;
    for (const Outline& outline : {fine, blunt, shapes::moved(fine, 0, 10, {3, 4})}) {
        const Element e = prepared(outline, options);
        const double chord = surface::summarize(e).chord;
        const Point nose = outline[outline.size() / 2], tail = outline[0];
        EXPECT_TRUE(e.resampled);
        EXPECT_LE(spacing_at(e.points, nose), 1.2 * 2e-4 * chord);
        EXPECT_GE(spacing_at(e.points, nose), 0.8 * 2e-4 * chord);
        EXPECT_LE(spacing_at(e.points, tail), 1.2 * 3e-4 * chord);
        EXPECT_GE(spacing_at(e.points, tail), 0.8 * 3e-4 * chord);
        EXPECT_LE(max_edge_length(e.points), 1.01 * 0.01 * chord);
        EXPECT_LE(max_spacing_ratio(e.points), options.max_ratio);
        expect_equal_loops(shapes::mirrored(e.points), prepared(shapes::mirrored(outline), options).points);
    }
}

TEST(RequestedSpacings, YieldToTheCurvatureAtTheNoseAndReplaceThatOfCornersAtTheTail) {
    const Outline outline = naca_airfoil("0012", 60).points;
    SurfaceOptions coarse;
    coarse.leading_edge_spacing = 0.02;
    coarse.trailing_edge_spacing = 0.005;
    const Outline wall = prepared(outline, coarse).points, plain = prepared(outline, resampling(10)).points;
    EXPECT_NEAR(spacing_at(wall, {0, 0}), spacing_at(plain, {0, 0}), 0.2 * spacing_at(plain, {0, 0}));
    EXPECT_GT(spacing_at(wall, {1, 0}), 0.004);
    EXPECT_LT(spacing_at(plain, {1, 0}), 0.0012);
    EXPECT_LE(max_distance_from(naca_airfoil("0012", 2000).points, wall), 2 * coarse.tolerance);
}

}  // namespace
}  // namespace lamina
