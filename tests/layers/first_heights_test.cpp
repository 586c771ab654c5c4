// Layers of which each element has its own first height.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/layers.hpp>
#include <lamina/threads.hpp>

#include "layers/growth_laws.hpp"
#include "layers/heights/heights.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

/// Returns options under which a law gives layers of a few per cent of a chord.
LayerOptions options_with_own_heights(GrowthLaw law) {
    LayerOptions options;
    options.growth_law = law;
    options.layers = 20;
    if (law == GrowthLaw::polynomial) options.growth = 2.2;
    if (layers::growth_law_entry(law).fills_thickness) options.thickness = 0.02;
    return options;
}

Layer layer_with(const Geometry& geometry, const LayerOptions& options, std::vector<double> first_heights) {
    Layer layer = close_border(grow_rays(geometry, options, layer_growth(options, {}, std::move(first_heights))));
    for (const std::string& finding : check_layer(layer, options)) ADD_FAILURE() << finding;
    return layer;
}

/// Returns the points of all rays of an element, ray by ray from the wall.
std::vector<Point> ray_points(const Layer& layer, std::size_t element) {
    std::vector<Point> points;
    for (const Ray& ray : layer.rays[element])
        for (std::uint32_t n = 0; n <= ray.layers; ++n) points.push_back(layer.points[ray.vertex(n).index()]);
    return points;
}

Outline second_section() { return shapes::moved(shapes::section(0.12, 0.01, 60), 0.2, 0.4, {0.2, 0.8}); }

/// Elements that are far from each other have the layers that they would have alone.
TEST(FirstHeights, EachElementHasTheLayersOfItsOwn) {
    const Outline first = shapes::section(0.12, 0, 80), second = second_section();
    std::vector<LayerOptions> cases;
    for (const layers::GrowthLawEntry& law : layers::growth_law_table())
        cases.push_back(options_with_own_heights(law.law));
    cases.push_back(cases.front());
    cases.back().layers.reset();
    for (const LayerOptions& options : cases) {
        SCOPED_TRACE(testing::Message() << "law " << static_cast<int>(options.growth_law));
        const std::vector<double> heights{1e-5, 4e-5};
        const Layer layer = layer_with(shapes::geometry({first, second}), options, heights);
        for (std::size_t e = 0; e < 2; ++e) {
            LayerOptions alone = options;
            alone.first_height = heights[e];
            EXPECT_EQ(ray_points(layer, e),
                      ray_points(test::make_layer(shapes::geometry({e == 0 ? first : second}), alone), 0));
        }
    }
}

TEST(FirstHeights, GoWithTheirElements) {
    const Outline first = shapes::section(0.12, 0, 80), second = second_section();
    const LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
    const Layer layer = layer_with(shapes::geometry({first, second}), options, {1e-5, 4e-5}),
                permuted = layer_with(shapes::geometry({second, first}), options, {4e-5, 1e-5});
    EXPECT_EQ(ray_points(layer, 0), ray_points(permuted, 1));
    EXPECT_EQ(ray_points(layer, 1), ray_points(permuted, 0));
}

TEST(FirstHeights, TheSameForAllIsNoOtherThanOne) {
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 80), second_section()});
    LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
    options.first_height = 3e-5;
    EXPECT_EQ(layer_with(geometry, options, {3e-5, 3e-5}).points, test::make_layer(geometry, options).points);
}

/// The columns of both elements are cut short where they meet. Their first heights stay, and no cell is crossed.
TEST(FirstHeights, LayersOfDifferentHeightsMeetInAGap) {
    const Geometry geometry = shapes::geometry(
        {shapes::refined(shapes::box(), 40), shapes::moved(shapes::refined(shapes::box(), 30), 0, 0.7, {0.1, 1.012})});
    for (const bool automatic : {false, true}) {
        LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
        options.layers = automatic ? std::nullopt : std::optional(std::uint32_t{30});
        const std::vector<double> heights{2e-5, 1.1e-4};
        const Layer layer = layer_with(geometry, options, heights);
        const Rays made = grow_rays(geometry, options, layer_growth(options, {}, heights));
        std::size_t cut = 0;
        for (std::size_t e = 0; e < 2; ++e) {
            cut += layer.coverage[e].all.incomplete_rays;
            for (std::size_t i = 0; i < layer.rays[e].size(); ++i) {
                const Ray& ray = layer.rays[e][i];
                ASSERT_GT(ray.layers, 0u);
                const Point origin = layer.points[ray.origin.index()], top = layer.points[ray.vertex(1).index()];
                EXPECT_NEAR(distance(origin, top) / (made.set.lines[made.set.begin[e] + i].slant * heights[e]), 1,
                            1e-9);
            }
        }
        EXPECT_GT(cut, 20u);
        for (const LayerTopology topology : {LayerTopology::delaunay, LayerTopology::layered, LayerTopology::quads}) {
            const LayerCells cells = fill_layer(layer, topology);
            EXPECT_FALSE(cells.grid_refused);
            for (const Triangle& t : cells.triangles)
                EXPECT_GT(cross(layer.points[t.v[1].index()] - layer.points[t.v[0].index()],
                                layer.points[t.v[2].index()] - layer.points[t.v[0].index()]),
                          0);
        }
    }
}

