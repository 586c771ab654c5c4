#include <lamina/latin_hypercube.hpp>

#include <cmath>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

namespace lamina {
namespace {

TEST(LatinHypercube, HasOneSampleInEveryPartOfEveryInterval) {
    const std::vector<ValueInterval> intervals{{-4, 8}, {1e5, 1e7, true}, {0, 1e-3}};
    for (const std::size_t count : {1u, 2u, 17u, 1000u}) {
        const auto samples = latin_hypercube(intervals, count, 5);
        ASSERT_EQ(samples.size(), count);
        for (std::size_t i = 0; i < intervals.size(); ++i) {
            const auto& [first, last, by_logarithm] = intervals[i];
            std::set<double> parts;
            for (const std::vector<double>& sample : samples) {
                ASSERT_EQ(sample.size(), intervals.size());
                const double share = by_logarithm ? std::log(sample[i] / first) / std::log(last / first)
                                                  : (sample[i] - first) / (last - first);
                parts.insert(std::floor(share * static_cast<double>(count)));
            }
            EXPECT_EQ(parts.size(), count);
            EXPECT_EQ(*parts.begin(), 0);
            EXPECT_EQ(*parts.rbegin(), static_cast<double>(count) - 1);
        }
    }
}

TEST(LatinHypercube, DependsOnTheSeedAloneAndTiesNoIntervalToAnother) {
    constexpr std::size_t count = 2000;
    const std::vector<ValueInterval> intervals{{-1, 1}, {-1, 1}};
    const auto samples = latin_hypercube(intervals, count, 1);
    EXPECT_EQ(samples, latin_hypercube(intervals, count, 1));
    EXPECT_NE(samples, latin_hypercube(intervals, count, 2));
    double product = 0;
    for (const std::vector<double>& sample : samples) product += sample[0] * sample[1];
    // The correlation of independent numbers has a standard deviation of 1 / sqrt(count).
    EXPECT_LT(std::abs(3 * product / count), 4 / std::sqrt(double{count}));
}

TEST(LatinHypercube, ReadsIntervals) {
    const ValueInterval interval = parse_interval("1e5:1e7:log");
    EXPECT_EQ(interval.first, 1e5);
    EXPECT_EQ(interval.last, 1e7);
    EXPECT_TRUE(interval.by_logarithm);
    EXPECT_FALSE(parse_interval("-4:8").by_logarithm);
    for (const char* text : {"", "1", "1:2:3", "2:1", "1:1", "0:1:log", "-1:1:log", "1:inf", "a:b", "1:2:lg", ":log"})
        EXPECT_THROW(parse_interval(text), UsageError) << text;
}

}  // namespace
}  // namespace lamina
