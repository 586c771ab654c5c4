// Ranges of numbers: their values, their texts, and what is refused.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/value_range.hpp>

namespace lamina {
namespace {

TEST(ValueRanges, HoldTheDecimalNumbersThatAreMeant) {
    EXPECT_EQ(values_of(parse_range("-4:18")).size(), 23u);
    EXPECT_EQ(values_of(parse_range("0:0.3:0.1")), (std::vector<double>{0, 0.1, 0.2, 0.3}));
    EXPECT_EQ(values_of(parse_range("-0.3:0.3:0.3")), (std::vector<double>{-0.3, 0, 0.3}));
    EXPECT_EQ(values_of(parse_range("1e5:3e5:1e5")), (std::vector<double>{1e5, 2e5, 3e5}));
    EXPECT_EQ(values_of(parse_range("0:5:2")), (std::vector<double>{0, 2, 4}));
    EXPECT_EQ(values_of(parse_range("3:3")), std::vector<double>{3});
    EXPECT_EQ(values_of({0, 1, 1.0 / 3}).size(), 4u);
    // Every decimal step of every number of digits ends where it says, and holds what its text reads as.
    for (const int per_unit : {2, 4, 5, 8, 10, 20, 25, 100}) {
        const std::vector<double> values = values_of({-1, 1, 1.0 / per_unit});
        ASSERT_EQ(values.size(), static_cast<std::size_t>(2 * per_unit + 1)) << per_unit;
        for (int i = 0; i <= 2 * per_unit; ++i)
            EXPECT_EQ(values[static_cast<std::size_t>(i)], static_cast<double>(i - per_unit) / per_unit);
    }
}

TEST(ValueRanges, ReadBackFromTheirText) {
    for (const ValueRange& range : {ValueRange{-4, 18, 1}, ValueRange{0.1, 0.7, 0.05}, ValueRange{1e5, 1e7, 1e5}})
        EXPECT_EQ(parse_range(range_text(range)), range);
    EXPECT_TRUE(is_range("1:2"));
    EXPECT_FALSE(is_range("1"));
}

TEST(ValueRanges, AreRefusedWithTheReason) {
    const auto reason = [](const std::string& text) -> std::string {
        try {
            parse_range(text);
        } catch (const UsageError& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(reason("0:10:0").find("step"), std::string::npos);
    EXPECT_NE(reason("0:10:-1").find("step"), std::string::npos);
    EXPECT_NE(reason("10:0").find("A is above B"), std::string::npos);
    EXPECT_NE(reason("0:1e9").find("10000 values"), std::string::npos);
    EXPECT_NE(reason("0:1:1e-300").find("10000 values"), std::string::npos);
    EXPECT_NE(reason("1:2:3:4").find("A:B:STEP"), std::string::npos);
    for (const char* text : {"1:", ":1", ":", "a:b", "0:nan", "0:inf", "0:1:"}) EXPECT_NE(reason(text), "") << text;
}

}  // namespace
}  // namespace lamina
