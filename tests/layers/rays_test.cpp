// The rays: bisectors where the wall is convex or turns gently, tilted out of concavities elsewhere; rays inserted
// where numbers of layers change or where the border is divided.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <utility>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/checked_layer.hpp"
#include "layers/directions/corners.hpp"
#include "layers/directions/rays.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

LayerOptions layers_as_high_as(double height) {
    LayerOptions options;
    options.layers = 30;
    options.first_height =
        height / layer_height(test::growth_of(options), *options.layers) * test::first_height(options);
    return options;
}

double made_share(const Outline& outline, const LayerOptions& options) {
    const LayerCoverage all = test::checked_layer(outline, options).coverage[0].all;
    return double(all.made_cells) / double(all.requested_cells);
}

/// Returns the outline with each coordinate of its vertices moved at random by up to `noise`.
Outline noisy(Outline outline, double noise) {
    std::mt19937 random(7);
    const auto offset = [&] { return noise * (2.0 * double(random()) / 4294967295.0 - 1); };
    for (Point& p : outline) p = p + Point{offset(), offset()};
    return outline;
}

std::vector<RayLine> rays_of(const Outline& outline, const LayerOptions& options,
                             layers::OutlineKind kind = layers::OutlineKind::given) {
    const LayerGrowth growth = test::growth_of(options);
    const std::vector<double> heights(outline.size(), layer_height(growth, *options.layers));
    return layers::make_rays(layers::outline_with_wake(outline), kind, options, growth, heights);
}

TEST(Rays, AreBisectorsWhereTheWallIsConvexOrTurnsGently) {
    const LayerOptions options = layers_as_high_as(0.02);
    for (const Outline& outline : {shapes::circle(1, 80), shapes::joukowski(0.08, 0.3, 300)}) {
        const std::vector<RayLine> rays = rays_of(outline, options);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::size_t n = outline.size();
            const Point before = unit(outline[i] - outline[(i + n - 1) % n]),
                        after = unit(outline[(i + 1) % n] - outline[i]);
            if (dot(before, after) < 0.5) continue;
            const Point bisector = unit(-perpendicular(before) - perpendicular(after));
            const auto ray =
                std::find_if(rays.begin(), rays.end(), [&](const RayLine& r) { return r.origin == outline[i]; });
            ASSERT_NE(ray, rays.end());
            EXPECT_LT(distance(ray->direction, bisector), 1e-14);
        }
    }
}

TEST(Rays, LeanOutOfConcaveCornersSoThatLayersGoThroughThem) {
    for (std::size_t parts : {4u, 15u, 60u}) {
        EXPECT_GT(made_share(shapes::refined(shapes::l_shape(), parts), layers_as_high_as(0.1)), 0.97) << parts;
        EXPECT_GT(made_share(shapes::refined(shapes::c_shape(1.2), parts), layers_as_high_as(0.04)), 0.9) << parts;
    }
}

TEST(Rays, LeanAcrossNoise) {
    const Outline smooth = shapes::circle(1, 300);
    for (double noise : {1e-4, 1e-3, 4e-3}) {
        EXPECT_GT(made_share(noisy(smooth, noise), layers_as_high_as(0.05)), 0.97) << noise;
    }
}

/// The corners of a star with edges of equal length, which are as short as a surface may make them.
TEST(Rays, StandAtTheVerticesOfJaggedWallsAlone) {
    Outline star = shapes::circle(1, 40);
    for (std::size_t i = 0; i < star.size(); i += 2) star[i] = 0.99 * star[i];
    star = shapes::refined(star, 3);
    const LayerOptions options = layers_as_high_as(0.05);
    EXPECT_GT(rays_of(star, options).size(), star.size());
    EXPECT_EQ(rays_of(star, options, layers::OutlineKind::jagged).size(), star.size());

    Geometry geometry = shapes::geometry({star});
    geometry.elements[0].resampled = true;
    const Layer layer = test::checked_layer(geometry, options);
    EXPECT_EQ(layer.walls[0].size(), star.size());
    EXPECT_GT(layer.coverage[0].all.made_cells, 0.95 * static_cast<double>(layer.coverage[0].all.requested_cells));

    // Columns that would open widely are divided.
    const Outline coarse = shapes::circle(1, 8);
    const std::vector<RayLine> rays = rays_of(coarse, options, layers::OutlineKind::jagged);
    EXPECT_EQ(rays.size(), 3 * coarse.size());
}

