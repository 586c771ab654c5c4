// Refinement of regions with frozen borders, with lattice patches and without.
#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/cell_shape.hpp"
#include "sizing/requests.hpp"
#include "support/point_sets.hpp"
#include "support/refinement_checks.hpp"
#include "support/triangulation_checks.hpp"

namespace lamina::test {
namespace {

/// Returns the border points, then the Steiner points.
std::vector<Point> all_points(const Border& border, const Refinement& r) {
    std::vector<Point> points = border.points;
    points.insert(points.end(), r.steiner_points.begin(), r.steiner_points.end());
    return points;
}

/// Checks all that refine() promises.
void expect_promises(const Border& border, const Refinement& r, const SizeField& size, const RefineOptions& options,
                     double area) {
    const auto points = all_points(border, r);
    expect_valid(points, r.triangles, border.segments);
    double covered = 0;
    std::size_t below = 0, oversized = 0;
    for (const Triangle& t : r.triangles) {
        const Point a = points[t.v[0].index()], b = points[t.v[1].index()], c = points[t.v[2].index()];
        const double triangle = 0.5 * cross(b - a, c - a);
        covered += triangle;
        below += smallest_angle_deg(points, t) < options.min_angle_deg - 1e-6;
        oversized += is_oversized(a, b, c, (size(a) + size(b) + size(c)) / 3, options.max_area_ratio);
    }
    EXPECT_NEAR(covered, area, 1e-9 * area);
    EXPECT_EQ(below, r.stats.below_bound);
    EXPECT_EQ(oversized, r.stats.oversized);
}

/// Returns a graded field with a single short edge at the origin.
SizeField graded(double min_size, double gradation, double extent) {
    const std::vector<SizeSource> sources{{{0, 0}, {min_size, 0}, min_size}};
    return SizeField(sources, {.gradation = gradation}, {{-extent, -extent}, {extent, extent}});
}

TEST(Refine, UniformSquareMeetsBounds) {
    for (double angle : {20.7, 28.0, 30.0}) {
        const double h = 0.02;
        const Border border = square_border(1, sizing::frozen_share * h);
        const SizeField size(h);
        const RefineOptions options{.min_angle_deg = angle};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1.0);
        EXPECT_EQ(r.stats.below_bound, 0u) << angle;
        EXPECT_EQ(r.stats.oversized, 0u) << angle;
        EXPECT_EQ(r.stats.refused, 0u) << angle;
        // The mesh is not finer than needed: the mean triangle is about as large as an equilateral one.
        EXPECT_LT(double(r.triangles.size()), 1.05 / (equilateral_area * h * h));
    }
}

TEST(Refine, GradedBorderMeetsBounds) {
    // A square whose border spacing follows h(x) = 0.001 + 0.2 |x|.
    const SizeField size = graded(1e-3, 0.2, 4);
    Border border;
    const std::vector<Point> corners{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int side = 0; side < 4; ++side) {
        const Point a = corners[side], b = corners[(side + 1) % 4];
        // The side is divided from its finer end, into lengths of 0.95 h, which are stretched to fit.
        const bool forward = size(a) <= size(b);
        const Point from = forward ? a : b, to = forward ? b : a;
        std::vector<double> cuts{0};
        while (cuts.back() < 1) cuts.push_back(cuts.back() + 0.95 * size(from + cuts.back() * (to - from)));
        const double stretch = 1 / cuts.back();
        std::vector<Point> line;
        for (double c : cuts) line.push_back(from + std::min(1.0, c * stretch) * (to - from));
        if (!forward) std::reverse(line.begin(), line.end());
        border.points.insert(border.points.end(), line.begin(), line.end() - 1);
    }
    border.close_loop();
    for (double angle : {20.7, 30.0}) {
        const RefineOptions options{.min_angle_deg = angle};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1.0);
        EXPECT_EQ(r.stats.below_bound, 0u) << angle;
        EXPECT_EQ(r.stats.oversized, 0u) << angle;
    }
}

/// Returns the mean of the smallest angles, in degrees.
double mean_smallest_angle(const Border& border, const Refinement& r) {
    const auto points = all_points(border, r);
    double sum = 0;
    for (const Triangle& t : r.triangles) sum += smallest_angle_deg(points, t);
    return sum / double(r.triangles.size());
}

