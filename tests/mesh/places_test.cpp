// Places of meshes that have names.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <lamina/places.hpp>

#include "support/sample_meshes.hpp"

namespace lamina {
namespace {

/// Adds an outline as a marker: an ellipse whose long axis points in the direction (c, s).
void add_ellipse(Mesh& mesh, const std::string& name, MarkerKind kind, Point center, double length, double c,
                 double s) {
    const std::size_t n = 400, first = mesh.points.size();
    Marker marker{name, kind, {}};
    for (std::size_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
        const Point p{0.5 * length * std::cos(angle), 0.05 * length * std::sin(angle)};
        mesh.points.push_back(center + Point{c * p.x - s * p.y, s * p.x + c * p.y});
        marker.edges.push_back({VertexId(first + (i + 1) % n), VertexId(first + i)});
    }
    mesh.markers.push_back(marker);
}

std::vector<std::string> names_of(const std::vector<Place>& places) {
    std::vector<std::string> names;
    for (const Place& place : places) names.push_back(place.name);
    return names;
}

TEST(Places, NosesTailsAndSlotsOfSeveralBodies) {
    Mesh mesh;
    add_ellipse(mesh, "main", MarkerKind::wall, {0.5, 0}, 1, 1, 0);
    add_ellipse(mesh, "flap", MarkerKind::other, {1.14, -0.1}, 0.3, 0.8, -0.6);
    add_ellipse(mesh, "far away", MarkerKind::wall, {5, 3}, 0.2, 1, 0);
    add_ellipse(mesh, "farfield", MarkerKind::far_field, {0, 0}, 100, 1, 0);
    const std::vector<Place> places = named_places(mesh);
    ASSERT_EQ(names_of(places), (std::vector<std::string>{"all", "walls", "nose:1", "tail:1", "nose:2", "tail:2",
                                                          "nose:3", "tail:3", "slot:1"}));
    const auto expect_at = [&](std::size_t i, Point center, double tolerance) {
        EXPECT_NEAR(places[i].window.center().x, center.x, tolerance) << places[i].name;
        EXPECT_NEAR(places[i].window.center().y, center.y, tolerance) << places[i].name;
        EXPECT_NEAR(places[i].window.width(), places[i].window.height(), 1e-12) << places[i].name;
    };
    expect_at(2, {0, 0}, 1e-9);
    expect_at(3, {1, 0}, 1e-9);
    expect_at(4, {1.14 - 0.12, -0.1 + 0.09}, 2e-3);
    expect_at(5, {1.14 + 0.12, -0.1 - 0.09}, 2e-3);
    // The two bodies are nearest to each other where the tail of the one meets the nose of the other.
    expect_at(8, {1.01, -0.005}, 0.01);
    EXPECT_LT(places[8].window.width(), 0.1);
    for (const Place& place : places) EXPECT_TRUE(places.front().window.contains(place.window.center())) << place.name;
}

TEST(Places, DoNotDependOnTheOrderOfMarkerEdges) {
    const Mesh mesh = test::annulus({.around = 40});
    const std::vector<Place> places = named_places(mesh), again = named_places(test::shuffled(mesh, 3));
    ASSERT_EQ(names_of(places), names_of(again));
    ASSERT_EQ(places.size(), 4u);
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_EQ(places[i].window.lower, again[i].window.lower);
    EXPECT_EQ(places[3].window.center(), (Point{1, 0}));  // the tail of the circle
}

TEST(Places, NoneWithoutPointsAndFewWithoutWalls) {
    EXPECT_TRUE(named_places(Mesh{}).empty());
    Mesh mesh = test::annulus();
    for (Marker& marker : mesh.markers) marker.kind = MarkerKind::far_field;
    EXPECT_EQ(names_of(named_places(mesh)), std::vector<std::string>{"all"});
    mesh.points.assign(mesh.points.size(), Point{2, 3});
    EXPECT_TRUE(named_places(mesh).empty());  // no window has a size
}

}  // namespace
}  // namespace lamina
