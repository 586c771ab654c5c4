// The heights of each growth law against its formula, and layers that end where they are as high as wide.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <lamina/error.hpp>
#include <lamina/layers.hpp>

#include "layers/checked_layer.hpp"
#include "layers/compare_points.hpp"
#include "layers/growth_laws.hpp"
#include "layers/heights/heights.hpp"
#include "layers/layer.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

using test::checked_layer;

std::vector<GrowthLaw> every_law() {
    std::vector<GrowthLaw> laws;
    for (const layers::GrowthLawEntry& entry : layers::growth_law_table()) laws.push_back(entry.law);
    return laws;
}

/// Returns options under which a law gives a layer of a few per cent of a chord.
LayerOptions options_of(GrowthLaw law) {
    LayerOptions options;
    options.first_height = 2e-5;
    options.growth_law = law;
    options.layers = 30;
    if (law == GrowthLaw::polynomial) options.growth = 2.2;
    if (layers::growth_law_entry(law).fills_thickness) options.thickness = 0.02;
    if (law == GrowthLaw::aflr) options.layers = 20;
    return options;
}

LayerOptions automatic(double growth = 1.2) {
    LayerOptions options;
    options.first_height = 2e-5;
    options.growth = growth;
    options.layers.reset();
    return options;
}

std::vector<Outline> sections() {
    return {shapes::section(0.12, 0, 80),          shapes::section(0.12, 0.01, 60), shapes::joukowski(0.1, 0.1, 120),
            shapes::ellipse(1, 0.05, 150),         shapes::circle(0.5, 60),         shapes::plate(0.05, 16),
            shapes::refined(shapes::l_shape(), 10)};
}

double tip_distance(const Layer& layer, const Ray& a, const Ray& b) {
    return distance(layer.points[a.tip().index()], layer.points[b.tip().index()]);
}

TEST(GrowthLaw, EachHasOneNameAndOneRow) {
    std::set<std::string> names;
    std::set<GrowthLaw> laws;
    for (const layers::GrowthLawEntry& entry : layers::growth_law_table()) {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_TRUE(laws.insert(entry.law).second) << entry.name;
        EXPECT_EQ(&layers::growth_law_entry(entry.law), &entry);
    }
    EXPECT_THROW(layers::growth_law_entry(static_cast<GrowthLaw>(1000)), OptionError);
}

TEST(GrowthLaw, TellsTheHeightOfAllLayersWhereItIsOne) {
    for (const GrowthLaw law : every_law()) {
        LayerGrowth growth = test::growth_of(options_of(law));
        const bool by_spacing = layers::growth_law_entry(law).by_spacing != nullptr;
        ASSERT_EQ(requested_height(growth).has_value(), !by_spacing);
        if (by_spacing) continue;
        EXPECT_EQ(*requested_height(growth), layer_height(growth, *growth.layers));
        if (layers::growth_law_entry(law).fills_thickness) continue;
        growth.thickness = 1e-3;
        EXPECT_EQ(*requested_height(growth), 1e-3);
        growth.layers.reset();
        EXPECT_FALSE(requested_height(growth).has_value());
    }
}

TEST(GrowthLaw, FollowsItsFormula) {
    using Real = long double;
    for (const double h : {1e-6, 3e-3}) {
        for (const double growth : {1.05, 1.2, 1.5, 2.0, 2.7}) {
            LayerOptions options;
            options.first_height = h;
            options.growth = growth;
            const auto expect = [&](std::uint32_t n, Real expected) {
                EXPECT_NEAR(static_cast<double>(layer_height(test::growth_of(options), n) / expected), 1, 1e-12) << n;
            };
            for (std::uint32_t n = 1; n < 60; ++n) {
                options.growth_law = GrowthLaw::geometric;
                expect(n, h * (std::pow(Real(growth), Real(n)) - 1) / (Real(growth) - 1));
                options.growth_law = GrowthLaw::polynomial;
                expect(n, h * std::pow(Real(n), Real(growth)));
            }
        }
    }
}