/// Returns points between u and v that divide the integral of ds / h into equal shares of at most frozen_share.
std::vector<Point> graded_points(Point u, Point v, const SizeField& size) {
    constexpr std::size_t steps = 20'000;
    const auto at = [&](std::size_t i) { return u + (static_cast<double>(i) / steps) * (v - u); };
    std::vector<double> integral{0};
    for (std::size_t i = 0; i < steps; ++i)
        integral.push_back(integral.back() + distance(u, v) / steps / size(midpoint(at(i), at(i + 1))));
    const auto n = static_cast<std::size_t>(std::ceil(integral.back() / sizing::frozen_share));
    std::vector<Point> points;
    for (std::size_t k = 1, i = 0; k < n; ++k) {
        while (integral[i] < integral.back() * static_cast<double>(k) / static_cast<double>(n)) ++i;
        points.push_back(at(i));
    }
    return points;
}

/// Returns a polygon whose sides are divided as the size field demands.
Border graded_border(const std::vector<Point>& corners, const SizeField& size) {
    Border border;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        border.points.push_back(corners[i]);
        for (Point p : graded_points(corners[i], corners[(i + 1) % corners.size()], size)) border.points.push_back(p);
    }
    border.close_loop();
    return border;
}

double enclosed_area(const Border& border) {
    double area = 0;
    for (const Segment& s : border.segments)
        area += 0.5 * cross(border.points[s.a.index()], border.points[s.b.index()]);
    return area;
}

/// Returns the mean over all edges of their length, divided by h at their middle; edges of two triangles count twice.
double mean_edge_over_size(const Border& border, const Refinement& r, const SizeField& size) {
    const auto points = all_points(border, r);
    double sum = 0;
    for (const Triangle& t : r.triangles) {
        for (int e = 0; e < 3; ++e) {
            const Point a = points[t.v[e].index()], b = points[t.v[(e + 1) % 3].index()];
            sum += distance(a, b) / size(midpoint(a, b));
        }
    }
    return sum / double(3 * r.triangles.size());
}

/// Returns the share of Steiner points with six neighbours.
double share_with_six_neighbours(const Border& border, const Refinement& r) {
    std::vector<int> triangles(border.points.size() + r.steiner_points.size(), 0);
    for (const Triangle& t : r.triangles)
        for (const VertexId v : t.v) ++triangles[v.index()];
    const auto six = std::count(triangles.begin() + std::ptrdiff_t(border.points.size()), triangles.end(), 6);
    return double(six) / double(r.steiner_points.size());
}

/// Returns the share of triangles with an angle below this one.
double share_below(const Border& border, const Refinement& r, double degrees) {
    const auto points = all_points(border, r);
    const auto below = std::count_if(r.triangles.begin(), r.triangles.end(),
                                     [&](const Triangle& t) { return smallest_angle_deg(points, t) < degrees; });
    return double(below) / double(r.triangles.size());
}

TEST(Refine, GradedTrianglesAreNearlyEquilateral) {
    // Another frontal mesher, JIGSAW, reaches mean angles of 56.9, 55.5 and 54.1 degrees.
    struct Aim {
        double gradation, mean_angle, smallest_angle;
    };
    for (const auto& [gradation, mean_angle, smallest_angle] :
         {Aim{0.02, 57.5, 36}, Aim{0.05, 56.5, 36}, Aim{0.1, 55.5, 36}}) {
        SCOPED_TRACE(gradation);
        const std::vector<SizeSource> corner{{{0, 0}, {0, 0}, 1e-3}};
        const SizeField size(corner, {.gradation = gradation}, {{0, 0}, {1, 1}});
        const Border border = graded_border({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, size);
        const RefineOptions options{.lattice = false};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1.0);
        EXPECT_EQ(r.stats.refused, 0u);
        EXPECT_GT(mean_smallest_angle(border, r), mean_angle);
        EXPECT_GT(smallest_angle_deg(all_points(border, r), r.triangles), smallest_angle);
        EXPECT_LT(share_below(border, r, 40), 0.003);
        EXPECT_NEAR(mean_edge_over_size(border, r, size), 1, 0.03);
        EXPECT_GT(share_with_six_neighbours(border, r), 0.9);
    }
}

