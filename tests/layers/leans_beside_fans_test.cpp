// Rays beside fans lean towards them so that columns widen with the height, and numbers of layers stay the same across
// narrow columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include <lamina/layers.hpp>

#include "core/angles.hpp"
#include "layers/narrow_columns.hpp"
#include "layers/rays.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina {
namespace {

using shapes::Outline;

constexpr double front_height = 0.05;

/// Returns a section whose edges at the trailing edge are 1 / 10,000 chords long.
Outline finely_divided_section(double base) {
    Outline outline = shapes::section(0.12, base, 160);
    if (base == 0) return outline;
    const Point lower = outline.back(), upper = outline.front();
    const int parts = static_cast<int>(std::ceil(base / 1e-4));
    for (int k = 1; k < parts; ++k) outline.push_back(lower + (double(k) / parts) * (upper - lower));
    return outline;
}

std::vector<RayLine> spread_rays(const Outline& outline, bool spread) {
    const LayerOptions options;
    const std::vector<double> heights(spread ? outline.size() : 0, front_height);
    return layers::make_rays(layers::outline_with_wake(outline), layers::OutlineKind::smooth, options,
                             test::growth_of(options), heights);
}

TEST(LeansBesideFans, KeepsOriginsAndTheOrderOfDirections) {
    const LayerOptions options;
    for (const double base : {0.0, 0.0005, 0.003, 0.02}) {
        SCOPED_TRACE(base);
        const Outline outline = finely_divided_section(base);
        const std::vector<RayLine> rays = spread_rays(outline, true);
        std::size_t vertex = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const RayLine &ray = rays[i], &next = rays[(i + 1) % rays.size()];
            vertex += vertex + 1 < outline.size() && ray.origin == outline[vertex + 1];
            // The nose, which is coarse, has refining rays, and the base, whose rays lean apart.
            if (ray.origin.x > 0.5 && ray.origin.x < 1) {
                EXPECT_EQ(ray.origin, outline[vertex]) << "no ray is added, and none is left out";
            }
            const double turning = core::degrees(core::angle_between(ray.direction, next.direction));
            // Rays of wide columns may converge, but stay apart up to the front and beyond.
            const double edge = distance(ray.origin, next.origin);
            EXPECT_GE(edge + front_height * core::radians(turning), 0.5 * edge) << ray.origin.x << " " << ray.origin.y;
            EXPECT_LT(turning, options.max_ray_angle_deg + 1e-9) << ray.origin.x << " " << ray.origin.y;
            if (ray.origin != next.origin) {
                const Point normal = -perpendicular(unit(next.origin - ray.origin));
                EXPECT_LT(std::abs(core::degrees(core::angle_between(normal, ray.direction))), 52) << ray.origin.x;
            }
        }
        EXPECT_EQ(vertex + 1, outline.size());
    }
}

/// Returns a plate from which the corner at the origin, its first vertex, cuts off an angle. The corner turns by so many
/// degrees, and the edges beside it are short.
Outline plate_with_corner(double turning_deg) {
    const double angle = core::radians(turning_deg);
    const Point before{0, 1}, after = core::rotated(before, angle);
    Outline outline{{0, 0}};
    const auto lengths = [](int k) { return 1e-4 * k * (1 + 0.05 * k); };
    for (int k = 1; k <= 60; ++k) outline.push_back(lengths(k) * after);
    for (int k = 60; k >= 1; --k) outline.push_back(-lengths(k) * before);
    return outline;
}

/// Long cells on both sides of one ray at which rows turn by 90 degrees have a skewness of 2.5. Fans of corners keep a
/// column for that, and rays beside them lean by no more than 35 degrees.
TEST(LeansBesideFans, CornersKeepAColumn) {
    const LayerOptions options;
    for (const double turning : {40.0, 60.0, 75.0, 90.0, 100.0, 115.0}) {
        SCOPED_TRACE(turning);
        const Outline outline = plate_with_corner(turning);
        std::vector<Point> at_corner;
        for (const RayLine& ray : spread_rays(outline, true))
            if (ray.origin == outline[0]) at_corner.push_back(ray.direction);
        ASSERT_GE(at_corner.size(), 2u);
        const auto turned = [](Point a, Point b) { return core::degrees(core::angle_between(a, b)); };
        const double kept = turned(at_corner.front(), at_corner.back());
        EXPECT_GT(kept, 0.99 * options.max_ray_angle_deg);
        const Point before = -perpendicular(unit(outline[0] - outline.back())),
                    after = -perpendicular(unit(outline[1] - outline[0]));
        EXPECT_LT(turned(before, at_corner.front()), 35.01);
        EXPECT_LT(turned(at_corner.back(), after), 35.01);
        EXPECT_NEAR(turned(before, at_corner.front()), turned(at_corner.back(), after), 0.01) << "round the bisector";
    }
}

