// Where the vertices of a mesh are on other shapes.
#include <lamina/morph.hpp>

#include <gtest/gtest.h>

#include "morphing/morphing_fixtures.hpp"
#include "support/outline_measures.hpp"

namespace lamina::test {

namespace {

/// Returns half the thickness of a symmetric section of four digits at a station.
double half_thickness(double thickness, double x) {
    return 5 * thickness *
           (0.2969 * std::sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

TEST(WallTargets, OwnShapeMovesNothingFar) {
    const Mesh mesh = generate_mesh({"naca:2412"}, options_to_morph()).mesh;
    const MorphMap map(mesh);
    const std::vector<std::string> own{"naca:2412"};
    const std::vector<Point> wall = wall_points_on(map, read_geometry(own));
    for (std::size_t i = 0; i < wall.size(); ++i) EXPECT_LT(distance(wall[i], map.wall_points()[i]), 2e-6);
}

TEST(WallTargets, LieOnTheShape) {
    const Mesh mesh = generate_mesh({"naca:0012"}, options_to_morph()).mesh;
    const MorphMap map(mesh);
    const std::vector<std::string> other{"naca:0015"};
    const std::vector<Point> wall = wall_points_on(map, read_geometry(other));
    for (const Point p : wall) EXPECT_NEAR(std::abs(p.y), half_thickness(0.15, std::max(p.x, 0.0)), 1e-6);
    EXPECT_EQ(wall[0], map.wall_points()[0]);  // the trailing edge
    const MorphResult result = morph(map, wall);
    expect_valid(map, result.points);
    EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 0.01);
}

TEST(WallTargets, FollowTransformationsOfElements) {
    const Mesh mesh = mesh_to_morph({"naca:0012:100"});
    const MorphMap map(mesh);
    const std::vector<Transformation> turn{parse_transformation("airfoil:rotate:90"),
                                           parse_transformation("all:shift:1,2")};
    const std::vector<Point> wall = moved_wall_points(map, turn);
    for (std::size_t i = 0; i < wall.size(); ++i) {
        const Point p = map.wall_points()[i];
        EXPECT_EQ(wall[i], (Point{-p.y + 1, p.x + 2}));
    }
    const std::vector<Transformation> unknown{parse_transformation("flap:rotate:90")};
    EXPECT_THROW(moved_wall_points(map, unknown), OptionError);
}

TEST(WallTargets, KinksMayAppearAndVanish) {
    const std::vector<Transformation> deflection{parse_transformation("airfoil:flap:20:0.7,0")};
    const Geometry plain = make_geometry({naca_airfoil("0012", 400)});
    const Geometry flapped = transformed(plain, deflection);
    for (const auto& [from, onto] : {std::pair(plain, flapped), std::pair(flapped, plain)}) {
        const Mesh mesh = generate_mesh(from, options_to_morph()).mesh;
        const std::vector<Point> wall = wall_points_on(MorphMap(mesh), onto);
        // No edge of the wall, which are up to 0.02 long, cuts a kink off: one of 20 degrees would lose 0.0017.
        for (const Point p : wall) EXPECT_LT(distance_to(onto.elements[0].points, p), 1e-4);
        for (const Point p : onto.elements[0].points) EXPECT_LT(distance_to(wall, p), 2e-4);
    }
}

TEST(WallTargets, FollowDeflectedFlaps) {
    const Mesh mesh = generate_mesh({"naca:0012"}, options_to_morph()).mesh;
    const MorphMap map(mesh);
    const std::vector<Point> wall = moved_wall_points(map, std::vector{parse_transformation("airfoil:flap:5:0.7,0")});
    const double turn = 5 * 3.14159265358979 / 180;
    const auto tail = std::max_element(wall.begin(), wall.end(), [](Point a, Point b) { return a.x < b.x; });
    EXPECT_NEAR(tail->x, 0.7 + 0.3 * std::cos(turn), 1e-6);
    EXPECT_NEAR(tail->y, -0.3 * std::sin(turn), 1e-6);
    const MorphResult result = morph(map, wall);
    expect_valid(map, result.points);
    EXPECT_LT(compare_morphed(map, result.points).max_first_height_change, 0.05);
}

TEST(WallTargets, NeedTheSameBodiesAndCorners) {
    const Mesh mesh = mesh_to_morph({"naca:0012:100"});
    const MorphMap map(mesh);
    const Element section = naca_airfoil("0012", 100);
    Element second = section;
    for (Point& p : second.points) p.x += 2;
    const Geometry two = make_geometry({section, second}, {.names = {"a", "b"}});
    EXPECT_THROW(wall_points_on(map, two), InputError);
    const Geometry blunt = make_geometry({naca_airfoil("0012", 101, TrailingEdge::blunt)});
    try {
        wall_points_on(map, blunt);
        FAIL() << "a base has two corners";
    } catch (const InputError& error) {
        EXPECT_NE(error.reason().find("corners"), std::string::npos);
    }
}

}  // namespace

}  // namespace lamina::test