TEST(Refine, SmoothingImprovesTriangles) {
    const SizeField size = graded(2e-3, 0.1, 4);
    const Border border = graded_border({{0, 0}, {1, 0}, {0.8, 1}, {0.4, 0.7}, {0, 1}}, size);
    double worst = 0, mean = 0;
    for (unsigned smoothing : {0u, 1u, 2u, 12u}) {
        SCOPED_TRACE(smoothing);
        const RefineOptions options{.smoothing = smoothing, .lattice = false};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, enclosed_area(border));
        EXPECT_GE(smallest_angle_deg(all_points(border, r), r.triangles), worst);
        EXPECT_GT(mean_smallest_angle(border, r), mean);
        worst = smallest_angle_deg(all_points(border, r), r.triangles) - 1;
        mean = mean_smallest_angle(border, r);
    }
}

/// Returns the mean over all triangles of their mean ratio.
double mean_of_mean_ratios(const Border& border, const Refinement& r) {
    const auto points = all_points(border, r);
    double sum = 0;
    for (const Triangle& t : r.triangles)
        sum +=
            core::measure_triangle(points[t.v[0].index()], points[t.v[1].index()], points[t.v[2].index()]).mean_ratio;
    return sum / double(r.triangles.size());
}

TEST(Refine, RegularizedTrianglesAreTheMostRegular) {
    // No mesh could have a mean ratio of much more than 1 - gradation^2 / 6, that of a regular lattice under the
    // conformal map exp(gradation w).
    struct Case {
        double gradation, min_size, max_size;
    };
    for (const auto& [gradation, min_size, max_size] :
         {Case{0, 0.02, 0.02}, Case{0.02, 4e-3, 1}, Case{0.05, 2e-3, 1}, Case{0.1, 5e-4, 1}}) {
        SCOPED_TRACE(gradation);
        const std::vector<SizeSource> corner{{{0, 0}, {0, 0}, min_size}};
        const SizeField size(corner, {.gradation = gradation, .max_size = max_size}, {{0, 0}, {1, 1}});
        const Border border = graded_border({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, size);
        const RefineOptions smoothed_options{.smoothing = 20, .lattice = false}, options{.regularize = true};
        const Refinement smoothed = refine(border.points, border.segments, size, smoothed_options);
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1.0);
        EXPECT_EQ(r.stats.refused, 0u);
        EXPECT_GT(mean_of_mean_ratios(border, r), 0.9955);
        EXPECT_GT(mean_of_mean_ratios(border, r), mean_of_mean_ratios(border, smoothed));
        EXPECT_GT(smallest_angle_deg(all_points(border, r), r.triangles), 38);
        EXPECT_NEAR(mean_edge_over_size(border, r, size), 1, 0.03);
        EXPECT_LT(1 - share_with_six_neighbours(border, r), 0.7 * (1 - share_with_six_neighbours(border, smoothed)));
    }
}

TEST(Refine, RegularizationKeepsEveryPromise) {
    const SizeField size = graded(4e-3, 0.15, 4);
    const std::vector<Point> notched{{0, 0}, {2, 0}, {2, 0.05}, {1.2, 0.06}, {1.2, 1}, {1.02, 0.1}, {1, 1}, {0, 1}};
    Border with_hole = graded_border(notched, size);
    with_hole.add_loop({{0.3, 0.3}, {0.35, 0.7}, {0.7, 0.75}, {0.6, 0.3}}, 0.02);
    for (const Border& border : {with_hole, graded_border({{0, 0}, {1, 0}, {0.9, 0.3}}, size)}) {
        for (const double angle : {0.0, 20.7, 30.0})
            for (const unsigned smoothing : {0u, 2u}) {
                SCOPED_TRACE(testing::Message() << angle << " degrees, smoothing " << smoothing);
                RefineOptions options{.min_angle_deg = angle, .smoothing = smoothing, .lattice = false};
                const Refinement before = refine(border.points, border.segments, size, options);
                options.regularize = true;
                const Refinement r = refine(border.points, border.segments, size, options);
                expect_promises(border, r, size, options, enclosed_area(border));
                EXPECT_GT(mean_of_mean_ratios(border, r), mean_of_mean_ratios(border, before));
                EXPECT_LE(r.stats.below_bound, before.stats.below_bound);
                EXPECT_EQ(refine(border.points, border.segments, size, options).steiner_points, r.steiner_points);
            }
    }
}

