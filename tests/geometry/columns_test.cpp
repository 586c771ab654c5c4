// Comments, quotes, columns beside x and y, and headers of numbers change nothing about the points that are read.
#include <algorithm>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "geometry/parse_airfoil.hpp"
#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

/// Returns the geometry of the text of a file.
Geometry parsed(const std::string& content) {
    return make_geometry(geometry::parse_airfoil(content, "sample.dat"), {});
}

bool says(const Element& e, const std::string& part) {
    return std::any_of(e.repairs.begin(), e.repairs.end(),
                       [&](const std::string& r) { return r.find(part) != std::string::npos; });
}

/// Returns the text of a section as "x y" lines.
std::string plain_file(const std::vector<Point>& points) {
    std::string text;
    for (Point p : points) text += fmt::format("{} {}\n", p.x, p.y);
    return text;
}

/// Returns sections as lines "x y" without titles, of very different spacing: closed, open, blunt, clockwise, in per
/// cent, away from the origin, and as two surfaces from the nose.
std::vector<std::string> plain_sections() {
    std::vector<std::string> files;
    std::vector<std::vector<Point>> outlines{fixtures::loop, shapes::joukowski(0.1, 0.05, 60),
                                             shapes::ellipse(1, 0.2, 31)};
    for (std::vector<Point> outline : std::vector<std::vector<Point>>(outlines)) {
        for (Point& p : outline) p = {100 * p.x, 100 * p.y};
        outlines.push_back(outline);
        for (Point& p : outline) p = {p.x + 300, p.y - 20};
        outlines.push_back(outline);
    }
    outlines.push_back(naca_airfoil("4412", 40, TrailingEdge::blunt).points);
    for (std::vector<Point> outline : outlines) {
        outline.push_back(outline[0]);
        files.push_back(plain_file(outline));
        std::reverse(outline.begin(), outline.end());
        files.push_back(plain_file(outline));
    }
    files.push_back(fixtures::open_base.substr(6));
    files.push_back(fixtures::two_surfaces_one_run.substr(10));
    files.push_back(fixtures::wedge);
    return files;
}

/// Returns a text with every line replaced; `number` counts from 1.
std::string with_lines(const std::string& text,
                       const std::function<std::string(const std::string&, std::size_t)>& map) {
    std::istringstream in(text);
    std::string line, result;
    for (std::size_t number = 1; std::getline(in, line); ++number) result += map(line, number) + "\n";
    return result;
}

std::string with_separator(const std::string& line, const std::string& separator) {
    const std::size_t space = line.find(' ');
    return line.substr(0, space) + separator + line.substr(space + 1);
}

/// Expects the same outlines from both texts.
void expect_same(const std::string& plain, const std::string& changed) {
    SCOPED_TRACE(changed.substr(0, 500));
    const Geometry expected = parsed(plain);
    try {
        const Geometry found = parsed(changed);
        ASSERT_EQ(found.elements.size(), expected.elements.size());
        for (std::size_t i = 0; i < found.elements.size(); ++i)
            EXPECT_EQ(found.elements[i].points, expected.elements[i].points);
    } catch (const Error& e) {
        ADD_FAILURE() << e.what();
    }
}

TEST(Comments, BetweenCoordinatesChangeNothing) {
    const std::vector<std::string> marks{"#", "%", "!", "//", ";"};
    for (const std::string& plain : plain_sections()) {
        const auto lines = static_cast<std::size_t>(std::count(plain.begin(), plain.end(), '\n'));
        for (std::size_t at = 1; at <= lines; ++at) {
            const std::string& mark = marks[at % marks.size()];
            expect_same(plain, with_lines(plain, [&](const std::string& line, std::size_t number) {
                            return number == at ? mark + " point 5 of 1.0 0.5\n" + line : line;
                        }));
        }
        for (const std::size_t every : {1u, 2u, 3u, 7u})
            expect_same(plain, with_lines(plain, [&](const std::string& line, std::size_t number) {
                            return number % every == 0 ? line + "\n" + marks[number % marks.size()] + "12" : line;
                        }));
    }
}

