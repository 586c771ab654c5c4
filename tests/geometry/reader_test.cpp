// The reader understands the formats and quirks of files, and repairs them.
#include <algorithm>
#include <clocale>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"
#include "surface/summary.hpp"

namespace lamina {
namespace {

using surface::summarize;

using fixtures::has_repair;
using fixtures::read;

TEST(Reader, EveryFormatGivesTheSameLoop) {
    for (const std::string& content : fixtures::same_loop) {
        SCOPED_TRACE(content);
        const Geometry geometry = read(content);
        ASSERT_EQ(geometry.elements.size(), 1u);
        const Element& e = geometry.elements[0];
        EXPECT_EQ(e.name, "airfoil");
        EXPECT_EQ(e.points, fixtures::loop);
        ASSERT_EQ(e.lines.size(), e.points.size());
        EXPECT_TRUE(std::all_of(e.lines.begin(), e.lines.end(), [](std::size_t line) { return line > 0; }));
    }
}

TEST(Reader, DecimalCommasWithoutALeadingZero) {
    // "-,05" was once read as the two numbers "-" and 05, so that the y of the row before it ended up in x.
    const Element e = read("title\n1,0 ,0\n0,5 ,06\n0,0 0,0\n0,5 -,05\n").elements[0];
    EXPECT_EQ(e.points, (std::vector<Point>{{1, 0}, {0.5, 0.06}, {0, 0}, {0.5, -0.05}}));
    EXPECT_TRUE(has_repair(e, "decimal commas"));
    // Commas separate whole numbers here.
    EXPECT_EQ(read("title\n9 ,0\n5 ,3\n0 ,0\n5 ,-3\n").elements[0].points,
              (std::vector<Point>{{9, 0}, {5, 3}, {0, 0}, {5, -3}}));
}

TEST(Reader, CommasMeanOneThingInAFile) {
    for (const char* text :
         {"title\n1,0 0,0\n0,5, 0,06\n0,0 0,0\n0,5 -0,05\n", "title\n1,0\n5,3\n0,5 0,06\n0,0\n5,-3\n"})
        EXPECT_THROW(read(text), InputError) << text;
    EXPECT_NO_THROW(read("title\n\"1\",\"0\"\n\"0,5\",\"0,06\"\n\"0\",\"0\"\n\"0,5\",\"-0,05\"\n"));
}

TEST(Reader, NamesTheFormat) {
    EXPECT_EQ(read(fixtures::selig).elements[0].format, "selig");
    EXPECT_EQ(read(fixtures::no_title).elements[0].format, "xy");
    EXPECT_EQ(read(fixtures::csv).elements[0].format, "csv");
    EXPECT_EQ(read(fixtures::csv_semicolon).elements[0].format, "csv");
    EXPECT_EQ(read(fixtures::lednicer).elements[0].format, "lednicer");
    EXPECT_EQ(read(fixtures::lednicer_one_run).elements[0].format, "lednicer");
    EXPECT_EQ(read(fixtures::two_surfaces).elements[0].format, "lednicer");
    EXPECT_EQ(read(fixtures::two_surfaces_one_run).elements[0].format, "lednicer");
}

const std::vector<Point> wedge_from_table = {{1, 0}, {0.6, 0.05},  {0.3, 0.06},  {0.1, 0.04},
                                             {0, 0}, {0.1, -0.02}, {0.3, -0.03}, {0.6, -0.01}};

TEST(Reader, TablesOfUpperAndLowerOrdinates) {
    const std::string upper_first = "title\nx upper lower\n0 0 0\n.1 .04 -.02\n.3 .06 -.03\n.6 .05 -.01\n1 0 0\n";
    const std::string lower_first = "title\nx lower upper\n0 0 0\n.1 -.02 .04\n.3 -.03 .06\n.6 -.01 .05\n1 0 0\n";
    const std::string unnamed = "title\n0 0 0\n.1 .04 -.02\n.3 .06 -.03\n.6 .05 -.01\n1 0 0\n";
    for (const std::string& content : {upper_first, lower_first, unnamed}) {
        const Element e = read(content).elements[0];
        EXPECT_EQ(e.format, "table");
        EXPECT_EQ(e.points, wedge_from_table);
        EXPECT_TRUE(has_repair(e, "table of x, upper and lower ordinates"));
        EXPECT_FALSE(has_repair(e, "downward"));
    }
}

// Taken as they are, the surfaces would cross.
TEST(Reader, TablesThatCountLowerOrdinatesDownward) {
    const Element e = read("title\nx lower upper\n0 0 0\n.1 .02 .04\n.3 .07 .06\n.6 .01 .05\n1 0 0\n").elements[0];
    EXPECT_TRUE(has_repair(e, "downward"));
    EXPECT_NE(std::find(e.points.begin(), e.points.end(), Point{0.3, -0.07}), e.points.end());
    EXPECT_NE(std::find(e.points.begin(), e.points.end(), Point{0.6, 0.05}), e.points.end());
}

TEST(Reader, OneSurfaceOfASymmetricSectionStandsForBoth) {
    const std::string content =
        "DEMO\nNACA\n1\tSym Flag (0 - No, 1 - Yes)\n5\tNum Pnts Upper\n"
        "0. 0.\n.1 .04\n.3 .06\n.6 .05\n1. 0.001\n";
    const Element e = read(content).elements[0];
    EXPECT_TRUE(has_repair(e, "symmetric section"));
    for (Point p : e.points)
        EXPECT_NE(std::find(e.points.begin(), e.points.end(), Point{p.x, -p.y}), e.points.end()) << p.x;
    std::string unflagged = content;
    unflagged[unflagged.find("1\tSym")] = '0';
    EXPECT_THROW(read(unflagged), InputError);
}

TEST(Reader, KeepsTitlesAsPrintableText) {
    EXPECT_EQ(read(fixtures::selig).elements[0].title, "SAMPLE 12");
    EXPECT_EQ(read(fixtures::digits_title).elements[0].title, "23012 at 12 degrees");
    EXPECT_EQ(read(fixtures::two_numbers_title).elements[0].title, "63 212 modified");
    EXPECT_EQ(read(fixtures::latin1_title).elements[0].title, "G\xC3\xB6ttingen 417\xC2\xB0");
    EXPECT_EQ(read("\xEF\xBB\xBF" + fixtures::selig).elements[0].title, "SAMPLE 12");
    EXPECT_EQ(read("# only a comment\n" + fixtures::no_title).elements[0].title, "only a comment");
}

TEST(Reader, RemarksBehindCoordinatesAreIgnored) {
    std::string content = fixtures::selig;
    content.replace(content.find("1.0 0.0"), 7, "1 0 trailing edge");
    EXPECT_EQ(read(content).elements[0].points, fixtures::loop);
}

/// Authors of tables note behind them what they changed.
TEST(Reader, NotesOnCorrectionsAreNoCoordinates) {
    for (const std::string note :
         {"0.5 0.10 -> 0.5 0.11\n0 0.001 -> 0 0\n", "28/12/2005  1.0007 -->1.0\n", "0.5 0.10->0.11"}) {
        SCOPED_TRACE(note);
        const Element behind = read(fixtures::selig + "\nmodified by the author\n" + note).elements[0];
        EXPECT_EQ(behind.points, fixtures::loop);
        EXPECT_TRUE(has_repair(behind, "taken as a note on a correction"));
    }
    std::string content = fixtures::selig;
    content.replace(content.find("1.0 0.0"), 7, "1.0 0.0 -> 1.0 0.1");
    EXPECT_EQ(read(content).elements[0].points, fixtures::loop) << "a remark behind coordinates";
}

TEST(Reader, RemembersTheLinesOfPoints) {
    const Element e = read(fixtures::lednicer).elements[0];
    // The leading edge stands in line 10 with the lower surface and in line 4 with the upper one, which counts.
    EXPECT_EQ(e.lines, (std::vector<std::size_t>{8, 7, 6, 5, 4, 11, 12, 13}));
    EXPECT_EQ(e.points_read, 9u);
}

TEST(Reader, NumbersAreExactWhateverTheLocale) {
    const std::string content =
        "0.1 -.3333333333333333333333\n1e-3 2.2250738585072014e-16\n-0.30000000000000004 1\n0.1 "
        "-.3333333333333333333333\n";
    const char* comma_locale = std::setlocale(LC_ALL, "de_DE.UTF-8");  // absent on most machines
    const Element e = read(content).elements[0];
    if (comma_locale) std::setlocale(LC_ALL, "C");
    for (Point p :
         {Point{0.1, -0.3333333333333333}, Point{1e-3, 2.2250738585072014e-16}, Point{-0.30000000000000004, 1}})
        EXPECT_EQ(std::count(e.points.begin(), e.points.end(), p), 1) << p.x << ' ' << p.y;
}

TEST(Reader, SeveralElementsInOneFile) {
    for (const std::string& content :
         {fixtures::two_999, fixtures::two_blank, fixtures::two_labelled, fixtures::two_lednicer}) {
        SCOPED_TRACE(content);
        const Geometry geometry = read(content);
        ASSERT_EQ(geometry.elements.size(), 2u);
        EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
        EXPECT_EQ(geometry.elements[1].points.size(), 5u);
        EXPECT_EQ(geometry.elements[0].name, "sample_1");
        EXPECT_EQ(geometry.elements[1].name, "sample_2");
    }
    EXPECT_EQ(read(fixtures::two_labelled).elements[1].title, "Flap");
    EXPECT_EQ(read(fixtures::two_lednicer).elements[1].title, "Flap");
}

TEST(Reader, LonePointsAreLeftOutAndReported) {
    const Element before =
        read("201 NumCoords ! count\n! reference\n0.25 0\n! outline\n" + fixtures::no_title).elements[0];
    EXPECT_EQ(before.points, fixtures::loop);
    EXPECT_TRUE(has_repair(before, "line 3: lone point left out, not part of an outline (0.25, 0)"));
    const Element after = read(fixtures::selig + "\n\n0.99 -0.001\n").elements[0];
    EXPECT_EQ(after.points, fixtures::loop);
    EXPECT_TRUE(has_repair(after, "line 13: lone point"));
}

TEST(Reader, RemovesDuplicatesAndSaysSo) {
    std::string content = fixtures::selig;
    content.insert(content.find("0.5 0.07"), "0.5 0.07\n");
    const Element e = read(content).elements[0];
    EXPECT_EQ(e.points, fixtures::loop);
    EXPECT_TRUE(has_repair(e, "line 5: duplicate of line 4 removed (0.5, 0.07)"));
    EXPECT_TRUE(has_repair(e, "line 11: closing point merged with line 2 (1, 0)"));
    EXPECT_EQ(e.points_read, 10u);
}

TEST(Reader, MergesATrailingEdgeClosedButForRounding) {
    std::string content = fixtures::selig;
    content.replace(content.rfind("1.0 0.0"), 7, "1.0 -0.000000000000000019");
    const Element e = read(content).elements[0];
    EXPECT_EQ(e.points, fixtures::loop);
    EXPECT_TRUE(has_repair(e, "closing point merged"));
}

TEST(Reader, MergesSurfacesThatCrossByRounding) {
    const Geometry geometry = read(
        "ROUNDED\n1.00000 0.0\n0.99681 0.00031\n0.7 0.04\n0.3 0.06\n0 0\n0.3 -0.03\n0.7 -0.01\n0.99679 0.00011\n"
        "1.00001 -0.00000\n");
    EXPECT_EQ(geometry.elements[0].points.size(), 8u);
    EXPECT_EQ(geometry.elements[0].points[0], (Point{1, 0}));
    ASSERT_FALSE(geometry.elements[0].repairs.empty());
    EXPECT_NE(geometry.elements[0].repairs[0].find("the edges on both sides of them cross"), std::string::npos);
    // The same happens at a nose that each surface has with other digits.
    const Element nose =
        read("NOSE\n1 0\n0.6 0.05\n0.0005 0.01\n0 0\n0 0.00001\n0.0005 -0.01\n0.6 -0.04\n").elements[0];
    EXPECT_EQ(nose.points.size(), 6u);
    EXPECT_TRUE(
        has_repair(nose, "lines 6 and 5: the edges on both sides of them cross; (0, 1e-05) merged with (0, 0)"));
}

TEST(Reader, CutsOffATailWithoutThickness) {
    const Element e = read("TAIL\n1 0\n0.995 0.001\n0.6 0.05\n0 0\n0.6 -0.04\n0.995 0.001\n1 0\n").elements[0];
    EXPECT_EQ(e.points.size(), 4u);
    EXPECT_EQ(e.points[0], (Point{0.995, 0.001}));
    EXPECT_TRUE(has_repair(e, "a tail of no thickness cut off, from (0.995, 0.001) to (1, 0)"));
    // A long line is not taken for a tail.
    EXPECT_THROW(read("TAIL\n1 0\n0.9 0.01\n0.6 0.05\n0 0\n0.6 -0.04\n0.9 0.01\n1 0\n"), InputError);
}

TEST(Reader, ReversesClockwiseOrderFromTheSamePoint) {
    const Element e = read(fixtures::clockwise).elements[0];
    EXPECT_EQ(e.points.front(), (Point{1, 0}));
    EXPECT_TRUE(has_repair(e, "line 2: clockwise order reversed"));
    EXPECT_FALSE(has_repair(read(fixtures::selig).elements[0], "clockwise"));
}

TEST(Reader, ClosesAnOpenTrailingEdgeByABase) {
    const Element e = read(fixtures::open_base).elements[0];
    // The base is 0.02 long and its shorter neighbour hypot(0.01, 0.001), so that it gets two edges.
    ASSERT_EQ(e.points.size(), 12u);
    EXPECT_EQ(e.points.back(), (Point{1, 0}));
    EXPECT_EQ(e.lines.back(), 0u);
    EXPECT_EQ(e.lines.front(), 2u);
    EXPECT_TRUE(has_repair(e, "lines 12 and 2: open end closed from (1, -0.01) to (1, 0.01) by 2 edges, 0.02 long"));
    EXPECT_TRUE(summarize(e).blunt_trailing_edge);
}

TEST(Reader, ClosesAPlateAlongItsLongSide) {
    const Element e = read("plate\n1 0.001\n1 -0.001\n0 -0.001\n-0.001 0\n0 0.001\n").elements[0];
    EXPECT_GT(e.points.size(), 5u);
    const auto above = [](Point p) { return std::abs(p.y - 0.001) < 1e-15; };
    EXPECT_EQ(std::count_if(e.points.begin(), e.points.end(), above), static_cast<long>(e.points.size()) - 3);
}

TEST(Reader, NeverScalesOrMoves) {
    std::vector<Point> points;
    for (Point p : fixtures::loop) points.push_back({100 * p.x - 30, 100 * p.y + 7});
    const Element e = read(fixtures::as_file(points)).elements[0];
    for (Point p : points) EXPECT_EQ(std::count(e.points.begin(), e.points.end(), p), 1);
}

TEST(Reader, PerCentFilesAreNotMistakenForCounts) {
    // The first point (100, 2) looks like the counts of a Lednicer file.
    const Element e = read("100.0 2.0\n50 9\n20 8\n0 0\n20 -3\n50 -4\n100 2\n").elements[0];
    EXPECT_EQ(e.points.size(), 6u);
    EXPECT_EQ(e.points[0], (Point{100, 2}));
}

// The outline that is read from a rotated, scaled or shifted file is the image of the original outline.
TEST(Reader, MappedInputGivesTheMappedLoop) {
    std::mt19937 random(3);
    for (const shapes::Outline& shape : {shapes::joukowski(0.1, 0.05, 40), shapes::ellipse(1, 0.2, 31),
                                         shapes::c_shape(0.2), shapes::star(50, 0.3, random)}) {
        for (double angle : {0.0, 0.7, 2.0, 3.9}) {
            for (double scale : {1.0, 1e-6, 3e7}) {
                shapes::Outline image = shapes::moved(shape, angle, scale, {scale * 3, -scale});
                shapes::Outline closed = image;
                closed.push_back(image[0]);
                EXPECT_EQ(read(fixtures::as_file(closed)).elements[0].points, image);
                std::reverse(closed.begin(), closed.end());
                EXPECT_EQ(read(fixtures::as_file(closed)).elements[0].points, image);
                const shapes::Outline mirror = shapes::mirrored(image);
                EXPECT_EQ(read(fixtures::as_file(mirror)).elements[0].points.front(), mirror[0]);
                const shapes::Outline shifted = shapes::started_at(image, image.size() / 3);
                shapes::Outline shifted_closed = shifted;
                shifted_closed.push_back(shifted[0]);
                EXPECT_EQ(read(fixtures::as_file(shifted_closed)).elements[0].points, shifted);
            }
        }
    }
}

TEST(PointsInMemory, AreRepairedAsThoseOfFiles) {
    for (const std::string& content : fixtures::same_loop) {
        SCOPED_TRACE(content);
        const Element of_file = read(content).elements[0];
        std::vector<Point> points = of_file.points;
        const std::vector<Point> loop = points;
        EXPECT_EQ(element_of_points(points, "array").points, loop);
        points.push_back(points[0]);
        EXPECT_EQ(element_of_points(points, "array").points, loop);
        std::reverse(points.begin(), points.end());
        const Element clockwise = element_of_points(points, "array");
        EXPECT_EQ(clockwise.points, loop);
        EXPECT_TRUE(has_repair(clockwise, "clockwise order reversed"));
        EXPECT_EQ(make_geometry({clockwise}).elements[0].name, "airfoil");
    }
}

TEST(PointsInMemory, ErrorsSayWhichPoint) {
    std::vector<Point> points{{1, 0}, {0.5, 0.1}, {0, 0}, {0.5, -0.1}};
    points[2].x = HUGE_VAL;
    try {
        element_of_points(points, "wing");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.place().file, "wing");
        EXPECT_EQ(error.place().line, 3u);
    }
    EXPECT_THROW(element_of_points({}, "wing"), InputError);
    EXPECT_THROW(make_geometry({}), UsageError);
}

TEST(Names, ComeFromFileStemsOrTheUser) {
    const test::TemporaryFolder folder;
    const std::string main = folder.write("main element (v2).dat", fixtures::selig).string();
    const std::string flap = folder.write(std::string(60, 'f') + ".dat", fixtures::second_body).string();
    const std::vector<std::string> inputs{main, flap};
    const Geometry geometry = read_geometry(inputs);
    EXPECT_EQ(geometry.elements[0].name, "main_element__v2_");
    EXPECT_EQ(geometry.elements[1].name, std::string(32, 'f'));
    EXPECT_EQ(geometry.elements[0].file, main);

    GeometryOptions options;
    options.names = {"wing", "flap"};
    EXPECT_EQ(read_geometry(inputs, options).elements[1].name, "flap");
    EXPECT_TRUE(read_geometry(inputs, options).elements[1].warnings.empty());
    for (const std::vector<std::string>& bad :
         std::vector<std::vector<std::string>>{{"wing"}, {"a", "a"}, {"", "b"}, {"a", "b", "c"}}) {
        options.names = bad;
        EXPECT_THROW(read_geometry(inputs, options), UsageError);
    }
}

TEST(Names, AvoidTheNameOfTheOuterBoundary) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> inputs{folder.write("farfield.dat", fixtures::selig).string(),
                                          folder.write("flap.dat", fixtures::second_body).string()};
    EXPECT_EQ(read_geometry(inputs).elements[0].name, "wall_farfield");
}