TEST(GrowthLaw, ExponentialMeetsFirstHeightAndThickness) {
    using Real = long double;
    for (const std::uint32_t layers : {2u, 5u, 30u, 200u}) {
        for (const double stretch : {1.0001, 1.5, 10.0, 500.0}) {
            LayerOptions options;
            options.growth_law = GrowthLaw::exponential;
            options.first_height = 2e-5;
            options.layers = layers;
            options.thickness = test::first_height(options) * layers * stretch;
            const auto height = [&](Real a, std::uint32_t n) {
                return options.thickness->value * std::expm1(a * n / layers) / std::expm1(a);
            };
            Real low = 1e-9L, high = 10000;  // H(1) falls as a grows
            for (int k = 0; k < 200; ++k) {
                const Real a = (low + high) / 2;
                (height(a, 1) > test::first_height(options) ? low : high) = a;
            }
            for (std::uint32_t n = 1; n <= layers; n += 1 + layers / 20)
                EXPECT_NEAR(static_cast<double>(layer_height(test::growth_of(options), n) / height(low, n)), 1, 1e-8)
                    << n << " of " << layers;
            EXPECT_NEAR(layer_height(test::growth_of(options), layers) / options.thickness->value, 1, 1e-12);
            EXPECT_EQ(layer_height(test::growth_of(options), 1), test::first_height(options));
        }
    }
}

TEST(GrowthLaw, AflrAcceleratesUpToItsCap) {
    const LayerOptions options = options_of(GrowthLaw::aflr);
    double ratio = 1;
    for (std::uint32_t n = 1; n < 30; ++n) {
        const LayerGrowth growth = test::growth_of(options);
        const double spacing = layer_height(growth, n) - layer_height(growth, n - 1);
        const double above = layer_height(growth, n + 1) - layer_height(growth, n);
        if (n >= 5) ratio *= 1.05;
        EXPECT_NEAR(above / spacing, std::min(ratio, 1.5), 1e-9) << n;
    }
}

TEST(GrowthLaw, PlacesLayersAtTheirHeights) {
    for (const GrowthLaw law : every_law()) {
        const LayerOptions options = options_of(law);
        for (const Outline& outline : sections()) {
            SCOPED_TRACE(static_cast<int>(law));
            const Geometry geometry = shapes::geometry({outline});
            const Layer layer = checked_layer(geometry, options);
            const Rays made = grow_rays(geometry, options, test::growth_of(options));
            for (std::size_t i = 0; i < layer.rays[0].size(); ++i) {
                const Ray& ray = layer.rays[0][i];
                if (ray.layers < ray.requested || made.heights.column(i).stretch.factor != 1) continue;
                double height = 0;
                LayerOptions own = options;
                if (layers::growth_law_entry(law).by_spacing) own.growth = ray.growth;
                for (std::uint32_t n = 1; n <= ray.layers; ++n) {
                    const double spacing =
                        distance(layer.points[ray.vertex(n - 1).index()], layer.points[ray.vertex(n).index()]);
                    ASSERT_GT(spacing, 0.999 * test::first_height(options));
                    height += spacing;
                    ASSERT_NEAR(height / (made.set.lines[i].slant * layer_height(test::growth_of(own), n)), 1, 1e-9);
                }
            }
        }
    }
}

TEST(GrowthLaw, ExponentialLayersHaveTheRequestedThickness) {
    const LayerOptions options = options_of(GrowthLaw::exponential);
    const Geometry geometry = shapes::geometry({shapes::section(0.12, 0, 80)});
    const Layer layer = checked_layer(geometry, options);
    const Rays made = grow_rays(geometry, options, test::growth_of(options));
    for (std::size_t i = 0; i < layer.rays[0].size(); ++i) {
        const Ray& ray = layer.rays[0][i];
        EXPECT_EQ(ray.layers, 30u);
        EXPECT_NEAR(distance(layer.points[ray.origin.index()], layer.points[ray.tip().index()]),
                    0.02 * made.set.lines[i].slant, 1e-12);
    }
}

