// Lengths in chords and in units of the input.
#include <cmath>

#include <gtest/gtest.h>

#include <lamina/error.hpp>
#include <lamina/length.hpp>

#include "core/length.hpp"
#include "core/option_builders.hpp"

namespace lamina {
namespace {

TEST(Lengths, CountChordsUnlessTheSuffixSaysUnits) {
    EXPECT_EQ(core::parse_length("0.003"), Length(0.003));
    EXPECT_EQ(core::parse_length("0.003u"), input_units(0.003));
    EXPECT_EQ(core::parse_length("1e-5u"), input_units(1e-5));
    EXPECT_EQ(in_units(Length(0.003), 256), 0.003 * 256);
    EXPECT_EQ(in_units(input_units(0.003), 256), 0.003);
    EXPECT_EQ(in_chords(input_units(3), 4), 0.75);
    EXPECT_EQ(in_chords(Length(3), 4), 3);
}

TEST(Lengths, ReadBackFromTheirText) {
    for (const double value : {1e-5, 0.1, 1.0 / 3, 2.0, 1e300})
        for (const Length length : {Length(value), input_units(value)}) {
            EXPECT_EQ(core::parse_length(core::length_text(length)), length);
            EXPECT_EQ(as_length(option_value(length), "length"), length);
        }
}

TEST(Lengths, RefuseEverythingElse) {
    for (const char* text : {"", "u", "1 u", "1uu", "1m", "u1", "nan", "infu", "0x1p3", "1,5"})
        EXPECT_THROW(core::parse_length(text), UsageError) << text;
    EXPECT_THROW(as_length(true, "length"), OptionError);
}

}  // namespace
}  // namespace lamina