TEST(Rays, StayWellInsideTheHalfPlanesOfBothEdges) {
    const double min_cosine = std::cos(core::radians(51));
    for (const Outline& outline :
         {noisy(shapes::circle(1, 300), 6e-3), shapes::refined(shapes::c_shape(0.05), 20), shapes::comb(4, 0.1),
          shapes::refined(shapes::v_notch(0.4), 20), noisy(shapes::joukowski(0.1, 0.4, 200), 1e-3)}) {
        for (double height : {1e-3, 0.05, 1.0}) {
            LayerOptions options = layers_as_high_as(height);
            options.max_ray_angle_deg = 4;
            const std::vector<RayLine> rays = rays_of(outline, options);
            for (std::size_t i = 0; i < rays.size(); ++i) {
                const RayLine &ray = rays[i], &next = rays[(i + 1) % rays.size()];
                const double angle = core::angle_between(ray.direction, next.direction);
                EXPECT_LE(angle, core::radians(4 + 1e-6));
                if (ray.origin == next.origin) continue;
                const Point normal = -perpendicular(unit(next.origin - ray.origin));
                EXPECT_GT(std::min(dot(normal, ray.direction), dot(normal, next.direction)), 0.2);
            }
            // At vertices that turn gently, rays are within 50 degrees of both normals.
            for (std::size_t i = 0; i < outline.size(); ++i) {
                const std::size_t n = outline.size();
                const Point before = unit(outline[i] - outline[(i + n - 1) % n]),
                            after = unit(outline[(i + 1) % n] - outline[i]);
                if (dot(before, after) < 0.7) continue;
                const auto ray =
                    std::find_if(rays.begin(), rays.end(), [&](const RayLine& r) { return r.origin == outline[i]; });
                ASSERT_NE(ray, rays.end());
                EXPECT_GT(dot(-perpendicular(before), ray->direction), min_cosine);
                EXPECT_GT(dot(-perpendicular(after), ray->direction), min_cosine);
            }
        }
    }
}

/// A ray tilted at a vertex is not as high above both edges there. Where the wall is smooth, first heights stay within
/// a hundredth all the same.
TEST(Rays, LeanNoFurtherThanHeightsAboveBothEdgesAllow) {
    std::size_t tilted = 0;
    for (double amplitude : {0.01, 0.02, 0.03}) {
        Outline outline = shapes::circle(1, 600);
        for (std::size_t i = 0; i < outline.size(); ++i)
            outline[i] = (1 + amplitude * std::cos(shapes::full_turn * static_cast<double>(i) / 30)) * outline[i];
        const std::vector<RayLine> rays = rays_of(outline, layers_as_high_as(0.2));
        const std::size_t n = outline.size();
        for (const RayLine& ray : rays) {
            const auto at = std::find(outline.begin(), outline.end(), ray.origin);
            if (at == outline.end()) continue;  // a ray between two vertices
            const std::size_t i = static_cast<std::size_t>(at - outline.begin());
            const Point before = unit(outline[i] - outline[(i + n - 1) % n]),
                        after = unit(outline[(i + 1) % n] - outline[i]);
            if (std::abs(core::angle_between(before, after)) > core::radians(1)) continue;
            const double height_before = dot(-perpendicular(before), ray.direction),
                         height_after = dot(-perpendicular(after), ray.direction);
            const double mean = 0.5 * (height_before + height_after);
            EXPECT_NEAR(height_before / mean, 1, 0.00901);
            tilted += std::abs(height_before / mean - 1) > 0.001;
        }
    }
    EXPECT_GT(tilted, 20u);
}