/// Expects neighbouring columns that are not cut short to differ by less than 30 % in height, or by one layer.
void expect_smooth_heights(const Layer& layer, double growth = 1) {
    const double max_ratio = std::max(1.3, 1.05 * growth);
    for (const auto& rays : layer.rays) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Ray &ray = rays[i], &next = rays[(i + 1) % rays.size()];
            if (ray.layers < ray.requested || next.layers < next.requested) continue;
            if (!std::isinf(ray.height_limit) || !std::isinf(next.height_limit)) continue;
            const auto height = [&](const Ray& r) {
                return distance(layer.points[r.origin.index()], layer.points[r.tip().index()]);
            };
            EXPECT_LT(height(ray), max_ratio * height(next));
            EXPECT_LT(height(next), max_ratio * height(ray));
        }
    }
}

TEST(AdaptiveGrowth, MeetsTheSpacingAlongTheWall) {
    for (const std::uint32_t layers : {12u, 25u}) {
        LayerOptions options = options_of(GrowthLaw::adaptive);
        options.layers = layers;
        options.first_height = 0.02 / layers;
        const Layer layer = checked_layer(shapes::circle(1, 90), options);
        const auto& rays = layer.rays[0];
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const Point* points = &layer.points[rays[i].first_point];
            const double last = distance(points[layers - 2], points[layers - 1]);
            EXPECT_NEAR(last / tip_distance(layer, rays[i], rays[(i + 1) % rays.size()]), 1, 1e-6);
        }
    }
    for (const Outline& outline : sections()) {
        const Layer layer = checked_layer(outline, options_of(GrowthLaw::adaptive));
        for (const Ray& ray : layer.rays[0]) {
            EXPECT_GE(ray.growth, 1.05);
            EXPECT_LE(ray.growth, 1.5);
        }
        expect_smooth_heights(layer);
    }
}

/// Rays of a fan have ratios between those of its ends; rounding must not lead them out of the range of the law.
TEST(AdaptiveGrowth, StaysInItsRangeAcrossFans) {
    const Outline outline = shapes::section(0.12, 0, 80);
    for (const double first_height : {1e-9, 1e-2}) {
        for (int k = 0; k < 40; ++k) {
            LayerOptions options = options_of(GrowthLaw::adaptive);
            options.first_height = first_height;
            options.layers = 8;
            options.max_ray_angle_deg = 2 + 0.2 * k;
            checked_layer(outline, options);
        }
    }
}

TEST(AutomaticLayers, EndWhereTheyAreAsHighAsWide) {
    for (const double growth : {1.1, 1.2, 1.4}) {
        const Layer layer = checked_layer(shapes::circle(1, 120), automatic(growth));
        const auto& rays = layer.rays[0];
        for (std::size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(rays[i].layers, rays[0].layers);
            ASSERT_EQ(rays[i].requested, rays[0].layers);
            const Point* points = &layer.points[rays[i].first_point];
            const std::uint32_t n = rays[i].layers;
            const double last = distance(points[n - 2], points[n - 1]);
            const double width = tip_distance(layer, rays[i], rays[(i + 1) % rays.size()]);
            EXPECT_NEAR(last / width, 1, 0.1);
        }
    }
}

TEST(AutomaticLayers, VarySmoothlyOnAnySection) {
    for (const double growth : {1.05, 1.2, 1.35}) {
        for (const Outline& outline : sections()) {
            const Layer layer = checked_layer(outline, automatic(growth));
            expect_smooth_heights(layer, growth);
            for (const auto& rays : layer.rays) {
                // The front is no saw: numbers of layers do not alternate from ray to ray.
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    const auto at = [&](std::size_t k) { return rays[(i + k) % rays.size()].requested; };
                    EXPECT_FALSE(at(1) != at(0) && at(1) != at(2) && at(0) == at(2) && at(3) == at(1)) << i;
                }
            }
        }
    }
}

