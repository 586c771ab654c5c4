// Fans that end low before a wall have fewer rays.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <lamina/layers.hpp>

#include "checked_layer.hpp"
#include "core/angles.hpp"
#include "layers/low_fans.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

/// Returns the rays of a thin plate that ends in a fan of 180 degrees with so many columns, and goes on for one edge of
/// length 1 on both sides.
RaySet plate_with_fan(std::size_t columns) {
    RaySet set;
    set.lines.push_back({{-1, 0}, {0, 1}});
    for (std::size_t k = 0; k <= columns; ++k) {
        const double angle = core::pi * (0.5 - static_cast<double>(k) / static_cast<double>(columns));
        set.lines.push_back({{0, 0}, {std::cos(angle), std::sin(angle)}});
    }
    set.lines.push_back({{-1, 0}, {0, -1}});
    set.begin.push_back(set.lines.size());
    return set;
}

/// Returns the rays that are left of the plate's where all may go up to a limit. All layers are 1 high.
std::vector<RayLine> rays_left(const RaySet& set, double limit, bool jagged = true) {
    const std::size_t n = set.lines.size();
    Rays rays;
    rays.set = set;
    rays.jagged = {jagged};
    rays.asked.assign(n, 1);
    rays.front.assign(n, std::min(limit, 1.0));
    const RaySet left = layers::leave_out_rays_of_low_fans(rays);
    EXPECT_EQ(left.begin, (std::vector<std::size_t>{0, left.lines.size()}));
    return left.lines;
}

TEST(LowFans, HaveColumnsAtLeastAQuarterAsWideAsThoseBeside) {
    const RaySet set = plate_with_fan(36);
    const std::size_t all = set.lines.size();
    // The half circle at the limit is as long as pi times the limit, and four columns of the fan are as wide as an edge.
    EXPECT_EQ(rays_left(set, 0.9).size(), 3 + 11u);
    EXPECT_EQ(rays_left(set, 0.6).size(), 3 + 7u);
    EXPECT_EQ(rays_left(set, 0.01).size(), 3 + 6u) << "no column opens by more than 30 degrees";
    EXPECT_EQ(rays_left(set, 0).size(), 3 + 6u);
    EXPECT_EQ(rays_left(set, HUGE_VAL).size(), all) << "the fan is not cut short";
    EXPECT_EQ(rays_left(set, 0.6, false).size(), all) << "neighbouring rays may not differ by more than asked for";
    RaySet narrow = set;
    narrow.lines.front().origin.x = narrow.lines.back().origin.x = -0.1;
    EXPECT_EQ(rays_left(narrow, 0.5).size(), all) << "the columns beside are narrow, too";
}

TEST(LowFans, KeepTheirFirstAndLastRayAndSymmetry) {
    for (std::size_t columns = 1; columns <= 40; ++columns)
        for (const double limit : {0.9, 0.7, 0.5, 0.4, 0.3, 0.1}) {
            const RaySet set = plate_with_fan(columns);
            const std::vector<RayLine> left = rays_left(set, limit);
            EXPECT_EQ(left[1].direction, set.lines[1].direction);
            for (std::size_t i = 0; i < left.size(); ++i) {
                const Point direction = left[i].direction, mirrored = left[left.size() - 1 - i].direction;
                EXPECT_NEAR(direction.x, mirrored.x, 1e-15);
                EXPECT_NEAR(direction.y, -mirrored.y, 1e-15);
            }
            const double most = std::max(core::radians(max_low_fan_angle_deg), core::pi / double(columns));
            for (std::size_t i = 1; i + 2 < left.size(); ++i)
                EXPECT_LE(-core::angle_between(left[i].direction, left[i + 1].direction), most + 1e-12);
        }
}

/// A horn of ice whose tip stands before a plate: the fan round the tip has fewer rays than that of a free one.
TEST(LowFans, HaveFewRaysBeforeAWall) {
    const LayerOptions options = test::layers_of(1e-4, 1.2, 20);
    const auto rays_at_tip = [&](double gap) {
        const Outline horn = shapes::refined({{0, 0}, {-1, 0.2}, {-1, -0.2}}, 60);
        const Outline plate = shapes::refined({{gap, -0.5}, {gap + 0.2, -0.5}, {gap + 0.2, 0.5}, {gap, 0.5}}, 60);
        Geometry geometry = shapes::geometry({horn, plate});
        for (Element& element : geometry.elements) element.resampled = true;  // and not smooth, as ice
        const Layer layer = test::checked_layer(geometry, options);
        return std::count_if(layer.rays[0].begin(), layer.rays[0].end(), [&](const Ray& ray) {
            return layer.points[ray.origin.index()] == Point{0, 0};
        });
    };
    EXPECT_GT(rays_at_tip(0.5), 20);
    EXPECT_LE(rays_at_tip(2e-3), 8);
}

}  // namespace
}  // namespace lamina
