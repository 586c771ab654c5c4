// DXF, SVG, IGES and STEP: the outlines are those that the curves draw, and nothing that a drawing says makes the
// reader run away.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>
#include <lamina/surface.hpp>

#include "geometry/parse_airfoil.hpp"
#include "support/drawings.hpp"
#include "support/geometry_fixtures.hpp"
#include "support/mutator.hpp"

namespace lamina {
namespace {

using fixtures::dxf;
using fixtures::entity;
using fixtures::has_repair;
using fixtures::iges;
using fixtures::step;
using fixtures::svg;

Geometry of_text(const std::string& text, const GeometryOptions& options = {}) {
    return make_geometry(geometry::parse_airfoil(text, "drawing", options), options);
}

Element element_of(const std::string& text) {
    const Geometry geometry = of_text(text);
    EXPECT_EQ(geometry.elements.size(), 1u);
    return geometry.elements.at(0);
}

std::string message_of(const std::string& text, const GeometryOptions& options = {}) {
    try {
        of_text(text, options);
    } catch (const InputError& error) {
        EXPECT_EQ(error.place().file, "drawing");
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
        return error.what();
    }
    ADD_FAILURE() << "accepted: " << text.substr(0, 400);
    return {};
}

/// Returns the largest distance of the edges of an outline from the unit circle.
double deviation_from_circle(const std::vector<Point>& p) {
    double deviation = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        EXPECT_NEAR(length(p[i]), 1, 1e-12);
        deviation = std::max(deviation, 1 - length(midpoint(p[i], p[(i + 1) % p.size()])));
    }
    return deviation;
}

TEST(Drawings, EveryWayToDrawACircleIsExact) {
    for (const auto& [name, text] : fixtures::unit_circles()) {
        SCOPED_TRACE(name);
        const Element e = element_of(text);
        EXPECT_EQ(e.format, name.substr(0, name.find(' ')));
        EXPECT_TRUE(e.samples_of_curve);
        EXPECT_LE(deviation_from_circle(e.points), 2e-6);  // 1e-6 of the diameter
        EXPECT_LT(e.points.size(), 5000u);
        EXPECT_TRUE(e.given_corners.empty());
    }
}

TEST(Drawings, WallsOfACircleKeepItsShape) {
    for (const auto& [name, text] : fixtures::unit_circles()) {
        SCOPED_TRACE(name);
        const Element wall = prepare_surfaces(of_text(text)).elements[0];
        for (const Point p : wall.points) EXPECT_NEAR(length(p), 1, 1e-8);
    }
}

// A nose of two cubics, a straight rear and a base: corners are those of the base alone.
TEST(Drawings, CornersStayAndSmoothJointsAreNone) {
    const Element e = element_of(svg("<path d='M100,-1 L50,-10 C20,-15.4 0,-12 0,0 C0,12 20,15.4 50,10 L100,1 Z'/>"));
    ASSERT_EQ(e.given_corners.size(), 2u);
    for (const std::size_t corner : e.given_corners) {
        EXPECT_EQ(e.points[corner].x, 100);
        EXPECT_EQ(std::abs(e.points[corner].y), 1);
    }
    // Straight parts beside curves are divided so that neighbours differ by little.
    const std::size_t n = e.points.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (std::binary_search(e.given_corners.begin(), e.given_corners.end(), i)) continue;
        const double before = distance(e.points[(i + n - 1) % n], e.points[i]);
        const double after = distance(e.points[i], e.points[(i + 1) % n]);
        EXPECT_LT(std::max(before, after), 2.2 * std::min(before, after)) << i;
    }
}

