// Exact sums: the same in every order and in every grouping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "core/exact_sum.hpp"

namespace lamina::test {
namespace {

using core::ExactSum;

double sum_of(const std::vector<double>& numbers) {
    ExactSum sum;
    for (const double number : numbers) sum.add(number);
    return sum.value();
}

/// Returns numbers of both signs with exponents up to this one.
std::vector<double> random_numbers(std::size_t n, int max_exponent, std::mt19937& random) {
    std::uniform_real_distribution<double> mantissa(-1, 1);
    std::uniform_int_distribution<int> exponent(-max_exponent, max_exponent);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < n; ++i) numbers.push_back(std::ldexp(mantissa(random), exponent(random)));
    return numbers;
}

TEST(ExactSum, OfPartsKnowsWhatIsNotFinite) {
    ExactSum part, sum;
    part.add(std::numeric_limits<double>::infinity());
    sum.add(1);
    sum.add(part);
    EXPECT_EQ(sum.value(), std::numeric_limits<double>::infinity());
}

TEST(ExactSum, OfOneNumberIsThatNumber) {
    std::mt19937 random(1);
    std::vector<double> numbers = random_numbers(2000, 1020, random);
    using Limits = std::numeric_limits<double>;
    for (const double special : {0.0, 1.0, Limits::min(), Limits::denorm_min(), 3 * Limits::denorm_min(), Limits::max(),
                                 Limits::min() - Limits::denorm_min()})
        numbers.push_back(special);
    for (const double number : numbers) {
        EXPECT_EQ(sum_of({number}), number);
        EXPECT_EQ(sum_of({-number}), -number);
    }
}

TEST(ExactSum, LosesNothing) {
    EXPECT_EQ(sum_of({1e300, 1.0, -1e300}), 1.0);
    EXPECT_EQ(sum_of({1.0, 0x1p-1074, -1.0}), 0x1p-1074);
    EXPECT_EQ(sum_of({-3.0, 1.5, 0.25}), -1.25);
    std::mt19937 random(2);
    // All of these are whole multiples of 2^-20, so that their sum is known.
    std::int64_t whole = 0;
    std::vector<double> numbers;
    for (int i = 0; i < 10000; ++i) {
        const auto number = static_cast<std::int32_t>(random());
        whole += number;
        numbers.push_back(std::ldexp(static_cast<double>(number), -20));
    }
    EXPECT_EQ(sum_of(numbers), std::ldexp(static_cast<double>(whole), -20));
}

TEST(ExactSum, IsTheSameInEveryOrderAndGrouping) {
    std::mt19937 random(3);
    for (const int max_exponent : {1, 30, 1000})
        for (int repeat = 0; repeat < 20; ++repeat) {
            std::vector<double> numbers = random_numbers(500, max_exponent, random);
            const double expected = sum_of(numbers);
            std::shuffle(numbers.begin(), numbers.end(), random);
            EXPECT_EQ(sum_of(numbers), expected);
            std::vector<ExactSum> parts(7);
            for (const double number : numbers) parts[random() % parts.size()].add(number);
            ExactSum whole;
            for (const ExactSum& part : parts) {
                core::Packer packer;
                part.put(packer);
                const std::string bytes = packer.take();
                core::Unpacker unpacker(bytes);
                whole.add(ExactSum::get(unpacker));
                EXPECT_TRUE(unpacker.at_end());
            }
            EXPECT_EQ(whole.value(), expected);
        }
}

TEST(ExactSum, TellsWhatIsNotFinite) {
    const double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(sum_of({1, infinity}), infinity);
    EXPECT_TRUE(std::isnan(sum_of({1, infinity, -infinity})));
    EXPECT_TRUE(std::isnan(sum_of({std::numeric_limits<double>::quiet_NaN(), 1})));
}

}  // namespace
}  // namespace lamina::test
