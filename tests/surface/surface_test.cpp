// The surface stage keeps its promises on spacings, corners, symmetry and shape.
#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/surface.hpp>

#include "core/angles.hpp"
#include "support/geometry_fixtures.hpp"
#include "support/outline_measures.hpp"
#include "support/shapes.hpp"
#include "surface/corners.hpp"
#include "surface/noise.hpp"

namespace lamina {
namespace {

std::size_t count_inflections(const Outline& p) {
    const std::vector<double> t = surface::turning_angles(p);
    std::size_t changes = 0;
    for (std::size_t i = 0; i < t.size(); ++i)
        if (t[i] * t[(i + 1) % t.size()] < 0) ++changes;
    return changes;
}

/// Returns sections that are as coarse as those of old collections.
std::vector<Outline> coarse_sections() {
    return {shapes::section(0.12, 0, 15),     shapes::section(0.12, 0.003, 20),
            shapes::section(0.2, 0.02, 12),   shapes::joukowski(0.1, 0.08, 40),
            naca_airfoil("23012", 40).points, naca_airfoil("0006", 31, TrailingEdge::blunt).points,
            shapes::ellipse(1, 0.2, 30),      shapes::circle(1, 16),
            shapes::plate(0.05, 8),           shapes::refined(shapes::v_notch(0.6), 3),
            shapes::refined(shapes::box(), 2)};
}

TEST(Resampling, BoundsSpacingsAndTurning) {
    for (const Outline& outline : coarse_sections()) {
        SCOPED_TRACE(outline.size());
        for (double limit : {2.0, 5.0}) {
            const SurfaceOptions options = resampling(limit);
            const Element e = prepared(outline, options);
            EXPECT_LE(max_spacing_ratio(e.points), options.max_ratio);
            EXPECT_LE(max_turning_deg(e.points), limit);
            Box box;
            for (Point p : outline) box.include(p);
            EXPECT_LE(max_edge_length(e.points), options.max_spacing * 1.01 * std::max(box.width(), box.height()));
            EXPECT_EQ(e.surface_notes.size(), 1u);
        }
    }
}

TEST(Resampling, KeepsCorners) {
    struct Case {
        Outline outline;
        std::vector<Point> corners;
    };
    const double r = 0.025;
    for (const Case& c : std::vector<Case>{{shapes::section(0.12, 0, 15), {{1, 0}}},
                                           {shapes::section(0.2, 0.02, 12), {{1, 0.01}, {1, -0.01}}},
                                           {shapes::joukowski(0.1, 0.08, 40), {{2, 0}}},
                                           {shapes::plate(2 * r, 8), {{1, r}, {1, -r}}},
                                           {shapes::refined(shapes::v_notch(0.6), 3), shapes::v_notch(0.6)},
                                           {shapes::refined(shapes::box(), 2), shapes::box()}}) {
        SCOPED_TRACE(c.outline.size());
        const Outline p = prepared(c.outline, resampling()).points;
        for (Point corner : c.corners) EXPECT_TRUE(contains(p, corner)) << corner.x << ' ' << corner.y;
        EXPECT_EQ(surface::find_corners(c.outline).size(), c.corners.size()) << "and nothing else is one";
    }
    // The hinge of a flap is a kink of 20 degrees between straight parts.
    Outline kinked{{0, 0}, {0.7, 0}, {0.85, -0.05}, {1, -0.1}, {0.85, -0.03}, {0.7, 0.03}, {0.35, 0.05}};
    EXPECT_TRUE(contains(prepared(kinked, resampling()).points, {0.7, 0}));
}

/// Returns a section at the stations of old tables, of these ordinates over x on its upper (1) and lower (-1) side.
Outline at_old_stations(const std::function<double(double x, int side)>& ordinate) {
    const std::vector<double> stations{1,    0.95, 0.9,  0.8, 0.7,   0.6,  0.5,   0.4,    0.3,
                                       0.25, 0.2,  0.15, 0.1, 0.075, 0.05, 0.025, 0.0125, 0};
    Outline outline;
    for (const double x : stations) outline.push_back({x, ordinate(x, 1)});
    for (std::size_t k = stations.size() - 1; k-- > 1;) outline.push_back({stations[k], ordinate(stations[k], -1)});
    return outline;
}

TEST(Corners, NosesAtTheStationsOfOldTablesAreRound) {
    for (const double thickness : {0.06, 0.09, 0.12, 0.18})
        for (const double camber : {0.0, 0.02, 0.05}) {
            SCOPED_TRACE(std::to_string(thickness) + " " + std::to_string(camber));
            const Outline outline = at_old_stations([&](double x, int side) {
                return side * std::max(0.0, naca_half_thickness(thickness, x)) + 4 * camber * x * (1 - x);
            });
            EXPECT_EQ(surface::find_corners(outline), std::vector<std::size_t>{0});
            Outline mirrored = outline;
            for (Point& p : mirrored) p.x = -p.x;
            std::reverse(mirrored.begin() + 1, mirrored.end());
            EXPECT_EQ(surface::find_corners(mirrored), std::vector<std::size_t>{0});
        }
}

// Thin noses are round for a few thousandths of the chord and then like wedges, so that the outline hardly turns at the
// samples beside the foremost one: that of Goe 411 by 14 degrees, and by 95 degrees at the nose.
TEST(Corners, NosesThatTurnLittleBesideTheirForemostSampleAreRound) {
    const auto corners_of = [](double round, double straight) {
        return surface::find_corners(at_old_stations(
            [&](double x, int side) { return side * (round * std::sqrt(x) + straight * x) * (1 - x); }));
    };
    for (const double round : {0.06, 0.068, 0.08})
        EXPECT_EQ(corners_of(round, 0.3), std::vector<std::size_t>{0}) << round;
    EXPECT_EQ(corners_of(0.01, 0.6).size(), 2u) << "nearly a wedge";
}

// As of the Falcon section, an open file whose sides close by 30 degrees over the last hundredth of the chord.
TEST(Corners, BothEndsOfABluntTailThatClosesAreCorners) {
    const Outline upper{{1, 0.00145}, {0.9975, 0.0029}, {0.9907, 0.0058}, {0.98, 0.008}, {0.96, 0.01},
                        {0.9, 0.018}, {0.7, 0.04},      {0.5, 0.055},     {0.3, 0.06},   {0.2, 0.057},
                        {0.1, 0.045}, {0.05, 0.033},    {0.02, 0.0215},   {0.005, 0.011}};
    Outline outline = upper;
    outline.push_back({0, 0});
    for (std::size_t k = upper.size(); k-- > 0;) outline.push_back({upper[k].x, -upper[k].y});
    EXPECT_EQ(surface::find_corners(outline), (std::vector<std::size_t>{0, outline.size() - 1}));
}

TEST(Corners, WedgesAndLensesAreSharpAtBothEnds) {
    Outline wedge, lens;
    const std::size_t n = 20;
    for (std::size_t k = 0; k <= 2 * n - 1; ++k) {
        const double s = k <= n ? 1 - static_cast<double>(k) / n : static_cast<double>(k) / n - 1;
        const double side = k <= n ? 1 : -1;
        wedge.push_back({s, side * 0.2 * std::min(s, 1 - s)});
        lens.push_back({s, side * 0.4 * s * (1 - s)});
    }
    for (const Outline& outline : {wedge, lens}) {
        const auto corners = surface::find_corners(outline);
        EXPECT_EQ(corners.front(), 0u);
        EXPECT_TRUE(std::find(corners.begin(), corners.end(), n) != corners.end());
    }
}

// Sections of the FX, AH and LWK families close over their last two samples, as bluntly as a nose.
TEST(Corners, TheEndsOfAFileAreATrailingEdge) {
    Outline outline;
    for (std::size_t k = 0; k < 80; ++k) {
        const double a = 6.283185307179586 * static_cast<double>(k) / 80, x = 0.5 * (1 + std::cos(a));
        const double half = 0.1 * std::sqrt(x) * (1 - x) + 0.002 * std::sqrt(x) * std::pow(1 - x, 0.1);
        outline.push_back({x, k <= 40 ? half : -half});
    }
    outline[0].y = outline[40].y = 0;
    EXPECT_EQ(surface::find_corners(outline), std::vector<std::size_t>{0});
    EXPECT_LT(surface::turning_angles(outline)[0], 2.1) << "so that the angle alone does not make it a corner";
    std::rotate(outline.begin(), outline.begin() + 20, outline.end());
    EXPECT_TRUE(surface::find_corners(outline).empty())
        << "where the file begins elsewhere nothing tells it from a nose";
}

TEST(Resampling, ClustersAtTheTrailingEdge) {
    const Element sharp = prepared(shapes::section(0.12, 0, 15), resampling());
    const Outline& p = sharp.points;
    ASSERT_EQ(p[0], (Point{1, 0}));
    EXPECT_LT(distance(p[0], p[1]), 0.0012);
    EXPECT_LT(distance(p[0], p.back()), 0.0012);
    const Element blunt = prepared(shapes::section(0.12, 0.004, 15), resampling());
    const auto on_base = std::count_if(blunt.points.begin(), blunt.points.end(), [](Point q) { return q.x == 1; });
    EXPECT_GE(on_base, 4);
}

TEST(Resampling, FollowsCurvesThatAreKnownExactly) {
    struct Case {
        Outline coarse, exact;
        double tolerance;
    };
    const std::vector<Case> cases{
        {shapes::ellipse(1, 0.3, 40), shapes::ellipse(1, 0.3, 20000), 3e-4},
        {shapes::circle(1, 24), shapes::circle(1, 20000), 3e-4},
        {naca_airfoil("0012", 60).points, naca_airfoil("0012", 20000).points, 1.5e-4},
        {naca_airfoil("4412", 60).points, naca_airfoil("4412", 20000).points, 1.5e-4},
        {shapes::joukowski(0.1, 0.05, 60), shapes::joukowski(0.1, 0.05, 20000), 6e-4},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.coarse.size());
        const Element e = prepared(c.coarse, resampling());
        EXPECT_LT(max_distance_from(c.exact, e.points), c.tolerance);
        // The polygon through the given points is farther away.
        EXPECT_LT(2 * max_distance_from(c.exact, e.points), max_distance_from(c.exact, c.coarse));
    }
}

TEST(Resampling, SectionsWithAFormulaGetTheWallTheyNeed) {
    const SurfaceOptions options;
    for (const char* input : {"naca:0012", "naca:0006", "naca:0024", "naca:0012:extended"}) {
        SCOPED_TRACE(input);
        const std::vector<std::string> inputs{input};
        const Geometry g = prepare_surfaces(read_geometry(inputs), options);
        const Element& e = g.elements[0];
        EXPECT_TRUE(e.resampled);
        EXPECT_LT(e.points.size(), 500u);
        EXPECT_LE(max_turning_deg(e.points), options.max_turning_deg);
        EXPECT_LE(max_spacing_ratio(e.points), options.max_ratio);
        EXPECT_TRUE(contains(e.points, {0, 0})) << "the nose";
        const double thickness = std::stod(std::string(input).substr(7, 2)) / 100;
        const bool extended = std::string(input).ends_with("extended");
        const double length = extended ? 1.0089304115 : 1, last = extended ? -0.1015 : -0.1036;
        for (const Point p : e.points) {
            const double x = length * p.x;
            const double y = naca_half_thickness(thickness, x, last) / length;
            // The formula is steep at the nose, so that the distance from the curve is less than the difference in y.
            const double slope = 5 * thickness * 0.5 * 0.2969 / std::sqrt(std::max(x, 1e-12));
            EXPECT_NEAR(std::abs(p.y), y, 1e-10 * (1 + slope)) << p.x;
        }
    }
    const std::vector<std::string> given{"naca:0012:300"};
    EXPECT_EQ(prepare_surfaces(read_geometry(given), options).elements[0].points.size(), 300u);
    SurfaceOptions keep;
    keep.treatment = SurfaceTreatment::keep;
    const std::vector<std::string> free{"naca:0012"};
    EXPECT_EQ(prepare_surfaces(read_geometry(free), keep).elements[0].points.size(), 2000u);
}

/// Returns a point of the upper or lower surface of a section with a camber line, by the parameter x of its formula.
Point naca_point(double x, double thickness, bool is_upper,
                 const std::function<std::pair<double, double>(double)>& camber) {
    const auto [y, slope] = camber(x);
    const double half = naca_half_thickness(thickness, x, -0.1036), across = is_upper ? half : -half;
    const double scale = 1 / std::sqrt(1 + slope * slope);
    return {x - across * slope * scale, y + across * scale};
}

TEST(Resampling, EveryPointOfACamberedSectionLiesOnTheCurve) {
    struct Section {
        const char* name;
        double thickness;
        std::function<std::pair<double, double>(double)> camber;  ///< ordinate and slope of the camber line
    };
    // The curvature of the camber lines of four digits jumps where they are highest, which bends the outline.
    const auto four_digit = [](double height, double position) {
        return [=](double x) {
            const double q = x < position ? position : 1 - position, a = height / (q * q);
            return std::pair{height - a * (x - position) * (x - position), 2 * a * (position - x)};
        };
    };
    const Section sections[] = {{"naca:4412", 0.12, four_digit(0.04, 0.4)},
                                {"naca:9112", 0.12, four_digit(0.09, 0.1)},
                                {"naca:6421", 0.21, four_digit(0.06, 0.4)},
                                {"naca:23012", 0.12, [](double x) {
                                     constexpr double m = 0.2025, k = 15.957 / 6;
                                     return x < m ? std::pair{k * (x * x * x - 3 * m * x * x + m * m * (3 - m) * x),
                                                              k * (3 * x * x - 6 * m * x + m * m * (3 - m))}
                                                  : std::pair{k * m * m * m * (1 - x), -k * m * m * m};
                                 }}};
    for (const Section& section : sections) {
        const std::vector<std::string> inputs{section.name};
        const Geometry g = prepare_surfaces(read_geometry(inputs), {});
        double farthest = 0;
        for (const Point p : g.elements[0].points) {
            double nearest = HUGE_VAL;
            for (const bool is_upper : {true, false}) {
                // The square root of x is the parameter, since the nose is round. A search by thirds follows a scan.
                const auto off = [&](double u) {
                    return distance(p, naca_point(u * u, section.thickness, is_upper, section.camber));
                };
                double best = 0;
                for (int k = 0; k <= 1000; ++k)
                    if (off(k / 1000.0) < off(best)) best = k / 1000.0;
                double from = std::max(0.0, best - 0.001), to = std::min(1.0, best + 0.001);
                for (int k = 0; k < 100; ++k) {
                    const double third = (to - from) / 3;
                    (off(from + third) < off(to - third) ? to : from) =
                        off(from + third) < off(to - third) ? to - third : from + third;
                }
                nearest = std::min(nearest, off(0.5 * (from + to)));
            }
            farthest = std::max(farthest, nearest);
        }
        EXPECT_LT(farthest, 1e-9) << section.name;
    }
}

TEST(Resampling, MirroredInputGivesMirroredPoints) {
    for (const Outline& outline : coarse_sections()) {
        SCOPED_TRACE(outline.size());
        expect_equal_loops(shapes::mirrored(prepared(outline, resampling()).points),
                           prepared(shapes::mirrored(outline), resampling()).points);
    }
}

TEST(Resampling, ASymmetricSectionStaysSymmetricAndKeepsItsNose) {
    for (const Outline& outline : {shapes::section(0.12, 0, 15), naca_airfoil("0012", 50).points,
                                   naca_airfoil("0009", 41, TrailingEdge::blunt).points}) {
        const Outline p = prepared(outline, resampling()).points;
        expect_equal_loops(p, shapes::mirrored(p));
        EXPECT_LT(distance_to(p, {0, 0}), 1e-12);
        EXPECT_TRUE(std::any_of(p.begin(), p.end(), [](Point q) { return length(q) < 1e-12; }));
    }
}

TEST(Resampling, MovesTurnsAndScalesWithTheBody) {
    const Outline outline = naca_airfoil("4412", 50).points;
    const Outline p = prepared(outline, resampling()).points;
    const Outline shifted = prepared(shapes::moved(outline, 0, 4, {3, -2}), resampling()).points;
    const Outline expected = shapes::moved(p, 0, 4, {3, -2});
    ASSERT_EQ(shifted.size(), expected.size());
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_LT(distance(shifted[i], expected[i]), 1e-10);
}

TEST(Resampling, MakesAboutTheRequestedNumberOfPoints) {
    for (std::size_t points : {60u, 150u, 400u, 2000u}) {
        SurfaceOptions options;
        options.points = points;
        for (const Outline& outline : {naca_airfoil("4412", 50).points, shapes::section(0.12, 0.003, 20)}) {
            const Element e = prepared(outline, options);
            EXPECT_NEAR(double(e.points.size()), double(points), 0.02 * double(points) + 3);
            if (points >= 150) {
                EXPECT_LE(max_spacing_ratio(e.points), options.max_ratio);
            }
        }
    }
}

TEST(Resampling, PolygonsKeepTheirSides) {
    Outline hexagon;
    for (int k = 0; k < 6; ++k) hexagon.push_back(shapes::circle(1, 6)[static_cast<std::size_t>(k)]);
    const Outline thin_diamond{{1, 0}, {0.5, 0.03}, {0, 0}, {0.5, -0.03}},
        plate{{1, 0.005}, {0, 0.005}, {0, -0.005}, {1, -0.005}};
    for (const Outline& polygon : {shapes::wedge(), shapes::diamond(), shapes::box(), shapes::l_shape(),
                                   shapes::c_shape(0.3), shapes::comb(3, 0.2), hexagon, thin_diamond, plate}) {
        SCOPED_TRACE(polygon.size());
        for (const SurfaceOptions& options : {resampling(), SurfaceOptions{}}) {
            const Element e = prepared(polygon, options);
            EXPECT_GT(e.points.size(), polygon.size());
            for (Point p : polygon) EXPECT_TRUE(contains(e.points, p));
            for (Point p : e.points) EXPECT_LT(distance_to(polygon, p), 1e-12);
            EXPECT_LE(max_spacing_ratio(e.points), 1.25);
        }
    }
    const Outline side_in_two_parts{{0, 0}, {0.5, 0}, {1, 0}, {1, 0.5}, {0, 0.5}};
    const Element e = prepared(side_in_two_parts, SurfaceOptions{});
    EXPECT_GT(e.points.size(), 50u);
    for (Point p : e.points) EXPECT_LT(distance_to(side_in_two_parts, p), 1e-12);
}

TEST(Resampling, SurvivesNearDuplicates) {
    std::mt19937 random(5);
    for (Outline outline : {naca_airfoil("4412", 50).points, shapes::section(0.12, 0.003, 20)}) {
        const Outline clean = prepared(outline, resampling()).points;
        for (double off : {1e-6, 1e-5, 1e-4})
            for (std::size_t at : {5u, 14u, 24u, 25u, 33u}) {
                Outline doubled = outline;
                const Point p = outline[at];
                doubled.insert(doubled.begin() + at + 1, p + off * unit(outline[at + 1] - p) +
                                                             0.3 * off * perpendicular(unit(outline[at + 1] - p)));
                const Element e = prepared(doubled, resampling());
                EXPECT_LT(max_distance_from(clean, e.points), 2e-4) << off << ' ' << at;
                EXPECT_LE(max_turning_deg(e.points), 5);
            }
    }
}

TEST(Resampling, SpacingsInASlotFitIt) {
    constexpr double gap = 0.004;
    const Outline main = naca_airfoil("0012", 60).points;
    const Outline below = shapes::moved(main, 0, 1, {0, -0.12 - gap});
    const Geometry result = prepare_surfaces(shapes::geometry({main, below}), resampling());
    EXPECT_NO_THROW(check_simple(result));
    double longest = 0;
    for (int e = 0; e < 2; ++e) {
        const Outline &p = result.elements[static_cast<std::size_t>(e)].points,
                      &other = result.elements[static_cast<std::size_t>(1 - e)].points;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const double room = distance_to(other, p[i]);
            if (room < 2 * gap) longest = std::max(longest, distance(p[i], p[(i + 1) % p.size()]) / room);
        }
    }
    EXPECT_GT(longest, 0);
    EXPECT_LT(longest, 1.2);
}

