// Rounding that takes away what no decision should hang on.
#include "core/rounding.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"

namespace lamina::core {
namespace {

TEST(Rounding, GivesMultiplesNearTheValueAndIsOdd) {
    Random random(62);
    for (int i = 0; i < 10'000; ++i) {
        const double step = std::ldexp(1.0, -static_cast<int>(random.below(40)));
        const double value = random.real(-1000, 1000) * step * 1000;
        const double rounded = rounded_to_multiple(value, step);
        ASSERT_EQ(std::floor(rounded / step), rounded / step);
        ASSERT_LE(std::abs(rounded - value), 0.59 * step);
        ASSERT_EQ(rounded_to_multiple(-value, step), -rounded);
        ASSERT_EQ(rounded_to_multiple(rounded, step), rounded);
    }
}

TEST(Rounding, ErrorsDoNotDecideAboutSimpleFractions) {
    for (const double whole : {0.0, 1.0, 7.0, 1000.0})
        for (const double fraction : {0.0, 0.25, 1.0 / 3, 0.5, 2.0 / 3, 0.75})
            for (const double step : {0x1p-20, 1.0, 8.0}) {
                const double value = (whole + fraction) * step;
                EXPECT_EQ(rounded_to_multiple(value * (1 + 1e-12), step),
                          rounded_to_multiple(value * (1 - 1e-12), step));
            }
}

TEST(Rounding, PowersOfTwoBelow) {
    EXPECT_EQ(power_of_two_below(1), 1);
    EXPECT_EQ(power_of_two_below(1.999), 1);
    EXPECT_EQ(power_of_two_below(0.3), 0.25);
    EXPECT_EQ(power_of_two_below(1e300), std::ldexp(1.0, 996));
}

TEST(Rounding, PlacesAreTheSameTheOtherWayRound) {
    Random random(35);
    for (int i = 0; i < 10'000; ++i) {
        const double share = random.real(), edge = std::exp2(random.real(-12, 12));
        const double place = rounded_place(share, edge);
        ASSERT_LE(std::abs(place - share), std::min(edge / 1024, 0.5));
        ASSERT_GE(place, 0);
        ASSERT_LE(place, 1);
        ASSERT_EQ(rounded_place(1 - share, edge), 1 - place);
    }
    EXPECT_EQ(rounded_place(1e-13, 0.1), 0);
    EXPECT_EQ(rounded_place(1 - 1e-13, 0.1), 1);
}

TEST(Rounding, OneOfAVectorAndItsOppositePointsForward) {
    Random random(8);
    for (int i = 0; i < 1000; ++i) {
        const Point v{random.real(-1, 1), random.real(-1, 1)};
        ASSERT_EQ(is_forward(v), v.x > 0);
        ASSERT_NE(is_forward(v), is_forward(-v));
    }
    EXPECT_TRUE(is_forward({-1e-16, 1}));
    EXPECT_FALSE(is_forward({1e-16, -1}));
}

}  // namespace
}  // namespace lamina::core
