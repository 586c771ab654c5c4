// Layers that go on along wakes behind sharp and blunt trailing edges.
#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/layers.hpp>
#include <lamina/surface.hpp>
#include <lamina/threads.hpp>

#include "layers/expect_cover.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

/// A section whose features are known, of unit chord, turned and moved.
Geometry section_with_features(double base, double angle = 0, Point shift = {0, 0}) {
    return prepare_surfaces(shapes::geometry({shapes::moved(shapes::section(0.12, base, 60), angle, 1, shift)}),
                            {.treatment = SurfaceTreatment::keep});
}

/// Returns the line of a wake of this length that leaves in this direction and curves upwards.
WakeLine line_from(std::size_t element, Point from, double direction, double length, double height = 0.02) {
    WakeLine line{element, {}};
    for (int i = 0; i <= 200; ++i) {
        const double s = length * i / 200;
        const Point along{std::cos(direction), std::sin(direction)};
        line.points.push_back(
            {from + s * along + 0.05 * s * s * perpendicular(along), height * (1 + s), height * (1 + s)});
    }
    return line;
}

LayerOptions options_with_wakes() {
    LayerOptions options;
    options.first_height = 1e-5;
    options.layers.reset();
    options.wake_layers = true;
    return options;
}

LayerGrowth growth_with(const LayerOptions& options, std::vector<WakeLine> wakes) {
    LayerGrowth growth = test::growth_of(options);
    growth.wakes = std::move(wakes);
    return growth;
}

/// The rays of one wake: those on the way out, the one at its end, and those on the way back.
std::vector<Ray> wake_rays(const Layer& layer, std::size_t element) {
    std::vector<Ray> rays;
    for (const Ray& ray : layer.rays[element])
        if (ray.place != RayPlace::wall) rays.push_back(ray);
    return rays;
}

/// Makes the layer, and expects it to be sound and to be covered by the cells of all topologies.
Layer sound_layer(const Geometry& geometry, const LayerOptions& options, const LayerGrowth& growth) {
    Layer layer = close_border(grow_rays(geometry, options, growth));
    for (const std::string& finding : check_layer(layer, options)) ADD_FAILURE() << finding;
    for (const LayerTopology topology : test::topologies) {
        SCOPED_TRACE(static_cast<int>(topology));
        const LayerCells cells = fill_layer(layer, topology);
        EXPECT_FALSE(cells.grid_refused);
        test::expect_cover(layer, layer.edges, cells);
    }
    return layer;
}

TEST(WakeLayers, CoverBothSidesOfSharpAndBluntTrailingEdges) {
    const LayerOptions options = options_with_wakes();
    for (const double base : {0.0, 1e-3, 0.01}) {
        for (const double angle : {0.0, 0.7, -0.4}) {
            SCOPED_TRACE(testing::Message() << "base " << base << ", turned by " << angle);
            const Geometry geometry = section_with_features(base, angle);
            const Point tail = geometry.elements[0].features.trailing_edge;
            const Layer layer = sound_layer(geometry, options, growth_with(options, {line_from(0, tail, angle, 2)}));
            const std::vector<Ray> rays = wake_rays(layer, 0);
            ASSERT_GT(rays.size(), 60u);
            // One ray at the end, without layers; the others have some.
            const std::size_t middle = rays.size() / 2;
            for (std::size_t i = 0; i < rays.size(); ++i) {
                EXPECT_EQ(rays[i].place == RayPlace::wake_end, i == middle);
                EXPECT_EQ(rays[i].layers == 0, i == middle);
            }
            EXPECT_GT(distance(layer.points[rays[middle].origin.index()], tail), 1.9);
            EXPECT_EQ(layer.cores.size(), base > 0 ? 1u : 0u);
        }
    }
}

TEST(WakeLayers, SpoiledSpacesBehindBasesAreFound) {
    const LayerOptions options = options_with_wakes();
    const Geometry geometry = section_with_features(0.01);
    const Layer valid = sound_layer(
        geometry, options, growth_with(options, {line_from(0, geometry.elements[0].features.trailing_edge, 0, 2)}));
    ASSERT_EQ(valid.cores.size(), 1u);
    const auto expect_finding = [&](auto spoil) {
        Layer layer = valid;
        spoil(layer);
        EXPECT_FALSE(check_layer(layer, options).empty());
    };
    const std::vector<VertexId>& chain = valid.cores[0].chains[1];
    ASSERT_GT(chain.size(), 2u);
    expect_finding([&](Layer& l) { l.points[chain[1].index()] = l.points[chain[1].index()] - Point{0.005, 0}; });
    expect_finding([&](Layer& l) { l.points[chain[1].index()] = l.points[chain[1].index()] + Point{0, 0.02}; });
    expect_finding([&](Layer& l) { l.cores[0].stations.pop_back(); });
    expect_finding([&](Layer& l) { l.cores.clear(); });
}