/// Returns a wedge whose finely divided tail bulges: its walls are concave first, and then convex.
Outline bulging_tail() {
    const auto half_thickness = [](double x) {
        const double u = std::min(1.0, std::abs(x - 0.985) / 0.015);
        return 0.05 * (1 - x) + 0.003 * (1 - u * u) * (1 - u * u);
    };
    Outline upper{{1, 0}};
    for (double x = 1, step = 1e-4; x - step > 0; step *= x < 0.95 ? 1.1 : 1) {
        x -= step;
        upper.push_back({x, half_thickness(x)});
    }
    Outline outline = upper;
    outline.push_back({0, 0});
    for (std::size_t k = upper.size() - 1; k > 0; --k) outline.push_back({upper[k].x, -upper[k].y});
    return outline;
}

/// Rays lean for several reasons, but no farther in all than first heights allow where the wall bends.
TEST(LeansBesideFans, KeepsFirstHeightsInConcaveWalls) {
    for (const double radius : {0.01, 0.02, 0.04, 0.08})
        for (const int parts : {20, 30, 45}) {
            SCOPED_TRACE(testing::Message() << "radius " << radius << ", " << parts << " parts");
            // An L with arms of unequal length, whose inner corner is round.
            const double step = 0.5 * core::pi / parts, edge = step * radius;
            Outline outline{{0.5, -0.3}, {0.5, 0}};
            for (double x = 0.5 - edge; x > radius; x -= edge) outline.push_back({x, 0});
            for (int k = 0; k <= parts; ++k)
                outline.push_back(Point{radius, radius} - radius * Point{std::sin(k * step), std::cos(k * step)});
            for (double y = radius + edge; y < 1; y += edge) outline.push_back({0, y});
            outline.insert(outline.end(), {{0, 1}, {-0.3, 1}, {-0.3, -0.3}});
            const std::vector<RayLine> rays = spread_rays(outline, true);
            for (std::size_t i = 1; i + 1 < rays.size(); ++i) {
                const RayLine &before = rays[i - 1], &ray = rays[i], &next = rays[i + 1];
                if (ray.origin.x < 0 || ray.origin.y < 0 || length(ray.origin) > 0.4) continue;
                const double a = dot(-perpendicular(unit(ray.origin - before.origin)), ray.direction);
                const double b = dot(-perpendicular(unit(next.origin - ray.origin)), ray.direction);
                EXPECT_LT(std::abs(a - b) / (a + b), 0.0095) << ray.origin.x << " " << ray.origin.y;
            }
        }
}

/// Expects a mirrored outline to have mirrored rays.
void expect_mirrored(const Outline& outline) {
    Outline mirrored;
    for (const Point p : outline) mirrored.insert(mirrored.begin(), {p.x, -p.y});
    const std::vector<RayLine> rays = spread_rays(outline, true);
    std::vector<RayLine> others = spread_rays(mirrored, true);
    std::reverse(others.begin(), others.end());
    ASSERT_EQ(rays.size(), others.size());
    for (std::size_t i = 0; i < rays.size(); ++i) {
        EXPECT_EQ(rays[i].origin.x, others[i].origin.x);
        EXPECT_NEAR(rays[i].direction.x, others[i].direction.x, 1e-12);
        EXPECT_NEAR(rays[i].direction.y, -others[i].direction.y, 1e-12);
    }
}

TEST(LeansBesideFans, MirroredOutlinesHaveMirroredRays) {
    expect_mirrored(finely_divided_section(0.003));
    expect_mirrored(bulging_tail());
}

/// Returns parallel rays so far apart, which close a ring.
RaySet parallel_rays(std::size_t count, double apart) {
    RaySet set;
    for (std::size_t i = 0; i < count; ++i) set.lines.push_back({{apart * double(i), 0}, {0, 1}});
    set.begin.push_back(count);
    return set;
}

/// Returns the end of a column 1 high, whose last layer is 0.1 high with any of these numbers of layers.
layers::ColumnEnd end_with(layers::LayerRange range, bool cut) { return {1, 0.1, range.least, range, 0.1, 0.1, cut}; }

