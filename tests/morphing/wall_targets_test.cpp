// Where the vertices of a mesh are on other shapes.
#include <lamina/morph.hpp>

#include <gtest/gtest.h>

#include "morphing/morphing_fixtures.hpp"

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
