// Properties of the layer on parametric outlines. check_layer() judges all layers that are made here.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <set>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>
#include <lamina/predicates.hpp>

#include "core/angles.hpp"
#include "layers/checked_layer.hpp"
#include "layers/compare_points.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;
using test::checked_layer;

LayerOptions scaled(LayerOptions options, double scale) {
    options.first_height = test::first_height(options) * scale;
    if (options.thickness) options.thickness->value *= scale;
    return options;
}

/// Expects the first layer to have its height above the edges of the wall beside each ray, on average, or a little more
/// at sharp corners. check_layer() knows how the layers above grow.
void expect_first_heights(const Layer& layer, const LayerOptions& options) {
    const auto at = [&](VertexId v) { return layer.points[v.index()]; };
    for (const auto& rays : layer.rays) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (rays[i].layers == 0) continue;
            const Point origin = at(rays[i].origin), up = at(rays[i].vertex(1)) - origin;
            const Point before = at(rays[(i + rays.size() - 1) % rays.size()].origin),
                        after = at(rays[(i + 1) % rays.size()].origin);
            double sum = 0, edges = 0;
            for (const Point edge : {origin - before, after - origin}) {
                if (edge == Point{}) continue;
                sum += dot(up, -perpendicular(unit(edge)));
                ++edges;
            }
            const double height = edges > 0 ? sum / edges : length(up);
            ASSERT_GT(height, 0.998 * test::first_height(options)) << origin.x << ' ' << origin.y;
            ASSERT_LT(height, 1.1 * test::first_height(options)) << origin.x << ' ' << origin.y;
        }
    }
}

std::size_t full_rays(const Layer& layer) {
    std::size_t count = 0;
    for (const auto& rays : layer.rays)
        for (const Ray& ray : rays) count += ray.layers == ray.requested;
    return count;
}

TEST(LayerHeight, IsTheGeometricSum) {
    const LayerGrowth growth = test::growth_of(test::thesis_layer());
    EXPECT_EQ(layer_height(growth, 0), 0);
    EXPECT_EQ(layer_height(growth, 1), growth.first_height);
    for (std::uint32_t n = 1; n < 60; ++n) {
        const double lower = layer_height(growth, n) - layer_height(growth, n - 1);
        const double upper = layer_height(growth, n + 1) - layer_height(growth, n);
        EXPECT_NEAR(upper / lower, growth.growth, 1e-11);
        const double closed_form = growth.first_height * (std::pow(growth.growth, n) - 1) / (growth.growth - 1);
        EXPECT_NEAR(layer_height(growth, n) / closed_form, 1, 1e-12);
    }
}

TEST(Layer, SmoothSectionsCarryAllLayers) {
    for (const Outline& outline : {shapes::section(0.12, 0, 100), shapes::section(0.12, 0.01, 80),
                                   shapes::joukowski(0.1, 0, 200), shapes::joukowski(0.08, 0.15, 200),
                                   shapes::circle(0.5, 60), shapes::ellipse(1, 0.05, 150), shapes::plate(0.05, 16)}) {
        const Layer layer = checked_layer(outline, test::thesis_layer());
        EXPECT_EQ(layer.coverage[0].all.incomplete_rays, 0u);
        EXPECT_EQ(layer.coverage[0].all.made_cells, layer.coverage[0].all.requested_cells);
        EXPECT_EQ(full_rays(layer), layer.rays[0].size());
        expect_first_heights(layer, test::thesis_layer());
    }
}

TEST(Layer, KeepsEveryVertexOfTheWallInOrder) {
    for (const Outline& outline : {shapes::section(0.12, 0, 60), shapes::l_shape(), shapes::c_shape(0.05)}) {
        for (CornerRays corners : {CornerRays::fan, CornerRays::refine}) {
            LayerOptions options = test::thesis_layer();
            options.corners = corners;
            const Layer layer = checked_layer(outline, options);
            std::size_t found = 0;
            for (VertexId v : layer.walls[0]) {
                ASSERT_LT(v.index(), layer.wall_points);
                if (found < outline.size() && layer.points[v.index()] == outline[found]) ++found;
            }
            EXPECT_EQ(found, outline.size());
        }
    }
}

