// Size sources (wakes, boxes, circles and lines) near walls and far from them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include <lamina/error.hpp>

#include "pipeline/cases.hpp"
#include "sizing/requests.hpp"
#include "support/refinement_checks.hpp"

namespace lamina::test {
namespace {

/// Returns the size that the sources request at p.
double requested_size(const std::vector<SizeSource>& sources, double gradation, Point p) {
    double size = HUGE_VAL;
    for (const SizeSource& s : sources) size = std::min(size, s.size + gradation * distance_to(s, p));
    return size;
}

/// Expects that no triangle is larger than the sources allow, and no edge of the layer's border too long to be frozen.
void expect_sizes(const MeshResult& result, const std::vector<SizeSource>& sources, double gradation) {
    const auto& points = result.mesh.points;
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
        if (result.mesh.region[t] != Region::isotropic) continue;
        const auto& v = result.mesh.triangles[t].v;
        const Point a = points[v[0].index()], b = points[v[1].index()], c = points[v[2].index()];
        double h = 0;
        for (Point p : {a, b, c}) h += requested_size(sources, gradation, p) / 3;
        h *= 1 + SizeField::relative_error;
        ASSERT_FALSE(is_oversized(a, b, c, h, RefineOptions{}.max_area_ratio)) << a.x << ' ' << a.y;
    }
    for (const Segment& edge : result.mesh.constraints) {
        const Point a = points[edge.a.index()], b = points[edge.b.index()];
        ASSERT_LE(distance(a, b), 1.02 * sizing::frozen_share * requested_size(sources, gradation, midpoint(a, b)));
    }
}

SizeSource box(Point lower, Point upper, double size) {
    return {.a = lower, .b = upper, .size = size, .shape = SizeSource::Shape::box};
}
SizeSource circle(Point center, double radius, double size) {
    return {.a = center, .b = center, .size = size, .radius = radius};
}

std::size_t isotropic_triangles_in(const Mesh& mesh, const Box& window) {
    std::size_t count = 0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        const auto& v = mesh.triangles[t].v;
        count += mesh.region[t] == Region::isotropic && window.contains(mesh.points[v[0].index()]) &&
                 window.contains(mesh.points[v[1].index()]) && window.contains(mesh.points[v[2].index()]);
    }
    return count;
}

