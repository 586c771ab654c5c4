// Flow conditions: the reference chord and the Reynolds number.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include <lamina/conditions.hpp>
#include <lamina/error.hpp>

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