TEST(Comments, BehindCoordinatesChangeNothing) {
    for (const std::string& plain : plain_sections())
        for (const std::string mark : {" # 3 4", "  % 3", "\t! x", " // 1 2", " ; 1", ";"})
            expect_same(plain, with_lines(plain, [&](const std::string& line, std::size_t) { return line + mark; }));
}

TEST(Comments, DivideElementsThatAreComplete) {
    const std::string first = fixtures::selig.substr(10), second = fixtures::second_body;
    for (const std::string& body : {first, first.substr(0, first.rfind("1.0"))}) {  // closed, and open at the tail
        const Geometry geometry = parsed("# main\n" + body + "# flap\n" + second);
        ASSERT_EQ(geometry.elements.size(), 2u);
        EXPECT_EQ(geometry.elements[0].points.size(), 8u);
        EXPECT_EQ(geometry.elements[1].points.size(), 5u);
    }
}

TEST(Comments, BehindEveryPointOfSeveralElements) {
    for (const std::string between : {"\n# c", "\n", "\n\n% c\n"}) {
        const Geometry geometry =
            parsed(with_lines("0.25 0\n" + fixtures::loop_lines + fixtures::second_body,
                              [&](const std::string& line, std::size_t) { return line + between; }));
        ASSERT_EQ(geometry.elements.size(), 2u);
        EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
        EXPECT_TRUE(says(geometry.elements[0], "line 1: lone point left out"));
    }
}

TEST(Comments, BetweenTheSurfacesOfSeveralElements) {
    const std::string upper = "0 0\n.2 .06\n.5 .07\n.75 .04\n1 0\n", lower = "0 0\n.2 -.04\n.5 -.05\n.75 -.03\n1 0\n";
    const std::string flap =
        "1.02 -0.06\n1.1 -0.04\n1.2 -0.05\n1.3 -0.1\n# lower\n1.02 -0.06\n1.1 -0.09\n1.2 -.1\n1.3 -0.1\n";
    const Geometry geometry = parsed("# upper\n" + upper + "# lower\n" + lower + "# flap, upper\n" + flap);
    ASSERT_EQ(geometry.elements.size(), 2u);
    EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
    EXPECT_EQ(geometry.elements[1].points.size(), 6u);
}

TEST(Separators, ChangeNothing) {
    for (const std::string& plain : plain_sections())
        for (const std::string separator : {",", ";", "\t", ", ", " ;\t", "   "})
            expect_same(plain, with_lines(plain, [&](const std::string& line, std::size_t) {
                            return with_separator(line, separator);
                        }));
}

TEST(Quotes, ChangeNothing) {
    for (const std::string& plain : plain_sections())
        for (const std::string quote : {"\"", "'"})
            for (const std::string separator : {",", ";", " , ", "\t"}) {
                const auto quoted = [&](const std::string& line, std::size_t) {
                    return quote + with_separator(line, quote + separator + quote) + quote;
                };
                expect_same(plain, with_lines(plain, quoted));
                expect_same(plain, with_lines("x y\n" + plain, quoted));
            }
}

TEST(Quotes, RoundWholeLinesAndDecimalCommas) {
    const std::string plain = fixtures::no_title;
    expect_same(plain, with_lines(plain, [](const std::string& line, std::size_t) { return '"' + line + '"'; }));
    expect_same(plain,
                "\"x\",\"y\"\n\"1,0\",\"0,0\"\n\"0,75\",\"0,04\"\n\"0,5\",\"0,07\"\n\"0,2\",\"0,06\"\n\"0\",\"0\"\n"
                "\"0,2\",\"-0,04\"\n\"0,5\",\"-0,05\"\n\"0,75\",\"-0,03\"\n\"1\",\"0\"\n");
    EXPECT_EQ(parsed("\"NACA's 23 012\"\n" + plain).elements[0].title, "\"NACA's 23 012\"");
    expect_same(plain, "'tis Peter's\n" + plain);
}

