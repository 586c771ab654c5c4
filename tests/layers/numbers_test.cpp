// Numbers of layers, which change from ray to ray where that shears cells little.
#include "layers/heights/numbers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

#include "core/angles.hpp"
#include "layers/stages.hpp"
#include "support/layers.hpp"

namespace lamina {
namespace {

using layers::ColumnEnd;
using Numbers = std::vector<std::uint32_t>;

/// Returns parallel rays so far apart, which close a ring.
RaySet parallel_rays(std::size_t count, double apart) { return test::rays_in_a_row(std::vector<double>(count, apart)); }

/// Returns the end of a column 1 high, whose last layer is 0.1 high with any number of layers.
ColumnEnd end_with(std::uint32_t wanted, std::uint32_t below, std::uint32_t above) {
    return {1, 0.1, wanted, {wanted - below, wanted + above}};
}

std::vector<ColumnEnd> ends_with(const Numbers& wanted, std::uint32_t off) {
    std::vector<ColumnEnd> ends;
    for (const std::uint32_t n : wanted) ends.push_back(end_with(n, off, off));
    return ends;
}

std::size_t changes_in(const Numbers& numbers) {
    std::size_t changes = 0;
    for (std::size_t i = 1; i < numbers.size(); ++i) changes += numbers[i] != numbers[i - 1];
    return changes;
}

/// Returns numbers that are wanted: a slow rise and fall with noise.
Numbers noisy_numbers() { return {40, 40, 41, 40, 41, 42, 41, 42, 43, 42, 41, 42, 41, 40, 39, 40, 40, 40}; }

TEST(Numbers, OfWideColumnsAreThoseWanted) {
    const Numbers wanted{40, 40, 40, 40, 40, 41, 41, 41, 41, 41, 42, 42, 42, 42, 42, 41, 41, 41, 41, 41};
    EXPECT_EQ(layers::cheapest_numbers(parallel_rays(wanted.size(), 2), ends_with(wanted, 4)), wanted);
}

TEST(Numbers, OfNarrowColumnsChangeRarely) {
    const Numbers wanted = noisy_numbers();
    const Numbers made = layers::cheapest_numbers(parallel_rays(wanted.size(), 0.01), ends_with(wanted, 4));
    EXPECT_GE(changes_in(wanted), 3 * changes_in(made));
}

TEST(Numbers, AreMirroredWithTheRays) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> width(0.02, 0.3);
    for (int round = 0; round < 100; ++round) {
        std::vector<double> widths;
        for (std::size_t i = 0; i < noisy_numbers().size(); ++i) widths.push_back(width(random));
        RaySet set = test::rays_in_a_row(widths), mirrored = set;
        std::reverse(mirrored.lines.begin(), mirrored.lines.end());
        for (RayLine& line : mirrored.lines) line.origin.x = -line.origin.x;
        Numbers wanted = noisy_numbers();
        const Numbers made = layers::cheapest_numbers(set, ends_with(wanted, 3));
        std::reverse(wanted.begin(), wanted.end());
        Numbers other = layers::cheapest_numbers(mirrored, ends_with(wanted, 3));
        std::reverse(other.begin(), other.end());
        EXPECT_EQ(made, other) << round;
    }
}

TEST(Numbers, StayInTheirRanges) {
    std::mt19937 random(3);
    std::uniform_int_distribution<std::uint32_t> wanted(20, 40), off(0, 4);
    for (int round = 0; round < 200; ++round) {
        std::vector<ColumnEnd> ends;
        for (std::size_t i = 0; i < 40; ++i) ends.push_back(end_with(wanted(random), off(random), off(random)));
        const Numbers made = layers::cheapest_numbers(parallel_rays(40, 0.01), ends);
        for (std::size_t i = 0; i < made.size(); ++i) {
            EXPECT_GE(made[i], ends[i].layers.least);
            EXPECT_LE(made[i], ends[i].layers.most);
        }
    }
}

/// Rows fall towards the ray with more layers. Where rays lean to that side, too, the cells are nearer to rectangles.
TEST(Numbers, ChangeWhereRowsFallTheWayThatRaysLean) {
    const std::size_t rays = 41, middle = 20;
    for (const bool rises : {false, true}) {
        RaySet set = parallel_rays(rays, 0.08);
        std::vector<ColumnEnd> ends;
        for (std::size_t i = 0; i < rays; ++i) {
            const double lean = 30 - 1.5 * double(i);  // to one side, then to the other
            set.lines[i].direction = core::rotated(set.lines[i].direction, core::radians(-lean));
            const bool first = i == 0, last = i + 1 >= rays - 1;
            const std::uint32_t held = first == rises ? 30 : 31;
            ends.push_back({1, 0.1, held, {first || last ? held : 30, first || last ? held : 31}});
        }
        const Numbers made = layers::cheapest_numbers(set, ends);
        EXPECT_EQ(changes_in(made), 1u);
        for (std::size_t i = 1; i < rays; ++i)
            if (made[i] != made[i - 1]) {
                EXPECT_EQ(i > middle, rises) << i;
            }
    }
}

TEST(Numbers, ChangeByOneWhereTheyMustChange) {
    std::vector<ColumnEnd> ends(41, end_with(30, 10, 10));
    for (const std::size_t held : {0, 1, 39, 40}) ends[held].layers = {30, 30};
    ends[20].layers = {34, 40};
    const Numbers made = layers::cheapest_numbers(parallel_rays(ends.size(), 0.01), ends);
    EXPECT_EQ(made[20], 34u);
    for (std::size_t i = 1; i < made.size(); ++i) EXPECT_LE(std::abs(int(made[i]) - int(made[i - 1])), 1) << i;
}

TEST(Numbers, AreNoneOnRaysWithoutLayers) {
    for (const double apart : {0.0, 0.01, 2.0}) {
        std::vector<ColumnEnd> ends(40, end_with(3, 2, 2));
        for (std::size_t i = 10; i < 30; ++i) ends[i] = {};
        const Numbers made = layers::cheapest_numbers(parallel_rays(ends.size(), apart), ends);
        for (std::size_t i = 10; i < 30; ++i) EXPECT_EQ(made[i], 0u);
    }
}

}  // namespace
}  // namespace lamina