TEST(Refine, RegularizationOfRandomPolygons) {
    for (std::uint64_t seed = 1; seed <= 25; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        std::vector<Point> corners;
        const double corner_count = 3 + std::floor(random.real(0, 6));
        for (double k = 0; k < corner_count; ++k) {
            const double angle = 2 * M_PI * (k + random.real(0, 0.8)) / corner_count, radius = random.real(0.3, 1);
            corners.push_back(radius * Point{std::cos(angle), std::sin(angle)});
        }
        const SizeField size = graded(random.real(0.005, 0.05), random.real(0, 0.4), 4);
        const Border border = graded_border(corners, size);
        if (enclosed_area(border) < 0.05) continue;
        const RefineOptions options{.min_angle_deg = 25, .regularize = true};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, enclosed_area(border));
    }
}

TEST(Refine, RegularizationKeepsTheLimitOfPoints) {
    const SizeField size = graded(2e-3, 0.1, 4);
    const Border border = graded_border({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, size);
    const std::size_t without = refine(border.points, border.segments, size).steiner_points.size();
    for (const std::size_t limit : {without / 2, without, without + 1}) {
        const RefineOptions options{.max_points = limit, .stop_at_max_points = true, .regularize = true};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1);
        EXPECT_LE(r.steiner_points.size(), limit);
    }
}

TEST(Refine, ATighterBoundOfAreasIsKept) {
    const SizeField size = graded(5e-3, 0.05, 4);
    const Border border = graded_border({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, size);
    for (double ratio : {1.1, 1.3}) {
        const RefineOptions options{.max_area_ratio = ratio};
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1.0);
        EXPECT_LE(double(r.stats.oversized), 1e-3 * double(r.triangles.size()));
    }
}

TEST(Refine, LatticePatchesKeepEveryPromise) {
    for (double angle : {20.7, 30.0}) {
        const double h = 0.008;
        const Border border = square_border(1, sizing::frozen_share * h);
        const SizeField size(h);
        const RefineOptions with_lattice{.min_angle_deg = angle},
            without_lattice{.min_angle_deg = angle, .lattice = false};
        const Refinement r = refine(border.points, border.segments, size, with_lattice);
        expect_promises(border, r, size, with_lattice, 1.0);
        EXPECT_EQ(r.stats.below_bound, 0u);
        EXPECT_EQ(r.stats.oversized, 0u);
        EXPECT_EQ(r.stats.refused, 0u);
        EXPECT_GT(mean_smallest_angle(border, r), 57);
        const Refinement pure = refine(border.points, border.segments, size, without_lattice);
        expect_promises(border, pure, size, without_lattice, 1.0);
        EXPECT_LT(double(r.triangles.size()), double(pure.triangles.size()));
        EXPECT_GT(mean_smallest_angle(border, pure), 56);
    }
}

TEST(Refine, SeamsOfLatticePatchesAreSmoothed) {
    // The rows of patches are horizontal, so how patches and border meet depends on how the square is turned.
    struct Aim {
        double turn, smallest_angle;
    };
    for (const auto& [turn, smallest_angle] :
         {Aim{0, 35}, Aim{0.1, 35}, Aim{0.3, 32}, Aim{M_PI / 6, 35}, Aim{0.7, 35}}) {
        for (const double h : {0.0071, 0.0093, 0.0119, 0.015, 0.019}) {
            SCOPED_TRACE("turned by " + std::to_string(turn) + ", h = " + std::to_string(h));
            std::vector<Point> corners;
            for (int i = 0; i < 4; ++i) {
                const double angle = turn + i * M_PI / 2;
                corners.push_back({std::sqrt(0.5) * std::cos(angle), std::sqrt(0.5) * std::sin(angle)});
            }
            const SizeField size(h);
            const Border border = graded_border(corners, size);
            const RefineOptions options;
            const Refinement r = refine(border.points, border.segments, size, options);
            expect_promises(border, r, size, options, 1);
            EXPECT_EQ(r.stats.refused, 0u);
            EXPECT_GT(smallest_angle_deg(all_points(border, r), r.triangles), smallest_angle);
            EXPECT_LT(share_below(border, r, 40), 0.008);
            EXPECT_GT(mean_smallest_angle(border, r), 58);
            EXPECT_LT(r.triangles.size(),
                      refine(border.points, border.segments, size, {.lattice = false}).triangles.size());
        }
    }
}

