// Transformations: texts, inverses, order and names.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>

#include "support/geometry_fixtures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

/// Returns the transformations that these texts stand for.
std::vector<Transformation> parsed_transformations(const std::vector<std::string>& texts) {
    std::vector<Transformation> result;
    for (const std::string& text : texts) result.push_back(parse_transformation(text));
    return result;
}

Geometry transformed_by(const Geometry& geometry, const std::vector<std::string>& texts) {
    return transformed(geometry, parsed_transformations(texts));
}

/// Expects the same points in the same order, within a tolerance.
void expect_near(const Geometry& a, const Geometry& b, double tolerance) {
    ASSERT_EQ(a.elements.size(), b.elements.size());
    for (std::size_t i = 0; i < a.elements.size(); ++i) {
        const std::vector<Point>&p = a.elements[i].points, &q = b.elements[i].points;
        ASSERT_EQ(p.size(), q.size());
        for (std::size_t k = 0; k < p.size(); ++k) EXPECT_LE(distance(p[k], q[k]), tolerance) << k;
        EXPECT_EQ(a.elements[i].lines, b.elements[i].lines);
    }
}

/// Returns two sections side by side, with lines.
Geometry two_sections() {
    Geometry geometry = shapes::geometry(
        {naca_airfoil("2412", 60).points, shapes::moved(naca_airfoil("0012", 40).points, 0.3, 0.3, {1.1, -0.05})});
    for (Element& e : geometry.elements)
        for (std::size_t i = 0; i < e.points.size(); ++i) e.lines.push_back(i + 2);
    return geometry;
}

TEST(TransformationText, IsReadBack) {
    for (const std::string text :
         {"flap:scale:0.001:0,0", "all:scale:25.4:1,-2e-05", "a-b.c+d:rotate:-30:0.8,0", "x:rotate:360:0,0",
          "x:shift:-0.1,1e+20", "x:mirror:0", "x:mirror:-0.25", "x:flap:20:0.75,0.01", "x:flap:-90:0,0"})
        EXPECT_EQ(transformation_text(parse_transformation(text)), text);
    EXPECT_EQ(transformation_text(parse_transformation("x:mirror")), "x:mirror:0");
    EXPECT_EQ(transformation_text(parse_transformation("x:scale:2")), "x:scale:2:0,0");
    EXPECT_EQ(transformation_text(parse_transformation("x:rotate:5")), "x:rotate:5:0,0");
}