TEST(Drawings, PathsMayBeWrittenInManyWays) {
    const std::vector<Point> expected = element_of(svg("<polygon points='4,0 2,-1 0,0 2,1'/>")).points;
    EXPECT_EQ(expected.size(), 4u);
    for (const std::string path :
         {"M4 0L2-1 0 0 2 1Z", "m4,0l-2-1-2 1 2 1z", "M 4 0 L 2 -1 L 0 0 L 2 1 L 4 0", "M4e0.0,2-1,0,0,2,1z"}) {
        EXPECT_EQ(element_of(svg("<path id='a' d='" + path + "'/>")).points, expected) << path;
    }
    const Element box = element_of(svg("<path d='M0 0H3V2H0Z'/>"));
    EXPECT_EQ(box.points, element_of(svg("<rect width='3' height='2mm'/>")).points);
    EXPECT_EQ(bounding_box(Geometry{{box}}).lower.y, -2) << "y points down";
    // The same curve by C and S, and by Q and T.
    const auto curve = [](const std::string& d) { return element_of(svg("<path d='" + d + "'/>")).points; };
    EXPECT_EQ(curve("M0 0C.5 .5 1 1 2 0C3 -1 3.5 -.5 4 0L2 5Z"), curve("M0 0c.5.5 1 1 2 0s1.5-.5 2 0L2 5z"));
    EXPECT_EQ(curve("M0 0Q1 1 2 0Q3 -1 4 0L2 5Z"), curve("M0 0q1 1 2 0t2 0L2 5z"));
}

TEST(Drawings, GroupsTransformAndHideShapes) {
    const std::string box = "<rect x='1' y='1' width='2' height='1'/>";
    const auto lower = [&](const std::string& group) {
        return bounding_box(Geometry{{element_of(svg("<g transform='" + group + "'>" + box + "</g>"))}}).lower;
    };
    EXPECT_EQ(lower("translate(10 5)"), (Point{11, -7}));
    EXPECT_EQ(lower("matrix(2,0,0,3,0,0)"), (Point{2, -6}));
    EXPECT_NEAR(lower("rotate(90)").x, -2, 1e-12);
    EXPECT_NEAR(lower("rotate(180, 2, 1.5)").x, 1, 1e-12);
    EXPECT_NEAR(lower("skewX(45)").x, 2, 1e-12);
    const Element e = element_of(svg(box + "<g style='display:none'><circle r='9'/></g><defs><circle r='8'/></defs>"
                                           "<text x='1'>A</text><use href='#a'/><!-- <circle r='7'/> -->"));
    EXPECT_EQ(e.points.size(), 4u);
    EXPECT_TRUE(has_repair(e, "2 hidden or unplaced shapes, 1 text, 1 use (unlink clones)"));
}

std::string lines_of_dxf(const std::vector<std::pair<Point, Point>>& lines) {
    std::string text;
    for (const auto& [a, b] : lines)
        text += entity("LINE", {fmt::format("10 {}", a.x), fmt::format("20 {}", a.y), fmt::format("11 {}", b.x),
                                fmt::format("21 {}", b.y)});
    return text;
}

TEST(Drawings, CurvesInAnyOrderAndDirectionAreJoined) {
    const std::string text =
        dxf(lines_of_dxf({{{4, 0}, {2, 1}}, {{0, 0}, {2, -1}}, {{2, -1}, {4, 1e-6}}, {{0, 0}, {2, 1}}}));
    const Element e = element_of(text);
    EXPECT_EQ(e.points.size(), 4u);
    EXPECT_FALSE(e.samples_of_curve);
}

TEST(Drawings, ConstructionLinesAreLeftOut) {
    const std::string outline =
        lines_of_dxf({{{4, 0}, {2, 1}}, {{2, 1}, {0, 0}}, {{0, 0}, {2, -1}}, {{2, -1}, {4, 0}}});
    const std::vector<std::pair<std::string, std::string>> extras{
        {lines_of_dxf({{{0, 0}, {4, 0}}}), "1 construction line left out"},
        {lines_of_dxf({{{0, 0}, {-1, 0}}}), "1 construction line left out"},
        {lines_of_dxf({{{2, 1}, {2, -1}}}), "1 construction line left out"},
        {outline, "4 curves drawn twice"},
        {entity("TEXT", {"1 chord"}) + entity("DIMENSION", {}), "1 DIMENSION, 1 TEXT"},
        {entity("LINE", {"6 CENTER", "10 0", "20 0", "11 9", "21 9"}), "1 centre lines"},
        {entity("CIRCLE", {"67 1", "10 0", "20 0", "40 9"}), "1 entities of the paper"},
        {entity("CIRCLE", {"10 2", "20 0", "40 0.01"}), "1 outline left out: below 1 %"},
        {entity("CIRCLE", {"10 2", "20 0", "40 0.3"}), "1 outline left out: inside another one"},
        {entity("LWPOLYLINE", {"70 1", "10 -9", "20 -9", "10 9", "20 -9", "10 9", "20 9", "10 -9", "20 9"}),
         "1 outline left out: a frame"},
        {entity("CIRCLE", {"10 2", "20 0", "40 99"}), "1 outline left out: a frame"}};
    for (const auto& [extra, note] : extras) {
        const Element e = element_of(dxf(outline + extra));
        EXPECT_EQ(e.points.size(), 4u) << note;
        EXPECT_TRUE(has_repair(e, note)) << note << ": " << fmt::format("{}", e.repairs.at(0));
    }
}