TEST(Names, ThatNoMarkerMayHaveAreChangedWithAWarning) {
    const test::TemporaryFolder folder;
    std::vector<std::string> inputs{folder.write("0012.dat", fixtures::selig).string(),
                                    folder.write("63-215.dat", fixtures::second_body).string()};
    const Geometry geometry = read_geometry(inputs);
    EXPECT_EQ(geometry.elements[0].name, "wall_0012");
    EXPECT_EQ(geometry.elements[1].name, "wall_63-215");
    EXPECT_EQ(geometry.elements[1].given_name, "63-215");
    ASSERT_EQ(geometry.elements[0].warnings.size(), 1u);
    EXPECT_EQ(geometry.elements[0].warnings[0].code, WarningCode::marker_renamed);

    GeometryOptions options;
    options.names = {"a b", std::string(33, 'x')};
    EXPECT_EQ(read_geometry(inputs, options).elements[0].name, "a_b");
    EXPECT_EQ(read_geometry(inputs, options).elements[1].name, std::string(32, 'x'));
    // Transformations know elements by both names.
    options.names = {"0012", "flap"};
    for (const char* name : {"0012", "wall_0012"}) {
        options.transformations = {parse_transformation(std::string(name) + ":shift:-1,0")};
        EXPECT_EQ(read_geometry(inputs, options).elements[0].points[0], (Point{0, 0})) << name;
    }
    // The same file twice, with a stem that is no name.
    inputs = {inputs[0], inputs[0]};
    options.names.clear();
    options.transformations = {parse_transformation("0012_2:shift:3,0")};
    EXPECT_EQ(read_geometry(inputs, options).elements[1].name, "wall_0012_2");
}

}  // namespace
}  // namespace lamina