TEST(TransformationText, IsRefusedWithTheReason) {
    struct Case {
        const char *text, *reason;
    };
    for (const auto& [text, reason] : {Case{"", "a transformation is ELEMENT:scale:S"},
                                       {"flap", "a transformation is"},
                                       {":mirror", "a transformation is"},
                                       {"rotate:30", "a transformation is"},
                                       {"x:turn:30", "a transformation is"},
                                       {"x:mirror:1:2", "a transformation is"},
                                       {"x:flap:30", "a transformation is"},
                                       {"x:shift", "a transformation is"},
                                       {"x:scale:0", "the factor must be > 0"},
                                       {"x:scale:-1", "the factor must be > 0"},
                                       {"x:scale:nan", "is not a number"},
                                       {"x:shift:1", "two coordinates"},
                                       {"x:shift:1,2,3", "two coordinates"},
                                       {"x:rotate:1e9", "from -360 to 360"},
                                       {"x:flap:91:0,0", "from -90 to 90"},
                                       {"x:rotate:30:a,b", "is not a number"}})
        try {
            parse_transformation(text);
            ADD_FAILURE() << text;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    // The library refuses the same values.
    GeometryOptions options;
    options.transformations = {{"all", Scaling{.factor = -1}}};
    EXPECT_THROW(validate(options), OptionError);
}

TEST(Transformed, AnInverseGivesTheGivenPoints) {
    const Geometry given = two_sections();
    const std::vector<std::string> pairs[] = {{"all:scale:1000", "all:scale:0.001"},
                                              {"all:scale:3:0.25,-7", "all:scale:0.333333333333333333:0.25,-7"},
                                              {"body1:rotate:-37.5:0.3,0.4", "body1:rotate:37.5:0.3,0.4"},
                                              {"body0:rotate:350", "body0:rotate:10"},
                                              {"all:rotate:180:0.5,0", "all:rotate:-180:0.5,0"},
                                              {"all:shift:3,-0.7", "all:shift:-3,0.7"},
                                              {"body1:mirror:0.3", "body1:mirror:0.3"}};
    for (const std::vector<std::string>& pair : pairs) {
        SCOPED_TRACE(pair[0]);
        expect_near(transformed_by(given, pair), given, 1e-14);
        const Geometry once = transformed_by(given, {pair[0]});
        EXPECT_FALSE(once.elements[0].points == given.elements[0].points &&
                     once.elements[1].points == given.elements[1].points);
        EXPECT_NO_THROW(check_simple({{once.elements[0]}}));
        EXPECT_NO_THROW(check_simple({{once.elements[1]}}));
    }
}

TEST(Transformed, SizesAndDirectionsAreAsAsked) {
    const Geometry given = shapes::geometry({shapes::box()});
    const auto points = [&](const std::string& text) { return transformed_by(given, {text}).elements[0].points; };
    // Multiples of 90 degrees are exact, and positive angles are counter-clockwise.
    EXPECT_EQ(points("all:rotate:90"), (std::vector<Point>{{0, 0}, {0, 1}, {-1, 1}, {-1, 0}}));
    EXPECT_EQ(points("all:rotate:-90"), (std::vector<Point>{{0, 0}, {0, -1}, {1, -1}, {1, 0}}));
    EXPECT_EQ(points("all:rotate:180:1,0"), (std::vector<Point>{{2, 0}, {1, 0}, {1, -1}, {2, -1}}));
    EXPECT_EQ(points("all:rotate:360"), given.elements[0].points);
    EXPECT_EQ(points("all:scale:2:1,1"), (std::vector<Point>{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
    EXPECT_EQ(points("all:shift:2,-3"), (std::vector<Point>{{2, -3}, {3, -3}, {3, -2}, {2, -2}}));
    EXPECT_EQ(points("all:mirror:1"), (std::vector<Point>{{0, 2}, {0, 1}, {1, 1}, {1, 2}}));
    EXPECT_NEAR(points("all:rotate:30")[1].x, std::sqrt(0.75), 1e-15);
    EXPECT_NEAR(points("all:rotate:30")[1].y, 0.5, 1e-15);
    // Left and right are exchanged by half a turn and a mirror.
    EXPECT_EQ(transformed_by(given, {"all:rotate:180:0.5,0", "all:mirror"}).elements[0].points,
              (std::vector<Point>{{1, 0}, {1, 1}, {0, 1}, {0, 0}}));
}

TEST(Transformed, OrderCountsAndIsNoted) {
    const Geometry given = shapes::geometry({shapes::box()});
    const Geometry one = transformed_by(given, {"all:scale:2", "body0:shift:1,0"});
    const Geometry other = transformed_by(given, {"body0:shift:1,0", "all:scale:2"});
    EXPECT_EQ(one.elements[0].points[0], (Point{1, 0}));
    EXPECT_EQ(other.elements[0].points[0], (Point{2, 0}));
    EXPECT_EQ(one.elements[0].transformations,
              (std::vector<std::string>{"scaled by 2 about (0, 0)", "shifted by (1, 0)"}));
}

TEST(Transformed, LinesStayWithTheirPoints) {
    const Geometry given = fixtures::read(fixtures::selig);
    for (const Geometry& mirrored :
         {transformed_by(given, {"airfoil:mirror"}), transformed_by(given, {"all:rotate:180", "all:mirror"})}) {
        const Element &a = given.elements[0], &b = mirrored.elements[0];
        ASSERT_EQ(a.lines.size(), b.lines.size());
        EXPECT_EQ(a.lines[0], b.lines[0]);
        for (std::size_t i = 0; i < a.points.size(); ++i) {
            const auto k =
                static_cast<std::size_t>(std::find(b.lines.begin(), b.lines.end(), a.lines[i]) - b.lines.begin());
            ASSERT_LT(k, b.lines.size());
            EXPECT_EQ(std::abs(b.points[k].y), std::abs(a.points[i].y));
        }
        EXPECT_NO_THROW(check_simple(mirrored));
    }
}

TEST(Transformed, WarningsKeepTheirPlaces) {
    Geometry given = shapes::geometry({shapes::box()});
    given.elements[0].warnings.push_back({.code = WarningCode::crossing_tail_cut, .at = Point{1, 0}});
    EXPECT_EQ(transformed_by(given, {"all:rotate:90"}).elements[0].warnings[0].at, (Point{0, 1}));
    EXPECT_EQ(transformed_by(given, {"all:rotate:180:0.5,0", "all:mirror"}).elements[0].warnings[0].at, (Point{0, 0}));
}

TEST(Transformed, NumbersOutOfRangeAreRefused) {
    const double none = std::nan("");
    for (const auto& change : std::initializer_list<decltype(Transformation::change)>{
             Scaling{.factor = 0}, Scaling{.factor = 1, .center = {none, 0}}, Rotation{.angle_deg = 361},
             Rotation{.angle_deg = none}, Shift{.by = {HUGE_VAL, 0}}, Mirroring{.y = none},
             FlapDeflection{.angle_deg = 91}, FlapDeflection{.angle_deg = 5, .hinge = {0, none}}})
        EXPECT_THROW(transformed(two_sections(), std::vector<Transformation>{{"all", change}}), OptionError);
}

TEST(Transformed, AllIsNotTheNameOfOneOfSeveral) {
    Geometry geometry = two_sections();
    geometry.elements[1].name = "all";
    EXPECT_THROW(transformed_by(geometry, {"all:mirror"}), OptionError);
    EXPECT_NO_THROW(transformed_by(geometry, {"body0:mirror"}));
}

TEST(Transformed, UnknownNamesAreRefused) {
    try {
        transformed_by(two_sections(), {"bod1:mirror"});
        ADD_FAILURE();
    } catch (const OptionError& error) {
        EXPECT_EQ(error.option(), "transform");
        EXPECT_EQ(error.reason(), "element 'bod1' is not known: did you mean 'body1'? (known: all, body0, body1)");
    }
}

TEST(ReadGeometry, OneFileMayBeGivenTwice) {
    const test::TemporaryFolder folder;
    const std::string file = folder.write("blade.dat", fixtures::selig).string();
    const std::vector<std::string> inputs{file, file};
    EXPECT_THROW(read_geometry(inputs), InputError);
    GeometryOptions options;
    options.transformations =
        parsed_transformations({"blade_2:mirror", "blade_2:rotate:-20", "blade_2:shift:0.4,-0.5"});
    const Geometry geometry = read_geometry(inputs, options);
    EXPECT_EQ(geometry.elements[0].name, "blade_1");
    EXPECT_EQ(geometry.elements[0].points, fixtures::loop);
    EXPECT_EQ(geometry.elements[1].name, "blade_2");
    EXPECT_EQ(geometry.elements[1].points.size(), fixtures::loop.size());
    EXPECT_EQ(geometry.elements[1].transformations.size(), 3u);
    const std::vector<std::string> sections{"naca:0012:50", "naca:0012:50"};
    options.transformations = parsed_transformations({"naca0012_2:shift:0,1"});
    EXPECT_EQ(read_geometry(sections, options).elements[1].points[0].y, 1);
}

TEST(ReadGeometry, ErrorsNamePlacesAfterTheTransformation) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> inputs{folder.write("a.dat", fixtures::selig).string(),
                                          folder.write("b.dat", fixtures::selig).string()};
    GeometryOptions options;
    options.transformations = parsed_transformations({"b:rotate:90:0.5,0", "all:shift:100,0"});
    try {
        read_geometry(inputs, options);
        ADD_FAILURE();
    } catch (const InputError& error) {
        ASSERT_TRUE(error.place().at.has_value());
        EXPECT_NEAR(error.place().at->x, 100.5, 0.5);
        EXPECT_GT(error.place().line, 0u);
    }
    options.transformations = parsed_transformations({"all:scale:1e70"});
    EXPECT_THROW(read_geometry(inputs, options), InputError);
}

TEST(ReadGeometry, SectionsForFlowFromTheRightAreTurned) {
    std::string text = "reversed\n";
    for (const Point p : naca_airfoil("4412", 80).points)
        text += std::to_string(1 - p.x) + " " + std::to_string(p.y) + "\n";
    const test::TemporaryFolder folder;
    const std::vector<std::string> inputs{folder.write("a.dat", text).string()};
    const Element given = read_geometry(inputs).elements[0];
    ASSERT_EQ(given.warnings.size(), 1u);
    const std::string& message = given.warnings[0].message;
    EXPECT_NE(message.find("give --transform all:rotate:180 --transform all:mirror"), std::string::npos) << message;
    GeometryOptions options;
    options.transformations = parsed_transformations({"all:rotate:180", "all:mirror"});
    const Geometry geometry = read_geometry(inputs, options);
    EXPECT_TRUE(geometry.elements[0].warnings.empty());
    const Box before = bounding_box({{given}}), after = bounding_box(geometry);
    EXPECT_EQ(after.lower, (Point{-before.upper.x, before.lower.y}));
    EXPECT_EQ(after.upper, (Point{-before.lower.x, before.upper.y}));
    // A section that stands right is turned wrongly.
    std::string standing = "right\n";
    for (const Point p : naca_airfoil("4412", 80).points)
        standing += std::to_string(p.x) + " " + std::to_string(p.y) + "\n";
    const std::vector<std::string> right{folder.write("b.dat", standing).string()};
    const Element wrong = read_geometry(right, options).elements[0];
    ASSERT_EQ(wrong.warnings.size(), 1u);
    EXPECT_EQ(wrong.warnings[0].code, WarningCode::reversed_flow);
}

}  // namespace
}  // namespace lamina