TEST(Columns, AConstantOneIsLeftOut) {
    for (const std::string& plain : plain_sections())
        for (const std::string value : {"0", "1.5", "-20.25"}) {
            expect_same(plain,
                        with_lines(plain, [&](const std::string& line, std::size_t) { return line + " " + value; }));
            expect_same(plain,
                        with_lines(plain, [&](const std::string& line, std::size_t) { return value + "\t" + line; }));
            expect_same(plain, with_lines(plain, [&](const std::string& line, std::size_t) {
                            return with_separator(line, "," + value + ",");
                        }));
        }
    EXPECT_TRUE(says(parsed(fixtures::z_column).elements[0], "line 2: third column ignored, 0 throughout"));
    const std::string x_first =
        with_lines(fixtures::loop_lines, [](const std::string& line, std::size_t) { return "7 " + line; });
    EXPECT_TRUE(says(parsed(x_first).elements[0], "line 1: first column ignored, 7 throughout"));
}

TEST(Columns, AnIndexIsLeftOut) {
    for (const std::string& plain : plain_sections())
        for (const std::size_t first : {0u, 1u, 101u})
            for (const std::string title : {"", "title\n", "# i x y\n", "\"i\",\"x\",\"y\"\n"}) {
                const auto index = [&](std::size_t number) { return std::to_string(number - 1 + first); };
                expect_same(plain, title + with_lines(plain, [&](const std::string& line, std::size_t number) {
                                       return index(number) + " " + line;
                                   }));
                expect_same(plain, title + with_lines(plain, [&](const std::string& line, std::size_t number) {
                                       return index(number) + "," + with_separator(line, ",") + ",0.0";
                                   }));
            }
    const std::string indexed = with_lines(fixtures::loop_lines, [](const std::string& line, std::size_t number) {
        return std::to_string(number) + " " + line;
    });
    EXPECT_TRUE(says(parsed(indexed).elements[0], "line 1: first column ignored, it counts the points"));
}

TEST(Columns, AnIndexMayBeginAgain) {
    expect_same(
        fixtures::lednicer,
        "t\n5 5\n\n1 0 0\n2 .2 .06\n3 .5 .07\n4 .75 .04\n5 1 0\n\n1 0 0\n2 .2 -.04\n3 .5 -.05\n4 .75 -.03\n5 1 0\n");
}

// In per cent of the chord, x of a table may count the rows.
TEST(Columns, ATableInStepsOfOneIsATable) {
    std::string table = "t\n";
    for (int x = 0; x <= 40; ++x) table += fmt::format("{} {} {}\n", x, 0.02 * x * (40 - x), -0.01 * x * (40 - x));
    EXPECT_EQ(parsed(table).elements[0].format, "table");
    const std::string indexed = with_lines(table.substr(2), [](const std::string& line, std::size_t number) {
        return std::to_string(number) + " " + line;
    });
    EXPECT_EQ(parsed(indexed).elements[0].points, parsed(table).elements[0].points);
}

TEST(Columns, NamesDecide) {
    const std::string plain = fixtures::loop_lines;
    const auto with_pressure = [](const std::string& line, std::size_t number) {
        return line + fmt::format(" {}", 0.3 - 0.07 * static_cast<double>(number * number % 7));
    };
    for (const std::string header :
         {"x y Cp\n", "# x y Cp\n", "\"X\",\"Y\",\"Cp\"\n", "x[m];y[m];p[Pa]\n", "x/c y/c cp\n"})
        expect_same(plain, header + with_lines(plain, with_pressure));
    EXPECT_THROW(parsed(with_lines(plain, with_pressure)), InputError);
    const std::string swapped = with_lines(plain, [](const std::string& line, std::size_t) {
        const std::size_t space = line.find(' ');
        return line.substr(space + 1) + "," + line.substr(0, space);
    });
    expect_same(plain, "y,x\n" + swapped);
}

/// A section given by its camber line and its thickness, which both surfaces follow.
struct Stations {
    std::vector<double> x{0, 0.1, 0.3, 0.6, 0.8, 1}, camber{0, 0.01, 0.02, 0.02, 0.01, 0},
        thickness{0, 0.08, 0.1, 0.08, 0.04, 0};

    double upper(std::size_t i) const { return camber[i] + thickness[i] / 2; }
    double lower(std::size_t i) const { return camber[i] - thickness[i] / 2; }

    /// Returns the outline from the tail over the upper surface.
    std::vector<Point> outline() const {
        std::vector<Point> points;
        for (std::size_t i = x.size(); i-- > 0;) points.push_back({x[i], upper(i)});
        for (std::size_t i = 1; i + 1 < x.size(); ++i) points.push_back({x[i], lower(i)});
        return points;
    }

