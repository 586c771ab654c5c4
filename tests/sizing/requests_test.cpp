// Sources along wakes, and those that shorten the edges of loops, against their definitions.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "sizing/binding_sources.hpp"
#include "sizing/wake.hpp"

namespace lamina::sizing {
namespace {

TEST(WakeSources, GrowByATenthOfTheGradationInSmallSteps) {
    constexpr double first = 0.01, gradation = 0.1;
    const Wake wake{{1, 0.2}, {0.6, 0.8}, 3};
    const std::vector<SizeSource> sources = wake_sources(wake, first, gradation);
    ASSERT_FALSE(sources.empty());
    EXPECT_EQ(sources.front().a, wake.from);
    EXPECT_NEAR(distance(sources.back().b, wake.from), wake.length, 1e-12);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (i > 0) {
            EXPECT_EQ(sources[i].a, sources[i - 1].b);
            EXPECT_LE(sources[i].size, 1.06 * sources[i - 1].size);
        }
        const double grown = first + 0.1 * gradation * distance(sources[i].a, wake.from);
        EXPECT_NEAR(sources[i].size, grown, 1e-9 * grown);
    }
}

// Lengths of edges vary a little when others are divided, so those count that a source nearly shortens.
TEST(BindingSources, AreThoseThatNearlyShortenAnEdge) {
    constexpr double gradation = 0.2, share = 1, nearly = 1.2, hardly = 1.3;
    core::Random random(3);
    std::vector<Point> loop;
    for (int i = 0; i < 40; ++i) loop.push_back({std::cos(0.157 * i), std::sin(0.157 * i)});
    std::vector<SizeSource> sources;
    for (int i = 0; i < 2000; ++i) {
        const double x = random.real(-2, 2), y = random.real(-2, 2);
        sources.push_back({.a = {x, y}, .b = {x, y}, .size = random.real(0.05, 0.35)});
    }
    const std::vector<std::vector<Point>> loops{loop};
    const std::vector<SizeSource> found = binding_sources(sources, loops, gradation, share);
    std::size_t binding = 0;
    for (const SizeSource& source : sources) {
        const bool is_found = std::any_of(
            found.begin(), found.end(), [&](const SizeSource& s) { return s.a == source.a && s.size == source.size; });
        for (const double factor : {nearly, hardly}) {
            double most = -HUGE_VAL;
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const Point a = loop[i], b = loop[(i + 1) % loop.size()];
                const SizeSource edge{.a = a, .b = b, .size = 1};
                most = std::max(most, factor * distance(a, b) - gradation * distance_to(edge, source.a));
            }
            if (factor == nearly && most > share * source.size) {
                EXPECT_TRUE(is_found);
                ++binding;
            }
            EXPECT_FALSE(factor == hardly && most < share * source.size && is_found);
        }
    }
    EXPECT_GT(binding, 100u);
    EXPECT_LT(binding, 1900u);
}

}  // namespace
}  // namespace lamina::sizing