/// A small body lies near one vertex of a wall of few vertices. Numbers of layers change by one from vertex to vertex,
/// and most layers are kept.
TEST(Rays, OfCoarseWallsBesideASmallBodyKeepMostLayers) {
    const Outline plate = shapes::polygon({{0, -1}, {4, -1}, {4, 0}, {3, 0}, {2, 0}, {1, 0}, {0, 0}});
    const Outline small = shapes::moved(shapes::circle(0.05, 40), 0, 1, {2, 0.06});
    const Layer layer = test::checked_layer(shapes::geometry({plate, small}), layers_as_high_as(0.1));
    const LayerCoverage& all = layer.coverage[0].all;
    EXPECT_GT(double(all.made_cells), 0.75 * double(all.requested_cells));
}

/// Returns the number of points that divide the border of an element between the tips of its rays.
std::size_t division_points(const Layer& layer, std::size_t element) {
    std::size_t first = 0;
    for (const auto& rays : layer.rays)
        for (const Ray& ray : rays) first = std::max(first, ray.first_point + ray.layers);
    const auto& border = layer.borders[element];
    return static_cast<std::size_t>(
        std::count_if(border.begin(), border.end(), [&](VertexId v) { return v.index() >= first; }));
}

/// A fine body above a coarse wall requests short edges of the wall's border, and with them a finer wall below.
TEST(Rays, AskForFinerResampledWallsBelowBordersThatWouldBeDivided) {
    const Outline wall = shapes::refined(shapes::polygon({{0, -1}, {4, -1}, {4, 0}, {0, 0}}), 20);
    const Outline fine = shapes::moved(shapes::circle(0.05, 200), 0, 1, {2, 0.3});
    const LayerOptions options = layers_as_high_as(0.05);
    const BorderOptions border;
    Geometry geometry = shapes::geometry({wall, fine});
    EXPECT_GT(division_points(test::make_layer(geometry, options, border), 0), 20u);
    EXPECT_TRUE(wall_spacings(grow_rays(geometry, options, test::growth_of(options)), border)
                    .empty());  // no element is resampled

    for (Element& element : geometry.elements) element.resampled = true;
    const std::vector<geometry::WallSpacing> spacings =
        wall_spacings(grow_rays(geometry, options, test::growth_of(options)), border);
    ASSERT_FALSE(spacings.empty());
    for (const geometry::WallSpacing& spacing : spacings) {
        EXPECT_EQ(spacing.element, 0u);
        EXPECT_LT(spacing.spacing, distance(spacing.a, spacing.b));
        EXPECT_GT(spacing.spacing, 0.001);
    }
}

/// Rays of a smooth outline leave its blunter corners in fans, so that no refining rays divide the edges beside.
TEST(Rays, LeaveBluntCornersOfSmoothOutlinesInFans) {
    const Outline hexagon = shapes::refined(shapes::polygon({{0, 0}, {2, -0.5}, {4, 0}, {4, 2}, {2, 2.5}, {0, 2}}), 20);
    const LayerOptions options = layers_as_high_as(0.05);
    const auto origins = [&](layers::OutlineKind kind) {
        const std::vector<RayLine> rays =
            layers::make_rays(layers::outline_with_wake(hexagon), kind, options, test::growth_of(options));
        std::set<std::pair<double, double>> points;
        for (const RayLine& ray : rays) points.emplace(ray.origin.x, ray.origin.y);
        return points.size();
    };
    EXPECT_EQ(origins(layers::OutlineKind::smooth), hexagon.size());
    EXPECT_GT(origins(layers::OutlineKind::given), hexagon.size());
}