TEST(Layer, FansStandAtSharpCornersOnly) {
    const Layer fans = checked_layer(shapes::box(), test::thesis_layer());
    std::set<VertexId> origins;
    for (const Ray& ray : fans.rays[0]) origins.insert(ray.origin);
    EXPECT_EQ(origins.size(), 4u);
    EXPECT_EQ(fans.rays[0].size(), 4u * 24u);  // 90 degrees by steps of at most 4

    LayerOptions refine = test::thesis_layer();
    refine.corners = CornerRays::refine;
    const Layer refined = checked_layer(shapes::box(), refine);
    origins.clear();
    for (const Ray& ray : refined.rays[0]) origins.insert(ray.origin);
    EXPECT_EQ(origins.size(), refined.rays[0].size());
    EXPECT_GT(refined.wall_points, 4u * 20u);

    // A polygon of 10 corners turns by 36 degrees at each of them, which is too little for fans.
    const Layer smooth = checked_layer(shapes::circle(1, 10), test::thesis_layer());
    origins.clear();
    for (const Ray& ray : smooth.rays[0]) origins.insert(ray.origin);
    EXPECT_EQ(origins.size(), smooth.rays[0].size());
}

TEST(Layer, AngleBetweenRaysKeepsItsLimitForAnyLimit) {
    for (double limit : {0.7, 4.0, 10.0, 36.0, 90.0}) {
        for (CornerRays corners : {CornerRays::fan, CornerRays::refine}) {
            LayerOptions options = test::thesis_layer();
            options.max_ray_angle_deg = limit;
            options.corners = corners;
            checked_layer(shapes::section(0.12, 0, 30), options);  // check_layer() looks at the angles
            checked_layer(shapes::l_shape(), options);
        }
    }
}

TEST(Layer, ThicknessLimitsTheNumberOfLayers) {
    LayerOptions options = test::thesis_layer();
    options.thickness = layer_height(test::growth_of(options), 12);
    Layer layer = checked_layer(shapes::circle(1, 50), options);
    for (const Ray& ray : layer.rays[0]) EXPECT_EQ(ray.layers, 12u);
    options.thickness = 0.999 * layer_height(test::growth_of(options), 12);
    layer = checked_layer(shapes::circle(1, 50), options);
    for (const Ray& ray : layer.rays[0]) EXPECT_EQ(ray.layers, 11u);
    EXPECT_EQ(layer.coverage[0].all.incomplete_rays, 0u);
}

TEST(Layer, MovesWithItsInput) {
    const Outline outline = shapes::refined(shapes::l_shape(), 8);
    LayerOptions options = test::thesis_layer();
    options.first_height = 1e-3;
    options.layers = 15;
    const Layer layer = checked_layer(outline, options);
    for (double scale : {1e-3, 1.0, 1e3}) {
        for (double angle : {0.3, 1.5, 4.0}) {
            const Point shift{3 * scale, -2 * scale};
            const Layer image = checked_layer(shapes::moved(outline, angle, scale, shift), scaled(options, scale));
            ASSERT_EQ(image.rays[0].size(), layer.rays[0].size());
            const Outline expected = shapes::moved(layer.points, angle, scale, shift);
            for (std::size_t i = 0; i < layer.rays[0].size(); ++i)
                EXPECT_LE(
                    std::abs(static_cast<int>(image.rays[0][i].layers) - static_cast<int>(layer.rays[0][i].layers)), 1);
            for (std::size_t i = 0; i < layer.wall_points; ++i)
                ASSERT_LT(distance(image.points[i], expected[i]), 1e-13 * scale);
        }
    }
}

