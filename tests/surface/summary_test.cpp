// Summaries of elements, as numbers and as text.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/surface.hpp>

#include "geometry/trailing_edge.hpp"
#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"
#include "surface/summary.hpp"

namespace lamina {
namespace {

using surface::ElementSummary;
using surface::summarize;

ElementSummary summary_of(const shapes::Outline& outline) { return summarize(shapes::geometry({outline}).elements[0]); }

TEST(Summary, MeasuresKnownShapes) {
    const ElementSummary box = summary_of(shapes::box());
    EXPECT_EQ(box.chord, 1);
    EXPECT_EQ(box.area, 1);
    EXPECT_EQ(box.perimeter, 4);
    EXPECT_EQ(box.min_spacing, 1);
    EXPECT_EQ(box.max_spacing, 1);
    EXPECT_EQ(box.max_spacing_ratio, 1);
    EXPECT_NEAR(box.max_turning_deg, 90, 1e-12);
    EXPECT_EQ(box.sharp_corners, 4u);

    const ElementSummary l = summary_of(shapes::l_shape());
    EXPECT_EQ(l.area, 3);
    EXPECT_EQ(l.sharp_corners, 5u) << "the concave corner is none";
    EXPECT_EQ(l.max_spacing_ratio, 2);

    const ElementSummary wedge = summary_of(shapes::wedge());
    EXPECT_GT(wedge.max_turning_deg, 160);
    EXPECT_EQ(wedge.max_turning_at, (Point{0, 0}));
}

TEST(Summary, TellsABluntTrailingEdge) {
    EXPECT_TRUE(summary_of(shapes::section(0.12, 0.01, 40)).blunt_trailing_edge);
    EXPECT_TRUE(summary_of(shapes::plate(0.05, 20)).blunt_trailing_edge);
    EXPECT_FALSE(summary_of(shapes::section(0.12, 0, 40)).blunt_trailing_edge);
    EXPECT_FALSE(summary_of(shapes::circle(1, 60)).blunt_trailing_edge);
}

TEST(Summary, FindsTheTrailingEdge) {
    const auto trailing_edge = [](const shapes::Outline& outline) { return summary_of(outline).trailing_edge; };
    EXPECT_EQ(trailing_edge(shapes::section(0.12, 0, 40)), (Point{1, 0}));
    EXPECT_NEAR(distance(trailing_edge(shapes::section(0.12, 0.01, 40)), {1, 0}), 0, 1e-12);
    // The outline of so many points turns as little all round the nose as along a base.
    for (const std::size_t start : {0, 1, 5000}) {
        const auto fine = shapes::started_at(shapes::section(0.12, 0.01, 5000), start);
        OutlineFeatures features;
        geometry::find_trailing_edge(fine, features);
        ASSERT_TRUE(features.base);
        EXPECT_LT(fine[features.base->first].y, 0) << start;
        EXPECT_GT(fine[features.base->last].y, 0) << start;
    }
    EXPECT_EQ(trailing_edge(shapes::circle(1, 60)), (Point{1, 0}));
    EXPECT_EQ(trailing_edge(shapes::diamond()), (Point{1, 0}));
    // Of equally rearmost vertices of a smooth outline it is the lowest.
    EXPECT_EQ(trailing_edge({{1, -0.2},
                             {1, 0.2},
                             {0.9, 0.6},
                             {0.6, 0.9},
                             {0.2, 1},
                             {-0.2, 1},
                             {-0.6, 0.9},
                             {-0.9, 0.6},
                             {-1, 0.2},
                             {-1, -0.2},
                             {-0.9, -0.6},
                             {-0.6, -0.9},
                             {-0.2, -1},
                             {0.2, -1},
                             {0.6, -0.9},
                             {0.9, -0.6}}),
              (Point{1, -0.2}));
    // Sharp and blunt flaps are deflected and scaled.
    for (double base : {0.0, 0.01})
        for (double angle : {-1.0, -0.6, 0.3, 0.9}) {
            const Point turned{2 + 0.3 * std::cos(angle), 1 + 0.3 * std::sin(angle)};
            const auto flap = shapes::moved(shapes::section(0.12, base, 40), angle, 0.3, {2, 1});
            EXPECT_NEAR(distance(trailing_edge(flap), turned), 0, 1e-12) << base << ' ' << angle;
        }
}

TEST(Summary, ScalesWithTheBody) {
    const ElementSummary a = summary_of(shapes::section(0.12, 0.01, 40)),
                         b = summary_of(shapes::moved(shapes::section(0.12, 0.01, 40), 0, 8, {1, 2}));
    EXPECT_NEAR(b.perimeter, 8 * a.perimeter, 1e-12);
    EXPECT_NEAR(b.area, 64 * a.area, 1e-12);
    EXPECT_NEAR(b.max_turning_deg, a.max_turning_deg, 1e-9);
    EXPECT_EQ(b.sharp_corners, a.sharp_corners);
}

TEST(Describe, TellsMeasuresAndRepairs) {
    const std::string text = describe(fixtures::read(fixtures::clockwise));
    for (const char* part : {"airfoil", "sample.dat (selig)", "SAMPLE", "9 read, 8 in the outline", "chord",
                             "x 0 to 1, y -0.05 to 0.07", "clockwise order reversed", "closing point merged"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
    const std::vector<std::string> naca{"naca:0012:200"};
    EXPECT_NE(describe(read_geometry(naca)).find("200 generated"), std::string::npos);
}

TEST(Describe, ListsTransformations) {
    const std::vector<std::string> naca{"naca:0012:200"};
    GeometryOptions options;
    options.transformations = {parse_transformation("all:mirror"), parse_transformation("airfoil:scale:2"),
                               parse_transformation("airfoil:rotate:3")};
    const Geometry geometry = read_geometry(naca, options);
    const std::vector<std::string>& done = geometry.elements[0].transformations;
    ASSERT_EQ(done.size(), 3u);
    EXPECT_NE(describe(geometry).find("  transformed    " + done[0] + "\n                 " + done[1] +
                                      "\n                 " + done[2] + "\n"),
              std::string::npos)
        << describe(geometry);
}

}  // namespace
}  // namespace lamina