/// Returns a section of straight lines with spars at these abscissae, of which each is a vertex of both sides.
std::string section_with_spars(const std::vector<double>& spars, double height) {
    std::vector<Point> outline{{10, 0}};
    for (std::size_t k = spars.size(); k-- > 0;) outline.push_back({spars[k], height});
    outline.push_back({0, 0});
    for (const double x : spars) outline.push_back({x, -height});
    std::vector<std::pair<Point, Point>> lines;
    for (std::size_t i = 0; i < outline.size(); ++i) lines.emplace_back(outline[i], outline[(i + 1) % outline.size()]);
    for (const double x : spars) lines.push_back({{x, -height}, {x, height}});
    return dxf(lines_of_dxf(lines));
}

TEST(Drawings, SparsAtNeighbouringVerticesAreLeftOut) {
    for (const double height : {0.3, 3.0}) {
        for (const std::vector<double>& spars : {std::vector{2.0, 4.0}, {2.0, 4.0, 6.0}, {1.0, 2.0, 4.0, 8.0}}) {
            const Element e = element_of(section_with_spars(spars, height));
            EXPECT_EQ(e.points.size(), 2 * spars.size() + 2);
            EXPECT_TRUE(has_repair(e, fmt::format("{} construction lines left out", spars.size())));
        }
    }
    // Neither the longest nor the shortest lines first leave one outline.
    EXPECT_NE(message_of(section_with_spars({1, 1.1, 5}, 0.3)).find("not clear which of them"), std::string::npos);
    // A line that joins two outlines.
    const std::string second = lines_of_dxf({{{6, 0}, {8, 1}}, {{8, 1}, {8, -1}}, {{8, -1}, {6, 0}}});
    const Geometry two = of_text(dxf(lines_of_dxf({{{4, 0}, {0, 1}}, {{0, 1}, {0, -1}}, {{0, -1}, {4, 0}}}) + second +
                                     lines_of_dxf({{{4, 0}, {6, 0}}})));
    EXPECT_EQ(two.elements.size(), 2u);
}

TEST(Drawings, PolylinesEndWithoutSeqendAndMissingBlocksAreNamed) {
    const auto vertex = [](const char* x, const char* y) {
        return entity("VERTEX", {std::string("10 ") + x, std::string("20 ") + y});
    };
    const Element e = element_of(dxf(entity("POLYLINE", {"66 1", "70 1"}) + vertex("0", "0") + vertex("4", "0") +
                                     vertex("4", "1") + entity("POLYLINE", {"66 1", "60 1"}) + vertex("9", "9") +
                                     entity("SEQEND", {}) + entity("INSERT", {"2 none", "10 0", "20 0"})));
    EXPECT_EQ(e.points.size(), 3u);
    EXPECT_TRUE(has_repair(e, "1 INSERT of a block that is missing, 1 hidden entities"));
}

TEST(Drawings, LengthsInPercentAreLeftOut) {
    const Element e = element_of(svg("<rect width='3' height='2mm'/><circle cx='1' cy='50%' r='1'/>"));
    EXPECT_EQ(e.points.size(), 4u);
    EXPECT_TRUE(has_repair(e, "1 shapes with lengths in percent"));
}

