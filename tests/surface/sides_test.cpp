// Exact numbers of edges on both sides of a section, and spacings at stations.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/option.hpp>
#include <lamina/surface.hpp>

#include "support/outline_measures.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

SurfaceOptions sides(std::size_t upper, std::size_t lower, std::optional<std::size_t> base = {}) {
    SurfaceOptions options;
    options.side_edges = {{upper, lower, base}};
    return options;
}

/// Returns the edges from the upper corner of the trailing edge to the given point farthest from it, and from there to
/// the lower corner.
std::pair<std::size_t, std::size_t> edges_of_sides(const Element& e, const Outline& given) {
    const std::size_t n = e.points.size();
    const Point tail = e.features.trailing_edge;
    const auto index_of = [&](Point p) {
        return static_cast<std::size_t>(std::find(e.points.begin(), e.points.end(), p) - e.points.begin());
    };
    const std::size_t start = e.features.base ? e.features.base->last : index_of(tail);
    const std::size_t end = e.features.base ? e.features.base->first : start;
    const auto nose_of_given = std::max_element(
        given.begin(), given.end(), [&](Point a, Point b) { return distance(a, tail) < distance(b, tail); });
    const std::size_t nose = index_of(*nose_of_given);
    EXPECT_LT(nose, n) << "it is a vertex";
    return {(nose + n - start) % n, (end + n - nose) % n};
}

TEST(Sides, HaveTheirNumbersOfEdges) {
    const std::vector<Outline> sections{shapes::section(0.12, 0, 40), shapes::section(0.12, 0.003, 20),
                                        naca_airfoil("23012", 400).points,
                                        naca_airfoil("0006", 301, TrailingEdge::blunt).points};
    for (const Outline& outline : sections)
        for (const auto& [upper, lower] :
             {std::pair<std::size_t, std::size_t>{80, 80}, {120, 60}, {61, 97}, {300, 200}}) {
            const Element e = prepared(outline, sides(upper, lower, 4));
            EXPECT_EQ(e.points.size(), upper + lower + (e.features.base ? 4 : 0));
            EXPECT_EQ(edges_of_sides(e, outline), std::pair(upper, lower));
        }
}

TEST(Sides, OfEqualNumbersAreEven) {
    for (const Outline& outline : {shapes::section(0.12, 0, 40), naca_airfoil("4412", 2000).points}) {
        const Element e = prepared(outline, sides(100, 100));
        EXPECT_LE(max_spacing_ratio(e.points), 1.25);
    }
}

// A point so near the leading edge that the two become one.
TEST(Sides, MeetWhereTheLeadingEdgeWasMerged) {
    Outline outline = shapes::section(0.12, 0, 40);
    const auto nose = std::min_element(outline.begin(), outline.end(), [](Point a, Point b) { return a.x < b.x; });
    for (const double above : {1e-6, -1e-6}) {
        Outline doubled = outline;
        const auto at = doubled.begin() + (nose - outline.begin()) + (above > 0 ? 0 : 1);
        doubled.insert(at, *nose + Point{1e-7, above});
        const Element e = prepared(doubled, sides(80, 60));
        EXPECT_EQ(e.points.size(), 140u);
        const auto foremost =
            std::min_element(e.points.begin(), e.points.end(), [](Point a, Point b) { return a.x < b.x; });
        const auto tail = std::find(e.points.begin(), e.points.end(), e.features.trailing_edge);
        EXPECT_EQ((foremost - tail + 140) % 140, 80);
    }
}

TEST(Sides, OfEachElementHaveTheirOwnNumbers) {
    using Edges = std::pair<std::size_t, std::size_t>;
    const Outline main = naca_airfoil("4412", 100).points, slat = shapes::section(0.12, 0.003, 20);
    const Geometry given =
        make_geometry({element_of_points(shapes::moved(slat, 0, 1, {-1.5, 0}), "slat"), element_of_points(main, "main"),
                       element_of_points(shapes::moved(main, 0, 1, {1.5, 0}), "flap")},
                      {.names = {"slat", "main", "flap"}});
    const auto sides_in = [&](const SurfaceOptions& options, std::size_t e) {
        return edges_of_sides(prepare_surfaces(given, options).elements[e], given.elements[e].points);
    };
    SurfaceOptions options;
    options.side_edges = {{70, 60, 3, "slat"}, {90, 80, 7, "all"}};
    EXPECT_EQ(sides_in(options, 0), Edges(70, 60)) << "its own numbers count, wherever those of all stand";
    EXPECT_EQ(prepare_surfaces(given, options).elements[0].points.size(), 133u);
    EXPECT_EQ(sides_in(options, 1), Edges(90, 80));
    options.side_edges = {{70, 60, 3, "slat"}};
    EXPECT_EQ(prepare_surfaces(given, options).elements[1].points, prepare_surfaces(given).elements[1].points);
    options.side_edges = {{70, 60, 3, "wing"}};
    EXPECT_THROW(prepare_surfaces(given, options), OptionError);
}