TEST(SizeSources, AreHonouredNearWallsAndFarFromThem) {
    const std::vector<std::vector<SizeSource>> cases{
        {box({0.2, 0.02}, {0.8, 0.5}, 0.004)},                    // a wall runs through it
        {box({-0.1, -0.2}, {1.1, 0.2}, 0.01)},                    // all of the section
        {circle({1, 0}, 0.05, 5e-4)},                             // the trailing edge
        {circle({-3, 2}, 1, 0.03), box({4, -8}, {9, -7}, 0.05)},  // outside the near-body box, at the far field
        {{.a = {0, -0.2}, .b = {1.2, -0.05}, .size = 0.002}},     // oblique, close to the border
        {{.a = {-20, 5}, .b = {20, 5}, .size = 0.05}},            // beyond the far field on both sides
        {box({0.4, -0.01}, {0.5, 0.01}, 0.001), circle({0, 0}, 0.02, 0.0005)},  // inside the body
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        SCOPED_TRACE(i);
        CaseOptions options = quick_options();
        options.sizing.sources = cases[i];
        options.decoupling.pieces_target = i % 2 == 0 ? 50'000 : 3'000;
        const MeshResult result = mesh_of({naca("2412")}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        expect_sizes(result, cases[i], options.sizing.gradation);
        EXPECT_LT(result.check.isotropic.p999_neighbour_area_ratio, 3);
    }
}

TEST(SizeSources, FillTheirAreaAndNoMore) {
    CaseOptions options = quick_options();
    const Box window{{1.5, -0.5}, {2.5, 0.5}};
    const double h = 0.01;
    options.sizing.sources = {box(window.lower, window.upper, h)};
    const MeshResult result = mesh_of({naca("0012")}, options);
    expect_sound(result, options);
    // A lattice with edges of 1.02 h, and edges of h along its borders.
    const double expected = 1 / (1.02 * equilateral_area * h * h);
    EXPECT_NEAR(double(isotropic_triangles_in(result.mesh, window)), expected, 0.08 * expected);
}

TEST(SizeSources, WithoutLayersTheWallIsDivided) {
    CaseOptions options = quick_options();
    options.layer.enabled = false;
    options.sizing.sources = {circle({0.5, 0}, 0.1, 0.003)};
    const MeshResult result = mesh_of({naca("0012")}, options);
    expect_sound(result, options);
    expect_nothing_left_over(result);
    expect_sizes(result, options.sizing.sources, options.sizing.gradation);
}

/// Expects that the options are refused at once with a message that contains `said`; a run would never end.
void expect_refused(const CaseOptions& options, const std::string& said) {
    try {
        mesh_of({naca("0012")}, options);
        ADD_FAILURE() << "accepted: " << said;
    } catch (const UsageError& error) {
        EXPECT_NE(std::string(error.what()).find(said), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("triangles"), std::string::npos) << error.what();
    }
}

TEST(Sizes, TooSmallForAnyMeshAreRefusedByName) {
    const auto with = [](auto set) {
        CaseOptions options = quick_options();
        set(options);
        return options;
    };
    expect_refused(with([](CaseOptions& o) { o.sizing.far_size = 1e-5; }), "far_size: 1e-05");
    expect_refused(with([](CaseOptions& o) { o.sizing.wall_size = 1e-10; }), "wall_size: 1e-10");
    expect_refused(with([](CaseOptions& o) {
                       o.sizing.sources = {circle({3, 0}, 1, 1e-6)};
                   }),
                   "refine: circle:3,0,1,1e-06");
    expect_refused(with([](CaseOptions& o) { o.sizing.sources = {box({-10, -1}, {-9, 1}, 1e-6)}; }), "refine");
    expect_refused(with([](CaseOptions& o) {
                       o.sizing.sources = {{.a = {2, 0}, .b = {30, 0}, .size = 1e-9}};
                   }),
                   "refine");
    expect_refused(with([](CaseOptions& o) {
                       o.sizing.gradation = 1e-6;
                       o.sizing.wakes = {WakeOptions{.angle_deg = 0, .length = 5, .size = 1e-9}};
                   }),
                   "wake: 0:5:1e-09");
    expect_refused(with([](CaseOptions& o) {
                       o.sizing.gradation = 1e-9;
                       o.far_field.size = 500;
                   }),
                   "gradation: 1e-09");
    // Sources outside the far field have no effect.
    EXPECT_NO_THROW(mesh_of({naca("0012")}, with([](CaseOptions& o) {
                                o.sizing.sources = {circle({30, 0}, 1, 1e-6)};
                            })));
}

TEST(Wake, MakesSmallTrianglesAlongItsLine) {
    for (double angle : {0.0, 20.0, -35.0}) {
        SCOPED_TRACE(angle);
        CaseOptions options = quick_options();
        const Point along{std::cos(angle * M_PI / 180), std::sin(angle * M_PI / 180)};
        options.sizing.wakes = {WakeOptions{.angle_deg = angle, .length = 3, .size = 0.004}};
        const MeshResult result = mesh_of({naca("0012")}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        std::vector<SizeSource> line;
        for (int i = 0; i < 300; ++i) {
            const double at = 0.01 * i, size = 1.05 * (0.004 + 0.1 * options.sizing.gradation * (at + 0.01));
            line.push_back({.a = Point{1, 0} + at * along, .b = Point{1, 0} + (at + 0.01) * along, .size = size});
        }
        expect_sizes(result, line, options.sizing.gradation);
    }
}

TEST(Wake, SeveralLinesAddUp) {
    const auto triangles_with = [](std::vector<WakeOptions> wakes, const Box& window) {
        CaseOptions options = quick_options();
        options.sizing.wakes = std::move(wakes);
        const MeshResult result = mesh_of({naca("0012")}, options);
        expect_sound(result, options);
        return double(isotropic_triangles_in(result.mesh, window));
    };
    const Box above{{2, 0.5}, {2.5, 1}}, below{{2, -1}, {2.5, -0.5}};
    const WakeOptions up{.angle_deg = 30, .length = 3}, down{.angle_deg = -30, .length = 3, .size = 0.004};
    const double of_up = triangles_with({up}, above), of_down = triangles_with({down}, below);
    EXPECT_GT(of_up, 3 * triangles_with({down}, above));
    for (const std::vector<WakeOptions>& both : {std::vector<WakeOptions>{up, down}, {down, up}}) {
        EXPECT_NEAR(triangles_with(both, above), of_up, 0.1 * of_up);
        EXPECT_NEAR(triangles_with(both, below), of_down, 0.1 * of_down);
    }
}

TEST(Wake, StartsWithTheSizeOfTheBorderUnlessToldOtherwise) {
    CaseOptions options = quick_options();
    const shapes::Outline blunt = naca("4412", 101, TrailingEdge::blunt);
    const MeshResult without = mesh_of({blunt}, options);
    options.sizing.wakes = {WakeOptions{.angle_deg = 5}};
    const MeshResult with = mesh_of({blunt}, options);
    expect_sound(with, options);
    expect_nothing_left_over(with);
    // The layer's border is divided no further than before, but near the wake.
    EXPECT_LT(with.mesh.constraints.size(), 1.02 * double(without.mesh.constraints.size()));
    const Box window{{1.5, 0}, {2.5, 0.2}};
    EXPECT_GT(isotropic_triangles_in(with.mesh, window), 20 * isotropic_triangles_in(without.mesh, window));
    const Box before{{-3, -2}, {-0.2, 2}};
    const auto expected = double(isotropic_triangles_in(without.mesh, before));
    EXPECT_NEAR(double(isotropic_triangles_in(with.mesh, before)), expected, 0.02 * expected);
}

TEST(Wake, EndsAtTheNextBody) {
    const shapes::Outline flap = shapes::moved(naca("0012", 80), -0.5, 0.3, {1.05, -0.03});
    for (const std::optional<double> size : {std::optional<double>{}, std::optional<double>{0.002}}) {
        CaseOptions options = quick_options();
        options.sizing.wakes = {WakeOptions{.angle_deg = -10, .size = size}};
        const MeshResult result = mesh_of({naca("0012"), flap}, options);
        expect_sound(result, options);
        expect_nothing_left_over(result);
        // Behind the flap there is only the wake of the flap, which starts lower.
        EXPECT_GT(isotropic_triangles_in(result.mesh, {{2, -0.4}, {2.5, -0.25}}),
                  1.5 * isotropic_triangles_in(result.mesh, {{2, -0.25}, {2.5, -0.1}}));
    }
}

}  // namespace
}  // namespace lamina::test