/// Rays out of a concave corner converge with those beside it, and there are none between.
TEST(Rays, AreNotAddedBesideConcaveCorners) {
    const Outline corner =
        shapes::refined(shapes::polygon({{0, 0}, {0.1, 0}, {0.1, 0.1}, {-0.1, 0.1}, {-0.1, -0.1}, {0, -0.1}}), 1000);
    const LayerOptions options = test::layers_of(1e-6, 1.2, 5);
    for (const layers::OutlineKind kind :
         {layers::OutlineKind::given, layers::OutlineKind::smooth, layers::OutlineKind::jagged})
        for (const RayLine& ray :
             layers::make_rays(layers::outline_with_wake(corner), kind, options, test::growth_of(options)))
            EXPECT_NE(std::find(corner.begin(), corner.end(), ray.origin), corner.end());
}

/// Rows over both walls of a cove corner keep their heights above the walls. Heights along rays are larger the more
/// these lean, and the front rises slowly, so that it rounds the corner: the upper half of the layers is up to 7 %
/// lower, or there is a layer less.
TEST(Rays, OutOfCoveCornersKeepTheHeightsAboveBothWalls) {
    const Outline cove = shapes::refined(shapes::polygon({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {0, 2}}), 40);
    const LayerOptions options = layers_as_high_as(0.1);
    const Layer layer = test::checked_layer(cove, options);
    std::size_t leaning = 0;
    for (const Ray& ray : layer.rays[0]) {
        const Point origin = layer.points[ray.origin.index()];
        EXPECT_GE(ray.layers + 1, ray.requested) << origin.x << ' ' << origin.y;
        if (!(origin.x <= 2 && origin.x > 1 && origin.y == 2)) continue;  // the wall left of the corner
        leaning += ray.direction.y < 0.999;
        for (std::uint32_t n = 1; n <= ray.layers; ++n) {
            const double share = (layer.points[ray.vertex(n).index()].y - 2) / layer_height(layer.growth, n);
            EXPECT_GT(share, n <= ray.layers / 2 ? 0.99 : 0.93);
            if (n <= ray.layers / 2) {
                EXPECT_LT(share, 1.01);
            }
        }
        const double end = (layer.points[ray.tip().index()].y - 2) / layer_height(layer.growth, ray.requested);
        EXPECT_LT(end, 1.01);
        EXPECT_GT(end, 0.9);
    }
    EXPECT_GT(leaning, 2u);
}

/// A kink beside a cove corner tilts the rays of both. Their first layers have the same height above both edges, though
/// rays lean; rows above have not.
TEST(Rays, ThatLeanOutOfCornersKeepFirstHeightsAboveBothEdges) {
    const Outline cove =
        shapes::refined(shapes::polygon({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2.2}, {1.9, 2}, {0, 2}}), 12);
    const LayerOptions options = layers_as_high_as(0.1);
    const Geometry geometry = shapes::geometry({cove});
    const Layer layer = test::checked_layer(geometry, options);
    const Rays made = grow_rays(geometry, options, test::growth_of(options));
    const double height = layer_height(layer.growth, 1);
    std::size_t shifted = 0;
    for (std::size_t i = 0; i < layer.rays[0].size(); ++i) {
        const std::vector<Ray>& rays = layer.rays[0];
        const Ray &ray = rays[i], &before = rays[(i + rays.size() - 1) % rays.size()],
                  &after = rays[(i + 1) % rays.size()];
        if (made.set.lines[i].shift == Point{}) continue;
        ++shifted;
        const Point origin = layer.points[ray.origin.index()], top = layer.points[ray.vertex(1).index()];
        const auto height_above = [&](Point edge) { return dot(top - origin, -perpendicular(unit(edge))) / height; };
        EXPECT_NEAR(height_above(origin - layer.points[before.origin.index()]), 1, 1e-9);
        EXPECT_NEAR(height_above(layer.points[after.origin.index()] - origin), 1, 1e-9);
        EXPECT_GT(distance(top, origin + made.set.lines[i].slant * height * ray.direction), 0.009 * height);
    }
    EXPECT_GT(shifted, 0u);
    EXPECT_LT(shifted, 4u);
}