TEST(Layer, MirroredInputGivesMirroredPoints) {
    std::mt19937 random(7);
    for (const Outline& outline : {shapes::section(0.12, 0, 60), shapes::section(0.12, 0.02, 60),
                                   shapes::joukowski(0.1, 0.1, 90), shapes::refined(shapes::star(9, 0.3, random), 5)}) {
        LayerOptions options = test::thesis_layer();
        options.layers = 45;
        const Layer layer = checked_layer(outline, options);
        const Layer mirror = checked_layer(shapes::mirrored(outline), options);
        ASSERT_EQ(layer.points.size(), mirror.points.size());
        const auto a = test::sorted(layer.points), b = test::sorted_mirror(mirror.points);
        EXPECT_LT(std::max(test::set_distance(a, b), test::set_distance(b, a)), 1e-11);
    }
}

TEST(Layer, SymmetricSectionHasSymmetricLayer) {
    const Layer layer = checked_layer(shapes::section(0.12, 0, 70), test::thesis_layer());
    EXPECT_LT(test::set_distance(test::sorted_mirror(layer.points), test::sorted(layer.points)), 1e-12);
}

TEST(Layer, StartOfTheLoopDoesNotMatter) {
    const Outline outline = shapes::refined(shapes::l_shape(), 6);
    LayerOptions options = test::thesis_layer();
    options.first_height = 2e-3;
    const auto reference = test::sorted(checked_layer(outline, options).points);
    for (std::size_t first : {1u, 7u, 20u, 35u}) {
        const auto points = test::sorted(checked_layer(shapes::started_at(outline, first), options).points);
        ASSERT_EQ(points.size(), reference.size());
        EXPECT_LT(test::set_distance(points, reference), 1e-12);
    }
}

TEST(Layer, ThinsInAVNotchAndRecovers) {
    LayerOptions options = test::thesis_layer();
    options.first_height = 1e-3;
    const Layer layer = checked_layer(shapes::refined(shapes::v_notch(0.4), 20), options);
    EXPECT_GT(layer.coverage[0].all.incomplete_rays, 0u);
    EXPECT_GT(full_rays(layer), 20u);
    const auto beside_bottom = std::find_if(layer.rays[0].begin(), layer.rays[0].end(),
                                            [](const Ray& ray) { return !ray.corner_after.empty(); });
    ASSERT_NE(beside_bottom, layer.rays[0].end());
    ASSERT_EQ(beside_bottom->corner_after.size(), 1u);
    EXPECT_EQ(layer.points[beside_bottom->corner_after[0].index()], (Point{2, 0.2}));
    EXPECT_LT(beside_bottom->layers, 8u);
    EXPECT_LT(beside_bottom->height_limit, 0.02);
}

TEST(Layer, LipsThatNearlyTouchKeepSpaceBetweenTheirFronts) {
    for (double lips : {0.2, 0.02, 1e-3}) {
        LayerOptions options = test::thesis_layer();
        options.first_height = 1e-4;
        const Layer layer = checked_layer(shapes::refined(shapes::c_shape(lips), 20), options);
        // The slot runs along y = 1; no point comes nearer to its middle than an eighth of its width.
        for (Point p : layer.points) {
            if (p.x > 1.85 && p.x < 1.95) {
                EXPECT_GE(std::abs(p.y - 1), 0.12 * lips);
            }
        }
    }
}

TEST(Layer, VeryThickLayersStayValid) {
    for (std::uint32_t layers : {40u, 60u}) {
        LayerOptions options = test::thesis_layer();
        options.layers = layers;
        options.first_height = 1e-4;
        for (const Outline& outline :
             {shapes::l_shape(), shapes::c_shape(0.3), shapes::v_notch(1), shapes::comb(4, 0.1), shapes::wedge(),
              shapes::diamond(), shapes::joukowski(0.1, 0.3, 100)}) {
            for (std::size_t parts : {1u, 7u}) {
                for (CornerRays corners : {CornerRays::fan, CornerRays::refine}) {
                    options.corners = corners;
                    checked_layer(shapes::refined(outline, parts), options);
                }
            }
        }
    }
}

