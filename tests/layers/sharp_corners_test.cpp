// Sharp concave corners of walls, which have no rays, and the clefts that begin there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <lamina/layers.hpp>

#include "cell_angles.hpp"
#include "checked_layer.hpp"
#include "core/angles.hpp"
#include "expect_cover.hpp"
#include "layers/border/clefts.hpp"
#include "layers/directions/corners.hpp"
#include "layers/layer.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double first_height_of_layers = 1e-4;
constexpr double largest_allowed_deg = 150;

/// Returns a plate with a notch that is 0.8 deep, whose walls meet at this angle.
Outline notched_plate(double angle_deg, std::size_t parts = 40) {
    return shapes::refined(shapes::v_notch(1.6 * std::tan(core::radians(0.5 * angle_deg))), parts);
}

Geometry jagged_geometry(const Outline& outline) {
    Geometry geometry = shapes::geometry({outline});
    geometry.elements[0].resampled = true;
    return geometry;
}

LayerOptions options_of_layers(std::uint32_t layers = 25) {
    return test::layers_of(first_height_of_layers, 1.2, layers);
}

std::size_t corners_without_rays(const Rays& rays) {
    return static_cast<std::size_t>(std::count_if(rays.set.lines.begin(), rays.set.lines.end(),
                                                  [](const RayLine& ray) { return !ray.corner_after.empty(); }));
}

/// Returns the largest angle of the cells of a layer that lie in the notch, in degrees.
double largest_angle_in_notch_deg(const Layer& layer, const LayerCells& cells) {
    double largest = 0;
    test::for_each_cell(cells, [&](const std::vector<VertexId>& cell, std::uint16_t) {
        const Point corner = layer.points[cell[0].index()];
        if (std::abs(corner.x - 2) > 0.6 || std::abs(corner.y) < 0.15 || std::abs(corner.y) > 0.9) return;
        largest = std::max(largest, test::largest_angle_deg(layer, cell));
    });
    return largest;
}

/// Expects that the cell on each edge of the wall has the first height.
void expect_first_heights(const Layer& layer, const LayerCells& cells) {
    std::map<Segment, double> heights;
    test::for_each_cell(cells, [&](const std::vector<VertexId>& cell, std::uint16_t) {
        if (cell.size() != 3) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const VertexId a = cell[k], b = cell[(k + 1) % 3];
            const Point edge = layer.points[b.index()] - layer.points[a.index()];
            heights[{a, b}] =
                cross(edge, layer.points[cell[(k + 2) % 3].index()] - layer.points[a.index()]) / length(edge);
        }
    });
    for (const Segment& edge : layer.edges.walls[0]) {
        ASSERT_TRUE(heights.contains(edge));
        EXPECT_NEAR(heights.at(edge), first_height_of_layers, 0.01 * first_height_of_layers);
    }
}

TEST(SharpCorners, HaveNoRayButCellsOfTheFirstHeight) {
    for (const double angle_deg : {8.0, 15.0, 30.0, 45.0, 59.0})
        for (const bool mirrored : {false, true}) {
            SCOPED_TRACE(testing::Message() << angle_deg << " degrees" << (mirrored ? ", mirrored" : ""));
            const Outline outline = mirrored ? shapes::mirrored(notched_plate(angle_deg)) : notched_plate(angle_deg);
            const Geometry geometry = jagged_geometry(outline);
            EXPECT_EQ(
                corners_without_rays(grow_rays(geometry, options_of_layers(), test::growth_of(options_of_layers()))),
                1u);
            const Layer layer = test::checked_layer(geometry, options_of_layers());
            EXPECT_EQ(layer.walls[0].size(), outline.size());
            for (const LayerTopology topology : test::topologies) {
                const LayerCells cells = fill_layer(layer, topology);
                test::expect_cover(layer, layer.edges, cells);
                if (topology != LayerTopology::layered) continue;
                EXPECT_LT(largest_angle_in_notch_deg(layer, cells), largest_allowed_deg);
                expect_first_heights(layer, cells);
            }
        }
}

/// One ray in such a corner has cells of 180 degrees less half of the corner's angle beside it, and worse ones where
/// borders divide their tops.
TEST(SharpCorners, WouldHaveLargeAnglesWithOneRay) {
    for (const double angle_deg : {15.0, 30.0, 45.0}) {
        LayerOptions equal_fans = options_of_layers();
        equal_fans.equal_fans = true;
        const Layer layer = test::make_layer(jagged_geometry(notched_plate(angle_deg)), equal_fans);
        EXPECT_GT(largest_angle_in_notch_deg(layer, fill_layer(layer, LayerTopology::layered)), largest_allowed_deg);
    }
}