TEST(Drawings, CompositeCurvesOfIgesHaveTheirPartsAlone) {
    const Geometry geometry = of_text(iges({{102, "2,3,5,0,1,7", 9},
                                            {100, "0,0,0,1,0,-1,0", 0, 0, "00010000"},
                                            {100, "0,0,0,-1,0,1,0", 0, 0, "00010000"},
                                            {100, "0,0,0,1,0,1,0"},
                                            {124, "1,0,0,10,0,1,0,0,0,0,1,0"}}));
    ASSERT_EQ(geometry.elements.size(), 2u);
    EXPECT_NEAR(bounding_box(geometry).lower.x, -1, 1e-12);
    EXPECT_NEAR(bounding_box(geometry).upper.x, 11, 1e-12);
    EXPECT_NE(message_of(iges({{102, "9,3"}, {110, "0,0,0,1,1,0"}})).find("announces more"), std::string::npos);
}

TEST(Drawings, OtherConicsOfIgesAreLeftOut) {
    const Element e = element_of(iges({{104, "1,0,-1,0,0,-1,0,1,0,2,1.7"}, {100, "0,0,0,1,0,1,0"}}));
    EXPECT_TRUE(has_repair(e, "1 IGES entity 104"));
}

TEST(Drawings, TheErrorOfTheFirstPlaneIsShown) {
    const std::string head = "3,3,0,0,1,0,0,0,0,0,1,1,1,1,1,1,1,1,", tail = ",0,1,0,0,1";
    const std::string message = message_of(iges({{126, head + "0,0,0,1,1,0,2,1,0,3,0,0" + tail},
                                                 {126, head + "9,9,0,8,8,0,7,8,0,6,9,0" + tail},
                                                 {110, "0,0,5,1,0,5"},
                                                 {110, "1,0,5,1,1,5"}}));
    EXPECT_NE(message.find("close no outline: the longest of 2"), std::string::npos) << message;
}

TEST(Drawings, HiddenLayersAndUnitsOfDxf) {
    const std::string before = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nTABLES\n" +
                               entity("LAYER", {"2 off", "70 0", "62 -7"}) + "0\nENDSEC\n";
    const Element e = element_of(dxf(entity("CIRCLE", {"40 1"}) + "0\nCIRCLE\n8\noff\n10\n5\n20\n0\n40\n1\n", before));
    EXPECT_EQ(e.unit, "mm");
    EXPECT_TRUE(has_repair(e, "1 hidden entities"));
}

TEST(Drawings, SeveralOutlinesAreElements) {
    const Geometry geometry = of_text(dxf(entity("CIRCLE", {"10 0", "20 0", "40 1"}) +
                                          entity("ELLIPSE", {"10 5", "20 0", "11 2", "21 0", "40 0.3"})));
    ASSERT_EQ(geometry.elements.size(), 2u);
    EXPECT_NEAR(bounding_box(Geometry{{geometry.elements[1]}}).width(), 4, 1e-12);
}

TEST(Drawings, AnOpenBaseIsClosed) {
    const Element e = element_of(svg("<path d='M100,-1 C20,-30 0,-12 0,0 C0,12 20,30 100,1'/>"));
    EXPECT_TRUE(has_repair(e, "open end closed"));
}

TEST(Drawings, TheSectionOfAWingLiesInOneOfItsPlanes) {
    // Both ends of an extruded ellipse, in planes y = 0 and y = 5, and two edges between them.
    const std::string matrix_0 = "1,0,0,0,0,0,1,0,0,1,0,0", matrix_5 = "1,0,0,0,0,0,1,5,0,1,0,0";
    const std::string ellipse = "0.25,0,1,0,0,-1,0,2,0,2,0";
    const Element e = element_of(iges({{124, matrix_0},
                                       {124, matrix_5},
                                       {104, ellipse, 1, 1},
                                       {104, ellipse, 3, 1},
                                       {110, "2,0,0,2,5,0"},
                                       {110, "-2,0,0,-2,5,0"},
                                       {116, "0,0,0"},
                                       {126, "1,1,0,0,1,0,0,0,1,1,1,1,7,7,7,8,8,8,0,1,0,0,1", 0, 0, "00010500"}}));
    EXPECT_TRUE(has_repair(e, "the plane y = 0, with x and z as coordinates"));
    EXPECT_TRUE(has_repair(e, "1 IGES entity 116, 1 curves of surface parameters"));
    EXPECT_NEAR(bounding_box(Geometry{{e}}).height(), 2, 1e-12);
    EXPECT_EQ(e.unit, "mm");
}