TEST(Refine, LatticePatchesAreFoundInACornerOfASteepField) {
    // A thousandth of the region has one size and holds most of the triangles. Outside of it h doubles within ten
    // edges.
    const std::vector<SizeSource> sources{{.a = {-1, -1}, .b = {1, 1}, .size = 0.01, .shape = SizeSource::Shape::box}};
    const SizeField size(sources, {.gradation = 0.1}, {{-1, -1}, {31, 31}});
    const Border border = graded_border({{0, 0}, {31, 0}, {31, 31}, {0, 31}}, size);
    const RefineOptions with_lattice, without_lattice{.lattice = false};
    const Refinement r = refine(border.points, border.segments, size, with_lattice);
    expect_promises(border, r, size, with_lattice, enclosed_area(border));
    const Refinement pure = refine(border.points, border.segments, size, without_lattice);
    EXPECT_LT(double(r.triangles.size()), double(pure.triangles.size()));
    EXPECT_GT(mean_smallest_angle(border, r), mean_smallest_angle(border, pure));
}

TEST(Refine, LatticePatchesFitTheCommonestSize) {
    // A finer source inside does not make the lattice finer.
    const Border border = square_border(1, 0.01);
    const RefineOptions options;
    const double alone = double(refine(border.points, border.segments, SizeField(0.01), options).triangles.size());
    for (double fine : {0.0051, 0.0055, 0.006, 0.0065}) {
        const std::vector<SizeSource> sources{{{0.5, 0.5}, {0.5, 0.5}, fine}};
        const SizeField size(sources, {.gradation = 0.1, .max_size = 0.01}, {{0, 0}, {1, 1}});
        const Refinement r = refine(border.points, border.segments, size, options);
        expect_promises(border, r, size, options, 1);
        EXPECT_LT(double(r.triangles.size()), 1.05 * alone) << fine;
    }
}

TEST(Refine, LatticePatchesOfManyLevelsKeepEveryPromise) {
    // Sizes grow from a corner by a factor of 8, under one percent an edge.
    const std::vector<SizeSource> sources{{{-0.1, -0.2}, {-0.1, -0.2}, 1e-3}};
    const SizeField size(sources, {.gradation = 0.006}, {{-1, -1}, {2, 2}});
    const std::vector<Point> corners{{0, 0}, {0.9, -0.1}, {1.2, 0.8}, {0.3, 1}, {0.1, 0.5}};
    const Border border = graded_border(corners, size);
    const double area = enclosed_area(border);
    const RefineOptions with_lattice, without_lattice{.lattice = false};
    const Refinement r = refine(border.points, border.segments, size, with_lattice);
    expect_promises(border, r, size, with_lattice, area);
    EXPECT_EQ(r.stats.below_bound, 0u);
    EXPECT_EQ(r.stats.oversized, 0u);
    EXPECT_EQ(r.stats.refused, 0u);
    EXPECT_GT(mean_smallest_angle(border, r), 57);
    const Refinement pure = refine(border.points, border.segments, size, without_lattice);
    EXPECT_LT(double(r.triangles.size()), 1.05 * double(pure.triangles.size()));
}

TEST(Refine, LatticePatchesStayOutOfHolesNotchesAndThinParts) {
    const double h = 0.01;
    Border border;
    border.add_loop({{0, 0}, {2, 0}, {2, 0.05}, {1.2, 0.06}, {1.2, 1}, {1.02, 0.1}, {1, 1}, {0.5, 1.2}, {0, 1}},
                    sizing::frozen_share * h);
    border.add_loop({{0.3, 0.3}, {0.35, 0.7}, {0.7, 0.75}, {0.6, 0.3}}, sizing::frozen_share * h);
    const SizeField size(h);
    const RefineOptions options;
    const Refinement r = refine(border.points, border.segments, size, options);
    expect_promises(border, r, size, options, enclosed_area(border));
    // The tip of the needle leaves triangles below the bound, with patches as many as without.
    const Refinement pure = refine(border.points, border.segments, size, {.lattice = false});
    EXPECT_EQ(r.stats.below_bound, pure.stats.below_bound);
    EXPECT_GT(mean_smallest_angle(border, r), 52);
}