TEST(Layer, RandomStarsStayValid) {
    std::mt19937 random(20);
    for (int k = 0; k < 400; ++k) {
        const std::size_t corners = 3 + random() % 30;
        const double min_radius = 0.05 + 0.9 * static_cast<double>(random() % 1000) / 1000;
        Outline outline = shapes::refined(shapes::star(corners, min_radius, random), 1 + random() % 6);
        LayerOptions options;
        options.first_height = std::pow(10, -5 + 4 * static_cast<double>(random() % 1000) / 1000);
        options.growth = 1.05 + 0.5 * static_cast<double>(random() % 1000) / 1000;
        options.layers = 1 + random() % 40;
        options.thickness = std::max(test::first_height(options), 0.5);
        options.max_ray_angle_deg = 2 + random() % 20;
        options.corners = random() % 2 == 0 ? CornerRays::fan : CornerRays::refine;
        BorderOptions border;
        border.max_ratio = random() % 2 == 0 ? 1.5 : 2;
        SCOPED_TRACE(k);
        checked_layer(outline, options, border);
        if (HasFailure()) break;
    }
}

TEST(Layer, SeveralBodiesKeepApart) {
    LayerOptions options = test::thesis_layer();
    options.first_height = 1e-4;
    for (double gap : {1.0, 0.1, 0.01, 1e-4}) {
        const Outline main = shapes::section(0.12, 0, 40);
        const Outline flap = shapes::moved(shapes::section(0.12, 0.01, 30), -0.5, 0.3, {1 + gap, -0.01});
        const Layer layer = checked_layer(shapes::geometry({main, flap}), options);
        ASSERT_EQ(layer.borders.size(), 2u);
        EXPECT_GT(full_rays(layer), 20u);
    }
    // A small body between two rays of another one.
    const Outline speck = shapes::moved(shapes::circle(0.002, 8), 0, 1, {0.43, 1.05});
    checked_layer(shapes::geometry({shapes::box(), speck}), options);
}

TEST(Layer, WithoutLayersTheBorderIsTheWall) {
    LayerOptions options;
    options.enabled = false;
    const Outline outline = shapes::section(0.12, 0.01, 40);
    const Layer layer = checked_layer(outline, options);
    EXPECT_EQ(layer.borders, layer.walls);
    EXPECT_EQ(layer.wall_points, layer.points.size());
    EXPECT_TRUE(layer.rays[0].empty());
    std::size_t found = 0;
    for (VertexId v : layer.walls[0])
        if (found < outline.size() && layer.points[v.index()] == outline[found]) ++found;
    EXPECT_EQ(found, outline.size());
}

TEST(Layer, SourcesDivideTheBorder) {
    const Outline outline = shapes::section(0.12, 0.01, 40);
    const std::size_t whole = checked_layer(outline, test::thesis_layer()).borders[0].size();
    BorderOptions options;
    const std::vector<SizeSource> sources{
        {.a = {0.3, 0}, .b = {0.4, 0.3}, .size = 1e-3, .shape = SizeSource::Shape::box},
        {.a = {0.7, -0.1}, .b = {0.7, -0.1}, .size = 2e-3, .radius = 0.07},
        {.a = {1, 0}, .b = {2, 0.1}, .size = 5e-4}};
    for (std::size_t n = 0; n <= sources.size(); ++n) {
        options.sources.assign(sources.begin(), sources.begin() + static_cast<std::ptrdiff_t>(n));
        const Layer layer = checked_layer(outline, test::thesis_layer(), options);
        const auto& border = layer.borders[0];
        EXPECT_GE(border.size(), whole + 30 * n);
        for (std::size_t k = 0; k < border.size(); ++k) {
            const Point a = layer.points[border[k].index()], b = layer.points[border[(k + 1) % border.size()].index()];
            for (const SizeSource& source : options.sources) {
                const double away = distance_to(source, midpoint(a, b));
                EXPECT_LE(distance(a, b), (source.size + options.gradation * away) * 1.1);
            }
        }
    }
}