TEST(AutomaticSurface, KeepsFineAndExactOutlines) {
    const SurfaceOptions automatic;
    const std::vector<std::string> naca{"naca:0012:40"};
    EXPECT_EQ(prepare_surfaces(read_geometry(naca), automatic).elements[0].points.size(), 40u);
    for (const Outline& outline :
         {shapes::circle(1, 240), shapes::joukowski(0.1, 0.05, 4000), shapes::ellipse(1, 0.05, 3000)})
        EXPECT_EQ(prepared(outline, automatic).points, outline);
}

TEST(AutomaticSurface, ResamplesCoarseCurvesAndSaysWhy) {
    const Element e = prepared(shapes::circle(1, 20), {});
    EXPECT_GT(e.points.size(), 36u);
    EXPECT_NE(e.surface_notes.back().find("20 points resampled to"), std::string::npos) << e.surface_notes.back();
    EXPECT_NE(e.surface_notes.back().find("turn by up to 18.0 degrees"), std::string::npos) << e.surface_notes.back();
}

/// Spacings that jump by 1.6 are no wall for a layer, however small they are.
TEST(AutomaticSurface, ResamplesFineCurvesOfUnevenSpacing) {
    Outline outline;
    for (int k = 0; k < 180; ++k) {
        const double angle = core::radians(2 * k + (k % 10 == 5 ? 0.45 : 0));
        outline.push_back({std::cos(angle), std::sin(angle)});
    }
    const Element e = prepared(outline, {});
    EXPECT_NE(e.surface_notes.back().find("neighbouring spacings differ by up to 1.6"), std::string::npos)
        << e.surface_notes.back();
    const Outline& points = e.points;
    for (std::size_t i = 0, n = points.size(); i < n; ++i) {
        const double a = distance(points[(i + n - 1) % n], points[i]), b = distance(points[i], points[(i + 1) % n]);
        EXPECT_LT(std::max(a, b) / std::min(a, b), 1.25);
    }
}