/// Returns the shift of a ray that leans by so much, at a vertex where a wall of edges 1 long turns inwards.
Point shift_of_leaning_ray(double turning_deg, double lean_deg) {
    const double turning = core::radians(turning_deg), first_height = 1e-3;
    const Point edge = core::rotated({-1, 0}, -turning);
    RaySet set;
    set.lines = {{{1, 0}, {0, 1}}, {{0, 0}, core::rotated({0, 1}, core::radians(-lean_deg))}, {edge, {0, 1}}};
    set.begin = {0, 3};
    layers::shift_rays_of_corners(LayerGrowth{.first_height = first_height}, set);
    return set.lines[1].shift;
}

TEST(Rays, AreShiftedWhereFirstHeightsWouldBeOff) {
    EXPECT_NE(shift_of_leaning_ray(4.5, 30), Point{});
    EXPECT_NE(shift_of_leaning_ray(20, 30), Point{});
    EXPECT_EQ(shift_of_leaning_ray(4.5, 2), Point{}) << "0.2 % off";
}

TEST(Rays, AreShortenedInCirclesAndLeadOverToThoseBeside) {
    const Outline outline = shapes::circle(1, 200);
    const LayerOptions options = layers_as_high_as(0.2);
    const Geometry geometry = shapes::geometry({outline});
    Rays rays = grow_rays(geometry, options, test::growth_of(options));
    EXPECT_EQ(shorten_rays(std::vector<Circle>{{{3, 0}, 0.5}}, rays), std::vector<std::size_t>{0});
    const std::size_t shortened = shorten_rays(std::vector<Circle>{{{3, 0}, 0.5}, {{1.2, 0}, 0.1}}, rays)[1];
    EXPECT_GT(shortened, 2u);
    EXPECT_LT(shortened, 12u);
    const Layer layer = close_border(rays);
    for (const std::string& finding : check_layer(layer, options)) ADD_FAILURE() << finding;
    std::size_t cut = 0;
    for (const Ray& ray : layer.rays[0]) {
        cut += ray.layers < ray.requested;
        const Point origin = layer.points[ray.origin.index()], tip = layer.points[ray.tip().index()];
        if (distance(origin, {1, 0}) < 0.05) {
            EXPECT_LT(distance(origin, tip), 0.15);
        }
        if (origin.x < 0.5) {
            EXPECT_EQ(ray.layers, ray.requested);
        }
    }
    EXPECT_GT(cut, shortened);
}

TEST(Rays, OfAMirroredOutlineAreMirrored) {
    const LayerOptions options = layers_as_high_as(0.1);
    for (const Outline& outline : {shapes::refined(shapes::c_shape(0.3), 12), noisy(shapes::circle(1, 200), 4e-3),
                                   shapes::refined(shapes::v_notch(0.4), 15)}) {
        std::vector<RayLine> rays = rays_of(outline, options), mirrored = rays_of(shapes::mirrored(outline), options);
        ASSERT_EQ(rays.size(), mirrored.size());
        for (RayLine& ray : mirrored) ray = {{ray.origin.x, -ray.origin.y}, {ray.direction.x, -ray.direction.y}};
        for (const RayLine& ray : rays) {
            const auto same = std::find_if(mirrored.begin(), mirrored.end(), [&](const RayLine& other) {
                return distance(ray.origin, other.origin) < 1e-14 && distance(ray.direction, other.direction) < 1e-12;
            });
            EXPECT_NE(same, mirrored.end()) << ray.origin.x << ' ' << ray.origin.y;
        }
    }
}

}  // namespace
}  // namespace lamina