/// First heights that vary along the wall by a factor of 3 are those of the rays, within a tenth from vertex to vertex;
/// wakes and fans go on with those of the trailing edge.
TEST(FirstHeights, MayVaryAlongTheWall) {
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 400), second_section()});
    const std::vector<Point>& wall = geometry.elements[1].points;
    for (const bool automatic : {false, true}) {
        LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
        options.layers = automatic ? std::nullopt : std::optional(std::uint32_t{20});
        LayerGrowth growth = layer_growth(options, {}, {1e-5, 2e-5});
        for (std::size_t i = 0; i < wall.size(); ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(wall.size());
            growth.wall_first_heights.push_back({1, wall[i], 2e-5 * (2 - std::cos(6.283185307 * share))});
        }
        const std::vector<double> wanted = first_heights_on_wall(growth, 1, wall);
        const Rays made = grow_rays(geometry, options, growth);
        for (const std::string& finding : check_layer(close_border(made), options)) ADD_FAILURE() << finding;
        double largest = 0;
        std::size_t i = 0;
        for (std::size_t r = made.set.begin[1]; r < made.set.begin[2]; ++r) {
            const RayLine& ray = made.set.lines[r];
            if (i + 1 < wall.size() && ray.origin == wall[i + 1]) ++i;
            if (ray.origin != wall[i]) continue;
            EXPECT_NEAR(made.heights.of(r)[1] / (ray.slant * wanted[i]), 1, 1e-9);
            EXPECT_LE(wanted[(i + 1) % wall.size()], wanted[i] * 1.1 * (1 + 1e-12));
            largest = std::max(largest, wanted[i]);
        }
        EXPECT_EQ(i + 1, wall.size());
        EXPECT_GT(largest, 5.5e-5);
        EXPECT_TRUE(first_heights_on_wall(growth, 0, geometry.elements[0].points).empty());
    }
}

/// No layer goes beyond the thickness, whatever the first heights.
TEST(FirstHeights, ThatVaryKeepTheThickness) {
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 200)});
    const std::vector<Point>& wall = geometry.elements[0].points;
    for (const GrowthLaw law : {GrowthLaw::geometric, GrowthLaw::polynomial, GrowthLaw::exponential})
        for (const bool automatic : {false, true}) {
            if (automatic && law == GrowthLaw::exponential) continue;  // it needs a number of layers
            LayerOptions options = options_with_own_heights(law);
            options.layers = automatic ? std::nullopt : std::optional(std::uint32_t{25});
            options.thickness = 0.004;
            LayerGrowth growth = layer_growth(options, {}, {1e-5});
            for (std::size_t i = 0; i < wall.size(); ++i)
                growth.wall_first_heights.push_back({0, wall[i], 1e-5 * (1 + 3 * wall[i].x)});
            const Rays rays = grow_rays(geometry, options, growth);
            double thickest = 0;
            for (std::size_t r = 0; r < rays.set.lines.size(); ++r)
                thickest = std::max(thickest, rays.heights.of(r)[rays.counts[r]] / rays.set.lines[r].slant);
            EXPECT_LE(thickest, 0.004 * (1 + 1e-9)) << static_cast<int>(law) << automatic;
            EXPECT_GT(thickest, 0.003) << static_cast<int>(law) << automatic;
        }
}

TEST(FirstHeights, DoNotDependOnTheNumberOfThreads) {
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 400), second_section()});
    LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
    options.layers.reset();
    Layer one, four;
    with_threads(1, [&] { one = layer_with(geometry, options, {1e-5, 4e-5}); });
    with_threads(4, [&] { four = layer_with(geometry, options, {1e-5, 4e-5}); });
    EXPECT_EQ(one.points, four.points);
}

TEST(FirstHeights, OutOfRangeAreRefused) {
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 80), second_section()});
    LayerOptions options = options_with_own_heights(GrowthLaw::geometric);
    const auto grow = [&](std::vector<double> heights) {
        grow_rays(geometry, options, layer_growth(options, {}, std::move(heights)));
    };
    EXPECT_NO_THROW(grow({1e-5, 1e-4}));
    EXPECT_THROW(grow({1e-5}), OptionError);
    EXPECT_THROW(grow({1e-5, 1e-18}), OptionError);
    options.thickness = 5e-5;
    EXPECT_THROW(grow({1e-5, 1e-4}), OptionError);
    options = options_with_own_heights(GrowthLaw::exponential);
    EXPECT_THROW(grow({1e-5, 1e-3}), OptionError);
}