TEST(Drawings, EdgesOfStepAreParts) {
    // The upper half of a spline whose whole is longer, and a line, in millimetres.
    const Element e = element_of(
        step("#1=CARTESIAN_POINT('',(0.,0.));\n#2=CARTESIAN_POINT('',(2.,4.));\n#3=CARTESIAN_POINT('',(4.,0.));\n"
             "#4=B_SPLINE_CURVE_WITH_KNOTS('a;b',2,(#1,#2,#3),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.),.UNSPECIFIED.);\n"
             "#5=CARTESIAN_POINT('',(1.,1.5));\n#6=VERTEX_POINT('',#5);\n#7=CARTESIAN_POINT('',(3.,1.5));\n"
             "#8=VERTEX_POINT('',#7);\n#9=DIRECTION('',(1.,0.));\n#10=VECTOR('',#9,1.);\n#11=LINE('',#5,#10);\n"
             "/* a comment; with a semicolon */ #12=EDGE_CURVE('',#6,#8,#4,.T.);\n#13=EDGE_CURVE('',#8,#6,#11,.F.);\n"
             "#14=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"));
    EXPECT_EQ(e.unit, "mm");
    const Box box = bounding_box(Geometry{{e}});
    EXPECT_NEAR(box.lower.y, 1.5, 1e-9);
    EXPECT_NEAR(box.upper.y, 2, 1e-6);
    EXPECT_NEAR(box.width(), 2, 1e-9);
    EXPECT_EQ(e.given_corners.size(), 2u);
}

TEST(Drawings, StepWithoutEdgesGivesItsCurves) {
    const std::string circle =
        "#1=CARTESIAN_POINT('',(0.,0.));\n#2=DIRECTION('',(1.,0.));\n#3=AXIS2_PLACEMENT_2D('',#1,#2);\n"
        "#4=CIRCLE('',#3,1.);\n#5=CARTESIAN_POINT('',(1.,0.));\n#6=CARTESIAN_POINT('',(-1.,0.));\n";
    EXPECT_LT(deviation_from_circle(element_of(step(circle)).points), 2e-6);
    const Element half = element_of(step(circle + "#7=TRIMMED_CURVE('',#4,(#5),(#6),.T.,.CARTESIAN.);\n"
                                                  "#8=POLYLINE('',(#6,#5));\n"));
    EXPECT_NEAR(bounding_box(Geometry{{half}}).height(), 1, 1e-12);
}

/// Returns the unit circle as a closed spline of STEP, #30, whose seam is at (1, 0), with points on the axes, #10 to
/// #18, and further instances.
std::string spline_of_step(const std::string& more) {
    for (auto [name, text] : fixtures::unit_circles())
        if (name == "step spline") return text.insert(text.rfind("ENDSEC;"), more);
    return {};
}

TEST(Drawings, ClosedSplinesOfStepMayBeTrimmedAtTheirSeam) {
    std::string vertices;  // #40 at (1, 0), and on by quarters
    for (int k = 0; k < 4; ++k) vertices += fmt::format("#{}=VERTEX_POINT('',#{});\n", 40 + k, 10 + 2 * k);
    const auto edge = [](int number, int from, int to, const char* sense = ".T.") {
        return fmt::format("#{}=EDGE_CURVE('',#{},#{},#30,{});\n", number, from, to, sense);
    };
    for (const std::string& edges :
         {edge(50, 40, 42) + edge(51, 42, 40), edge(50, 41, 43) + edge(51, 43, 41), edge(50, 40, 40), edge(50, 42, 42),
          edge(50, 40, 42, ".F.") + edge(51, 40, 42), edge(50, 43, 43, ".F.")}) {
        SCOPED_TRACE(edges);
        EXPECT_LE(deviation_from_circle(element_of(spline_of_step(vertices + edges)).points), 2e-6);
    }
    const std::string open = "#31=B_SPLINE_CURVE_WITH_KNOTS('',1,(#10,#14),.U.,.F.,.F.,(2,2),(0.,1.),.U.);\n";
    const std::string message =
        message_of(spline_of_step(open + vertices + "#50=EDGE_CURVE('',#42,#40,#31,.T.);\n" + edge(51, 42, 40)));
    EXPECT_NE(message.find("its end comes before its start"), std::string::npos) << message;
}