TEST(Layer, BorderIsGradedBesideAFineFan) {
    // The edges over fans are a tenth of the side of the box; along the side, edges grow by the requested gradation.
    BorderOptions options;
    for (double gradation : {0.05, 0.1, 0.2}) {
        options.gradation = gradation;
        const Layer layer = checked_layer(shapes::box(), test::thesis_layer(), options);
        const auto& border = layer.borders[0];
        double shortest = HUGE_VAL, longest = 0;
        for (std::size_t k = 0; k < border.size(); ++k) {
            const double edge =
                distance(layer.points[border[k].index()], layer.points[border[(k + 1) % border.size()].index()]);
            shortest = std::min(shortest, edge);
            longest = std::max(longest, edge);
        }
        EXPECT_LE(longest, 1.4 * (shortest + 0.5 * gradation));
        EXPECT_GE(longest, 0.3 * (shortest + 0.5 * gradation));
    }
}

/// Returns the rays of a polygon of 160 equal edges, with layers of these heights.
Rays rays_of_circle(double first_height, std::uint32_t layers, bool resampled, LayerTopology topology) {
    LayerOptions options = test::thesis_layer();
    options.topology = topology;
    options.first_height = first_height;
    options.layers = layers;
    options.max_ray_angle_deg = 10;
    Geometry geometry = shapes::geometry({shapes::circle(0.5, 160)});
    geometry.elements[0].resampled = geometry.elements[0].smooth = resampled;
    return grow_rays(geometry, options, test::growth_of(options));
}

/// Checks that the front's edges, all equally long, are halved where they are longer than the largest edge of the
/// border by more than a tenth or, where `stay_whole`, by more than root 2; and by more than a source asks for in any
/// case.
void expect_halves(const Rays& rays, bool stay_whole) {
    const std::vector<Point> front = fronts(rays)[0];
    ASSERT_EQ(front.size(), 160U);
    for (const double excess : {1.05, 1.2, 1.35, 1.5}) {
        SCOPED_TRACE(testing::Message() << "excess " << excess);
        BorderOptions border;
        border.max_edge = 1.1 * distance(front[0], front[1]) / excess;
        const bool whole = excess < (stay_whole ? 1.4 : 1.1);
        EXPECT_EQ(close_border(rays, border).borders[0].size(), whole ? front.size() : 2 * front.size());
        border.sources = {{.a = {-1, -1}, .b = {1, 1}, .size = border.max_edge, .shape = SizeSource::Shape::box}};
        EXPECT_EQ(close_border(rays, border).borders[0].size(), excess < 1.1 ? front.size() : 2 * front.size());
    }
}

/// Below halves of the top of a flat cell the angle at the middle of the top would be near 180 degrees, and the
/// triangles of a cell that is about as high as wide would be twice as large as those on the halves.
TEST(Layer, TopsOfCellsOfTheGridOnResampledWallsStayWhole) {
    const double edge = 2 * 0.5 * std::sin(core::pi / 160);
    for (const double width_over_height : {0.5, 1.0, 1.5, 1.8, 2.0, 7.0, 8.0, 20.0, 1000.0})
        for (const bool resampled : {false, true})
            for (const LayerTopology topology :
                 {LayerTopology::delaunay, LayerTopology::layered, LayerTopology::quads}) {
                SCOPED_TRACE(testing::Message() << width_over_height << " times as wide as high, resampled "
                                                << resampled << ", topology " << int(topology));
                expect_halves(rays_of_circle(edge / width_over_height, 1, resampled, topology),
                              resampled && topology != LayerTopology::delaunay);
            }
}

TEST(Layer, RefusesOptionsOutOfRange) {
    const Geometry circle = shapes::geometry({shapes::circle(1, 20)});
    const auto refused = [&](auto change) {
        LayerOptions options = test::thesis_layer();
        change(options);
        EXPECT_THROW(test::make_layer(circle, options), UsageError);
    };
    refused([](LayerOptions& o) { o.first_height = 0.0; });
    refused([](LayerOptions& o) { o.first_height = -1e-5; });
    refused([](LayerOptions& o) { o.first_height = NAN; });
    refused([](LayerOptions& o) { o.first_height = 1e-18; });
    refused([](LayerOptions& o) { o.growth = 1; });
    refused([](LayerOptions& o) { o.growth = NAN; });
    refused([](LayerOptions& o) { o.layers = 0; });
    refused([](LayerOptions& o) { o.layers = 100000; });
    refused([](LayerOptions& o) { o.layers = 5000; });
    refused([](LayerOptions& o) { o.max_ray_angle_deg = 0; });
    refused([](LayerOptions& o) { o.max_ray_angle_deg = 180; });
    refused([](LayerOptions& o) { o.thickness = 1e-6; });
    EXPECT_THROW(test::make_layer(circle, test::thesis_layer(), {.max_ratio = 1}), OptionError);
    EXPECT_THROW(test::make_layer(circle, test::thesis_layer(), {.gradation = 0}), OptionError);
    EXPECT_THROW(test::make_layer(circle, test::thesis_layer(), {.max_edge = NAN}), OptionError);
}