/// Returns the numbers on rays so far apart, which stand between two others with 40 layers and wide columns.
/// All rays lean by so many degrees.
std::vector<std::uint32_t> kept_counts(std::vector<std::uint32_t> counts, double apart, double lean_deg = 0,
                                       bool cut = false) {
    RaySet set = parallel_rays(counts.size() + 4, apart);
    for (std::size_t i = 0; i < 2; ++i) {
        set.lines[i].origin.x -= 2.0 - double(i);
        set.lines[set.lines.size() - 1 - i].origin.x += 2.0 - double(i);
    }
    counts.insert(counts.begin(), 2, 40);
    counts.insert(counts.end(), 2, 40);
    std::vector<layers::ColumnEnd> ends;
    for (const std::uint32_t n : counts) ends.push_back(end_with({n - 4, n + 4}, cut));
    for (RayLine& ray : set.lines) ray.direction = core::rotated(ray.direction, core::radians(lean_deg));
    layers::keep_counts_on_narrow_columns(set, ends, counts);
    return {counts.begin() + 2, counts.end() - 2};
}

TEST(NarrowColumns, KeepTheirNumberOfLayers) {
    const std::vector<std::uint32_t> wanted{40, 41, 40, 41, 42, 41, 42, 43, 42, 41, 40, 39};
    const std::vector<std::uint32_t> in_pairs{40, 41, 41, 40, 40, 41, 41, 42, 42, 41, 40, 40};
    EXPECT_EQ(kept_counts(in_pairs, 0.2), in_pairs) << "wide columns stay as they are";
    const std::vector<std::uint32_t> alone{40, 40, 41, 40, 40, 39, 40, 40, 41, 41, 40, 40},
        without{40, 40, 40, 40, 40, 40, 40, 40, 41, 41, 40, 40};
    EXPECT_EQ(kept_counts(alone, 0.2), without) << "but for numbers that one ray alone has";
    const std::vector<std::uint32_t> kept = kept_counts(wanted, 0.01);
    std::size_t changes_before = 0, changes = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_LE(std::max(kept[i], wanted[i]) - std::min(kept[i], wanted[i]), 4u);
        if (i == 0) continue;
        changes_before += wanted[i] != wanted[i - 1];
        changes += kept[i] != kept[i - 1];
    }
    EXPECT_GE(changes_before, 3 * changes);
    std::vector<std::uint32_t> reversed(wanted.rbegin(), wanted.rend());
    reversed = kept_counts(reversed, 0.01);
    EXPECT_TRUE(std::equal(kept.begin(), kept.end(), reversed.rbegin())) << "both directions count alike";
}

/// Rows are shifted by a layer where numbers change. Where rays lean, cells would be sheared by both.
TEST(NarrowColumns, ColumnsThatLeanCountAsNarrower) {
    const std::vector<std::uint32_t> wanted{40, 41, 42, 43, 44, 44, 44, 43, 42, 41, 40, 40};
    const double apart = 0.17;
    EXPECT_EQ(kept_counts(wanted, apart), wanted);
    EXPECT_EQ(kept_counts(wanted, apart, 0, true), wanted);
    for (const double lean : {-35.0, 35.0}) {
        SCOPED_TRACE(lean);
        const std::vector<std::uint32_t> whole = kept_counts(wanted, apart, lean);
        EXPECT_EQ(*std::max_element(whole.begin(), whole.end()), 42u) << "changes that cost much are moved";
        const std::vector<std::uint32_t> cut = kept_counts(wanted, apart, lean, true);
        const auto [least, most] = std::minmax_element(cut.begin(), cut.end());
        EXPECT_LE(*most - *least, 2u);
    }
}

/// Rows fall towards the ray with more layers. Where rays lean to that side, too, the cells are nearer to rectangles.
TEST(NarrowColumns, ChangeWhereRowsFallTheWayThatRaysLean) {
    const std::size_t rays = 41, middle = 20;
    for (const bool rises : {false, true}) {
        RaySet set = parallel_rays(rays, 0.08);
        for (std::size_t i = 0; i < rays; ++i) {
            const double lean = 30 - 1.5 * double(i);  // to the left, then to the right
            set.lines[i].direction = core::rotated(set.lines[i].direction, core::radians(lean));
        }
        std::vector<std::uint32_t> counts(rays, 30);
        std::vector<layers::ColumnEnd> ends(rays, end_with({20, 40}, true));
        for (std::size_t i = 0; i < rays; ++i) {
            const bool last = i == 0 || i + 1 >= rays - 1;
            counts[i] = (i == 0) == rises ? 30 : 31;
            ends[i].layers = last ? layers::LayerRange{counts[i], counts[i]} : layers::LayerRange{30, 31};
        }
        layers::keep_counts_on_narrow_columns(set, ends, counts);
        std::size_t changes = 0, at = 0;
        for (std::size_t i = 0; i + 1 < rays; ++i)
            if (counts[i] != counts[i + 1]) ++changes, at = i;
        EXPECT_EQ(changes, 1u);
        EXPECT_EQ(at > middle, rises) << at;
    }
}