TEST(KeptSurface, IsUntouched) {
    SurfaceOptions keep;
    keep.treatment = SurfaceTreatment::keep;
    for (const Outline& outline : coarse_sections()) EXPECT_EQ(prepared(outline, keep).points, outline);
}

/// Returns a section with every point but the trailing edge moved at random by up to `noise`.
Outline noisy_section(double noise, std::size_t points) {
    std::mt19937 random(7);
    const auto uniform = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    Outline outline = naca_airfoil("2412", points).points;
    for (std::size_t i = 1; i < outline.size(); ++i)
        outline[i] = outline[i] + 0.7 * noise * Point{uniform(), uniform()};
    return outline;
}

TEST(Smoothing, RemovesNoiseWithinTheTolerance) {
    for (double noise : {1e-5, 1e-4}) {
        const Outline outline = noisy_section(noise, 200);
        SurfaceOptions options;
        options.treatment = SurfaceTreatment::keep;
        options.smooth = input_units(noise);
        const Outline smooth = prepared(outline, options).points;
        ASSERT_EQ(smooth.size(), outline.size());
        double moved = 0;
        for (std::size_t i = 0; i < smooth.size(); ++i) moved = std::max(moved, distance(smooth[i], outline[i]));
        EXPECT_LE(moved, noise);
        EXPECT_GT(moved, 0.3 * noise);
        EXPECT_EQ(smooth[0], outline[0]) << "the trailing edge is a corner";
        EXPECT_LT(3 * count_inflections(smooth), count_inflections(outline));
        EXPECT_LT(surface::estimate_noise(smooth, surface::find_corners(smooth)).vertices, 3u);
    }
}