TEST(Drawings, ParametersTrimSplinesOfStep) {
    const auto box_of = [](const std::string& from, const std::string& to, const std::string& rest) {
        return bounding_box(of_text(spline_of_step(fmt::format(
            "#31=TRIMMED_CURVE('',#30,(PARAMETER_VALUE({})),(PARAMETER_VALUE ( {} )),{});\n", from, to, rest))));
    };
    const Box upper = box_of("0.", "2.", ".T.,.PARAMETER.);\n#32=POLYLINE('',(#14,#10)");
    EXPECT_NEAR(upper.lower.y, 0, 1e-12);
    EXPECT_NEAR(upper.upper.y, 1, 1e-12);
    const Box right = box_of("3.", "1.", ".T.,.PARAMETER.);\n#32=POLYLINE('',(#12,#16)");
    EXPECT_NEAR(right.lower.x, 0, 1e-12);
    EXPECT_NEAR(right.upper.x, 1, 1e-12);
    EXPECT_NEAR(box_of("2.", "0.", ".F.,.PARAMETER.);\n#32=POLYLINE('',(#14,#10)").lower.y, 0, 1e-12);
}

TEST(Drawings, TheSenseOfTrimmedCurvesBelowEdgesCounts) {
    const std::string circle =
        "#1=CARTESIAN_POINT('',(0.,0.));\n#2=DIRECTION('',(1.,0.));\n#3=AXIS2_PLACEMENT_2D('',#1,#2);\n"
        "#4=CIRCLE('',#3,1.);\n#5=CARTESIAN_POINT('',(1.,0.));\n#6=CARTESIAN_POINT('',(-1.,0.));\n"
        "#7=VERTEX_POINT('',#5);\n#8=VERTEX_POINT('',#6);\n#9=VECTOR('',#2,1.);\n#10=LINE('',#5,#9);\n"
        "#11=TRIMMED_CURVE('',#4,(#5),(#6),.F.,.CARTESIAN.);\n#12=EDGE_CURVE('',#8,#7,#10,.T.);\n";
    const Box box = bounding_box(of_text(step(circle + "#13=EDGE_CURVE('',#7,#8,#11,.T.);\n")));
    EXPECT_NEAR(box.lower.y, -1, 1e-12);
    EXPECT_NEAR(box.upper.y, 0, 1e-12);
}

TEST(Drawings, UnitsOfStepHaveNames) {
    const std::string metre = "#31=(LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.));\n";
    const auto unit_of = [](const std::string& units) { return element_of(spline_of_step(units)).unit; };
    EXPECT_EQ(unit_of(metre), "m");
    EXPECT_EQ(unit_of("#31=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT( .MILLI. , .METRE. ));\n"), "mm");
    for (const auto& [name, unit] : {std::pair{"FOOT", "ft"}, {"INCH", "in"}, {"inch", "in"}, {"MILE", ""}})
        EXPECT_EQ(unit_of(metre + fmt::format("#32=(CONVERSION_BASED_UNIT('{}',#33)LENGTH_UNIT()NAMED_UNIT(#34));\n"
                                              "#33=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(0.3048),#31);\n",
                                              name)),
                  unit);
    EXPECT_EQ(unit_of("#32=(CONVERSION_BASED_UNIT('DEGREE',#33)NAMED_UNIT(#34)PLANE_ANGLE_UNIT());\n" + metre), "m");
}