/// Rows turn where a front has a kink. A change beside it would make them turn twice as much at one ray.
TEST(NarrowColumns, ChangesKeepAwayFromKinksOfTheFront) {
    const std::size_t rays = 41, kink = 20;
    for (const bool rises : {false, true}) {
        std::vector<std::uint32_t> counts(rays);
        std::vector<layers::ColumnEnd> ends;
        for (std::size_t i = 0; i < rays; ++i) {
            counts[i] = (rises ? i > kink : i < kink) ? 31 : 30;
            const double height = 5 - 0.1 * std::abs(double(i) - double(kink));
            ends.push_back({height, 0.1, 30, {29, 32}, 0.1, 0.1, true});
        }
        layers::keep_counts_on_narrow_columns(parallel_rays(rays, 0.16), ends, counts);
        EXPECT_EQ(counts[kink], 31u) << "the change is on the other side, where rows rise";
        EXPECT_EQ(counts[rises ? kink - 5 : kink + 5], 30u);
        EXPECT_EQ(counts[rises ? kink + 5 : kink - 5], 31u);
    }
}

/// Layers that are stretched are higher than those of the growth law, and rows are shifted by that.
TEST(NarrowColumns, ChangeWhereTheLastLayerIsLowAfterwards) {
    const std::size_t rays = 41, middle = 20;
    for (const bool low_first : {false, true}) {
        std::vector<std::uint32_t> counts(rays, 30);
        std::vector<layers::ColumnEnd> ends;
        for (std::size_t i = 0; i < rays; ++i) {
            const double spacing = (i < middle) == low_first ? 0.08 : 0.3;
            ends.push_back({1, 0.1, 30, {30, 31}, 0.1, spacing, true});
        }
        for (const std::size_t i : {0, 1}) ends[i].layers = {30, 30};
        for (const std::size_t i : {39, 40}) ends[i].layers = {31, 31};
        counts[39] = counts[40] = 31;
        layers::keep_counts_on_narrow_columns(parallel_rays(rays, 0.12), ends, counts);
        EXPECT_EQ(counts[middle], low_first ? 31u : 30u);
    }
}

TEST(NarrowColumns, KeepTheRangesOfTheirRays) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::uint32_t> wanted(20, 40), below(0, 4), above(0, 4);
    for (int round = 0; round < 200; ++round) {
        std::vector<std::uint32_t> counts(40);
        std::vector<layers::ColumnEnd> ends;
        for (std::uint32_t& n : counts) {
            n = wanted(random);
            ends.push_back(end_with({n - below(random), n + above(random)}, false));
        }
        layers::keep_counts_on_narrow_columns(parallel_rays(counts.size(), 0.01), ends, counts);
        for (std::size_t i = 0; i < counts.size(); ++i) {
            EXPECT_GE(counts[i], ends[i].layers.least);
            EXPECT_LE(counts[i], ends[i].layers.most);
        }
    }
}

TEST(NarrowColumns, MayStandBesideRaysWithoutLayers) {
    const std::size_t rays = 40;
    for (const double apart : {0.0, 0.01, 2.0}) {
        std::vector<std::uint32_t> counts(rays, 3);
        std::vector<layers::ColumnEnd> ends(rays, end_with({1, 5}, false));
        for (std::size_t i = 10; i < 30; ++i) {
            counts[i] = 0;
            ends[i] = {};
        }
        const std::vector<std::uint32_t> wanted = counts;
        layers::keep_counts_on_narrow_columns(parallel_rays(rays, apart), ends, counts);
        for (std::size_t i = 0; i < rays; ++i) {
            EXPECT_GE(counts[i], ends[i].layers.least);
            EXPECT_LE(counts[i], ends[i].layers.most);
        }
        if (apart == 2) {
            EXPECT_EQ(counts, wanted);
        }
    }
}

TEST(NarrowColumns, ChangeByOneWhereTheyMustChange) {
    std::vector<std::uint32_t> counts(41, 30);
    std::vector<layers::ColumnEnd> ends(41, end_with({20, 40}, false));
    for (const std::size_t held : {0, 1, 39, 40}) ends[held].layers = {30, 30};
    ends[20].layers = {34, 40};
    layers::keep_counts_on_narrow_columns(parallel_rays(counts.size(), 0.01), ends, counts);
    EXPECT_EQ(counts[20], 34u);
    for (std::size_t i = 1; i < counts.size(); ++i) {
        EXPECT_EQ(counts[i], counts[40 - i]) << "both directions count alike";
        const std::uint32_t before = counts[i - 1];
        EXPECT_LE(std::max(counts[i], before) - std::min(counts[i], before), 1u);
    }
}

}  // namespace
}  // namespace lamina
