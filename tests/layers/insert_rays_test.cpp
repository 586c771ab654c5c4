// Rays are inserted where limits let numbers of layers change by more than one, but not into narrow columns.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/insert_rays.hpp"

namespace lamina {
namespace {

constexpr std::uint32_t ring_layers = 20;

/// Returns parallel rays on a line, so far apart.
RaySet rays_on_a_line(std::size_t count, double apart) {
    RaySet set;
    for (std::size_t i = 0; i < count; ++i) set.lines.push_back({{-apart * double(i), 0}, {0, 1}});
    set.begin.push_back(count);
    return set;
}

/// Returns heights of layers that grow by 1.2, the first of them 1 high, for so many rays.
LayerHeights growing_heights(std::size_t rays) {
    std::vector<double> table{0};
    for (double spacing = 1; table.size() <= ring_layers; spacing *= 1.2) table.push_back(table.back() + spacing);
    return LayerHeights(table, std::vector<HeightColumn>(rays, HeightColumn{0, ring_layers, 1.2}));
}

/// Returns how many rays are inserted between rays so many last spacings apart, of which one has `fewer` layers less.
std::size_t inserted_rays(double last_spacings, std::uint32_t fewer, bool jagged = false) {
    const LayerHeights heights = growing_heights(2);
    const std::span<const double> column = heights.of(0);
    const double last = column[ring_layers] - column[ring_layers - 1];
    const RaySet set = rays_on_a_line(2, last_spacings * last);
    const std::vector<double> limits{HUGE_VAL, column[ring_layers - fewer]};
    const RaySet larger = layers::insert_rays_where_counts_change(set, std::vector<char>{jagged}, heights, limits);
    return larger.lines.size() - set.lines.size();
}

TEST(InsertedRays, StandBetweenRaysWhoseNumbersDiffer) {
    for (const std::uint32_t fewer : {0u, 1u}) EXPECT_EQ(inserted_rays(100, fewer), 0u);
    // The two rays are neighbours on both sides.
    for (const std::uint32_t fewer : {2u, 3u, 5u}) EXPECT_EQ(inserted_rays(100, fewer), 2 * (fewer - 1));
}

TEST(InsertedRays, DoNotDivideNarrowColumns) {
    for (const std::uint32_t fewer : {2u, 3u, 5u}) {
        EXPECT_EQ(inserted_rays(1.9 * fewer, fewer), 0u);
        EXPECT_GT(inserted_rays(2.1 * fewer, fewer), 0u);
    }
}

/// The surface has made edges of jagged walls as short as they may be. Divided ones would be shorter than their
/// neighbours by whole factors.
TEST(InsertedRays, LeaveTheEdgesOfJaggedWallsWhole) {
    for (const std::uint32_t fewer : {2u, 3u, 5u}) EXPECT_EQ(inserted_rays(100, fewer, true), 0u);
}

}  // namespace
}  // namespace lamina