/// Where a wall turns inwards below rays that all lean to one side, heights along them jump, as first heights want it.
/// The front of thick layers must not.
TEST(AutomaticLayers, RiseLittleWhereRaysLeanFromTwoWalls) {
    constexpr std::size_t n = 200, corner = n / 2;
    constexpr double edge = 1e-3;
    const Point before{1, 0}, after = unit({4, -1});  // the outside lies below
    RaySet set;
    for (std::size_t i = 0; i < n; ++i) {
        const double along = edge * (static_cast<double>(i) - static_cast<double>(corner));
        const Point origin = along * (i < corner ? before : after);
        set.lines.push_back({.origin = origin, .direction = unit({1, -3}), .least_height = 0.02});
    }
    set.begin.push_back(n);
    LayerOptions options = automatic();
    options.first_height = 1e-5;
    LayerGrowth growth = test::growth_of(options);
    growth.least_heights = {WallHeight{}};  // they are those of the rays
    layers::set_slants(set);
    const std::vector<double> asked = layers::asked_heights(set, growth);
    const LayerHeights heights = layers::columns_up_to(set, growth, asked, asked);
    const auto slant = [&](std::size_t i) { return set.lines[i].slant; };
    const auto tip = [&](std::size_t i) { return set.lines[i].origin + asked[i] * set.lines[i].direction; };
    ASSERT_GT(slant(corner + 20) - slant(corner - 20), 0.1);
    for (std::size_t i = 20; i + 21 < n; ++i) {
        EXPECT_NEAR(heights.of(i)[1], slant(i) * 1e-5, 1e-12) << "first heights are kept";
        EXPECT_NEAR(heights.of(i).back(), asked[i], 1e-9 * asked[i]);
        EXPECT_LT(std::abs(asked[i + 1] - asked[i]), 0.221 * distance(tip(i), tip(i + 1))) << "column " << i;
        EXPECT_GT(dot(tip(i + 1) - tip(i), before), 0);
    }
    EXPECT_NEAR(asked[n - 40] / asked[40], slant(n - 40) / slant(40), 0.05);
}

TEST(AutomaticLayers, EndAtTheThicknessIfThatIsLess) {
    LayerOptions options = automatic();
    const Outline outline = shapes::section(0.12, 0, 80);
    const Layer free = checked_layer(outline, options);
    options.thickness = 0.01;
    const Layer cut = checked_layer(outline, options);
    ASSERT_EQ(free.rays[0].size(), cut.rays[0].size());
    std::uint32_t max_layers = 0;
    for (const Ray& ray : cut.rays[0]) max_layers = std::max(max_layers, ray.layers);
    EXPECT_LE(layer_height(test::growth_of(options), max_layers), 0.01);
    EXPECT_GT(layer_height(test::growth_of(options), max_layers + 1), 0.01);
    for (std::size_t i = 0; i < cut.rays[0].size(); ++i) EXPECT_LE(cut.rays[0][i].layers, free.rays[0][i].layers);
}

TEST(AutomaticLayers, NeedAGrowthThatGetsThere) {
    EXPECT_THROW(test::make_layer(shapes::geometry({shapes::circle(1, 20)}), automatic(1.001)), UsageError);
    LayerOptions options = automatic(1.001);
    options.thickness = 1e-3;
    checked_layer(shapes::circle(1, 20), options);
}

