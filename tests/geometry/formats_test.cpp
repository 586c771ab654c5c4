// Formats of other programs, half sections, surfaces in two files and outlines that options close.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "geometry/length_units.hpp"
#include "geometry/parse_airfoil.hpp"
#include "support/geometry_fixtures.hpp"

namespace lamina::formats_test {
namespace {

const std::vector<Point> upper{{0, 0}, {0.2, 0.06}, {0.5, 0.07}, {0.75, 0.04}, {1, 0}},
    lower{{0, 0}, {0.2, -0.04}, {0.5, -0.05}, {0.75, -0.03}, {1, 0}};

Geometry of_text(const std::string& content, const GeometryOptions& options = {}) {
    return make_geometry(geometry::parse_airfoil(content, "sample.dat", options), options);
}

/// Returns lines that `line(i, point)` makes of points, where i counts from 1.
std::string lines_of(const std::vector<Point>& points, const std::function<std::string(std::size_t, Point)>& line) {
    std::string text;
    for (std::size_t i = 0; i < points.size(); ++i) text += line(i + 1, points[i]) + "\n";
    return text;
}

std::string xyz(std::size_t, Point p) { return fmt::format("{} {} 0", p.x, p.y); }

std::vector<Point> reversed(std::vector<Point> points) {
    std::reverse(points.begin(), points.end());
    return points;
}

std::string message_of(const std::string& content) {
    try {
        of_text(content);
    } catch (const InputError& e) {
        return e.what();
    }
    return "accepted";
}

TEST(Formats, CurvesOfIcem) {
    for (const std::vector<Point>& first : {upper, reversed(upper)})
        EXPECT_EQ(of_text("5 2\n" + lines_of(first, xyz) + lines_of(lower, xyz)).elements[0].points, fixtures::loop);
    EXPECT_EQ(of_text("8 1\n" + lines_of(fixtures::loop, xyz)).elements[0].points, fixtures::loop);
}

TEST(Formats, CurvesOfDesignModeler) {
    const auto row = [](int curve) {
        return [=](std::size_t i, Point p) { return fmt::format("{}\t{}\t{}\t{}\t0", curve, i, p.x, p.y); };
    };
    const auto flap = [&](std::size_t i, Point p) { return fmt::format("2 {} {} {} 0", i, p.x + 2, p.y); };
    const std::string closed = lines_of(fixtures::loop, row(1)) + "1 0\n";
    for (const std::string header : {"", "#group\tpoint\tx\ty\tz\n"}) {
        EXPECT_EQ(of_text(header + closed).elements[0].points, fixtures::loop);
        EXPECT_EQ(of_text(header + closed + lines_of(fixtures::loop, flap) + "2 0\n").elements.size(), 2u);
        EXPECT_EQ(of_text(header + lines_of(upper, row(1)) + lines_of(lower, row(2))).elements[0].points,
                  fixtures::loop);
    }
}

TEST(Formats, Labels) {
    const auto named = [](std::size_t i, Point p) { return fmt::format("P{} {} {}", i, p.x, p.y); };
    const auto on = [](const std::string& side) {
        return [=](std::size_t, Point p) { return fmt::format("\"{}\",{},{}", side, p.x, p.y); };
    };
    EXPECT_EQ(of_text(lines_of(fixtures::loop, named)).elements[0].points, fixtures::loop);
    EXPECT_EQ(of_text("side,x,y\n" + lines_of(upper, on("upper")) + lines_of(lower, on("lower"))).elements[0].points,
              fixtures::loop);
    std::string circle;
    constexpr std::size_t points = 3000;
    for (std::size_t i = 0; i < points; ++i) {
        const double turn = 2 * M_PI * static_cast<double>(i) / points;
        circle += named(i, {std::cos(turn), std::sin(turn)});
        circle += '\n';
    }
    EXPECT_EQ(of_text(circle).elements[0].points.size(), points);
    EXPECT_NE(message_of(lines_of(fixtures::loop, named) + "P9 0.9 nan\n").find("no label and two numbers"),
              std::string::npos);
}

TEST(Formats, Units) {
    const auto row = [](std::size_t, Point p) { return fmt::format("{}mm\t{}mm\t0mm", p.x, p.y); };
    const auto spaced = [](std::size_t, Point p) { return fmt::format("{} in {} in", p.x, p.y); };
    const Element e = of_text(lines_of(fixtures::loop, row)).elements[0];
    EXPECT_EQ(e.points, fixtures::loop);
    EXPECT_EQ(e.unit, "mm");
    EXPECT_EQ(of_text("wing\n" + lines_of(fixtures::loop, spaced)).elements[0].unit, "in");
    EXPECT_EQ(of_text("\"x [mm]\";\"y [mm]\"\n" + fixtures::loop_lines).elements[0].unit, "mm");
    EXPECT_NE(message_of("1mm 0mm\n.5mm .1mm\n0cm 0cm\n").find("the unit is cm here, but mm before"),
              std::string::npos);
    GeometryOptions options;
    options.transformations = {parse_transformation("all:scale:0.001")};
    EXPECT_EQ(of_text(lines_of(fixtures::loop, row), options).elements[0].unit, "");
}

TEST(Formats, UnitsAreAsLongAsTheyAre) {
    for (const auto& [text, metres] : {std::pair{"um", 1e-6},
                                       {"mm", 1e-3},
                                       {"CM", 1e-2},
                                       {"meter", 1.0},
                                       {"in", 0.0254},
                                       {"inches", 0.0254},
                                       {"ft", 0.3048}}) {
        const auto unit = geometry::length_unit(text);
        ASSERT_TRUE(unit) << text;
        EXPECT_EQ(unit->metres, metres) << text;
    }
}

TEST(Formats, CamberAndChordLinesAreLeftOut) {
    const std::string text = "Name,sample\nChord(mm),1\n\nAirfoil surface,\nX(mm),Y(mm)\n" +
                             lines_of(fixtures::loop, [](auto, Point p) { return fmt::format("{},{}", p.x, p.y); }) +
                             "\nCamber line,\nX(mm),Y(mm)\n0,0\n0.5,0.01\n1,0\n\nChord line,\nX(mm),Y(mm)\n0,0\n1,0\n";
    const Geometry geometry = of_text(text);
    ASSERT_EQ(geometry.elements.size(), 1u);
    EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
    EXPECT_EQ(geometry.elements[0].unit, "mm");
}

TEST(Formats, Plot3d) {
    const auto coordinates = [](const std::vector<Point>& points, bool with_z) {
        std::string text;
        std::size_t written = 0;
        const auto write = [&](double value) { text += fmt::format("{}{}", value, ++written % 5 == 0 ? "\n" : " "); };
        for (const Point p : points) write(p.x);
        for (const Point p : points) write(p.y);
        if (with_z)
            for (std::size_t i = 0; i < points.size(); ++i) write(0);
        return text + "\n";
    };
    EXPECT_EQ(of_text("1\n8 1 1\n" + coordinates(fixtures::loop, true)).elements[0].points, fixtures::loop);
    EXPECT_EQ(of_text("8 1\n" + coordinates(fixtures::loop, false)).elements[0].points, fixtures::loop);
    EXPECT_EQ(of_text("2\n5 1 1 5 1 1\n" + coordinates(upper, true) + coordinates(lower, true)).elements[0].points,
              fixtures::loop);
}

TEST(Formats, PointsOfGmsh) {
    const std::string points = lines_of(fixtures::loop, [](std::size_t i, Point p) {
        return fmt::format("Point({}) = {{{}, {}, 0, lc}};", i, p.x, p.y);
    });
    for (const std::string curves :
         {"", "Spline(1) = {1:8};\nLine(2) = {8, 1};\n", "Line(3)={1:5}; Spline(9)={1,8:5};\n"})
        EXPECT_EQ(of_text("lc = 0.1; // size\n" + points + curves).elements[0].points, fixtures::loop) << curves;
    const std::string far =
        "Point(20)={-9,-9,0};Point(21)={9,-9,0};Point(22)={9,9,0};Point(23)={-9,9,0};\n"
        "Line(20)={20,21};Line(21)={21,22};Line(22)={22,23};Line(23)={23,20};\n";
    const Geometry with_far_field = of_text(far + points + "Spline(1) = {1:8, 1};\n");
    ASSERT_EQ(with_far_field.elements.size(), 1u);
    EXPECT_EQ(with_far_field.elements[0].points, fixtures::loop);
    EXPECT_NE(message_of(points + "BSpline(1) = {1:8,1};\n").find("BSpline(1) does not pass through"),
              std::string::npos);
    EXPECT_NE(message_of(points + "Line(1) = {1:999999999};\n").find("there is no point 9"), std::string::npos);
}

TEST(Formats, DrawingsSayHowToExport) {
    EXPECT_NE(message_of("  0\nSECTION\n  2\nHEADER\n").find("a DXF drawing"), std::string::npos);
    EXPECT_NE(message_of("<svg xmlns=''><text>a</text></svg>").find("an SVG drawing"), std::string::npos);
    EXPECT_NE(message_of("ISO-10303-21;\nHEADER;\n").find("a STEP file"), std::string::npos);
    EXPECT_NE(message_of(fmt::format("{:<72}S{:>7}\n", "start", 1)).find("an IGES file"), std::string::npos);
}

TEST(Formats, ExtensionsSayHowToExportWhatCannotBeRead) {
    const std::vector<std::pair<std::string, std::string>> names{{"a.dxf", "a DXF drawing"},
                                                                 {"a.SVG", "an SVG drawing"},
                                                                 {"a.igs", "an IGES file"},
                                                                 {"a.step", "a STEP file"},
                                                                 {"a.json", "JSON"}};
    for (const auto& [name, said] : names) {
        try {
            fixtures::read("{}\nnothing\n", name);
            ADD_FAILURE() << name;
        } catch (const InputError& error) {
            EXPECT_EQ(error.reason().find(said), 0u) << error.what();
        }
        EXPECT_EQ(fixtures::read(fixtures::selig, name).elements.size(), 1u);
    }
}

TEST(Formats, JsonSaysHowToExport) {
    for (const std::string text :
         {R"({"x": [1, 0.5, 0, 0.5], "y": [0, 0.1, 0, -0.1]})",
          R"([{"x": 1, "y": 0}, {"x": 0.5, "y": 0.1}, {"x": 0, "y": 0}])",
          "{\"x\": 1, \"y\": 0}\n{\"x\": 0.5, \"y\": 0.1}\n{\"x\": 0, \"y\": 0}\n",
          "[\n  [\n    1.0,\n    0.0\n  ],\n  [\n    0.5,\n    0.1\n  ],\n  [\n    0,\n    0\n  ]\n]\n",
          "[[1, 0.5, 0, 0.5], [0, 0.1, 0, -0.1]]", "[[1, 0.5, 0], [0, 0.1, 0]]", "[1, 0, 0.5, 0.1, 0, 0]",
          "{x: [1, 0.5, 0], y: [0, 0.1, 0]}"}) {
        const std::string message = message_of(text);
        EXPECT_NE(message.find("JSON, of which lamina reads lists of points alone: print the points"),
                  std::string::npos)
            << text << '\n'
            << message;
    }
    for (const std::string text :
         {"\xEF\xBB\xBF\n {\n  \"name\": \"a\",\n  \"points\": [\n    [1, 0],\n    [0.5, 0.1],\n    [0, 0],\n    [0.5, "
          "-0.1]\n  ]\n}\n",
          "[\n 1, 0,\n 0.5, 0.1,\n 0, 0,\n 0.5, -0.1\n]\n", "[[1, 0], [0.5, 0.1], [0, 0], [0.5, -0.1]]",
          "[[1, 0],\n[0.5, 0.1],\n[0, 0],\n[0.5, -0.1]]\n", "[1 0; 0.5 0.1; 0 0; 0.5 -0.1]",
          "{1, 0},\n{0.5, 0.1},\n{0, 0},\n{0.5, -0.1}\n", "[\n  [1, 0],\n  [0.5, 0.1],\n  [0, 0],\n  [0.5, -0.1]\n]\n"})
        EXPECT_EQ(of_text(text).elements[0].points.size(), 4u) << text;
}

TEST(HalfSections, AreMirrored) {
    GeometryOptions options;
    options.mirror_half = true;
    std::vector<Point> whole = reversed(upper);
    for (std::size_t i = 1; i + 1 < upper.size(); ++i) whole.push_back({upper[i].x, -upper[i].y});
    const auto row = [](std::size_t, Point p) { return fmt::format("{} {}", p.x, p.y); };
    for (const std::vector<Point>& half : {upper, reversed(upper)}) {
        EXPECT_EQ(of_text(lines_of(half, row), options).elements[0].points, whole);
        EXPECT_EQ(of_text(lines_of(half, row) + row(0, half[0]) + "\n", options).elements[0].points, whole);
    }
    std::vector<Point> blunt = upper;
    blunt.back().y = 0.01;
    EXPECT_EQ(of_text(lines_of(blunt, row), options).elements[0].points.front(), (Point{1, 0.01}));
    EXPECT_THROW(of_text(fixtures::selig, options), InputError);
    const std::string refusal = message_of(lines_of(upper, row));
    EXPECT_NE(refusal.find("--mirror-half if this is half"), std::string::npos) << refusal;
    EXPECT_NE(refusal.find("repeat the first point at the end or give --close"), std::string::npos) << refusal;
}

TEST(HalfSections, ThatAreClosedAreWarnedOf) {
    std::string text = "half\n";
    for (int i = 0; i <= 20; ++i) {
        const double x = 1 - i * i / 400.0;
        text += fmt::format("{} {}\n", 1 - x, 0.2 * std::sqrt(1 - x) * x);
    }
    GeometryOptions mirrored;
    mirrored.mirror_half = true;
    const std::vector<Point> whole = of_text(text + "0 0\n", mirrored).elements[0].points;
    for (const std::string side : {"", "0.5 0\n", "0.9 0\n0.7 0\n0.4 1e-8\n0.1 0\n0.01 0\n"}) {
        const std::vector<Warning> warnings = of_text(text + side + "0 0\n").elements[0].warnings;
        ASSERT_EQ(warnings.size(), 1u) << side;
        EXPECT_EQ(warnings[0].code, WarningCode::half_section);
        EXPECT_EQ(of_text(text + side + "0 0\n", mirrored).elements[0].points, whole) << side;
    }
    EXPECT_TRUE(of_text("car\n4 .3\n4 .9\n3 1.4\n.05 .75\n0 .3\n4 .3\n").elements[0].warnings.empty());
    EXPECT_TRUE(of_text("flat\n0 0\n0.2 0.06\n0.5 0.07\n1 0\n0 0\n").elements[0].warnings.empty());
}

TEST(OpenOutlines, AreClosedOnRequest) {
    GeometryOptions options;
    options.close = true;
    const Element e = of_text("arc\n1 0\n0.75 0.08\n0.5 0.1\n0.25 0.08\n0 0\n", options).elements[0];
    EXPECT_EQ(e.points.size(), 8u);
    EXPECT_EQ(std::count_if(e.points.begin(), e.points.end(), [](Point p) { return p.y == 0; }), 5);
}

TEST(TwoFiles, OfUpperAndLowerSurfaceAreOneElement) {
    const test::TemporaryFolder folder;
    const auto row = [](std::size_t, Point p) { return fmt::format("{} {}", p.x, p.y); };
    for (const std::vector<Point>& a : {upper, reversed(upper)})
        for (const std::vector<Point>& b : {lower, reversed(lower)}) {
            const std::vector<std::string> inputs{folder.write("upper.dat", lines_of(a, row)).string(),
                                                  folder.write("lower.dat", lines_of(b, row)).string(), "naca:0012"};
            GeometryOptions options;
            options.transformations = {parse_transformation("naca0012:shift:3,0")};
            const Geometry geometry = read_geometry(inputs, options);
            ASSERT_EQ(geometry.elements.size(), 2u);
            EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
            EXPECT_EQ(geometry.elements[0].name, "upper");
        }
}

TEST(TwoFiles, OfPlatesThatBeginAtACornerAreTwoElements) {
    const test::TemporaryFolder folder;
    const auto row = [](std::size_t, Point p) { return fmt::format("{} {}", p.x, p.y); };
    const auto plate = [&](const std::string& name, double y, std::size_t first) {
        std::vector<Point> points{{0, y + 0.02}, {0, y}, {1, y}, {1, y + 0.02}};
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(first), points.end());
        return folder.write(name, lines_of(points, row)).string();
    };
    for (std::size_t first = 0; first < 4; ++first) {
        const std::vector<std::string> inputs{plate("upper.dat", 0, first), plate("lower.dat", -0.0201, first)};
        const Geometry geometry = read_geometry(inputs, {});
        ASSERT_EQ(geometry.elements.size(), 2u) << first;
        EXPECT_EQ(geometry.elements[0].name, "upper");
        EXPECT_EQ(geometry.elements[1].name, "lower");
    }
}

TEST(ReferenceBox, IsThatBeforeElementsAreTurned) {
    const auto width = [](const std::string& change, const std::string& input = "naca:0012") {
        GeometryOptions options;
        options.transformations = {parse_transformation(change)};
        const std::vector<std::string> inputs{input};
        return reference_box(read_geometry(inputs, options)).width();
    };
    EXPECT_EQ(width("all:rotate:-10"), 1);
    EXPECT_EQ(width("all:rotate:60"), 1);
    EXPECT_EQ(width("all:flap:20:0.75,0"), 1);
    EXPECT_EQ(width("all:scale:2"), 2);
    const test::TemporaryFolder folder;
    const auto upright = [](std::size_t, Point p) { return fmt::format("{} {}", p.y, p.x); };
    EXPECT_EQ(width("all:rotate:90", folder.write("up.dat", lines_of(fixtures::loop, upright)).string()), 1);
}

TEST(ReferenceChord, IsThatOfTheElementThatIsNamed) {
    const auto chord = [](const std::string& name, const std::vector<std::string>& changes, bool unite = false) {
        GeometryOptions options{.names = {"main", "12"}, .unite = unite};
        for (const std::string& change : changes) options.transformations.push_back(parse_transformation(change));
        const std::vector<std::string> inputs{"naca:0012", "naca:4412:100:sharp"};
        return reference_conditions({.chord_element = name}, read_geometry(inputs, options)).chord;
    };
    const std::vector<std::string> tandem{"12:scale:0.25", "12:shift:3,0.5"};
    EXPECT_EQ(chord("main", tandem), 1);
    EXPECT_NEAR(chord("12", tandem), 0.25, 1e-3) << "as it was given";
    EXPECT_NEAR(chord("wall_12", tandem), 0.25, 1e-3) << "as its marker is called";
    EXPECT_NEAR(chord("", tandem), 3.25, 1e-3);
    EXPECT_EQ(chord("main", {"12:shift:3,0", "all:rotate:40", "main:flap:20:0.7,0"}), 1);
    EXPECT_EQ(chord("main", {"12:shift:0.5,0.02"}, true), 1) << "where both are joined";
    try {
        chord("mian", tandem);
        ADD_FAILURE();
    } catch (const OptionError& error) {
        EXPECT_EQ(error.option(), "chord");
        EXPECT_NE(error.reason().find("did you mean 'main'?"), std::string::npos) << error.reason();
    }
}

TEST(ReferenceChord, OfAnElementStaysWhereRowsAreTurnedAndHalvesAreCut) {
    Geometry row = blade_row(make_geometry({naca_airfoil("0012", 100)}), 1, 30);
    EXPECT_EQ(reference_conditions({.chord_element = "airfoil"}, row).chord, 1);
    row.unturned_elements.clear();
    EXPECT_LT(reference_conditions({.chord_element = "airfoil"}, row).chord, 0.9) << "elements made by hand";
    const Geometry half = cut_at_symmetry(make_geometry({naca_airfoil("0012", 100)}), 0);
    EXPECT_EQ(reference_conditions({.chord_element = "airfoil"}, half).chord, 1);
}

TEST(UnitOfTitle, IsTheOneOfTheCoordinates) {
    const auto unit = [](const std::string& title) {
        const auto found = geometry::unit_of_title(title, 250);
        return found ? std::string(found->name) : "";
    };
    for (const char* title :
         {"main element (mm)", "Main [mm]", "units: mm", "UNITS = MM", "unit mm", "units in mm", "coordinates in mm",
          "all dimensions in millimetres", "NACA 0012, chord 250 mm", "NACA 0012 (chord = 250mm)",
          "chord length: 249.8 mm", "slat, chord of 250 mm, cut in 1998"})
        EXPECT_EQ(unit(title), "mm") << title;
    EXPECT_EQ(unit("all dimensions in inches"), "in");
    EXPECT_EQ(unit("units: in"), "in");
    EXPECT_EQ(unit("chord 250 in"), "in");
    for (const char* title :
         {"", "NACA 0012", "chord 1 m", "chord 300 mm", "tested in 1942", "NLF(1)-0416", "in a tunnel", "5 mm gap",
          "chord", "chord =", "length 250", "(chord", "m series (mod)", "in in"})
        EXPECT_EQ(unit(title), std::string(title) == "in in" ? "in" : "") << title;
}

TEST(UnitOfTitle, IsThatOfTheElementUnlessTheColumnsNameOne) {
    EXPECT_EQ(of_text("wing, units: mm\n" + fixtures::loop_lines).elements[0].unit, "mm");
    EXPECT_EQ(of_text("wing, chord 1 m\n" + fixtures::loop_lines).elements[0].unit, "m");
    EXPECT_EQ(of_text("wing, chord 1000 mm\n" + fixtures::loop_lines).elements[0].unit, "");
    EXPECT_EQ(of_text("wing (mm)\n\"x [in]\";\"y [in]\"\n" + fixtures::loop_lines).elements[0].unit, "in");
}

}  // namespace
}  // namespace lamina::formats_test
