// Bodies without thickness (GeometryOptions::sheets) as outlines, and on the walls of others.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/surface.hpp>

#include "geometry/sheet_curve.hpp"
#include "geometry/sheets.hpp"

namespace lamina {
namespace {

Geometry with(const std::vector<std::string>& inputs, std::vector<Sheet> sheets, GeometryOptions options = {}) {
    options.sheets = std::move(sheets);
    return read_geometry(inputs, options);
}

std::string refusal_of(const std::vector<std::string>& inputs, std::vector<Sheet> sheets) {
    try {
        with(inputs, std::move(sheets));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

/// Expects that both sides of all sheets have the same vertices but for the gap.
void expect_sides_alike(const Geometry& geometry) {
    for (const Element& element : geometry.elements)
        for (const geometry::SheetRange& range : geometry::sheet_ranges(element)) {
            const std::size_t n = element.points.size(), edges = range.tip - range.first;
            ASSERT_EQ(range.last - range.tip, edges) << element.name;
            for (std::size_t k = 0; k <= edges; ++k) {
                const Point there = element.points[(range.first + k) % n], back = element.points[(range.last - k) % n];
                EXPECT_LT(distance(there, back), 20 * geometry::sheet_gap(element.points)) << element.name;
            }
        }
}

std::vector<Point> random_curve(std::mt19937& random, Point from, double length) {
    const auto uniform = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
    const std::size_t edges = std::uniform_int_distribution<std::size_t>(1, 20)(random);
    double angle = uniform(-3, 3);
    const double turning = uniform(-1, 1) * 2 / static_cast<double>(edges);
    std::vector<Point> points{from};
    for (std::size_t i = 0; i < edges; ++i, angle += turning)
        points.push_back(points.back() + length / static_cast<double>(edges) * Point{std::cos(angle), std::sin(angle)});
    return points;
}

TEST(Sheets, RunThereAndBack) {
    const std::vector<Point> curve{{0, 0}, {0.5, 0.1}, {1, 0}};
    const Geometry geometry = with({}, {{"sail", curve}});
    ASSERT_EQ(geometry.elements.size(), 1u);
    const Element& sail = geometry.elements[0];
    EXPECT_EQ(sail.name, "sail");
    EXPECT_TRUE(geometry::is_sheet(sail));
    EXPECT_TRUE(std::equal(curve.begin(), curve.end(), sail.points.begin()));
    expect_sides_alike(geometry);
    EXPECT_EQ(reference_box(geometry).width(), 1);
    const Geometry prepared = prepare_surfaces(geometry);
    EXPECT_GT(prepared.elements[0].points.size(), 100u);
    EXPECT_EQ(prepared.elements[0].features.trailing_edge, (Point{1, 0}));
    expect_sides_alike(prepared);
    EXPECT_NO_THROW(check_simple(prepared));
}

TEST(Sheets, StandOnWallsThatTheyEndAt) {
    // From inside, a little beside the wall, and from the trailing edge itself; either end may be the foot.
    for (const std::vector<Point>& curve : {std::vector<Point>{{0.5, 0}, {0.5, 0.2}},
                                            {{0.5, 0.0531}, {0.5, 0.2}},
                                            {{1, -0.01}, {1, 0}},
                                            {{1, 0}, {0.98, -0.015}}}) {
        const Geometry geometry = with({"naca:0012"}, {{"strip", curve}});
        ASSERT_EQ(geometry.elements.size(), 1u);
        const Element& wing = geometry.elements[0];
        ASSERT_EQ(wing.sheets.size(), 1u);
        const SheetSides& strip = wing.sheets[0];
        EXPECT_FALSE(geometry::is_sheet(wing));
        ASSERT_EQ(wing.parts.size(), 2u);
        EXPECT_NEAR(distance(strip.begin, strip.end), geometry::sheet_gap(curve), 1e-12);
        EXPECT_TRUE(strip.tip == curve.front() || strip.tip == curve.back());
        const Geometry prepared = prepare_surfaces(geometry);
        expect_sides_alike(prepared);
        EXPECT_NO_THROW(check_simple(prepared));
    }
}

TEST(Sheets, AreTransformedBeforeTheyAreWalls) {
    const std::vector<Transformation> mirror{{"all", Mirroring{}}}, turn{{"sail", Rotation{90, {}}}};
    const Geometry mirrored = with({"naca:0012"}, {{"strip", {{0.5, 0}, {0.5, 0.2}}}}, {.transformations = mirror});
    EXPECT_EQ(mirrored.elements[0].sheets.at(0).tip, (Point{0.5, -0.2}));
    const Geometry turned = with({}, {{"sail", {{0, 0}, {1, 0}}}}, {.transformations = turn});
    EXPECT_EQ(turned.elements[0].sheets.at(0).tip, (Point{0, 1}));
    // Outlines that are mirrored as such run the other way.
    const Geometry folded = transformed(with({}, {{"sail", {{0, 0}, {0.4, 0.3}, {1, 0}}}}), mirror);
    EXPECT_NO_THROW(check_simple(folded));
    expect_sides_alike(folded);
}

TEST(Sheets, RandomOnesHaveSidesThatAreAlike) {
    std::mt19937 random(5);
    int made = 0;
    for (int trial = 0; trial < 60; ++trial) {
        const std::string input = trial % 3 == 0 ? "naca:2412" : "naca:0012:blunt";
        const Point from{std::uniform_real_distribution<double>(-0.5, 1.5)(random), 0.02};
        const Sheet sheet{"sheet", random_curve(random, from, trial % 2 == 0 ? 0.4 : 0.03)};
        try {
            const Geometry geometry = with({input}, {sheet});
            expect_sides_alike(geometry);
            const Geometry prepared = prepare_surfaces(geometry);
            expect_sides_alike(prepared);
            EXPECT_NO_THROW(check_simple(prepared)) << trial;
            ++made;
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("sheet"), std::string::npos) << error.what();
        }
    }
    EXPECT_GT(made, 30);
}

TEST(Sheets, RefusalsSayWhatHelps) {
    const Sheet plate{"plate", {{0, 0}, {1, 0}}};
    const auto expect = [](const std::string& message, const std::string& part) {
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect(refusal_of({}, {{"0", plate.points}}), "is no name");
    expect(refusal_of({}, {{"a", {{0, 0}}}}), "and two points");
    expect(refusal_of({}, {{"a", {{0, 0}, {1, 0}, {0.5, 0}}}}), "runs back on itself");
    expect(refusal_of({}, {{"a", {{0, 0}, {1, 0}, {1, 1}, {0, 0}}}}), "closed curve is a body");
    expect(refusal_of({}, {plate, plate}), "two sheets have this name");
    expect(refusal_of({}, {plate, {"b", {{0.5, -1}, {0.5, 1}}}}),
           "crosses or touches sheet plate: leave a gap, or give one of them as --line NAME:two-sided");
    expect(refusal_of({}, {plate, {"b", {{1, 0}, {2, 0}}}}), "stands on another sheet");
    expect(refusal_of({"naca:0012"}, {{"a", {{0.5, -1}, {0.5, 1}}}}), "crosses or touches airfoil");
    expect(refusal_of({"naca:0012"}, {{"a", {{0.3, 0}, {0.6, 0}}}}), "lies inside element airfoil");
    expect(refusal_of({"naca:0012"}, {{"a", {{0.3, 0}, {0.3, 0.3}, {0.6, 0.3}, {0.6, 0}}}}), "leave a gap");
    expect(refusal_of({"naca:0012"}, {{"airfoil", {{2, 0}, {3, 0}}}}), "name of another element");
    EXPECT_THROW(cut_at_symmetry(with({}, {plate}), 0), InputError);
    // Files of open curves say which option takes them.
    try {
        element_of_points(std::vector<Point>{{0, 0}, {0.5, 0.1}, {1, 0}}, "arc");
        ADD_FAILURE();
    } catch (const InputError& error) {
        expect(error.what(), "--sheet");
    }
}

TEST(Sheets, HaveTextsThatReadBack) {
    const Sheet sheet = geometry::parse_sheet("sail:0,0,0.5,0.1,1,0");
    EXPECT_EQ(sheet.points.size(), 3u);
    EXPECT_EQ(geometry::sheet_text(sheet), "sail:0,0,0.5,0.1,1,0");
}

}  // namespace
}  // namespace lamina