TEST(LocalHeights, MirrorWithTheInput) {
    for (const LayerOptions& options : {automatic(), options_of(GrowthLaw::adaptive)}) {
        for (const Outline& outline : {shapes::section(0.12, 0.02, 60), shapes::joukowski(0.1, 0.1, 90)}) {
            const Layer layer = checked_layer(outline, options);
            const Layer mirror = checked_layer(shapes::mirrored(outline), options);
            ASSERT_EQ(layer.points.size(), mirror.points.size());
            const auto a = test::sorted(layer.points), b = test::sorted_mirror(mirror.points);
            EXPECT_LT(std::max(test::set_distance(a, b), test::set_distance(b, a)), 1e-11);
        }
        const Layer layer = checked_layer(shapes::section(0.12, 0, 70), options);
        EXPECT_LT(test::set_distance(test::sorted_mirror(layer.points), test::sorted(layer.points)), 1e-11);
    }
}

TEST(LocalHeights, DoNotDependOnTheStartOfTheLoop) {
    for (const LayerOptions& options : {automatic(), options_of(GrowthLaw::adaptive)}) {
        const Outline outline = shapes::joukowski(0.1, 0.1, 90);
        const auto reference = test::sorted(checked_layer(outline, options).points);
        for (const std::size_t first : {1u, 7u, 41u}) {
            const auto points = test::sorted(checked_layer(shapes::started_at(outline, first), options).points);
            ASSERT_EQ(points.size(), reference.size());
            EXPECT_LT(test::set_distance(points, reference), 1e-11);
        }
    }
}

TEST(LocalHeights, StaySoundOnRandomStars) {
    std::mt19937 random(4);
    for (int k = 0; k < 200; ++k) {
        SCOPED_TRACE(k);
        const Outline outline = shapes::refined(shapes::star(3 + random() % 20, 0.3, random), 1 + random() % 8);
        LayerOptions options = k % 2 == 0 ? automatic(1.05 + 0.01 * (random() % 60)) : options_of(GrowthLaw::adaptive);
        options.first_height = std::pow(10, -5 + 3 * static_cast<double>(random() % 1000) / 1000);
        options.max_ray_angle_deg = 3 + random() % 20;
        options.corners = random() % 2 == 0 ? CornerRays::fan : CornerRays::refine;
        checked_layer(outline, options);
        if (testing::Test::HasFailure()) break;
    }
}

TEST(FirstHeight, FollowsTheFlatPlate) {
    EXPECT_NEAR(first_height_for(1, 6e6, 1), 4.456878e-6, 1e-12);
    for (const double reynolds : {1e4, 3e6, 1e9}) {
        const double expected = 0.5 * 3 / (reynolds * std::sqrt(0.5 * 0.026 / std::pow(reynolds, 1.0 / 7)));
        EXPECT_NEAR(first_height_for(0.5, reynolds, 3) / expected, 1, 1e-14);
    }
    EXPECT_THROW(first_height_for(0, 1e6, 1), UsageError);
    EXPECT_THROW(first_height_for(1, NAN, 1), UsageError);
    EXPECT_THROW(first_height_for(1, 1e6, -1), UsageError);
}

TEST(GrowthLaw, RefusesOptionsThatLackWhatTheLawNeeds) {
    const Geometry circle = shapes::geometry({shapes::circle(1, 20)});
    const auto refused = [&](GrowthLaw law, auto change) {
        LayerOptions options = options_of(law);
        change(options);
        EXPECT_THROW(test::make_layer(circle, options), UsageError);
    };
    for (const GrowthLaw law : every_law()) {
        refused(law, [](LayerOptions& o) { o.growth = 1; });
        refused(law, [](LayerOptions& o) { o.first_height = 0.0; });
        refused(law, [](LayerOptions& o) { o.layers = 0; });
    }
    refused(GrowthLaw::exponential, [](LayerOptions& o) { o.thickness.reset(); });
    refused(GrowthLaw::exponential, [](LayerOptions& o) { o.layers.reset(); });
    refused(GrowthLaw::exponential, [](LayerOptions& o) { o.layers = 1; });
    refused(GrowthLaw::exponential, [](LayerOptions& o) { o.thickness = *o.layers * test::first_height(o); });
    refused(GrowthLaw::adaptive, [](LayerOptions& o) { o.layers.reset(); });
}

}  // namespace
}  // namespace lamina