TEST(Refine, LatticePatchesOfRandomPolygons) {
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        Random random(seed);
        std::vector<Point> corners;
        const int n = 3 + int(random.below(9));
        for (int i = 0; i < n; ++i) {
            const double t = 2 * M_PI * (i + 0.5 * random.real()) / n, radius = random.real(0.4, 1);
            corners.push_back({radius * std::cos(t), radius * std::sin(t)});
        }
        const double h = random.real(0.008, 0.03);
        Border border;
        border.add_loop(corners, sizing::frozen_share * h);
        const SizeField size(h);
        const RefineOptions options;
        expect_promises(border, refine(border.points, border.segments, size, options), size, options,
                        enclosed_area(border));
    }
}

TEST(Refine, SameResultForSameArgumentsAndForAnyReserve) {
    const Border border = square_border(1, 0.025);
    const SizeField size(0.025);
    const Refinement a = refine(border.points, border.segments, size);
    const Refinement b = refine(border.points, border.segments, size, {.expected_triangles = 100000});
    EXPECT_EQ(a.steiner_points, b.steiner_points);
    EXPECT_EQ(a.triangles, b.triangles);
}

TEST(Refine, RegionWithHoleAndReflexCorners) {
    Border border;
    border.add_loop({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, 0.06);
    border.add_loop({{0.3, 0.3}, {0.3, 0.7}, {0.7, 0.7}, {0.7, 0.3}}, 0.06);
    const SizeField size(0.06);
    const RefineOptions options;
    const Refinement r = refine(border.points, border.segments, size, options);
    expect_promises(border, r, size, options, 5.0 - 0.16);
    EXPECT_EQ(r.stats.below_bound, 0u);
}

TEST(Refine, SmallInputAnglesTerminateAndStayConfined) {
    for (double degrees : {1.0, 5.0, 15.0, 40.0}) {
        Border border;
        const double a = degrees * M_PI / 180;
        border.add_loop({{0, 0}, {1, 0}, {std::cos(a), std::sin(a)}}, 0.02);
        const SizeField size(0.03);
        const Refinement r = refine(border.points, border.segments, size);
        expect_valid(all_points(border, r), r.triangles, border.segments);
    }
}

TEST(Refine, CoarseBorderIsNeverSplit) {
    // Border edges are fifty times longer than h. Points beside them would encroach and are refused; the mesh stays
    // valid.
    const Border border = square_border(1, 0.5);
    const SizeField size(0.01);
    const Refinement r = refine(border.points, border.segments, size);
    expect_valid(all_points(border, r), r.triangles, border.segments);
    EXPECT_GT(r.stats.refused, 0u);
}

TEST(Refine, StopsAtTheLimitOfPoints) {
    const Border border = square_border(1, 0.1);
    EXPECT_THROW(refine(border.points, border.segments, SizeField(0.001), {.max_points = 1000}), MeshError);
}

TEST(Refine, RandomConvexPolygons) {
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        Random random(seed);
        std::vector<Point> corners;
        const int n = 5 + int(random.below(8));
        for (int i = 0; i < n; ++i) {
            const double t = 2 * M_PI * (i + 0.6 * random.real()) / n;
            corners.push_back({std::cos(t), std::sin(t)});
        }
        const double h = random.real(0.02, 0.1);
        Border border;
        border.add_loop(corners, sizing::frozen_share * h);
        const SizeField size(h);
        const RefineOptions options;
        const Refinement r = refine(border.points, border.segments, size, options);
        double area = 0;
        for (int i = 0; i < n; ++i) area += 0.5 * cross(corners[i], corners[(i + 1) % n]);
        expect_promises(border, r, size, options, area);
        EXPECT_EQ(r.stats.below_bound, r.stats.exempt) << seed;
    }
}

}  // namespace
}  // namespace lamina::test
