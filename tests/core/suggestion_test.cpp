// Suggestions for misspelt words.
#include <gtest/gtest.h>

#include "core/edit_distance.hpp"
#include "core/suggestion.hpp"

namespace lamina::test {
namespace {

TEST(Suggestion, EditDistanceCountsSwapsOnce) {
    EXPECT_EQ(core::edit_distance("", ""), 0u);
    EXPECT_EQ(core::edit_distance("abc", ""), 3u);
    EXPECT_EQ(core::edit_distance("abc", "abd"), 1u);
    EXPECT_EQ(core::edit_distance("abc", "acb"), 1u);
    EXPECT_EQ(core::edit_distance("ca", "abc"), 3u);  // the unrestricted distance is 2
    EXPECT_EQ(core::edit_distance("kitten", "sitting"), 3u);
    EXPECT_EQ(core::edit_distance("heigth", "height"), 1u);
}

TEST(Suggestion, TheClosestWordIsTheFirstOfEquals) {
    const std::vector<std::string> known{"far-field", "far-size", "growth", "growth-law", "y-plus"};
    EXPECT_EQ(closest_word("--farfield", known), "far-field");
    EXPECT_EQ(closest_word("FAR_FIELD", known), "far-field");
    EXPECT_EQ(closest_word("grwoth", known), "growth");
    EXPECT_EQ(closest_word("yplsu", known), "y-plus");
    EXPECT_EQ(closest_word("entirely", known), "");
    EXPECT_EQ(closest_word("", known), "");
    EXPECT_EQ(closest_word("x", known), "");
    EXPECT_EQ(closest_word(std::string(100'000, 'g'), known), "");
    EXPECT_EQ(did_you_mean(""), "");
    EXPECT_EQ(did_you_mean("growth"), ": did you mean 'growth'?");
}

TEST(Suggestion, NamesOfOtherProgramsAreUnderstoodWhereTheirOptionIsKnown) {
    EXPECT_EQ(option_elsewhere("--AoA"), "alpha");
    EXPECT_EQ(option_elsewhere("firstLayer_Height"), "first-height");
    EXPECT_EQ(option_elsewhere("alpha"), "");
    const std::vector<std::string> keys{"alpha", "first_height", "growth", "reynolds"};
    EXPECT_EQ(meant_option("aoa", keys), "alpha");
    EXPECT_EQ(meant_option("re", keys), "reynolds");
    EXPECT_EQ(meant_option("h0", keys), "first_height");
    EXPECT_EQ(meant_option("grwoth", keys), "growth");
    EXPECT_EQ(meant_option("ncpu", keys), "");  // threads are not among them
    EXPECT_EQ(meant_option("", keys), "");
}

}  // namespace
}  // namespace lamina::test