TEST(Drawings, RefusalsSayWhereAndWhatHelps) {
    const auto says = [](const std::string& text, const std::string& said) {
        const std::string message = message_of(text);
        EXPECT_NE(message.find(said), std::string::npos) << message;
    };
    says("AutoCAD Binary DXF\r\n\x1a", "in binary form: save it as ASCII");
    says(dxf(entity("3DSOLID", {})), "without curves that lamina reads (1 3DSOLID): save it as ASCII");
    says(svg("<text>a</text>"), "without curves that lamina reads (1 text): turn objects to paths");
    says(iges({{144, "1,0,0"}}), "without curves that lamina reads (1 IGES entity 144)");
    says(step("#1=POINT('');\n"), "without curves that lamina reads: export the section's edges");
    says(dxf(lines_of_dxf({{{0, 0}, {1, 0}}, {{1, 0}, {1, 1}}})), "straight lines alone");
    says(dxf(entity("CIRCLE", {"40 one"})), "drawing:10: 'one' is not a number");
    says(dxf(entity("CIRCLE", {"40 1e99"})), "is not a number");
    says(dxf("0\n"), "is not a");
    says(svg("<g transform='scale(1e50)'><circle r='1e50'/></g>"), "the SVG circle: coordinates above 1e+60");
    says("0\nSECTION\n2\nENTITIES\n0", "ends within a group");
    says(dxf(entity("SPLINE", {"71 3", "10 0", "20 0", "10 1", "20 1"})),
         "SPLINE: it has 2 control points for degree 3");
    says(dxf(entity("SPLINE", {"71 1", "40 0", "40 0", "10 0", "20 0", "10 1", "20 1"})), "2 knots where 4 belong");
    says(dxf(entity("SPLINE", {"71 4000000000", "10 0", "20 0"})), "degree is not from 1 to 25");
    says(svg("<path d='M0 0 L 1 x'/>"), "drawing:3: 'x' stands in an SVG path where a number belongs");
    says(svg("<path d='1 2'/>"), "where a number belongs");
    says(iges({{126, "1000000,3,0,0,0,0,0,0"}}), "announces more than it holds");
    says(iges({{110, "0,0,0"}}), "its parameters end too early");
    says(iges({{110, "0,0,0,1,1,0", 5}}), "its transformation 5 is none");
    says(iges({{124, "1,0,0,0,0,1,0,0,0,0,1,0", 1}, {110, "0,0,0,1,1,0", 1}}), "its transformation 1 is none");
    says(iges({{102, "1,3"}, {102, "2,1,5"}, {110, "0,0,0,1,1,0"}}), "too many composite curves");
    says(step("#1=EDGE_CURVE('',#2,#3,#4,.T.);\n"), "it is named, but missing");
    says(step("#1=CARTESIAN_POINT('',(0.,0.));\n#2=VERTEX_POINT('',#1);\n#4=SURFACE_CURVE('',#4,(),.PCURVE_S1.);\n"
              "#5=EDGE_CURVE('',#2,#2,#4,.T.);\n"),
         "in a circle");
    says(step("#1=CARTESIAN_POINT('',(0.,0.));\n#4=B_SPLINE_CURVE_WITH_KNOTS('',1,(#1,#1),.U.,.F.,.F.,(4000000000,2),"
              "(0.,1.),.U.);\n"),
         "more knots than it can have");
    for (const char* name : {"wing.igs", "WING.IGS", "wing.Step", "wing.STP"}) {
        try {
            geometry::parse_airfoil("nothing", name, {});
            ADD_FAILURE();
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("by its name, but not by what it holds"), std::string::npos);
        }
    }
    // The curves of two chains that share no ends.
    says(svg("<path d='M0 0C1 1 2 1 3 0'/><path d='M5 5C6 6 7 6 8 5'/>"),
         "the curves close no outline: the longest of 2");
    // Three curves between the same two places are no outline.
    says(svg("<path d='M0 0C1 1 2 1 3 0'/><path d='M0 0C1-1 2-1 3 0'/><path d='M0 0C1 .5 2 .5 3 0'/>"),
         "3 curves meet there");
    // Off any plane.
    says(iges({{126, "3,3,0,0,1,0,0,0,0,0,1,1,1,1,1,1,1,1,0,0,0,1,2,3,4,1,5,9,9,1,0,1,0,0,1"}}), "in no plane");
}