/// Where there is no room for a first layer of the height wanted, it is lower, and all others keep theirs.
TEST(FirstHeights, AreLowerInSlotsWithoutRoom) {
    for (const double gap : {0.03, 0.01, 0.001})
        for (const std::optional<std::uint32_t> layers :
             {std::optional<std::uint32_t>(8), std::optional<std::uint32_t>()}) {
            SCOPED_TRACE(testing::Message() << "slots of " << gap << (layers ? "" : ", automatic layers"));
            LayerOptions options = test::layers_of(1e-2, 1.2, 8);
            options.layers = layers;
            const Outline comb = shapes::refined(shapes::comb(4, gap), 20);
            const Layer layer = layer_with(shapes::geometry({comb}), options, {1e-2});
            const Rays made = grow_rays(shapes::geometry({comb}), options, layer_growth(options, {}, {1e-2}));
            std::size_t lower = 0;
            for (std::size_t i = 0; i < layer.rays[0].size(); ++i) {
                const Ray& ray = layer.rays[0][i];
                const Point at = layer.points[ray.origin.index()];
                EXPECT_GE(ray.layers, 1u) << at.x << ", " << at.y;
                const double opening = made.set.lines[i].opening;
                EXPECT_LE(opening, 1);
                if (opening < 1) ++lower;
                const bool is_below_teeth = at.y < -0.1;
                EXPECT_TRUE(!is_below_teeth || opening == 1) << at.x << ", " << at.y;
            }
            EXPECT_GT(lower, 10u);
        }
}

/// First layers on opposite walls that are wanted higher than half of the gap leave a third of it between them, however
/// long the slot is against its width.
TEST(FirstHeights, OfOppositeWallsLeaveRoomBetweenThem) {
    for (const double gap : {0.01, 0.0008}) {
        SCOPED_TRACE(gap);
        const Outline plate = shapes::polygon({{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}});
        const Outline below = shapes::moved(plate, 0, 0.8, {0.1, -gap - 0.08});
        const Geometry plates = shapes::geometry({shapes::refined(plate, 400), shapes::refined(below, 500)});
        LayerOptions options = test::layers_of(gap, 1.2, 8);
        options.layers.reset();
        const Layer layer = layer_with(plates, options, {gap, 1.1 * gap});
        for (const std::vector<Ray>& rays : layer.rays)
            for (const Ray& ray : rays) {
                const Point at = layer.points[ray.origin.index()];
                if (at.x < 0.2 || at.x > 0.8 || at.y > 0 || at.y < -1.5 * gap) continue;
                ASSERT_GE(ray.layers, 1u) << at.x << ", " << at.y;
                const double height = distance(at, layer.points[ray.vertex(ray.layers).index()]);
                EXPECT_LE(height, 0.34 * gap) << at.x << ", " << at.y;
                EXPECT_GE(height, 0.31 * gap) << at.x << ", " << at.y;
            }
    }
}

/// It takes time in proportion to the number of rays: one round in place of one for each ray of the slot.
TEST(FirstHeights, OfOppositeWallsTakeLinearTime) {
    const auto seconds = [](std::size_t parts) {
        const Outline plate = shapes::polygon({{0, 0}, {1, 0}, {1, 0.1}, {0, 0.1}});
        const Outline below = shapes::moved(plate, 0, 0.8, {0.1, -0.0008 - 0.08});
        LayerOptions options = test::layers_of(8e-4, 1.2, 8);
        options.layers.reset();
        const std::clock_t start = std::clock();
        layer_with(shapes::geometry({shapes::refined(plate, parts), shapes::refined(below, parts)}), options,
                   {8e-4, 9e-4});
        return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    };
    const double few = seconds(400), many = seconds(3200);
    EXPECT_LT(many, 5 * 8 * few);
}

/// Walls whose edges are far shorter than the first layer is high have it nevertheless, with the heights of a flow,
/// too.
TEST(FirstHeights, AreKeptOnShortEdges) {
    const Outline circle = shapes::circle(0.5, 600);  // edges of 0.0052
    LayerOptions options = test::layers_of(0.02, 1.1, 1);
    options.layers.reset();
    LayerGrowth growth = test::growth_of(options);
    for (const Point p : circle) growth.least_heights.push_back({0, p, 0.1});
    const Layer layer = close_border(grow_rays(shapes::geometry({circle}), options, growth));
    for (const std::string& finding : check_layer(layer, options)) ADD_FAILURE() << finding;
    for (const Ray& ray : layer.rays[0])
        EXPECT_NEAR(distance(layer.points[ray.origin.index()], layer.points[ray.vertex(1).index()]), 0.02, 1e-4);
}

}  // namespace
}  // namespace lamina