TEST(Smoothing, IsSuggestedWhereItHelps) {
    const auto is_suggested = [](const Outline& outline) {
        const Element e = prepared(outline, {});
        return e.surface_notes.front().find("--smooth") != std::string::npos;
    };
    EXPECT_TRUE(is_suggested(noisy_section(2e-4, 200)));
    EXPECT_FALSE(is_suggested(naca_airfoil("2412", 200).points));
    EXPECT_FALSE(is_suggested(shapes::joukowski(0.1, 0.05, 200)));
}

TEST(MisplacedPoints, AreReportedAndKept) {
    const Outline good = naca_airfoil("2412", 60).points;
    EXPECT_TRUE(surface::find_misplaced_points(good).empty());
    for (const std::size_t i : {8u, 20u, 42u, 50u}) {
        for (const double off : {-0.012, 0.012}) {
            Outline outline = good;
            outline[i].y += off;
            for (const Outline& any : {outline, shapes::mirrored(outline)}) {
                const std::vector<std::size_t> misplaced = surface::find_misplaced_points(any);
                ASSERT_EQ(misplaced.size(), 1u) << i << ' ' << off;
                EXPECT_EQ(any[misplaced[0]].x, outline[i].x);
                const Element e = prepared(any, {});
                EXPECT_TRUE(std::any_of(e.surface_notes.begin(), e.surface_notes.end(), [](const std::string& note) {
                    return note.find("stands off the curve") != std::string::npos;
                }));
            }
        }
    }
    // Corners, flaps, steps and coves belong to the shape.
    for (const Outline& shape : {shapes::l_shape(), shapes::c_shape(0.05), shapes::comb(4, 0.1), shapes::diamond(),
                                 shapes::plate(0.05, 12), shapes::refined(shapes::v_notch(0.4), 15)})
        EXPECT_TRUE(surface::find_misplaced_points(shape).empty());
}