TEST(Drawings, BlocksInBlocksAreBounded) {
    std::string blocks = "0\nSECTION\n2\nBLOCKS\n", inserts;
    for (int i = 0; i < 100; ++i) inserts += entity("INSERT", {"2 next", "10 0", "20 0"});
    blocks += entity("BLOCK", {"2 next"}) + inserts + entity("ENDBLK", {}) + "0\nENDSEC\n";
    EXPECT_NE(message_of(dxf(entity("INSERT", {"2 next"}), blocks)).find("put into itself"), std::string::npos);
    std::string ladder = "0\nSECTION\n2\nBLOCKS\n";
    for (int level = 0; level < 6; ++level) {
        ladder += entity("BLOCK", {fmt::format("2 b{}", level)}) + entity("CIRCLE", {"40 1"});
        for (int i = 0; level > 0 && i < 40; ++i) ladder += entity("INSERT", {fmt::format("2 b{}", level - 1)});
        ladder += entity("ENDBLK", {});
    }
    EXPECT_NE(message_of(dxf(entity("INSERT", {"2 b5"}), ladder + "0\nENDSEC\n")).find("in"), std::string::npos);
    std::string deep;
    for (int i = 0; i < 1000; ++i) deep += "<g>";
    EXPECT_NE(message_of(svg(deep + "<circle r='1'/>")).find("inside each other"), std::string::npos);
}

TEST(Drawings, ManyCurvesTakeLittleTime) {
    // As many chains, small outlines and places as fit into some megabytes.
    std::string circles, star;
    for (int i = 0; i < 20'000; ++i) {
        circles += fmt::format("<circle cx='{}' r='{}'/>", 3 * (i % 100), i == 0 ? 1 : 0.001);
        star += fmt::format("<line x1='0' y1='0' x2='{}' y2='{}'/>", std::cos(i), std::sin(i));
    }
    EXPECT_EQ(element_of(svg(circles)).format, "svg");
    EXPECT_NE(message_of(svg(star)).find("curves meet there"), std::string::npos);
    // A long instance that all edges name, declarations without end, and composite curves with matrices of matrices.
    std::string edges = "#1=CARTESIAN_POINT('',(0.,0.));\n#2=VERTEX_POINT('',#1);\n#3=(BOUNDED_CURVE()A('" +
                        std::string(300'000, 'x') + "'));\n";
    for (int i = 0; i < 20'000; ++i) edges += fmt::format("#{}=EDGE_CURVE('',#2,#2,#3,.T.);\n", 10 + i);
    EXPECT_NE(message_of(step(edges)).find("named too often"), std::string::npos);
    std::string declarations;
    for (int i = 0; i < 300'000; ++i) declarations += "<!>";
    EXPECT_EQ(element_of(svg(declarations + "<circle r='1'/>")).format, "svg");
    std::string apart;
    for (int i = 0; i < 2500; ++i) apart += fmt::format("<circle cx='{}' r='1'/>", 3 * i);
    EXPECT_NE(message_of(svg(apart)).find("more than 2000 outlines"), std::string::npos);
}

// Whatever the bytes of a damaged drawing, the reader ends with a simple geometry or with an error.
TEST(Drawings, DamagedOnesGiveASimpleGeometryOrAnError) {
    std::vector<std::string> seeds;
    for (const auto& [name, text] : fixtures::unit_circles()) seeds.push_back(text);
    seeds.push_back(svg("<path d='M100,-1 L50,-10 C20,-15.4 0,-12 0,0 Q0,12 20,15.4 A30 9 0 0 1 100,1 Z'/>"));
    const test::Mutator mutator(11, {"nan", "1e60", "-1", "0", "9999999", "(", ")", ",", "#1", "'", ";", "1H,",
                                     "1e-300", "Z", "M", "\n", "0\nSPLINE\n", "<g>", "4H"});
    test::expect_taken_or_refused(mutator, seeds, 6000, [](const std::string& text) {
        const Geometry geometry = of_text(text);
        ASSERT_NO_THROW(check_simple(geometry)) << text;
    });
}

}  // namespace
}  // namespace lamina
