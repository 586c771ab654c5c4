// Turns of elements as functions of time.
#include <lamina/morph.hpp>

#include <cmath>
#include <variant>

#include <gtest/gtest.h>

#include <lamina/error.hpp>

namespace lamina::test {

namespace {

double angle_at(const TurnInTime& turn, double time) {
    return std::get<Rotation>(turn_at(turn, time).change).angle_deg;
}

TEST(TurnInTime, Pitches) {
    const TurnInTime turn = parse_turn_in_time("airfoil:pitch:10:5:0.25:0.25,-0.5");
    EXPECT_EQ(turn.element, "airfoil");
    EXPECT_EQ(turn.center, (Point{0.25, -0.5}));
    EXPECT_EQ(duration_of(turn), 4);
    EXPECT_EQ(turn_at(turn, 1).element, "airfoil");
    EXPECT_EQ(angle_at(turn, 0), -10);
    for (const double time : {0.3, 1.0, 2.0, 3.7, 4.0, 9.1})
        EXPECT_NEAR(angle_at(turn, time), -10 - 5 * std::sin(0.5 * M_PI * time), 1e-13);
}

TEST(TurnInTime, DeflectsFromRestToRest) {
    const TurnInTime turn = parse_turn_in_time("flap:deflect:20:2");
    EXPECT_EQ(turn.center, Point{});
    EXPECT_EQ(duration_of(turn), 2);
    EXPECT_EQ(angle_at(turn, 0), 0);
    EXPECT_NEAR(angle_at(turn, 1), -10, 1e-13);
    EXPECT_EQ(angle_at(turn, 2), -20);
    EXPECT_EQ(angle_at(turn, 5), -20);
    EXPECT_LT(std::abs(angle_at(turn, 1e-3)), 1e-4);
}

TEST(TurnInTime, RefusesOtherTexts) {
    for (const char* text : {"", "flap", ":pitch:1:2:3", "flap:pitch:1:2", "flap:pitch:1:2:0", "flap:pitch:1:2:-1",
                             "flap:pitch:1:2:3:4", "flap:pitch:1:2:3:4,5:6", "flap:pitch:x:2:3", "flap:deflect:1",
                             "flap:deflect:1:0", "flap:deflect:1:2:3", "flap:deflect:nan:2", "flap:turn:1:2"})
        EXPECT_THROW(parse_turn_in_time(text), UsageError) << text;
}

}  // namespace

}  // namespace lamina::test
