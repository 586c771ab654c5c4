// Trailing edges that options open, close or continue.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"

namespace lamina {
namespace {

Geometry shaped(Element element, const GeometryOptions& options) {
    return make_geometry({std::move(element)}, options);
}

GeometryOptions opened(double gap, double distance = 1) {
    GeometryOptions options;
    options.open_te = TrailingEdgeGap{gap, distance};
    return options;
}

GeometryOptions sharpened(TailSharpening way) {
    GeometryOptions options;
    options.sharpen_te = way;
    return options;
}

/// Returns the height of a section at one of the abscissae of its points.
double thickness_at(const Element& e, double x) {
    double upper = -1, lower = 1;
    for (const Point p : e.points) {
        if (std::abs(p.x - x) > 1e-9) continue;
        upper = std::max(upper, p.y);
        lower = std::min(lower, p.y);
    }
    return upper - lower;
}

TEST(TailShape, AGapIsWedgeShapedByDefault) {
    const Element given = naca_airfoil("0012", 200);
    for (const double gap : {0.0005, 0.01, 0.05}) {
        const Element e = shaped(given, opened(gap)).elements[0];
        EXPECT_NEAR(thickness_at(e, 1), gap, 1e-12);
        for (const Point p : given.points) {
            if (p.x == 0) continue;
            EXPECT_NEAR(thickness_at(e, p.x), thickness_at(given, p.x) + gap * p.x, 1e-12);
        }
        ASSERT_EQ(e.transformations.size(), 1u);
        EXPECT_EQ(e.points.size(), e.lines.size());
    }
}

TEST(TailShape, AGapFadesOverItsDistance) {
    const Element given = naca_airfoil("2412", 200);
    const auto added = [&](double distance, double x) {
        const Element e = shaped(given, opened(0.01, distance)).elements[0];
        double largest = 0;
        for (std::size_t i = 0; i < given.points.size(); ++i)
            if (std::abs(given.points[i].x - x) < 0.02)
                for (const Point q : e.points)
                    if (q.x > given.points[i].x - 1e-3 && q.x < given.points[i].x + 1e-3)
                        largest = std::max(largest, std::abs(q.y) - std::abs(given.points[i].y));
        return largest;
    };
    EXPECT_GT(added(1, 0.5), added(0.5, 0.5));
    EXPECT_GT(added(0.5, 0.5), added(0.1, 0.5));
    // XFOIL's law: x exp(-(1 - x)(1 / distance - 1)) of half the change.
    const Element e = shaped(naca_airfoil("0012", 200), opened(0.01, 0.25)).elements[0];
    const Element plain = naca_airfoil("0012", 200);
    for (const Point p : plain.points) {
        if (p.x == 0) continue;
        EXPECT_NEAR(thickness_at(e, p.x) - thickness_at(plain, p.x), 0.01 * p.x * std::exp(-3 * (1 - p.x)), 1e-12);
    }
    // The trailing edge alone.
    const Element tail = shaped(plain, opened(0.01, 0)).elements[0];
    EXPECT_NEAR(thickness_at(tail, 1), 0.01, 1e-12);
    EXPECT_NEAR(thickness_at(tail, plain.points[5].x), thickness_at(plain, plain.points[5].x), 1e-8);
}

TEST(TailShape, ABaseBecomesSharp) {
    const Element blunt = naca_airfoil("0012", 201, TrailingEdge::blunt);
    const Element blended = shaped(blunt, sharpened(TailSharpening::blend)).elements[0];
    EXPECT_EQ(thickness_at(blended, 1), 0);
    EXPECT_EQ(std::count(blended.points.begin(), blended.points.end(), Point{1, 0}), 1);
    const Element extended = shaped(blunt, sharpened(TailSharpening::extend)).elements[0];
    const Box box = bounding_box(Geometry{{extended}});
    // The published thickness vanishes at 1.0089; its tangents meet before that.
    EXPECT_GT(box.upper.x, 1.005);
    EXPECT_LT(box.upper.x, 1.0095);
    EXPECT_NEAR(thickness_at(extended, blunt.points[20].x), thickness_at(blunt, blunt.points[20].x), 1e-12);
}

TEST(TailShape, SharpOnesStaySharp) {
    const Element given = naca_airfoil("0012", 100);
    EXPECT_EQ(shaped(given, sharpened(TailSharpening::extend)).elements[0].points, given.points);
    EXPECT_EQ(shaped(given, opened(0)).elements[0].points.size(), given.points.size());
}

TEST(TailShape, CornersStayCorners) {
    const Geometry given = read_geometry(std::vector<std::string>{"naca:4412"});
    const Geometry open = read_geometry(std::vector<std::string>{"naca:4412"}, opened(0.01));
    ASSERT_EQ(open.elements[0].given_corners.size(), given.elements[0].given_corners.size());
    for (std::size_t k = 0; k < given.elements[0].given_corners.size(); ++k)
        EXPECT_NEAR(given.elements[0].points[given.elements[0].given_corners[k]].x,
                    open.elements[0].points[open.elements[0].given_corners[k]].x, 1e-3);
}

TEST(TailShape, FilesAndTransformationsFollow) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> inputs{folder.write("blunt.dat", fixtures::open_base).string()};
    GeometryOptions options = opened(0.004);
    options.transformations = {{"all", Scaling{2}}};
    const Element e = read_geometry(inputs, options).elements[0];
    EXPECT_NEAR(thickness_at(e, 2), 0.008, 1e-9);
    EXPECT_EQ(e.transformations.size(), 2u);
}

// The blunt end of a pod is a base, but not the trailing edge.
TEST(TailShape, ASharpTailBehindABluntPodOpens) {
    const std::vector<Point> given{{1, 0},      {0.5, 0.1},   {0, 0},       {0.3, -0.2},
                                   {0.8, -0.2}, {0.8, -0.12}, {0.6, -0.12}, {0.6, -0.05}};
    const Element e = shaped(element_of_points(given, "pod"), opened(0.01)).elements[0];
    EXPECT_NEAR(thickness_at(e, 1), 0.01, 1e-12);
    EXPECT_EQ(std::count(e.points.begin(), e.points.end(), Point{0, 0}), 1);
}

TEST(TailShape, Refusals) {
    std::vector<Point> round;
    for (int i = 0; i < 60; ++i) round.push_back({std::cos(0.1047 * i), 0.3 * std::sin(0.1047 * i)});
    const auto message = [](const std::vector<Point>& points, const GeometryOptions& options) -> std::string {
        try {
            make_geometry({element_of_points(points, "body")}, options);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_NE(message(round, opened(0.01)).find("it has no trailing edge to change"), std::string::npos);
    EXPECT_NE(message(round, sharpened(TailSharpening::blend)).find("airfoil"), std::string::npos);
    const std::vector<Point> plate{{1, -0.05}, {1, 0.05}, {0, 0.05}, {-0.05, 0}, {0, -0.05}};
    EXPECT_NE(message(plate, sharpened(TailSharpening::extend)).find("give --sharpen-te blend"), std::string::npos);
    EXPECT_EQ(message(plate, sharpened(TailSharpening::blend)), "accepted");
    EXPECT_THROW(validate(opened(-1)), OptionError);
    EXPECT_THROW(validate(opened(0.01, 2)), OptionError);
    GeometryOptions both = opened(0.01);
    both.sharpen_te = TailSharpening::blend;
    EXPECT_THROW(validate(both), OptionError);
}

}  // namespace
}  // namespace lamina
