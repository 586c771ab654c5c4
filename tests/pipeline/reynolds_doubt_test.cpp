// Velocity and viscosity in other units than the coordinates are warned of, and plausible flows are not.
#include <string>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "pipeline/reynolds_doubt.hpp"

namespace lamina::pipeline {
namespace {

std::string doubt(double velocity, double chord, double viscosity, const std::string& unit = "") {
    const FlowConditions conditions{.velocity = velocity, .viscosity = viscosity};
    return doubt_of_reynolds(conditions, reference_conditions(conditions, Box{{0, 0}, {chord, 1}}), unit).value_or("");
}

TEST(ReynoldsDoubt, OfMillimetresWithSiUnits) {
    const std::string remedy =
        "give --velocity 30000 --viscosity 15, in mm/s and mm2/s, or --transform all:scale:0.001";
    EXPECT_NE(doubt(30, 350, 1.5e-5).find(remedy), std::string::npos) << doubt(30, 350, 1.5e-5);
    EXPECT_NE(doubt(30, 350, 1.5e-5).find("7e+08 = 30 x 350 / 1.5e-05"), std::string::npos);
    EXPECT_NE(doubt(30, 20, 1.5e-5, "mm").find("the file is in mm, in which no fluid has this viscosity"),
              std::string::npos);
    EXPECT_NE(doubt(10, 14, 1e-6, "in").find("--transform all:scale:0.0254"), std::string::npos);
}

TEST(ReynoldsDoubt, NotOfPlausibleFlows) {
    EXPECT_EQ(doubt(30, 0.35, 1.5e-5), "");    // a model in a tunnel
    EXPECT_EQ(doubt(250, 12, 3.5e-5), "");     // an airliner
    EXPECT_EQ(doubt(0.5, 0.005, 1.5e-5), "");  // an insect
    EXPECT_EQ(doubt(15, 333, 1.2e-6), "");     // an aircraft carrier
    EXPECT_EQ(doubt(30000, 350, 15), "");      // millimetres throughout
    EXPECT_EQ(doubt(30000, 350, 15, "mm"), "");
    EXPECT_EQ(doubt(30, 0.35, 1.5e-5, "m"), "");
    EXPECT_EQ(doubt(100, 3, 1.6e-4, "ft"), "");
}

TEST(ReynoldsDoubt, OfNumbersOfNoFlow) {
    const auto given = [](double reynolds) {
        const FlowConditions conditions{.reynolds = reynolds};
        return doubt_of_reynolds(conditions, reference_conditions(conditions, Box{{0, 0}, {1, 1}}), "").has_value();
    };
    EXPECT_TRUE(given(0.5));
    EXPECT_TRUE(given(1e11));
    EXPECT_FALSE(given(5e9));
    EXPECT_FALSE(given(100));
}

}  // namespace
}  // namespace lamina::pipeline