    /// Returns a file with a header and one row for each station, with the columns that `row(i)` returns.
    std::string file(const std::string& header, const std::function<std::vector<double>(std::size_t)>& row,
                     bool falling = false) const {
        std::string text = header + "\n";
        for (std::size_t k = 0; k < x.size(); ++k)
            text += fmt::format("{}\n", fmt::join(row(falling ? x.size() - 1 - k : k), ","));
        return text;
    }
};

TEST(NamedTables, OfThicknessAndCamber) {
    const Stations s;
    const auto full = [&](std::size_t i) { return std::vector{s.x[i], s.thickness[i], s.camber[i]}; };
    const auto swapped = [&](std::size_t i) { return std::vector{s.camber[i], s.x[i], s.thickness[i]}; };
    const auto half = [&](std::size_t i) { return std::vector{s.x[i], s.camber[i], s.thickness[i] / 2}; };
    const auto along_camber = [&](std::size_t i) { return std::vector{s.x[i], s.camber[i], s.thickness[i]}; };
    for (const bool falling : {false, true}) {
        for (const std::string header :
             {"x,thickness,camber", "x/c,t/c,f/c", "X [mm],Thickness [mm],Camber [mm]", "station,t,yc", "x/t,d/t,f/t"})
            EXPECT_EQ(parsed(s.file(header, full, falling)).elements[0].points, s.outline()) << header;
        EXPECT_EQ(parsed(s.file("camber,x,thickness", swapped, falling)).elements[0].points, s.outline());
        for (const std::string header : {"x,yc,yt", "x,y_c,y_t", "# x/c,camber,half-thickness", "x,camber,t/2"})
            EXPECT_EQ(parsed(s.file(header, half, falling)).elements[0].points, s.outline()) << header;
        // No name says x alone, and no commas divide the names.
        EXPECT_EQ(parsed(s.file("X_c Y_c thickness", along_camber, falling)).elements[0].points, s.outline());
    }
    EXPECT_TRUE(says(parsed(s.file("x,thickness,camber", full)).elements[0],
                     "line 2: table of x, thickness and camber (surfaces at camber +- thickness / 2)"));
    EXPECT_TRUE(says(parsed(s.file("x,yc,yt", half)).elements[0], "(surfaces at camber +- half thickness)"));
}

TEST(NamedTables, OfThicknessAlone) {
    Stations s;
    s.camber.assign(s.x.size(), 0);
    const auto full = [&](std::size_t i) { return std::vector{s.x[i], s.thickness[i]}; };
    const auto half = [&](std::size_t i) { return std::vector{s.x[i], s.thickness[i] / 2}; };
    EXPECT_EQ(parsed(s.file("x/c,t/c", full)).elements[0].points, s.outline());
    EXPECT_EQ(parsed(s.file("x,yt", half)).elements[0].points, s.outline());
}

// The words upper and lower need not stand in the header, and the lower surface may come first.
TEST(NamedTables, OfUpperAndLowerOrdinates) {
    const Stations s;
    const auto upper_first = [&](std::size_t i) { return std::vector{s.x[i], s.upper(i), s.lower(i)}; };
    const auto lower_first = [&](std::size_t i) { return std::vector{s.x[i], s.lower(i), s.upper(i)}; };
    for (const bool falling : {false, true}) {
        for (const std::string header : {"x,yu,yl", "x,upper,lower", "x/c,yo/c,yu/c", "x,yt,yb", "x,y_top,y_bot"})
            EXPECT_EQ(parsed(s.file(header, upper_first, falling)).elements[0].points, s.outline()) << header;
        for (const std::string header : {"x,yl,yu", "x,lower,upper", "x,yb,yt", "x,yu,yo"})
            EXPECT_EQ(parsed(s.file(header, lower_first, falling)).elements[0].points, s.outline()) << header;
    }
    const auto with_slopes = [&](std::size_t i) {
        const double slope = static_cast<double>(i * i);
        return std::vector{s.x[i], s.upper(i), slope, s.lower(i), -slope};
    };
    EXPECT_EQ(parsed(s.file("x/c,y/c_upper,phi_upper,y/c_lower,phi_lower", with_slopes)).elements[0].points,
              s.outline());
}