TEST(SharpCorners, KeepTheirRayWhereTheyMust) {
    const auto count = [](const Geometry& geometry, const LayerOptions& options) {
        return corners_without_rays(grow_rays(geometry, options, test::growth_of(options)));
    };
    EXPECT_EQ(count(jagged_geometry(notched_plate(65)), options_of_layers()), 0u) << "wide";
    EXPECT_EQ(count(jagged_geometry(notched_plate(15)), test::layers_of(5e-2, 1.2, 3)), 0u) << "high first layers";
    LayerOptions equal_fans = options_of_layers();
    equal_fans.equal_fans = true;
    EXPECT_EQ(count(jagged_geometry(notched_plate(30)), equal_fans), 0u) << "equal numbers of rays";
}

/// Where no first layer fits between both walls, vertices near the corner have no rays, but cells of the layer.
TEST(SharpCorners, NarrowOnesReachFarther) {
    for (const double angle_deg : {3.0, 8.0, 15.0, 30.0})
        for (const double first_height : {5e-4, 2e-3, 5e-3}) {
            SCOPED_TRACE(testing::Message() << angle_deg << " degrees, " << first_height);
            const LayerOptions options = test::layers_of(first_height, 1.2, 5);
            const Geometry geometry = jagged_geometry(notched_plate(angle_deg));
            const Layer layer = test::checked_layer(geometry, options);
            for (const LayerTopology topology : test::topologies)
                test::expect_cover(layer, layer.edges, fill_layer(layer, topology));
            const auto with_corner = std::find_if(layer.rays[0].begin(), layer.rays[0].end(),
                                                  [](const Ray& ray) { return !ray.corner_after.empty(); });
            if (with_corner == layer.rays[0].end()) continue;  // no first layer fits near it
            const std::size_t left_out = with_corner->corner_after.size();
            EXPECT_EQ(left_out % 2, 1u);
            const double chord = 2 * std::sin(core::radians(0.5 * angle_deg)) *
                                 distance(layer.points[with_corner->origin.index()], {2, 0.2});
            EXPECT_GE(chord, 1.99 * first_height);
            const double reach = static_cast<double>((left_out + 1) / 2);
            EXPECT_LT(left_out > 1 ? chord * (reach - 1) / reach : 0, 2 * first_height) << "one vertex less would do";
        }
}