TEST(Smoothing, LeavesNoSeamInAClosedCurve) {
    std::mt19937 random(3);
    Outline rough = shapes::circle(1, 120);
    for (Point& p : rough) p = (1 + 1e-4 * (static_cast<double>(random()) / 2147483648.0 - 1)) * p;
    SurfaceOptions options;
    options.treatment = SurfaceTreatment::keep;
    options.smooth = input_units(2e-4);
    const Outline smooth = prepared(rough, options).points;
    EXPECT_EQ(count_inflections(smooth), 0u);
    expect_equal_loops(smooth, prepared(shapes::started_at(rough, 31), options).points);
}

TEST(SurfaceOptionsOutOfRange, AreRefused) {
    const Geometry body = shapes::geometry({shapes::circle(1, 20)});
    for (auto spoil : std::initializer_list<void (*)(SurfaceOptions&)>{
             [](SurfaceOptions& o) { o.points = 2; }, [](SurfaceOptions& o) { o.smooth = 0; },
             [](SurfaceOptions& o) { o.max_ratio = 1; }, [](SurfaceOptions& o) { o.max_turning_deg = 0; },
             [](SurfaceOptions& o) { o.max_spacing = -1; },
             // Edges would be four times as long as the limit, in silence.
             [](SurfaceOptions& o) { o.max_spacing = 5e-6; }, [](SurfaceOptions& o) { o.tolerance = NAN; }}) {
        SurfaceOptions options;
        spoil(options);
        EXPECT_THROW(prepare_surfaces(body, options), UsageError);
    }
}

}  // namespace
}  // namespace lamina
