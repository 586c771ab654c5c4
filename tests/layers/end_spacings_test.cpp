// The last layers of narrow columns are lowered towards the triangles beyond, where the front and the numbers of layers
// stay as they are.
#include "layers/heights/stretch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include <lamina/layers.hpp>
#include <lamina/predicates.hpp>

#include "layers/heights/stretch.hpp"
#include "layers/layered_rays.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"

namespace lamina {
namespace {

/// Returns heights that grow by a fifth up to this spacing, and go on with it.
std::vector<double> heights_with(double max_spacing, std::size_t layers) {
    std::vector<double> heights{0};
    double spacing = 1e-5;
    for (std::size_t n = 0; n < layers; ++n, spacing = std::min(1.2 * spacing, max_spacing))
        heights.push_back(heights.back() + spacing);
    return heights;
}

double last_spacing(const std::vector<double>& heights) { return heights.back() - heights[heights.size() - 2]; }

TEST(EndSpacings, AreMetBesideTheEnd) {
    for (const std::size_t layers : {8, 30, 60}) {
        const std::vector<double> before = heights_with(1e-3, layers);
        const auto above = static_cast<std::uint32_t>(layers / 2);
        for (const double ratio : {layers::max_end_ratio, 1.2, 1.0, 0.8, 0.6, 0.3, 0.1}) {
            SCOPED_TRACE(testing::Message() << layers << " layers, " << ratio);
            std::vector<double> after = before;
            layers::stretch_heights(layers::stretch_to_last_spacing(ratio, before, above), after);
            EXPECT_NEAR(after.back() / before.back(), 1, 1e-12);
            EXPECT_NEAR(last_spacing(after) / last_spacing(before), ratio, 1e-9);
            for (std::size_t n = 0; n <= above; ++n) EXPECT_EQ(after[n], before[n]) << n;
            for (std::size_t n = 1; n <= layers; ++n) {
                EXPECT_GT(after[n], after[n - 1]);
                EXPECT_TRUE(ratio > 1 ? after[n] <= before[n] * (1 + 1e-12) : after[n] >= before[n] * (1 - 1e-12)) << n;
            }
        }
    }
}

/// Returns so many columns with these heights.
LayerHeights alike(const std::vector<double>& heights, std::size_t columns) {
    std::vector<double> table;
    std::vector<HeightColumn> result;
    for (std::size_t i = 0; i < columns; ++i) {
        result.push_back({.first = table.size(), .layers = static_cast<std::uint32_t>(heights.size() - 1)});
        table.insert(table.end(), heights.begin(), heights.end());
    }
    return LayerHeights(std::move(table), std::move(result));
}

/// Returns rays in a row below a wall, so far apart, with columns of 60 layers whose last ones are 0.001 high. The last
/// ray and the first one are neighbours as on every element, though all cells between them are crossed.
Rays columns_apart(const std::vector<double>& widths) {
    Rays rays;
    rays.set = test::rays_in_a_row(widths);
    const std::vector<double> table = heights_with(1e-3, 60);
    rays.heights = alike(table, widths.size());
    rays.counts.assign(widths.size(), 60);
    return rays;
}

/// Returns whether the heights on a ray differ.
bool is_changed(const LayerHeights& before, const LayerHeights& after, std::size_t ray) {
    return !std::equal(before.of(ray).begin(), before.of(ray).end(), after.of(ray).begin(), after.of(ray).end());
}

/// Returns the ratio of the last spacing on a ray to the 1e-3 that it is in columns_apart().
double ratio_of(const Rays& rays, std::size_t ray) { return 1e3 * layers::layered_rays(rays).last_spacing(ray); }

/// Returns widths of columns that begin wide, are 4e-4 in the middle, and become wide again.
std::vector<double> widths_from_wide_to_wide() { return test::widths_with_narrow_middle(2e-3, 4e-4, 20); }

TEST(EndSpacings, LastLayersBecomeAsHighAsColumnsAreWide) {
    const std::vector<double> widths = widths_from_wide_to_wide();
    Rays rays = columns_apart(widths);
    const LayerHeights before = rays.heights;
    layers::fit_end_spacings(rays);
    for (std::size_t i = 2; i + 2 < widths.size(); ++i) {
        SCOPED_TRACE(testing::Message() << "column " << i << ", " << widths[i] << " wide");
        const std::vector<double> heights(rays.heights.of(i).begin(), rays.heights.of(i).end());
        EXPECT_EQ(heights.back(), before.of(i).back());
        EXPECT_TRUE(std::is_sorted(heights.begin(), heights.end()));
        const double width = std::sqrt(widths[i - 1] * widths[i]);
        EXPECT_LT(last_spacing(heights), 1.3 * width) << "half of the cell has 1.5 times the area beyond";
        EXPECT_GT(last_spacing(heights), std::min(1e-3, 0.5 * width));
        // Rows rise by a third of the width of a column at most.
        for (std::size_t n = 0; n < heights.size(); ++n)
            EXPECT_LE(std::abs(heights[n] - rays.heights.of(i - 1)[n]), 1.0 / 3 * widths[i - 1]) << n;
    }
}

TEST(EndSpacings, LowLayersOfWideColumnsBecomeHigher) {
    Rays rays = columns_apart(std::vector<double>(100, 2e-3)), wider = columns_apart(std::vector<double>(100, 4e-3));
    Rays of_quads = rays;
    of_quads.topology = LayerTopology::quads;
    layers::fit_end_spacings(rays);
    layers::fit_end_spacings(wider);
    layers::fit_end_spacings(of_quads);
    EXPECT_NEAR(ratio_of(rays, 50), 1.82, 1e-9) << "0.91 times as high as wide";
    EXPECT_NEAR(ratio_of(of_quads, 50), 1.08, 1e-9) << "0.54 times: higher ones would skew the faces beside";
    EXPECT_NEAR(ratio_of(wider, 50), layers::max_end_ratio, 1e-9);
}

/// Cells that lean are smaller than their edges say.
TEST(EndSpacings, CellsOfLeaningColumnsBecomeAsLargeAsUprightOnes) {
    const Point lean = unit({1, -1});
    const auto leaning = [&](double width) {
        Rays rays = columns_apart(std::vector<double>(1000, width));
        for (RayLine& line : rays.set.lines) line.direction = lean;
        return rays;
    };
    Rays narrow = leaning(3e-4), wide = leaning(1.2e-3);
    layers::fit_end_spacings(narrow);
    layers::fit_end_spacings(wide);
    EXPECT_NEAR(ratio_of(narrow, 500), 0.91 * 0.3 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(ratio_of(wide, 500), 0.91 * 1.2 * std::sqrt(2.0), 1e-9);
}

/// Low cells of wide columns ask narrow ones beside them for higher ones, which would be far higher than wide there.
TEST(EndSpacings, WideColumnsMakeNoNarrowOnesTooHigh) {
    std::vector<double> widths(60, 4e-4);
    widths.insert(widths.end(), 340, 3e-3);
    Rays rays = columns_apart(widths);
    layers::fit_end_spacings(rays);
    EXPECT_GT(ratio_of(rays, 90), 1.5);
    EXPECT_LE(ratio_of(rays, 58) * 1e-3, 1.2 * 4e-4 + 1e-12);
}

/// Where the front rises by a layer, the edges of the triangles beyond are longer.
TEST(EndSpacings, LastLayersAreHigherWhereFrontsRise) {
    Rays rays = columns_apart(std::vector<double>(400, 1.5e-3));
    for (std::size_t i = 200; i < 400; ++i) rays.counts[i] = 59;
    layers::fit_end_spacings(rays);
    // Beside the change the front's edges are level on one side and rise by a layer on the other, where the cell is as
    // large as a square on the edge when it is edge * edge / width high.
    const double rising = (1.5e-3 * 1.5e-3 + 1e-6) / 1.5e-3, square = 1e3 * std::sqrt(1.5e-3 * rising);
    // Those of the next columns are no higher than wide, and rows rise slowly from there.
    for (const std::size_t beside : {199u, 200u}) {
        EXPECT_GT(ratio_of(rays, beside), 1.5);
        EXPECT_LE(ratio_of(rays, beside), 0.91 * square + 1e-9);
    }
    EXPECT_NEAR(ratio_of(rays, 50), 0.91 * 1.5, 1e-9);
    // Not where narrow columns beside would have cells far higher than wide.
    std::vector<double> widths(400, 1.5e-3);
    for (std::size_t i = 203; i < 400; ++i) widths[i] = 4e-4;
    Rays narrow = columns_apart(widths);
    narrow.counts.assign(400, 60);
    for (std::size_t i = 200; i < 400; ++i) narrow.counts[i] = 59;
    layers::fit_end_spacings(narrow);
    EXPECT_LT(ratio_of(narrow, 200), 1);
}

/// The first layer of two stays, so the last one does.
TEST(EndSpacings, ColumnsOfFewLayersStay) {
    for (const std::uint32_t layers : {2, 60}) {
        Rays rays = columns_apart(std::vector<double>(50, 3e-4));
        rays.counts.assign(50, layers);
        const std::vector<double> table = heights_with(1e-5, 60);
        rays.heights = alike(table, 50);
        for (RayLine& line : rays.set.lines) line.origin.x *= 1e-5 / 3e-4 * 0.5;
        const LayerHeights before = rays.heights;
        layers::fit_end_spacings(rays);
        EXPECT_EQ(is_changed(before, rays.heights, 25), layers == 60) << layers << " layers";
    }
}

/// With a slope of less than 0 at the front, the layer below would be more than three times as high as the last one.
TEST(EndSpacings, LayersNeverTripleFromRowToRow) {
    for (const double width : {1e-3, 3e-4, 1e-4, 1e-5}) {
        Rays rays = columns_apart(std::vector<double>(100, width));
        layers::fit_end_spacings(rays);
        const std::span<const double> heights = rays.heights.of(50);
        for (std::size_t n = 31; n + 1 < heights.size(); ++n)
            EXPECT_LT(heights[n] - heights[n - 1], 3 * (heights[n + 1] - heights[n])) << width << ", layer " << n;
    }
}

TEST(EndSpacings, RequestedNumbersOfLayersKeepTheirHeights) {
    Rays rays = columns_apart(widths_from_wide_to_wide());
    const std::vector<double> table = rays.heights.table();
    rays.growth.layers = 60;
    layers::fit_end_spacings(rays);
    EXPECT_EQ(rays.heights.table(), table);
}

/// Returns whether the cells between two neighbouring rays are positive quadrilaterals, and the triangle at their step,
/// too.
bool are_sound(const layers::LayeredRays& rays, std::size_t i) {
    const std::uint32_t common = std::min(rays.counts[i], rays.counts[i + 1]);
    for (std::uint32_t n = 1; n <= common; ++n) {
        const Point a = rays.point(i, n - 1), b = rays.point(i, n), c = rays.point(i + 1, n),
                    d = rays.point(i + 1, n - 1);
        for (const auto& [p, q, r] :
             {std::array{a, b, c}, std::array{b, c, d}, std::array{c, d, a}, std::array{d, a, b}})
            if (!(orient2d(p, q, r) > 0)) return false;
    }
    if (rays.counts[i] == rays.counts[i + 1]) return true;
    const Point top = rays.point(rays.counts[i] > common ? i : i + 1, common + 1);
    return orient2d(rays.point(i, common), top, rays.point(i + 1, common)) > 0;
}

/// Columns between rays with sound cells.
struct SoundColumns {
    std::size_t changed = 0, left = 0;
};

/// Fits the last spacings of random columns of this topology, under fronts that rise by up to `steepest` of the width
/// from ray to ray. Expects that columns with sound cells keep them, and returns how many of these are changed.
SoundColumns fit_random_columns(LayerTopology topology, double steepest) {
    std::mt19937 random(7);
    const auto real = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    SoundColumns sound;
    for (int round = 0; round < 1500; ++round) {
        std::vector<double> widths;
        double width = 1e-3;
        for (std::size_t i = 0; i < 30; ++i) widths.push_back(width *= std::exp(real(-1.2, 1.2)));
        Rays rays = columns_apart(widths);
        rays.topology = topology;
        std::vector<double> table;
        std::vector<HeightColumn> columns;
        double lean = 0, scale = 1;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            columns.push_back({.first = table.size(), .layers = 60});
            const std::vector<double> heights = heights_with(1e-3, 60);
            scale += real(-steepest, steepest) * widths[i] / heights.back();
            for (const double height : heights) table.push_back(scale * height);
            lean += real(-1, 5) * widths[i] / heights.back();
            rays.set.lines[i].direction = unit(Point{lean, -1});
            if (i > 0) rays.counts[i] = std::clamp(rays.counts[i - 1] + std::uint32_t(real(0, 3)) - 1, 40u, 60u);
        }
        rays.heights = LayerHeights(table, columns);
        const LayerHeights before = rays.heights;
        layers::fit_end_spacings(rays);
        for (std::size_t i = 1; i + 2 < widths.size(); ++i) {
            if (!are_sound({rays.set, before, rays.counts}, i)) continue;
            EXPECT_TRUE(are_sound(layers::layered_rays(rays), i)) << "round " << round << ", column " << i;
            const bool changed = is_changed(before, rays.heights, i) || is_changed(before, rays.heights, i + 1);
            (changed ? sound.changed : sound.left) += 1;
        }
    }
    return sound;
}

/// Rows of neighbours whose last spacings are changed differently rise, and may do so where fronts and numbers of
/// layers are steep already.
TEST(EndSpacings, CrossesNoCells) {
    // Limits let fronts rise by a quarter of the width. Six widths are a hard case: columns of triangles are changed
    // more differently there, since wide ones do not raise narrow ones, and more changes are taken back whole.
    const SoundColumns of_quads = fit_random_columns(LayerTopology::quads, 6);
    const SoundColumns of_triangles = fit_random_columns(LayerTopology::layered, 0.25);
    const SoundColumns of_steep_triangles = fit_random_columns(LayerTopology::layered, 6);
    for (const SoundColumns* sound : {&of_quads, &of_triangles, &of_steep_triangles}) EXPECT_GT(sound->changed, 3'000u);
}

}  // namespace
}  // namespace lamina