TEST(WakeLayers, ShareTheirVerticesAndOpen) {
    const LayerOptions options = options_with_wakes();
    for (const double base : {0.0, 0.005}) {
        const Geometry geometry = section_with_features(base);
        const Rays made = grow_rays(
            geometry, options, growth_with(options, {line_from(0, geometry.elements[0].features.trailing_edge, 0, 2)}));
        const Layer layer = close_border(made);
        const std::vector<Ray> rays = wake_rays(layer, 0);
        std::vector<double> openings;
        for (const RayLine& line : made.set.lines)
            if (line.place != RayPlace::wall) openings.push_back(line.opening);
        const std::size_t n = rays.size(), sides = base > 0 ? layer.cores[0].stations.size() - 1 : 0;
        for (std::size_t k = 0; k < n / 2; ++k) {
            EXPECT_EQ(rays[k].origin == rays[n - 1 - k].origin, k >= sides);
            EXPECT_EQ(openings[k], openings[n - 1 - k]);
            if (k > 0) {
                EXPECT_GE(openings[k], openings[k - 1]);
                EXPECT_LE(openings[k], 1.13 * openings[k - 1]);
            }
        }
        EXPECT_EQ(openings[0] < 1.1, true);
        EXPECT_GT(openings[n / 2], 50);
    }
}

/// The wall keeps its vertices, and its first cells have the height that was asked for, at a base as elsewhere.
TEST(WakeLayers, LeaveFirstHeightsOnTheWallAsTheyAre) {
    const LayerOptions options = options_with_wakes();
    const double height = test::first_height(options);
    for (const double base : {0.0, 0.004}) {
        const Geometry geometry = section_with_features(base);
        const Layer layer = close_border(
            grow_rays(geometry, options,
                      growth_with(options, {line_from(0, geometry.elements[0].features.trailing_edge, 0, 2)})));
        const LayerCells cells = fill_layer(layer, LayerTopology::layered);
        std::set<std::pair<VertexId, VertexId>> wall;
        for (const Segment& edge : layer.edges.walls[0]) wall.insert({edge.a, edge.b});
        std::set<Point, bool (*)(Point, Point)> vertices(lexicographically_less);
        for (const VertexId v : layer.walls[0]) vertices.insert(layer.points[v.index()]);
        for (const Point p : geometry.elements[0].points) EXPECT_TRUE(vertices.contains(p));
        std::size_t first_cells = 0;
        for (const Triangle& t : cells.triangles)
            for (int k = 0; k < 3; ++k) {
                if (!wall.contains({t.v[k], t.v[(k + 1) % 3]})) continue;
                const Point a = layer.points[t.v[k].index()], b = layer.points[t.v[(k + 1) % 3].index()],
                            c = layer.points[t.v[(k + 2) % 3].index()];
                ++first_cells;
                EXPECT_NEAR(cross(b - a, c - a) / distance(a, b), height, 0.01 * height) << a.x << " " << a.y;
            }
        EXPECT_EQ(first_cells, wall.size());
    }
}

TEST(WakeLayers, EndBeforeTheNextWall) {
    const LayerOptions options = options_with_wakes();
    for (const double base : {0.0, 0.004})
        for (const double off : {0.0, 0.05, 0.1, -0.06}) {
            SCOPED_TRACE(testing::Message() << "base " << base << ", body off by " << off);
            Geometry geometry = shapes::geometry(
                {shapes::section(0.12, base, 60), shapes::moved(shapes::circle(0.1, 80), 0, 1, {1.6, off})});
            geometry = prepare_surfaces(geometry, {.treatment = SurfaceTreatment::keep});
            const WakeLine line = line_from(0, geometry.elements[0].features.trailing_edge, 0, 2, 0.01);
            const Rays rays = grow_rays(geometry, options, growth_with(options, {line}));
            EXPECT_GT(rays.wake_lengths[0], 0.1);
            EXPECT_LT(rays.wake_lengths[0], 0.5 + std::abs(off));
            EXPECT_EQ(rays.wake_lengths[1], 0);
            sound_layer(geometry, options, growth_with(options, {line}));
        }
}

