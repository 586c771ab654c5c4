// Flow conditions: the reference chord and the Reynolds number.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <lamina/conditions.hpp>
#include <lamina/error.hpp>
#include <lamina/option.hpp>

namespace lamina {
namespace {

constexpr Box bodies{{-1, -2}, {3, 5}};

std::string refused_option_of(const FlowConditions& conditions) {
    try {
        reference_conditions(conditions, bodies);
    } catch (const OptionError& error) {
        return error.option();
    }
    return "";
}

TEST(Conditions, TheChordIsTheExtentInXUnlessItIsGiven) {
    EXPECT_EQ(reference_conditions({}, bodies).chord, 4);
    EXPECT_EQ(reference_conditions({.chord = 0.5}, bodies).chord, 0.5);
}

TEST(Conditions, TheOptionChordIsANumberOrTheNameOfAnElement) {
    const Option<FlowConditions>& option = find_row(option_table<FlowConditions>(), "chord");
    FlowConditions conditions;
    EXPECT_FALSE(option.get(conditions));
    option.set(conditions, std::string("main"));
    EXPECT_EQ(conditions.chord_element, "main");
    EXPECT_EQ(option.get(conditions), OptionValue("main"));
    EXPECT_EQ(refused_option_of(conditions), "chord") << "a box has no elements";
    option.set(conditions, 0.5);
    EXPECT_EQ(conditions.chord, 0.5);
    EXPECT_EQ(conditions.chord_element, "");
    option.set(conditions, std::string("main"));
    EXPECT_FALSE(conditions.chord);
    EXPECT_THROW(option.set(conditions, std::string()), OptionError);
    EXPECT_THROW(option.set(conditions, -1.0), OptionError);
}

TEST(Conditions, VelocityAndViscosityGiveTheReynoldsNumberByTheChord) {
    EXPECT_FALSE(reference_conditions({}, bodies).reynolds);
    EXPECT_EQ(reference_conditions({.reynolds = 6e6}, bodies).reynolds, 6e6);
    EXPECT_EQ(reference_conditions({.velocity = 30, .viscosity = 1.5e-5}, bodies).reynolds, 30 * 4 / 1.5e-5);
    EXPECT_EQ(reference_conditions({.chord = 2, .velocity = 30, .viscosity = 1.5e-5}, bodies).reynolds,
              30 * 2 / 1.5e-5);
}

TEST(Conditions, AngleAndMachNumberStayAsTheyAre) {
    const ReferenceConditions reference = reference_conditions({.alpha_deg = -3, .mach = 0.7}, bodies);
    EXPECT_EQ(reference.alpha_deg, -3);
    EXPECT_EQ(reference.mach, 0.7);
}

TEST(Conditions, ContradictionsAndNumbersOutOfRangeAreRefused) {
    EXPECT_EQ(refused_option_of({.velocity = 30}), "velocity");
    EXPECT_EQ(refused_option_of({.viscosity = 1.5e-5}), "viscosity");
    EXPECT_EQ(refused_option_of({.reynolds = 1e6, .velocity = 30, .viscosity = 1.5e-5}), "reynolds");
    EXPECT_EQ(refused_option_of({.reynolds = -1}), "reynolds");
    EXPECT_EQ(refused_option_of({.mach = 0}), "mach");
    EXPECT_EQ(refused_option_of({.chord = HUGE_VAL}), "chord");
    EXPECT_EQ(refused_option_of({.alpha_deg = 200}), "alpha");
}

}  // namespace
}  // namespace lamina
