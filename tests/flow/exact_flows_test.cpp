// The panel method against flows that are known exactly, and against published ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include <lamina/flow.hpp>

#include "flow/mapped_section.hpp"
#include "flow/panel_system.hpp"
#include "support/shapes.hpp"

namespace lamina::test {
namespace {

constexpr double degree = M_PI / 180;

/// Returns the largest error of the pressure coefficients, away from the trailing edge by a share of the extent, where
/// each is compared with the exact one at the nearest of many points of the section.
double largest_pressure_error(const Flow& flow, const MappedSection& section, double alpha, double apart) {
    constexpr std::size_t n = 40000;
    const std::vector<Point> exact = section.outline(n);
    double worst = 0;
    const ElementFlow& element = flow.elements.at(0);
    for (const auto* side : {&element.upper, &element.lower})
        for (const FlowPoint& p : *side) {
            if (distance(p.at, exact[0]) < apart * flow.chord) continue;
            std::size_t nearest = 1;
            for (std::size_t i = 1; i < n; ++i)
                if (squared_length(exact[i] - p.at) < squared_length(exact[nearest] - p.at)) nearest = i;
            const double speed = section.speed(2 * M_PI * static_cast<double>(nearest) / n, alpha);
            worst = std::max(worst, std::abs(p.pressure_coefficient - (1 - speed * speed)));
        }
    return worst;
}

struct MappedCase {
    double thickness, camber, trailing_edge_deg, alpha_deg;
};

void PrintTo(const MappedCase& c, std::ostream* out) {
    *out << "thickness " << c.thickness << " camber " << c.camber << " tail " << c.trailing_edge_deg << " alpha "
         << c.alpha_deg;
}

class MappedFlow : public testing::TestWithParam<MappedCase> {};

TEST_P(MappedFlow, LiftAndPressuresAreExact) {
    const auto [thickness, camber, trailing_edge_deg, alpha_deg] = GetParam();
    const MappedSection section{{-thickness, camber}, trailing_edge_deg * degree};
    const Flow flow = solve_flow(shapes::geometry({section.outline(400)}), {.alpha_deg = alpha_deg});
    ASSERT_FALSE(flow.estimated);
    const double lift = section.lift(alpha_deg * degree), slope = section.lift(degree) - section.lift(0);
    // Where lift is near zero its error is compared with the lift at 5 degrees more.
    const double scale = std::max(std::abs(lift), 5 * slope);
    EXPECT_NEAR(flow.lift, lift, 1e-3 * scale);
    EXPECT_NEAR(flow.elements[0].lift, lift, 2e-3 * scale);
    double fastest = 0;
    for (const double strength : flow.panels->sheets[0].strengths) fastest = std::max(fastest, std::abs(strength));
    EXPECT_LT(largest_pressure_error(flow, section, alpha_deg * degree, 0.02), 0.004 * fastest * fastest);
}

INSTANTIATE_TEST_SUITE_P(Sections, MappedFlow,
                         testing::Values(MappedCase{0.1, 0, 0, 0}, MappedCase{0.1, 0, 0, 5}, MappedCase{0.1, 0, 0, 15},
                                         MappedCase{0.04, 0, 0, 4}, MappedCase{0.25, 0, 0, 10},
                                         MappedCase{0.1, 0.1, 0, 0}, MappedCase{0.1, 0.1, 0, -6},
                                         MappedCase{0.08, 0.2, 0, 10}, MappedCase{0.1, 0, 10, 5},
                                         MappedCase{0.1, 0.1, 10, 5}, MappedCase{0.1, 0.05, 20, 8},
                                         MappedCase{0.05, 0, 30, 10}));

/// Returns the logarithmic capacity of an outline: the radius of the circle whose outside is mapped to that of the
/// outline without a change of scale far away. Charges that make the logarithmic potential constant on the outline are
/// constant on each edge. Source: T. Ransford, Potential Theory in the Complex Plane (1995), chapter 5.
double capacity(const std::vector<Point>& outline) {
    const std::size_t n = outline.size();
    std::vector<std::vector<double>> rows(n + 1, std::vector<double>(n + 2));
    for (std::size_t j = 0; j < n; ++j) {
        const Point a = outline[j], b = outline[(j + 1) % n];
        const double edge = distance(a, b);
        for (std::size_t i = 0; i < n; ++i) {
            const Point p = midpoint(outline[i], outline[(i + 1) % n]);
            const Complex along(b.x - a.x, b.y - a.y), from(p.x - a.x, p.y - a.y);
            const Complex z = from / along * edge;
            // The integral of ln |z - t| for t from 0 to the length of the edge.
            const auto primitive = [](Complex u) { return (u * std::log(u) - u).real(); };
            rows[i][j] = i == j ? edge * (std::log(0.5 * edge) - 1) : primitive(z) - primitive(z - edge);
        }
        rows[j][n] = -1;
        rows[n][j] = edge;
    }
    rows[n][n + 1] = 1;
    for (std::size_t k = 0; k <= n; ++k) {
        std::size_t pivot = k;
        for (std::size_t i = k; i <= n; ++i)
            if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
        std::swap(rows[k], rows[pivot]);
        for (std::size_t i = k + 1; i <= n; ++i) {
            const double factor = rows[i][k] / rows[k][k];
            for (std::size_t j = k; j <= n + 1; ++j) rows[i][j] -= factor * rows[k][j];
        }
    }
    return std::exp(rows[n][n + 1] / rows[n][n]);
}

TEST(ExactFlow, LiftOfSymmetricSectionsFollowsFromTheirCapacity) {
    // The trailing edge of a symmetric section is the image of the rearmost point of the circle, so that the
    // circulation is 4 pi radius sin(alpha). The capacity is extrapolated from two numbers of edges, as its error is of
    // second order.
    for (const auto& [name, alpha_deg] : {std::pair("0012", 10.0), {"0006", 4.0}, {"0024", 8.0}}) {
        const auto outline = [name = std::string(name)](std::size_t n) { return naca_airfoil(name, n).points; };
        const double coarse = capacity(outline(150)), fine = capacity(outline(300));
        const double radius = fine + (fine - coarse) / 3;
        EXPECT_NEAR(fine, radius, 1e-3 * radius);
        const double exact = 8 * M_PI * radius * std::sin(alpha_deg * degree);
        const Flow flow = solve_flow(shapes::geometry({outline(200)}), {.alpha_deg = alpha_deg});
        EXPECT_NEAR(flow.lift, exact, 2e-3 * exact) << name;
    }
}

TEST(ExactFlow, EllipsesWithoutCirculation) {
    for (const double ratio : {1.0, 0.5, 0.2}) {
        const Flow flow = solve_flow(shapes::geometry({shapes::ellipse(1, ratio, 400)}));
        ASSERT_FALSE(flow.estimated);
        EXPECT_NEAR(flow.lift, 0, 1e-9);
        EXPECT_LT(distance(flow.elements[0].stagnation, {-1, 0}), 3e-4);
        double worst = 0;
        for (const FlowPoint& p : flow.elements[0].upper) {
            const double sine = p.at.y / ratio, cosine = p.at.x;
            const double exact = (1 + ratio) * sine / std::hypot(sine, ratio * cosine);
            worst = std::max(worst, std::abs(p.speed - exact));
        }
        EXPECT_LT(worst, 0.01) << ratio;
    }
}

TEST(ExactFlow, TwoElementsOfWilliams) {
    // Configuration A of B. R. Williams, An exact test case for the plane potential flow about two adjacent lifting
    // aerofoils, ARC R&M 3717 (1973): coefficients based on the chord of the main section, at alpha 0.
    const char* shared = std::getenv("LAMINA_SHARED");
    const std::filesystem::path file =
        std::filesystem::path(shared != nullptr ? shared : LAMINA_SOURCE_DIR "/../shared") /
        "geometry/multielement/williams_two_element.dat";
    if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
    const std::vector<std::string> inputs{file.string()};
    const Flow flow = solve_flow(read_geometry(inputs), {.chord = 1});
    ASSERT_FALSE(flow.estimated);
    // The file has five digits and open trailing edges, and the published parts and their sum differ by 0.002.
    EXPECT_NEAR(flow.lift, 3.7386, 0.005 * 3.7386);
    EXPECT_NEAR(flow.elements[0].lift, 2.9065, 0.005 * 2.9065);
    EXPECT_NEAR(flow.elements[1].lift, 0.8302, 0.01 * 0.8302);
}

}  // namespace
}  // namespace lamina::test