TEST(CheckLayer, FindsDefects) {
    const LayerOptions options = test::thesis_layer();
    const Layer valid = checked_layer(shapes::circle(1, 40), options);
    const auto expect_finding = [&](auto spoil) {
        Layer layer = valid;
        spoil(layer);
        EXPECT_FALSE(check_layer(layer, options).empty());
    };
    const std::size_t ray_point = valid.rays[0][3].first_point + 4;
    expect_finding([&](Layer& l) { l.points[ray_point] = {2, 0}; });
    expect_finding([&](Layer& l) { l.points[ray_point] = {0, 0}; });
    expect_finding([&](Layer& l) { l.points[ray_point] = l.points[ray_point + 1]; });
    expect_finding([&](Layer& l) { std::swap(l.borders[0][3], l.borders[0][4]); });
    expect_finding([&](Layer& l) { std::reverse(l.borders[0].begin(), l.borders[0].end()); });
    expect_finding([&](Layer& l) { l.borders[0].erase(l.borders[0].begin() + 5); });
    expect_finding([&](Layer& l) { l.rays[0][5].layers -= 2; });
    expect_finding([&](Layer& l) { std::swap(l.rays[0][5], l.rays[0][6]); });
    expect_finding([&](Layer& l) { l.points[l.borders[0][2].index()] = {5, 5}; });
    // A border that is simple and even, and not that of the cells.
    expect_finding([&](Layer& l) {
        std::vector<VertexId>& border = l.borders[0];
        for (std::size_t k = 0; k < border.size() / 2; ++k) border[k] = border[2 * k];
        border.resize(border.size() / 2);
    });
    expect_finding([&](Layer& l) {
        for (std::size_t i = 0; i < l.rays[0].size(); ++i)
            *std::find(l.borders[0].begin(), l.borders[0].end(), l.rays[0][i].tip()) = l.rays[0][i].vertex(3);
    });
    expect_finding([&](Layer& l) { l.walls[0].erase(l.walls[0].begin() + 7); });
    expect_finding([&](Layer& l) { l.rays[0].erase(l.rays[0].begin() + 7); });
}

/// Meshes measured sections where the shared folder is at hand.
TEST(Layer, RealSections) {
    const char* shared = std::getenv("LAMINA_SHARED");
    const std::filesystem::path folder =
        (shared != nullptr ? std::filesystem::path(shared) : std::filesystem::path(LAMINA_SOURCE_DIR) / "../shared") /
        "geometry/uiuc/selig";
    if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
    for (const char* name : {"rae2822", "e387", "s1223", "naca63a210", "n0012", "goe417a"}) {
        SCOPED_TRACE(name);
        const std::vector<std::string> inputs{(folder / (std::string(name) + ".dat")).string()};
        const Geometry geometry = read_geometry(inputs);
        LayerOptions options = test::thesis_layer();
        const Layer layer = checked_layer(geometry, options);
        expect_first_heights(layer, options);
        // The file of naca63a210 holds a step of 0.3 % chord at mid-chord; the others are smooth.
        if (std::string(name) != "naca63a210") {
            EXPECT_EQ(layer.coverage[0].all.incomplete_rays, 0u);
        }
        options.layers = 60;
        checked_layer(geometry, options);
    }
}

}  // namespace
}  // namespace lamina
