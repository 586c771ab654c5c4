// The reproducible functions against those of the C library.
#include "core/reproducible_math.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace lamina {
namespace {

TEST(ReproducibleMath, SineAndCosineAgreeWithTheLibrary) {
    std::mt19937_64 random(1);
    for (double range : {1e-8, 0.1, 1.0, 10.0, 1000.0, 1e6}) {
        std::uniform_real_distribution<double> angle(-range, range);
        for (int i = 0; i < 100000; ++i) {
            const double a = angle(random);
            ASSERT_NEAR(core::sin_reproducible(a), std::sin(a), 2.3e-16 * std::abs(std::sin(a)) + 1e-300) << a;
            ASSERT_NEAR(core::cos_reproducible(a), std::cos(a), 2.3e-16 * std::abs(std::cos(a)) + 1e-300) << a;
        }
    }
}

TEST(ReproducibleMath, ExactValuesAndSymmetry) {
    EXPECT_EQ(core::sin_reproducible(0.0), 0.0);
    EXPECT_EQ(core::cos_reproducible(0.0), 1.0);
    EXPECT_EQ(core::sin_reproducible(core::pi / 2), 1.0);
    EXPECT_EQ(core::cos_reproducible(core::pi), -1.0);
    EXPECT_EQ(core::sin_reproducible(-core::pi / 2), -1.0);
    for (int i = 1; i < 1000; ++i) {
        const double a = 0.0137 * i;
        EXPECT_EQ(core::sin_reproducible(-a), -core::sin_reproducible(a));
        EXPECT_EQ(core::cos_reproducible(-a), core::cos_reproducible(a));
        EXPECT_EQ(core::atan2_reproducible(-a, 1.7), -core::atan2_reproducible(a, 1.7));
    }
}

TEST(ReproducibleMath, ArctangentAgreesWithTheLibrary) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-300, 300);
    for (int i = 0; i < 300000; ++i) {
        double x = coordinate(random), y = coordinate(random);
        if (i % 3 == 0) x *= std::pow(10.0, exponent(random) / 2);
        if (i % 5 == 0) y *= std::pow(10.0, exponent(random) / 2);
        const double expected = std::atan2(y, x);
        ASSERT_NEAR(core::atan2_reproducible(y, x), expected, 4.5e-16 * std::abs(expected) + 1e-300) << y << ' ' << x;
    }
    EXPECT_EQ(core::atan2_reproducible(0.0, 0.0), 0.0);
    EXPECT_EQ(core::atan2_reproducible(0.0, -1.0), core::pi);
    EXPECT_EQ(core::atan2_reproducible(-0.0, -1.0), -core::pi);
    EXPECT_EQ(core::atan2_reproducible(1.0, 0.0), core::pi / 2);
    EXPECT_EQ(core::atan2_reproducible(-1.0, 0.0), -core::pi / 2);
    EXPECT_EQ(core::atan2_reproducible(1.0, 1.0), core::pi / 4);
}

TEST(ReproducibleMath, FirstQuadrantAnglesAgreeWithTheLibrary) {
    std::mt19937_64 random(4);
    std::uniform_real_distribution<double> coordinate(0, 1), exponent(-100, 100);
    for (int i = 0; i < 300000; ++i) {
        double x = coordinate(random), y = coordinate(random);
        if (i % 3 == 0) x *= std::pow(10.0, exponent(random));
        ASSERT_NEAR(core::first_quadrant_angle(y, x), std::atan2(y, x), 2e-15) << y << ' ' << x;
    }
    EXPECT_NEAR(core::first_quadrant_angle(0, 1), 0, 2e-15);
    EXPECT_NEAR(core::first_quadrant_angle(1, 0), core::pi / 2, 2e-15);
}

TEST(ReproducibleMath, PowersAgreeWithTheLibrary) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> magnitude(-30, 30), exponent(0, 1);
    for (double max_power : {1e-3, 1.0, 4.0, 9.0}) {
        for (int i = 0; i < 50000; ++i) {
            const double base = std::pow(10.0, magnitude(random)), power = max_power * exponent(random);
            const double expected = static_cast<double>(std::pow(static_cast<long double>(base), power));
            ASSERT_NEAR(core::pow_reproducible(base, power), expected, (2 + power) * 2.3e-16 * expected)
                << base << ' ' << power;
        }
    }
    for (double base : {0.3, 1.0, 2.0, 17.0}) {
        EXPECT_EQ(core::pow_reproducible(base, 0), 1);
        EXPECT_EQ(core::pow_reproducible(base, 1), base);
        EXPECT_EQ(core::pow_reproducible(base, 2), base * base);
        EXPECT_EQ(core::pow_reproducible(base, 0.5), std::sqrt(base));
        EXPECT_EQ(core::pow_reproducible(base, 1.5), std::sqrt(base) * base);
    }
}

TEST(ReproducibleMath, LogarithmsAgreeWithTheLibrary) {
    std::mt19937_64 random(5);
    const auto check = [](double value) {
        const auto expected = static_cast<double>(std::log(static_cast<long double>(value)));
        ASSERT_NEAR(core::log_reproducible(value), expected, 2.3e-16 * std::abs(expected)) << value;
    };
    for (double range : {1e-14, 1e-7, 1e-3, 0.5, 2.0, 30.0, 700.0}) {
        std::uniform_real_distribution<double> exponent(-range, range);
        for (int i = 0; i < 100000; ++i) check(std::exp(exponent(random)));
    }
    for (double value : {5e-324, 1e-310, 2.2250738585072014e-308, 0.70710678, 0.7071068, 1.41421356, 1.7e308})
        check(value);
    EXPECT_EQ(core::log_reproducible(1.0), 0.0);
}

TEST(ReproducibleMath, ExponentialsAgreeWithTheLibrary) {
    std::mt19937_64 random(6);
    for (double range : {1e-14, 1e-3, 0.34, 1.0, 30.0, 708.0}) {
        std::uniform_real_distribution<double> exponent(-range, range);
        for (int i = 0; i < 100000; ++i) {
            const double x = exponent(random);
            const auto expected = static_cast<double>(std::exp(static_cast<long double>(x)));
            ASSERT_NEAR(core::exp_reproducible(x), expected, 2.3e-16 * expected) << x;
        }
    }
    EXPECT_EQ(core::exp_reproducible(0.0), 1.0);
    EXPECT_EQ(core::exp_reproducible(-1000.0), 0.0);
    EXPECT_EQ(core::exp_reproducible(1000.0), HUGE_VAL);
    EXPECT_EQ(core::exp_reproducible(709.9), HUGE_VAL);
    EXPECT_NEAR(core::exp_reproducible(-740.0), std::exp(-740.0), 1e-323);
    EXPECT_NEAR(core::exp_reproducible(709.78) / std::exp(709.78), 1, 1e-15);
}

}  // namespace
}  // namespace lamina