TEST(Sides, AreReadAndWritten) {
    const OptionTable<SurfaceOptions>& table = option_table<SurfaceOptions>();
    const auto points = std::find_if(table.begin(), table.end(), [](const auto& o) { return o.name == "points"; });
    SurfaceOptions options;
    const std::vector<std::string> texts{"80:60", "80:60:4", "main:80:60", "main:80:60:4", "2412:80:60:4"};
    points->set(options, texts);
    EXPECT_EQ(points->get(options), OptionValue(texts));
    EXPECT_EQ(options.side_edges[1].base, 4u);
    EXPECT_EQ(options.side_edges[4].element, "2412");
    for (const std::string text :
         {"80", "main:80", "main:80:60:4:2", "0:80", "main:80:0", "80:60:0", ":80:60", "main:80:x", "80.5:60"})
        EXPECT_THROW(points->set(options, std::vector{text}), UsageError) << text;
}

TEST(Sides, Refusals) {
    EXPECT_THROW(prepared(shapes::ellipse(1, 0.2, 30), sides(40, 40)), OptionError);
    EXPECT_THROW(prepared(shapes::refined(shapes::box(), 2), sides(1, 1)), OptionError);
    SurfaceOptions options = sides(40, 40);
    options.treatment = SurfaceTreatment::keep;
    EXPECT_THROW(validate(options), OptionError);
    options.treatment = SurfaceTreatment::automatic;
    options.points = 100;
    EXPECT_THROW(validate(options), OptionError);
}

/// Returns the length of the longest edge near a station on the upper or the lower side.
double spacing_near(const Element& e, double station, bool is_upper) {
    double longest = 0;
    for (std::size_t i = 0; i < e.points.size(); ++i) {
        const Point a = e.points[i], b = e.points[(i + 1) % e.points.size()];
        if ((a.y > 0) == is_upper && std::min(a.x, b.x) <= station && std::max(a.x, b.x) >= station)
            longest = std::max(longest, distance(a, b));
    }
    return longest;
}

TEST(Stations, BoundTheSpacing) {
    const Outline outline = naca_airfoil("0012", 2000).points;
    SurfaceOptions options;
    options.station_spacings = {{"all", SurfaceSide::upper, 0.6, 0.001}};
    const Element e = prepared(outline, options);
    EXPECT_LE(spacing_near(e, 0.6, true), 0.0011);
    EXPECT_GT(spacing_near(e, 0.6, true), 0.0007);
    EXPECT_GT(spacing_near(e, 0.6, false), 0.01);
    EXPECT_LE(max_spacing_ratio(e.points), options.max_ratio);
    options.station_spacings[0].side = SurfaceSide::both;
    EXPECT_LE(spacing_near(prepared(outline, options), 0.6, false), 0.0011);
    // Beside exact numbers, too: the share of edges there grows.
    options = sides(100, 100);
    const double plain = spacing_near(prepared(outline, options), 0.6, true);
    options.station_spacings = {{"all", SurfaceSide::both, 0.6, 0.001}};
    const Element exact = prepared(outline, options);
    EXPECT_EQ(exact.points.size(), 200u);
    EXPECT_LT(spacing_near(exact, 0.6, true), 0.5 * plain);
}

TEST(Stations, Refusals) {
    const Outline outline = naca_airfoil("0012", 100).points;
    SurfaceOptions options;
    options.station_spacings = {{"wing", SurfaceSide::both, 0.6, 0.001}};
    EXPECT_THROW(prepared(outline, options), OptionError);
    options.station_spacings = {{"all", SurfaceSide::both, 1.5, 0.001}};
    EXPECT_THROW(validate(options), OptionError);
    options.station_spacings = {{"all", SurfaceSide::both, 0.5, 0}};
    EXPECT_THROW(validate(options), OptionError);
    const OptionTable<SurfaceOptions>& table = option_table<SurfaceOptions>();
    const auto spacing_at =
        std::find_if(table.begin(), table.end(), [](const auto& o) { return o.name == "spacing-at"; });
    for (const std::string text : {"all", "all:0.5", "all:0.5=", "all:left:0.5=0.1", ":0.5=0.1", "all:x=0.1"}) {
        SurfaceOptions o;
        EXPECT_THROW(spacing_at->set(o, std::vector<std::string>{text}), UsageError) << text;
    }
    SurfaceOptions o;
    spacing_at->set(o, std::vector<std::string>{"all:lower:0.5=0.1", "wing:1=0.2"});
    EXPECT_EQ(spacing_at->get(o), OptionValue(std::vector<std::string>{"all:lower:0.5=0.1", "wing:1=0.2"}));
}

}  // namespace
}  // namespace lamina