TEST(WakeLayers, AreNotMadeWhereNoneCanBe) {
    const LayerOptions options = options_with_wakes();
    const Geometry circle = prepare_surfaces(shapes::geometry({shapes::circle(0.5, 100)}));
    const Rays round = grow_rays(circle, options, growth_with(options, {line_from(0, {0.5, 0}, 0, 2)}));
    EXPECT_EQ(round.wake_lengths[0], 0);
    const Geometry section = section_with_features(0);
    const Rays too_short = grow_rays(section, options, growth_with(options, {line_from(0, {1, 0}, 0, 2e-5)}));
    EXPECT_EQ(too_short.wake_lengths[0], 0);
    LayerOptions fixed = options;
    fixed.layers = 20;
    EXPECT_EQ(grow_rays(section, fixed, growth_with(fixed, {line_from(0, {1, 0}, 0, 2)})).wake_lengths[0], 0);
    // Without wakes the rays are those of before, one by one.
    LayerOptions off = options;
    off.wake_layers = false;
    const Rays without = grow_rays(section, off, growth_with(off, {line_from(0, {1, 0}, 0, 2)}));
    ASSERT_EQ(too_short.set.lines.size(), without.set.lines.size());
    for (std::size_t i = 0; i < without.set.lines.size(); ++i)
        EXPECT_EQ(too_short.set.lines[i].direction, without.set.lines[i].direction);
}

/// Powers of two change no rounding, so that layers are the same bit for bit.
TEST(WakeLayers, ScaleWithTheUnit) {
    const double scale = 0.25;
    LayerOptions options = options_with_wakes(), small = options;
    small.first_height = scale * test::first_height(options);
    for (const double base : {0.0, 0.004}) {
        const Geometry geometry = section_with_features(base);
        Geometry scaled = geometry;
        for (Point& p : scaled.elements[0].points) p = scale * p;
        WakeLine line = line_from(0, geometry.elements[0].features.trailing_edge, 0.1, 2), scaled_line = line;
        for (WakePoint& p : scaled_line.points) p = {scale * p.at, scale * p.left, scale * p.right};
        const Layer a = close_border(grow_rays(geometry, options, growth_with(options, {line})));
        const Layer b = close_border(grow_rays(scaled, small, growth_with(small, {scaled_line})));
        ASSERT_EQ(a.points.size(), b.points.size());
        for (std::size_t i = 0; i < a.points.size(); ++i) EXPECT_EQ(scale * a.points[i], b.points[i]);
    }
}

/// Two sections behind each other, and a third beside: their layers meet the wakes of the others.
TEST(WakeLayers, MayPassOtherBodies) {
    const LayerOptions options = options_with_wakes();
    const Outline section = shapes::section(0.12, 0.004, 50);
    const Geometry geometry =
        prepare_surfaces(shapes::geometry({section, shapes::moved(section, -0.3, 0.4, {0.97, -0.06}),
                                           shapes::moved(shapes::section(0.1, 0, 50), 0.2, 0.3, {1.1, 0.15})}),
                         {.treatment = SurfaceTreatment::keep});
    std::vector<WakeLine> lines;
    for (std::size_t e = 0; e < 3; ++e) {
        const double direction = e == 0 ? 0.0 : e == 1 ? -0.3 : 0.2;
        lines.push_back(line_from(e, geometry.elements[e].features.trailing_edge, direction, 1.5, 0.006));
    }
    const Rays rays = grow_rays(geometry, options, growth_with(options, lines));
    EXPECT_GT(rays.wake_lengths[1], 0.5);
    EXPECT_GT(rays.wake_lengths[2], 0.5);
    const Layer layer = sound_layer(geometry, options, growth_with(options, lines));
    for (const unsigned threads : {1u, 3u})
        with_threads(threads, [&] {
            const Layer again = close_border(grow_rays(geometry, options, growth_with(options, lines)));
            EXPECT_TRUE(again.points == layer.points);
        });
}

}  // namespace
}  // namespace lamina
