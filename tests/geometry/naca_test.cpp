// NACA sections have the shapes that their digits promise.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include <lamina/geometry.hpp>

#include "surface/summary.hpp"

namespace lamina {
namespace {

using surface::summarize;

Element naca(const std::string& input, std::size_t default_points = 200) {
    const std::vector<std::string> inputs{input};
    GeometryOptions options;
    options.naca_points = default_points;
    return read_geometry(inputs, options).elements.at(0);
}

/// Returns the ordinate of a polyline at x.
double interpolate(const std::vector<Point>& line, double x) {
    for (std::size_t i = 1; i < line.size(); ++i) {
        const Point a = line[i - 1], b = line[i];
        if ((a.x - x) * (b.x - x) <= 0 && a.x != b.x) return a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y);
    }
    ADD_FAILURE() << x;
    return 0;
}

struct Surfaces {
    std::vector<Point> upper, lower;
};

/// Returns both surfaces of a section with n edges each, from the trailing to the leading edge and back.
Surfaces surfaces(const Element& e, std::size_t n) {
    Surfaces s;
    for (std::size_t k = 0; k <= n; ++k) s.upper.push_back(e.points.at(k));
    for (std::size_t k = n; k <= 2 * n; ++k) s.lower.push_back(e.points.at(k % e.points.size()));
    return s;
}

TEST(Naca, SymmetricSectionsAreMirrorImagesExactly) {
    for (const std::string digits : {"0006", "0012", "0024"}) {
        for (TrailingEdge tail : {TrailingEdge::sharp, TrailingEdge::blunt}) {
            const Element e = naca_airfoil(digits, 400, tail);
            for (Point p : e.points) {
                EXPECT_TRUE(
                    std::any_of(e.points.begin(), e.points.end(), [&](Point q) { return q.x == p.x && q.y == -p.y; }));
            }
        }
    }
}

TEST(Naca, StartsAtTheTrailingEdgeUpperSurfaceFirst) {
    for (const std::string digits : {"0012", "4412", "23012", "23112"}) {
        const Element e = naca_airfoil(digits, 100);
        ASSERT_EQ(e.points.size(), 100u);
        EXPECT_EQ(e.points[0], (Point{1, 0}));
        EXPECT_EQ(e.points[50], (Point{0, 0}));
        EXPECT_GT(e.points[10].y, e.points[90].y);
        EXPECT_GT(summarize(e).area, 0);
        EXPECT_TRUE(e.repairs.empty());
        EXPECT_EQ(e.format, "naca");
    }
}

TEST(Naca, ThicknessPeaksAtThirtyPerCent) {
    const auto [upper, lower] = surfaces(naca_airfoil("0012", 2000), 1000);
    EXPECT_NEAR(interpolate(upper, 0.3) - interpolate(lower, 0.3), 0.12, 2e-4);
    double thickest = 0, where = 0;
    for (Point p : upper)
        if (p.y > thickest) thickest = p.y, where = p.x;
    EXPECT_NEAR(2 * thickest, 0.12, 2e-4);
    EXPECT_NEAR(where, 0.30, 0.005);
    // Report 460 tables an ordinate of 6.002 per cent at 30 %, with the published coefficients.
    EXPECT_NEAR(interpolate(surfaces(naca_airfoil("0012", 2001, TrailingEdge::blunt), 1000).upper, 0.3), 0.06002, 1e-5);
}

TEST(Naca, MeanLinesPeakWhereTheDigitsSay) {
    const auto peak = [](const std::string& digits) {
        const auto [upper, lower] = surfaces(naca_airfoil(digits, 4000), 2000);
        Point best{0, -1};
        for (double x = 0.01; x < 0.99; x += 0.0005) {
            const double y = 0.5 * (interpolate(upper, x) + interpolate(lower, x));
            if (y > best.y) best = {x, y};
        }
        return best;
    };
    // The midpoints of a thin section lie on its mean line.
    EXPECT_NEAR(peak("4401").x, 0.4, 0.01);
    EXPECT_NEAR(peak("4401").y, 0.04, 1e-4);
    EXPECT_NEAR(peak("2601").x, 0.6, 0.01);
    EXPECT_NEAR(peak("2601").y, 0.02, 1e-4);
    EXPECT_NEAR(peak("23001").x, 0.15, 0.005);
    EXPECT_NEAR(peak("23001").y, 0.01838, 1e-4);
    EXPECT_NEAR(peak("25001").x, 0.25, 0.005);
    EXPECT_NEAR(peak("43001").y, 2 * peak("23001").y, 1e-4);
    EXPECT_NEAR(peak("23101").x, 0.15, 0.005);
}

TEST(Naca, ReflexedMeanLinesRiseAtTheTail) {
    const auto sides = surfaces(naca_airfoil("23112", 400), 200);
    const auto mean = [&](double x) { return 0.5 * (interpolate(sides.upper, x) + interpolate(sides.lower, x)); };
    EXPECT_LT(mean(0.75), 0.5 * (mean(0.5) + mean(1)) - 1e-4);
    EXPECT_NEAR(mean(1), 0, 1e-15);
}

TEST(Naca, BluntSectionsHaveThePublishedBase) {
    const Element e = naca("naca:0012:400:blunt");
    EXPECT_EQ(e.points[0].x, 1);
    EXPECT_NEAR(e.points[0].y, 0.00126, 1e-12);
    // The section has 401 surface points. The base gets further vertices, at x = 1 as well.
    EXPECT_EQ(e.points[400].x, 1);
    EXPECT_NEAR(e.points[0].y - e.points[400].y, 0.00252, 1e-12);
    EXPECT_GT(e.points.size(), 401u);
    for (std::size_t i = 401; i < e.points.size(); ++i) EXPECT_EQ(e.points[i].x, 1);
    EXPECT_TRUE(summarize(e).blunt_trailing_edge);
    EXPECT_FALSE(summarize(naca("naca:0012:400")).blunt_trailing_edge);
}

TEST(Naca, ExtendedSectionsAreThoseOfTheTurbulenceModelingResource) {
    const Element e = naca("naca:0012:400:extended");
    EXPECT_EQ(e.points.size(), 400u);
    EXPECT_EQ(e.points[0], (Point{1, 0}));
    EXPECT_FALSE(summarize(e).blunt_trailing_edge);
    double thickest = 0;
    for (const Point p : e.points) thickest = std::max(thickest, 2 * p.y);
    EXPECT_NEAR(thickest, 0.12 / 1.00893, 5e-5);
    // The ordinates that the resource gives: 0.594689181 (0.298222773 sqrt(x) - 0.127125232 x - ...).
    for (const Point p : e.points) {
        const double x = p.x;
        const double y = 0.594689181 * (0.298222773 * std::sqrt(x) - 0.127125232 * x - 0.357907906 * x * x +
                                        0.291984971 * x * x * x - 0.105174606 * x * x * x * x);
        EXPECT_NEAR(std::abs(p.y), std::max(0.0, y), 1e-9);
    }
}

TEST(Naca, CosineSpacing) {
    const Element e = naca_airfoil("0012", 64);
    const double full_turn = 6.283185307179586;
    for (std::size_t k = 0; k <= 32; ++k)
        EXPECT_NEAR(e.points[k].x, 0.5 * (1 + std::cos(full_turn * static_cast<double>(k) / 64)), 1e-15);
}

TEST(Naca, ManySamplesHaveACornerWhereTheMeanLineBends) {
    const Element e = naca("naca:4412", 0);
    EXPECT_EQ(e.points.size(), 2000u);
    ASSERT_EQ(e.given_corners.size(), 2u);
    EXPECT_EQ(midpoint(e.points[e.given_corners[0]], e.points[e.given_corners[1]]), (Point{0.4, 0.04}));
    EXPECT_EQ(naca("naca:23012", 0).given_corners.size(), 2u);
    EXPECT_TRUE(naca("naca:0012", 0).given_corners.empty());
    EXPECT_TRUE(naca("naca:4412").given_corners.empty());
}

TEST(Naca, InputsMayGiveTheNumberOfPoints) {
    EXPECT_EQ(naca("naca:0012").points.size(), 200u);
    EXPECT_FALSE(naca("naca:0012").samples_of_curve);
    EXPECT_TRUE(naca("naca:0012", 0).samples_of_curve);
    EXPECT_FALSE(naca("naca:0012:400", 0).samples_of_curve);
    EXPECT_EQ(naca("naca:0012", 90).points.size(), 90u);
    EXPECT_EQ(naca("naca:0012:400").points.size(), 400u);
    EXPECT_EQ(naca("naca:0012:401").points.size(), 402u);
    EXPECT_EQ(naca("naca:0012:400:sharp").points.size(), 400u);
    EXPECT_TRUE(summarize(naca("naca:0012:blunt")).blunt_trailing_edge);
    EXPECT_EQ(naca("naca:0012:400").file, "naca:0012:400");
    EXPECT_EQ(naca("naca:0012").name, "airfoil");
}

TEST(Naca, RefusesInputsThatNameNoSection) {
    for (const std::string input : {"naca:",
                                    "naca:12",
                                    "naca:001",
                                    "naca:0O12",
                                    "naca:001234",
                                    "naca:0000",
                                    "naca:2012",
                                    "naca:0412",
                                    "naca:23000",
                                    "naca:03012",
                                    "naca:26012",
                                    "naca:21112",
                                    "naca:23212",
                                    "naca:0012:",
                                    "naca:0012:5",
                                    "naca:0012:-3",
                                    "naca:0012:1e9",
                                    "naca:0012:99999999999",
                                    "naca:0012:99999999999999999999999",
                                    "naca:0012:100:round",
                                    "naca:0012:100:blunt:",
                                    "naca:0012:1:2:3"})
        EXPECT_THROW(naca(input), UsageError) << input;
}

std::string reason_against(const std::string& input) {
    try {
        naca(input);
    } catch (const UsageError& error) {
        return error.what();
    }
    return "";
}

TEST(Naca, DigitsThatTwoFamiliesShareGiveAWarning) {
    for (const std::string input : {"naca:63012", "naca:65112:300", "naca:64012:blunt"}) {
        const Element e = naca(input);
        ASSERT_EQ(e.warnings.size(), 1u) << input;
        EXPECT_EQ(e.warnings[0].code, WarningCode::ambiguous_section);
        EXPECT_NEAR(e.warnings[0].number, 0.9, 1e-12);
    }
    EXPECT_NE(naca("naca:63012").warnings[0].message.find("not NACA 63-012 of the 6-series"), std::string::npos);
    for (const std::string input : {"naca:0012", "naca:6312", "naca:23012", "naca:62012", "naca:61012"})
        EXPECT_TRUE(naca(input).warnings.empty()) << input;
}

TEST(Naca, RefusalsOfOtherFamiliesSayWhereTheyComeFrom) {
    for (const std::string input : {"naca:63-012", "naca:64212", "naca:66012", "naca:65A010", "naca:65(2)-415"})
        EXPECT_NE(reason_against(input).find("coordinates for a section of the 6-series"), std::string::npos) << input;
    for (const std::string input : {"naca:16012", "naca:16-212"})
        EXPECT_NE(reason_against(input).find("1-series"), std::string::npos) << input;
    for (const std::string input : {"naca:0012-64", "naca:23012-34"})
        EXPECT_NE(reason_against(input).find("modified section"), std::string::npos) << input;
    EXPECT_EQ(reason_against("naca:001").find("coordinates"), std::string::npos);
}

TEST(Naca, EverySectionIsSimple) {
    for (int camber = 1; camber <= 9; ++camber)
        for (int position = 1; position <= 9; ++position) {
            const std::string digits = std::to_string(camber) + std::to_string(position) + "12";
            EXPECT_NO_THROW(naca("naca:" + digits + ":300")) << digits;
        }
    for (const std::string line : {"210", "220", "230", "240", "250", "221", "231", "241", "251"})
        EXPECT_NO_THROW(naca("naca:" + line + "15:300:blunt")) << line;
}

}  // namespace
}  // namespace lamina