/// Returns a saw blade with teeth of any depth, whose edges are divided into parts of about one length, or of two.
Outline saw_blade(std::mt19937& random) {
    const auto real = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    const auto teeth = static_cast<std::size_t>(real(4, 16));
    Outline saw;
    for (std::size_t i = 0; i < 2 * teeth; ++i) {
        const double angle = core::pi * (static_cast<double>(i) + real(0, 0.8)) / static_cast<double>(teeth);
        const double radius = i % 2 == 0 ? real(0.7, 1) : real(0.2, 0.6);
        saw.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    Outline outline;
    const double spacing = std::exp(real(-5, -3)), others = real(0, 1) < 0.3 ? real(1, 2) : 1;
    for (std::size_t i = 0; i < saw.size(); ++i) {
        const Point a = saw[i], b = saw[(i + 1) % saw.size()];
        const double parts = std::ceil(distance(a, b) / (i % 2 == 0 ? spacing : others * spacing));
        for (double k = 0; k < parts; ++k) outline.push_back(a + (k / parts) * (b - a));
    }
    return outline;
}

/// Jagged outlines of any shape have sound layers, whatever corners they have.
TEST(SharpCorners, OfRandomOutlines) {
    std::mt19937 random(11);
    const auto real = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::size_t corners = 0, clefts = 0;
    for (int round = 0; round < 24; ++round) {
        SCOPED_TRACE(round);
        const Outline outline = saw_blade(random);
        LayerOptions options = test::layers_of(std::exp(real(-10, -4)), real(1.05, 1.4), 20);
        if (round % 3 == 0) options.layers.reset();
        const Geometry geometry = jagged_geometry(outline);
        corners += corners_without_rays(grow_rays(geometry, options, test::growth_of(options)));
        const Layer layer = test::checked_layer(geometry, options);
        clefts += layer.clefts.size();
        for (const LayerTopology topology : test::topologies)
            test::expect_cover(layer, layer.edges, fill_layer(layer, topology));
    }
    EXPECT_GT(corners, 20u);
    EXPECT_GT(clefts, 8u);
}

/// A cleft of ice whose sides turn away from it next to the corner. Without a ray at the corner, those beside it stand
/// on convex vertices, lean away from each other, and do not see the edges of the cleft: triangles were folded.
TEST(SharpCorners, KeepTheirRayWhereSidesBulge) {
    const Outline cleft = shapes::polygon({{45.6623, -44.2649},
                                           {45.8952, -43.8137},
                                           {46.1572, -43.4789},
                                           {46.4629, -43.1732},
                                           {46.8122, -42.9985},
                                           {46.9432, -42.8093},
                                           {46.8413, -43.0713},
                                           {46.5939, -43.4352},
                                           {46.361, -43.9301},
                                           {46.0844, -44.425},
                                           {48, -46},
                                           {48, -41},
                                           {44, -41},
                                           {44, -46}});
    const LayerOptions high = test::layers_of(0.03, 1.2, 5);
    const Geometry coarse =
        jagged_geometry(shapes::refined(cleft, 3));  // rays fit on the third vertices, the convex ones
    EXPECT_EQ(corners_without_rays(grow_rays(coarse, high, test::growth_of(high))), 0u);
    std::mt19937 random(5);
    const auto real = [&](double from, double to) { return std::uniform_real_distribution<double>(from, to)(random); };
    for (int round = 0; round < 20; ++round) {
        SCOPED_TRACE(round);
        Outline outline;
        for (std::size_t i = 0; i < cleft.size(); ++i) {
            const Point a = cleft[i], b = cleft[(i + 1) % cleft.size()];
            const double parts = std::ceil(distance(a, b) / real(0.05, 0.15));
            for (double k = 0; k < parts; ++k) outline.push_back(a + k / parts * (b - a));
        }
        LayerOptions options = test::layers_of(real(0.01, 0.05), 1.2, 20);
        if (round % 2 == 0) options.layers.reset();
        const Layer layer = test::checked_layer(jagged_geometry(outline), options);
        for (const LayerTopology topology : test::topologies)
            test::expect_cover(layer, layer.edges, fill_layer(layer, topology));
    }
}

TEST(SharpCorners, TheFirstVertexKeepsItsRay) {
    const Outline outline = notched_plate(30);
    const auto bottom = std::find(outline.begin(), outline.end(), Point{2, 0.2});
    ASSERT_NE(bottom, outline.end());
    for (const std::ptrdiff_t before : {0, 1, 2}) {
        Outline rotated = outline;
        std::rotate(rotated.begin(), rotated.begin() + (bottom - outline.begin()) - before, rotated.end());
        const Geometry geometry = jagged_geometry(rotated);
        EXPECT_EQ(corners_without_rays(grow_rays(geometry, options_of_layers(), test::growth_of(options_of_layers()))),
                  before == 0 ? 0u : 1u);
        const Layer layer = test::checked_layer(geometry, options_of_layers());
        test::expect_cover(layer, layer.edges, fill_layer(layer, LayerTopology::layered));
    }
}

/// Where rays beside the corner have no layers, the border runs through the corner, or ends beside it.
TEST(SharpCorners, BareWallsGoThroughThem) {
    for (const int bare : {0, 1, 2, 3}) {
        SCOPED_TRACE(bare);
        const LayerOptions options = options_of_layers();
        Rays rays = grow_rays(jagged_geometry(notched_plate(30)), options, test::growth_of(options));
        const auto ray = std::find_if(rays.set.lines.begin(), rays.set.lines.end(),
                                      [](const RayLine& line) { return !line.corner_after.empty(); });
        ASSERT_NE(ray, rays.set.lines.end());
        const auto i = static_cast<std::size_t>(ray - rays.set.lines.begin());
        if (bare & 1) rays.limits[i] = 0;
        if (bare & 2) rays.limits[i + 1] = 0;
        layers::fit_and_count_layers(rays);
        EXPECT_EQ(rays.counts[i] == 0, (bare & 1) != 0);
        EXPECT_EQ(rays.counts[i + 1] == 0, (bare & 2) != 0);
        const Layer layer = close_border(rays);
        for (const std::string& finding : check_layer(layer, options)) ADD_FAILURE() << finding;
        const std::vector<VertexId>& border = layer.borders[0];
        const VertexId corner = layer.rays[0][i].corner_after.front();
        EXPECT_EQ(std::find(border.begin(), border.end(), corner) != border.end(), bare == 3);
        for (const LayerTopology topology : test::topologies)
            test::expect_cover(layer, layer.edges, fill_layer(layer, topology));
    }
}

TEST(Clefts, EndWhereTheFrontsAreAsFarFromEachOtherAsEdgesAreLong) {
    for (const double angle_deg : {8.0, 15.0, 25.0}) {
        SCOPED_TRACE(angle_deg);
        const LayerOptions options = options_of_layers();
        const Rays rays = grow_rays(jagged_geometry(notched_plate(angle_deg)), options, test::growth_of(options));
        const layers::LayeredRays layered = layers::layered_rays(rays);
        const std::vector<layers::CleftEnd> ends = layers::cleft_ends(layered);
        ASSERT_EQ(ends.size(), 1u);
        const std::size_t corner = ends[0].corner, first = ends[0].first, last = ends[0].last;
        EXPECT_EQ(corner - first, last - corner - 1) << "both sides are alike";
        const std::size_t steps = corner - first;
        // The gap over the length of the front's edge, so many rays from the corner.
        const auto gap = [&](std::size_t k) {
            return distance(layered.tip(corner - k), layered.tip(corner + 1 + k)) /
                   distance(layered.tip(corner - k), layered.tip(corner - k - 1));
        };
        EXPECT_GE(gap(steps), 1.9);
        for (std::size_t k = 0; k < steps; ++k) EXPECT_LT(gap(k), 2.1);
        const std::vector<Point> front = fronts(rays)[0];
        EXPECT_EQ(front.size() + 2 * steps, rays.set.lines.size()) << "the front passes their rays by";
    }
}

TEST(Clefts, WideOnesStayOpen) {
    const LayerOptions options = options_of_layers(2);
    const Rays rays = grow_rays(jagged_geometry(notched_plate(59)), options, test::growth_of(options));
    EXPECT_EQ(corners_without_rays(rays), 1u);
    for (const layers::CleftEnd& end : layers::cleft_ends(layers::layered_rays(rays)))
        EXPECT_LE(end.last - end.first, 7u);
}

/// Layer cells keep their angles if borders are divided, at the end of a cleft, too.
TEST(Clefts, TheirEndsMayBeDivided) {
    for (const double size : {0.02, 0.01, 0.005}) {
        SCOPED_TRACE(size);
        const LayerOptions options = options_of_layers();
        BorderOptions border;
        border.sources.push_back({.a = {2, 0.3}, .b = {2, 0.3}, .size = size});
        const Layer layer = test::checked_layer(jagged_geometry(notched_plate(20)), options, border);
        ASSERT_EQ(layer.clefts.size(), 1u);
        for (const LayerTopology topology : test::topologies)
            test::expect_cover(layer, layer.edges, fill_layer(layer, topology));
    }
}

TEST(Clefts, SpoiledOnesAreFound) {
    const LayerOptions options = options_of_layers();
    const Layer valid = test::checked_layer(jagged_geometry(notched_plate(20)), options);
    ASSERT_EQ(valid.clefts.size(), 1u);
    const LayerCleft& cleft = valid.clefts[0];
    const auto expect_finding = [&](auto spoil) {
        Layer layer = valid;
        spoil(layer);
        EXPECT_FALSE(check_layer(layer, options).empty());
    };
    expect_finding([&](Layer& l) { l.rays[0][cleft.corner].corner_after.clear(); });
    expect_finding([&](Layer& l) { l.clefts[0].last = cleft.last - 1; });
    expect_finding([&](Layer& l) { l.clefts.clear(); });
    // Both sides of the corner are as near to each other as its last cells are wide, and overlap when one moves across.
    expect_finding([&](Layer& l) {
        const Ray &left = valid.rays[0][cleft.corner], &right = valid.rays[0][cleft.corner + 1];
        const Point across = valid.points[left.tip().index()] - valid.points[right.tip().index()];
        for (std::size_t i = cleft.corner + 1; i < cleft.last; ++i)
            for (std::uint32_t n = 1; n <= valid.rays[0][i].layers; ++n)
                l.points[valid.rays[0][i].vertex(n).index()] =
                    valid.points[valid.rays[0][i].vertex(n).index()] + 2 * across;
    });
}

/// Another body in the cleft keeps it open.
TEST(Clefts, AreNotClosedOverOtherBodies) {
    const LayerOptions options = options_of_layers();
    Geometry geometry =
        shapes::geometry({notched_plate(20), shapes::moved(shapes::circle(0.003, 60), 0, 1, {2, 0.33})});
    geometry.elements[0].resampled = true;
    const Layer layer = test::checked_layer(geometry, options);
    EXPECT_EQ(layer.clefts.size(), 0u);
    test::expect_cover(layer, layer.edges, fill_layer(layer, LayerTopology::layered));
}

}  // namespace
}  // namespace lamina