TEST(NamedTables, OfTheCoordinatesOfBothSurfaces) {
    const Stations s;
    const auto both = [&](std::size_t i) { return std::vector{s.x[i], s.upper(i), s.x[i], s.lower(i)}; };
    const auto lower_first = [&](std::size_t i) { return std::vector{s.x[i], s.lower(i), s.x[i], s.upper(i)}; };
    for (const bool falling : {false, true}) {
        for (const std::string header : {"xu,yu,xl,yl", "x_upper,y_upper,x_lower,y_lower", "Xo,Yo,Xu,Yu", "t",
                                         "station,ordinate,station,ordinate"})
            EXPECT_EQ(parsed(s.file(header, both, falling)).elements[0].points, s.outline()) << header;
        EXPECT_EQ(parsed(s.file("xl,yl,xu,yu", lower_first, falling)).elements[0].points, s.outline());
    }
    EXPECT_EQ(parsed("xu,yu,xl,yl\n0,0,0,0\n.5,.1,.5,-.1\n.7,.08,1,0\n1,0,,\n").elements[0].points,
              (std::vector<Point>{{1, 0}, {0.7, 0.08}, {0.5, 0.1}, {0, 0}, {0.5, -0.1}}));
}

TEST(Columns, AConstantOneOfXAndYAndZIsLeftOut) {
    const std::string plain = fixtures::loop_lines;
    const auto at = [](const std::string& line) { return line.find(' '); };
    expect_same(plain, "X Y Z\n" + with_lines(plain, [&](const std::string& line, std::size_t) {
                           return with_separator(line, " 1.25 ");
                       }));
    expect_same(plain, "x,y,z\n" + with_lines(plain, [&](const std::string& line, std::size_t) {
                           return "-3," + line.substr(0, at(line)) + "," + line.substr(at(line) + 1);
                       }));
    expect_same(plain,
                "x y z\n" + with_lines(plain, [&](const std::string& line, std::size_t) { return line + " 2"; }));
}

TEST(Columns, ALineOfUnitsBelowTheNamesIsNone) {
    expect_same("1 0\n.5 .1\n0 0\n.5 -.1\n1 0\n", "y,x\n[mm],[mm]\n0,1\n.1,.5\n0,0\n-.1,.5\n0,1\n");
}

TEST(Headers, OfNumbersAloneAreTitlesOrCounts) {
    for (const std::string& plain : plain_sections()) {
        const auto points = std::count(plain.begin(), plain.end(), '\n');
        for (const std::string& header :
             {std::string("0012"), std::string("23 012"), std::string("0012 61"), std::to_string(points),
              fmt::format("{} 1", points), fmt::format("{}.", points), std::string("65 2 215"), std::string("2412")}) {
            expect_same(plain, header + "\n" + plain);
            expect_same(plain, "title\n" + header + "\n" + plain);
        }
    }
    const Element e = parsed("23 012\n" + fixtures::loop_lines).elements[0];
    EXPECT_EQ(e.title, "23 012");
    EXPECT_TRUE(says(e, "line 1: '23 012' taken as a title, not as coordinates: one of its numbers starts with 0"));
}

TEST(Headers, OfNumbersAndThenText) {
    const Element e = parsed("23 012\n12 % thick\n" + fixtures::loop_lines).elements[0];
    EXPECT_EQ(e.points, fixtures::loop);
    EXPECT_EQ(e.title, "23 012");
    EXPECT_TRUE(says(e, "line 1: '23 012' taken as a title, not as coordinates: text follows"));
}

// Nine rows follow, which 4 + 05 could announce, but they are one loop.
TEST(Headers, ATitleThatAddsUpToTheNumberOfPoints) {
    expect_same(fixtures::loop_lines, "4 05\n" + fixtures::loop_lines);
}

TEST(Headers, CountsBeforeEachElement) {
    const Geometry geometry = parsed("9\n" + fixtures::selig.substr(10) + "6\n" + fixtures::second_body);
    ASSERT_EQ(geometry.elements.size(), 2u);
    EXPECT_EQ(geometry.elements[1].points.size(), 5u);
}

}  // namespace
}  // namespace lamina
