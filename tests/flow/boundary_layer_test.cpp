// The boundary layer against exact solutions, correlations of measurements, and itself.
#include "flow/boundary_layer.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/reproducible_math.hpp"

namespace lamina {
namespace {

using flow::EdgePoint;
using flow::LayerPoint;

constexpr double never = 1e30;  // a transition beyond every point

/// Samples a speed at s = 0 to length. Above 1, `crowding` moves points towards 0.
std::vector<EdgePoint> sample_speeds(const std::function<double(double)>& speed, double length, int intervals,
                                     double crowding = 1) {
    std::vector<EdgePoint> points;
    for (int i = 0; i <= intervals; ++i) {
        const double s = length * std::pow(static_cast<double>(i) / intervals, crowding);
        points.push_back({s, speed(s)});
    }
    return points;
}

std::vector<EdgePoint> plate_speeds(double length, int intervals) {
    return sample_speeds([](double) { return 1.0; }, length, intervals, 3);
}

/// A similar boundary layer of the speed s^m, m = beta / (2 - beta): f''' + f f'' + beta (1 - f'^2) = 0 (V. M. Falkner,
/// S. W. Skan 1931). Lengths are in units of sqrt(2 viscosity s / ((m + 1) u)).
struct SimilarLayer {
    double shear, displacement, momentum, thickness;
};

/// Integrates from the wall with the given shear there. Returns whether the speed overshoots that of the edge.
bool integrate_similar_layer(double beta, SimilarLayer& layer) {
    constexpr double step = 0.005;
    using Vector = std::array<double, 3>;
    const auto rates = [&](const Vector& y) { return Vector{y[1], y[2], -y[0] * y[2] - beta * (1 - y[1] * y[1])}; };
    const auto moved = [](const Vector& y, double by, const Vector& d) {
        return Vector{y[0] + by * d[0], y[1] + by * d[1], y[2] + by * d[2]};
    };
    Vector y{0, 0, layer.shear};
    layer.displacement = layer.momentum = layer.thickness = 0;
    for (double eta = 0; eta < 9; eta += step) {
        const double before = y[1];
        const Vector a = rates(y), b = rates(moved(y, step / 2, a)), c = rates(moved(y, step / 2, b)),
                     d = rates(moved(y, step, c));
        for (int i = 0; i < 3; ++i) y[i] += step / 6 * (a[i] + 2 * b[i] + 2 * c[i] + d[i]);
        if (y[1] > 1 + 1e-9) return true;
        if (y[2] < 0) return false;
        const double u = 0.5 * (before + y[1]);
        layer.displacement += step * (1 - u);
        layer.momentum += step * u * (1 - u);
        if (layer.thickness == 0 && y[1] >= 0.99) layer.thickness = eta + step * (0.99 - before) / (y[1] - before);
    }
    return false;
}

SimilarLayer similar_layer(double beta) {
    double low = 0, high = 2;
    SimilarLayer layer{};
    for (int i = 0; i < 60; ++i) {
        layer.shear = 0.5 * (low + high);
        (integrate_similar_layer(beta, layer) ? high : low) = layer.shear;
    }
    layer.shear = low;
    integrate_similar_layer(beta, layer);
    return layer;
}

TEST(BoundaryLayer, LaminarPlateIsThatOfBlasius) {
    const double viscosity = 1e-4;
    const auto layer = flow::boundary_layer(plate_speeds(1, 40), {viscosity, never});
    ASSERT_EQ(layer.size(), 41u);
    const auto points = plate_speeds(1, 40);
    for (std::size_t i = 1; i < layer.size(); ++i) {
        const LayerPoint exact = flow::flat_plate(points[i].s, viscosity, false);
        EXPECT_EQ(layer[i].state, BoundaryLayerState::laminar);
        EXPECT_NEAR(layer[i].momentum, std::sqrt(0.45 * viscosity * points[i].s), 1e-12);  // Thwaites, exactly
        EXPECT_NEAR(layer[i].momentum / exact.momentum, 1, 0.011);
        EXPECT_NEAR(layer[i].displacement / exact.displacement, 1, 0.02);
        EXPECT_NEAR(layer[i].thickness / exact.thickness, 1, 0.02);
        EXPECT_NEAR(layer[i].skin_friction / exact.skin_friction, 1, 0.02);
    }
    // The mean friction from the leading edge to the first point is twice that at the first point.
    EXPECT_NEAR(layer[0].skin_friction, 2 * layer[1].skin_friction, 0.05 * layer[1].skin_friction);
    EXPECT_EQ(layer[0].momentum, 0);
}

TEST(BoundaryLayer, StagnationFlowIsThatOfHiemenz) {
    const double viscosity = 1e-5, gradient = 3;
    const auto layer =
        flow::boundary_layer(sample_speeds([&](double s) { return gradient * s; }, 0.5, 10), {viscosity, never});
    const double unit = std::sqrt(viscosity / gradient);
    const SimilarLayer exact = similar_layer(1);
    EXPECT_NEAR(exact.shear, 1.232588, 1e-5);
    EXPECT_NEAR(exact.momentum, 0.2923, 1e-4);
    for (std::size_t i = 0; i < layer.size(); ++i) {
        EXPECT_NEAR(layer[i].momentum, std::sqrt(0.075) * unit, 1e-10 * unit) << i;
        EXPECT_NEAR(layer[i].momentum / (exact.momentum * unit), 1, 0.07);
        EXPECT_NEAR(layer[i].displacement / (exact.displacement * unit), 1, 0.06);
        EXPECT_NEAR(layer[i].thickness / (exact.thickness * unit), 1, 0.09);
        const double s = 0.05 * static_cast<double>(i);
        EXPECT_NEAR(layer[i].skin_friction, 2 * exact.shear * viscosity * gradient * s / unit,
                    0.07 * layer[i].skin_friction + 1e-12);
    }
}

TEST(BoundaryLayer, PowersOfTheDistanceAreThoseOfFalknerAndSkan) {
    const double viscosity = 1e-4;
    for (double beta : {-0.12, -0.06, 0.2, 0.5, 0.8}) {
        const double m = beta / (2 - beta);
        const SimilarLayer exact = similar_layer(beta);
        const auto points = sample_speeds([&](double s) { return std::pow(s + 1e-4, m); }, 1, 400, 2);
        const auto layer = flow::boundary_layer(points, {viscosity, never});
        for (std::size_t i = 200; i < layer.size(); i += 50) {
            const double s = points[i].s, u = points[i].speed, unit = std::sqrt(2 * viscosity * s / ((m + 1) * u));
            EXPECT_NEAR(layer[i].momentum / (exact.momentum * unit), 1, 0.08) << beta;
            EXPECT_NEAR(layer[i].shape / (exact.displacement / exact.momentum), 1, 0.1) << beta;
            EXPECT_NEAR(layer[i].thickness / (exact.thickness * unit), 1, 0.1) << beta;
            const double friction = 2 * viscosity * u * exact.shear / unit;
            EXPECT_NEAR(layer[i].skin_friction / friction, 1, 0.06) << beta;
        }
    }
}

TEST(BoundaryLayer, LinearlyRetardedFlowSeparatesWhereThwaitesSays) {
    // L. Howarth (1938): exact 0.120, Thwaites 0.123. A layer too thin for turbulence separates at once afterwards or
    // is turbulent; either ends the laminar one.
    for (int intervals : {20, 100, 1000}) {
        const auto points = sample_speeds([](double s) { return 1 - s; }, 0.2, intervals);
        const auto layer = flow::boundary_layer(points, {1e-6, never});
        std::size_t i = 0;
        while (layer[i].state == BoundaryLayerState::laminar) ++i;
        EXPECT_GT(points[i].s, 0.1225) << intervals;
        EXPECT_LT(points[i - 1].s, 0.1237) << intervals;
    }
}

/// F. M. White, Viscous Fluid Flow (2006), eq. 6-112: skin friction of the turbulent plate.
double white_friction(double reynolds) {
    const double logarithm = std::log(0.06 * reynolds);
    return 0.455 / (logarithm * logarithm);
}

/// H. M. Nagib, K. A. Chauhan, P. A. Monkewitz, Phil. Trans. R. Soc. A 365 (2007): skin friction as measured, from the
/// Reynolds number of the momentum thickness.
double coles_fernholz_friction(double momentum_reynolds) {
    const double edge = std::log(momentum_reynolds) / 0.384 + 4.127;
    return 2 / (edge * edge);
}

TEST(BoundaryLayer, TurbulentPlateFollowsTheCorrelations) {
    for (double reynolds : {1e6, 1e7, 1e8, 1e9}) {
        const auto layer = flow::boundary_layer(plate_speeds(1, 200), {1 / reynolds, {}});
        const LayerPoint& end = layer.back();
        EXPECT_EQ(end.state, BoundaryLayerState::turbulent);
        EXPECT_NEAR(end.skin_friction / white_friction(reynolds), 0.95, 0.05) << reynolds;
        EXPECT_NEAR(end.skin_friction / coles_fernholz_friction(end.momentum * reynolds), 1, 0.03) << reynolds;
        const double drag = 0.455 / std::pow(std::log10(reynolds), 2.58);  // Prandtl, Schlichting
        EXPECT_NEAR(2 * end.momentum / drag, 0.95, 0.05) << reynolds;
        const LayerPoint plate = flow::flat_plate(1, 1 / reynolds, true);
        EXPECT_NEAR(end.skin_friction / plate.skin_friction, 0.93, 0.07) << reynolds;
        EXPECT_NEAR(end.momentum / plate.momentum, 0.93, 0.07) << reynolds;
    }
    // P. Schlatter, R. Örlü, J. Fluid Mech. 659 (2010), direct simulation at a momentum thickness Reynolds number of
    // 2000: shape factor 1.41, thickness 671 viscous lengths, which is 8.1 momentum thicknesses.
    const LayerPoint simulated = flow::boundary_layer(plate_speeds(1, 200), {1.02e-6, {}}).back();
    EXPECT_NEAR(simulated.momentum / 1.02e-6, 2000, 30);
    EXPECT_NEAR(simulated.shape, 1.41, 0.02);
    EXPECT_NEAR(simulated.thickness / simulated.momentum, 8.1, 0.4);
}

TEST(BoundaryLayer, LayerIsTurbulentAsSoonAsItCanBeOrWhereItIsTripped) {
    const double viscosity = 1e-7;
    const auto points = plate_speeds(1, 1000);
    const auto first_turbulent = [&](std::optional<double> transition) {
        const auto layer = flow::boundary_layer(points, {viscosity, transition});
        std::size_t i = 0;
        while (i < layer.size() && layer[i].state == BoundaryLayerState::laminar) ++i;
        return i < layer.size() ? points[i].s : 2.0;
    };
    const double sustained = viscosity * flow::sustaining_reynolds * flow::sustaining_reynolds / 0.45;
    EXPECT_GE(first_turbulent({}), sustained);
    EXPECT_LT(first_turbulent({}), 1.1 * sustained);
    EXPECT_EQ(first_turbulent(0.0), first_turbulent({}));
    EXPECT_GE(first_turbulent(0.3), 0.3);
    EXPECT_LT(first_turbulent(0.3), 0.303);
    EXPECT_EQ(first_turbulent(never), 2.0);
    // Momentum thickness is lost momentum, which transition does not change.
    const auto early = flow::boundary_layer(points, {viscosity, {}}),
               late = flow::boundary_layer(points, {viscosity, 0.3});
    EXPECT_GT(early.back().momentum, late.back().momentum);
    for (std::size_t i = 1; i < points.size(); ++i) {
        EXPECT_GE(late[i].momentum, late[i - 1].momentum);
        EXPECT_LT(late[i].momentum, 1.1 * late[i - 1].momentum + 1e-5);
    }
}

/// The first point at which the layer is separated, or the number of points.
std::size_t first_separated(const std::vector<LayerPoint>& layer) {
    std::size_t i = 0;
    while (i < layer.size() && layer[i].state != BoundaryLayerState::separated) ++i;
    return i;
}

TEST(BoundaryLayer, OnlyEnoughRetardationSeparatesATurbulentLayer) {
    const flow::BoundaryLayerOptions options{1e-7, {}};
    const auto retarded = sample_speeds([](double s) { return 1 - s; }, 0.9, 300);
    const auto layer = flow::boundary_layer(retarded, options);
    const std::size_t i = first_separated(layer);
    ASSERT_LT(i, layer.size());
    // Two simple criteria give 0.40 (B. S. Stratford, J. Fluid Mech. 5 (1959), known to be early) and 0.45 (A. Buri,
    // 1931). The shape factor, which ends at 2.4, is 1.8 at 0.42.
    EXPECT_GT(retarded[i].s, 0.40);
    EXPECT_LT(retarded[i].s, 0.52);
    for (std::size_t k = i; k < layer.size(); ++k) {
        EXPECT_EQ(layer[k].state, BoundaryLayerState::separated);
        EXPECT_EQ(layer[k].skin_friction, 0);
        EXPECT_EQ(layer[k].momentum, layer[i].momentum);
        const double way = retarded[k].s - retarded[i].s;
        EXPECT_NEAR(layer[k].thickness, layer[i].thickness + 0.11 * way, 1e-12);
        EXPECT_NEAR(layer[k].displacement, layer[i].displacement + 0.055 * way, 1e-12);
    }
    for (double rate : {0.0, 0.1, 1.0, 10.0, 100.0}) {
        const auto accelerated = sample_speeds([&](double s) { return 1 + rate * s; }, 1, 300);
        const auto attached = flow::boundary_layer(accelerated, options);
        EXPECT_EQ(first_separated(attached), attached.size()) << rate;
    }
    // P. Bradshaw, J. Fluid Mech. 29 (1967): layers of the speeds s^-0.15 and s^-0.255 stay attached.
    for (double exponent : {-0.15, -0.255}) {
        const auto points = sample_speeds([&](double s) { return std::pow(0.1 + s, exponent); }, 3, 300);
        const auto attached = flow::boundary_layer(points, {1e-6, {}});
        EXPECT_NEAR(attached.back().shape, exponent > -0.2 ? 1.45 : 1.6, 0.05);
        EXPECT_EQ(first_separated(attached), attached.size()) << exponent;
    }
    const auto steep = sample_speeds([](double s) { return std::pow(0.1 + s, -0.6); }, 3, 300);
    EXPECT_LT(first_separated(flow::boundary_layer(steep, options)), 300u);
}

TEST(BoundaryLayer, LayerReattachesWhereThePressureFallsBelowThatOfSeparation) {
    // A cove: the flow leaves the wall at its edge, and comes back before the slot, where it is fast.
    const auto cove = [](double s) {
        return s < 0.3 ? 1.0 : s < 0.4 ? 1 - 8 * (s - 0.3) : s < 0.7 ? 0.2 : 0.2 + 4 * (s - 0.7);
    };
    const auto points = sample_speeds(cove, 1, 1000);
    const auto layer = flow::boundary_layer(points, {1e-7, {}});
    double separated_at = 0, speed_of_separation = 0, reattached_at = 0, thickest = 0;
    for (std::size_t i = 1; i < layer.size(); ++i) {
        const bool before = layer[i - 1].state == BoundaryLayerState::separated,
                   now = layer[i].state == BoundaryLayerState::separated;
        if (now && !before) separated_at = points[i].s, speed_of_separation = points[i - 1].speed;
        if (before && !now) reattached_at = points[i].s, thickest = layer[i - 1].thickness;
    }
    EXPECT_GT(separated_at, 0.3);
    EXPECT_LT(separated_at, 0.35);
    EXPECT_NEAR(reattached_at, 0.7 + (speed_of_separation - 0.2) / 4, 0.003);
    EXPECT_GT(thickest, 0.11 * (reattached_at - separated_at) - 1e-3);
    EXPECT_LT(layer.back().thickness, thickest);  // by acceleration
    EXPECT_GT(layer.back().skin_friction, layer[300].skin_friction / 2);
    EXPECT_EQ(layer.back().state, BoundaryLayerState::turbulent);
}

/// The speeds along the upper or lower side of a symmetric Joukowski section of chord 1 and some 12 % thickness, from
/// its stagnation point to its cusp.
std::vector<EdgePoint> joukowski_speeds(double alpha, bool upper, int intervals) {
    constexpr double pi = core::pi, eccentricity = 0.1, radius = 1 + eccentricity;
    const auto place = [&](double angle) {
        const std::complex<double> z = -eccentricity + std::polar(radius, angle);
        return z + 1.0 / z;
    };
    const double chord = 2 - place(pi).real();
    const auto speed = [&](double angle) {
        const std::complex<double> z = -eccentricity + std::polar(radius, angle);
        const double on_circle = 2 * std::abs(std::sin(angle - alpha) + std::sin(alpha));
        // At the cusp both are 0, and their ratio has this limit.
        if (std::abs(angle) < 1e-9) return std::cos(alpha) / radius;
        return on_circle / std::abs(1.0 - 1.0 / (z * z));
    };
    // The rear stagnation point of the circle is at angle 0, the front one at pi + 2 alpha.
    const double front = pi + 2 * alpha, rear = upper ? 0.0 : 2 * pi;
    std::vector<EdgePoint> points{{0, 0}};
    constexpr int parts = 20;
    for (int i = 1; i <= intervals; ++i) {
        double s = points.back().s, angle = 0;
        for (int part = 1; part <= parts; ++part) {
            const auto at = [&](int k) { return front + (rear - front) * ((i - 1) * parts + k) / (intervals * parts); };
            s += std::abs(place(at(part)) - place(at(part - 1))) / chord;
            angle = at(part);
        }
        points.push_back({s, speed(i == intervals ? 0.0 : angle)});
    }
    return points;
}

TEST(BoundaryLayer, ADentNearTheNoseDoesNotLast) {
    // A dent in the outline, or noise of its points, makes the layer separate at once, where it is far too thin for
    // turbulence. The friction of the side stays what it is without the dent, and its thickness nearly.
    const auto points = joukowski_speeds(0, true, 300);
    const auto smooth = flow::boundary_layer(points, {1 / 6e6, {}});
    for (std::size_t dent : {3, 10, 30}) {
        auto dented = points;
        dented[dent].speed *= 0.4;
        const auto layer = flow::boundary_layer(dented, {1 / 6e6, {}});
        EXPECT_EQ(layer.back().state, BoundaryLayerState::turbulent);
        EXPECT_NEAR(layer.back().thickness / smooth.back().thickness, 1, 0.15) << dent;
        double most = 0, most_smooth = 0;
        for (const LayerPoint& p : layer) most = std::max(most, p.skin_friction);
        for (const LayerPoint& p : smooth) most_smooth = std::max(most_smooth, p.skin_friction);
        EXPECT_NEAR(most / most_smooth, 1.1, 0.25) << dent;
    }
}

TEST(BoundaryLayer, SectionsHaveTheDragOfTheirKind) {
    // Drag of NACA 0012 with tripped layers at a Reynolds number of 6e6 (C. L. Ladson, NASA TM 4074 (1988)). The
    // section here is as thick, and has the speeds of flow without viscosity, which are too large at 10 degrees.
    for (const auto& [alpha_deg, measured] : {std::pair{0.0, 0.0081}, std::pair{10.0, 0.012}}) {
        double drag = 0;
        for (bool upper : {true, false}) {
            const auto points = joukowski_speeds(core::radians(alpha_deg), upper, 300);
            const auto layer = flow::boundary_layer(points, {1 / 6e6, {}});
            const LayerPoint& end = layer.back();
            EXPECT_EQ(first_separated(layer), layer.size()) << alpha_deg;
            drag += 2 * end.momentum * std::pow(points.back().speed, (end.shape + 5) / 2);  // Squire, Young (1937)
        }
        EXPECT_NEAR(drag / measured, 1, 0.1) << alpha_deg;
    }
}

TEST(BoundaryLayer, IncidenceThickensTheUpperSideAndRaisesItsFriction) {
    double thickness = 0, friction = 0;
    for (double alpha_deg : {0.0, 3.0, 6.0, 9.0, 12.0, 15.0}) {
        const auto layer = flow::boundary_layer(joukowski_speeds(core::radians(alpha_deg), true, 300), {1 / 6e6, {}});
        double most_friction = 0;
        for (const LayerPoint& p : layer) most_friction = std::max(most_friction, p.skin_friction);
        EXPECT_GT(layer.back().thickness, thickness) << alpha_deg;
        EXPECT_GT(most_friction, friction) << alpha_deg;
        thickness = layer.back().thickness, friction = most_friction;
    }
    EXPECT_LT(thickness, 0.15);
}

TEST(BoundaryLayer, ViscosityThickensLayersAndRaisesTheirFriction) {
    for (double alpha_deg : {0.0, 5.0}) {
        const auto points = joukowski_speeds(core::radians(alpha_deg), true, 200);
        double thickness = 1, friction = 1;
        for (double reynolds = 3e5; reynolds < 1e10; reynolds *= 2) {
            const auto layer = flow::boundary_layer(points, {1 / reynolds, {}});
            double most_friction = 0;
            for (const LayerPoint& p : layer) most_friction = std::max(most_friction, p.skin_friction);
            EXPECT_LT(layer.back().thickness, thickness) << reynolds;
            EXPECT_LT(most_friction, friction) << reynolds;
            thickness = layer.back().thickness, friction = most_friction;
        }
    }
}

TEST(BoundaryLayer, MorePointsConverge) {
    const auto run = [](int intervals) {
        return flow::boundary_layer(joukowski_speeds(core::radians(6), true, intervals), {1 / 3e6, {}});
    };
    const auto finest = run(6400);
    double before = 1;
    for (int intervals : {100, 200, 400, 800}) {
        const auto layer = run(intervals);
        double error = 0;
        const std::size_t step = 6400 / static_cast<std::size_t>(intervals);
        for (std::size_t i = layer.size() / 5; i < layer.size(); ++i)
            error = std::max(error, std::abs(layer[i].momentum / finest[i * step].momentum - 1));
        EXPECT_LT(error, 0.7 * before);
        before = error;
    }
    EXPECT_LT(before, 3e-4);
}

TEST(BoundaryLayer, LengthsScaleByPowersOfTwoExactly) {
    for (double factor : {0x1p-40, 0.5, 0x1p70}) {
        const auto points = joukowski_speeds(core::radians(9), true, 150);
        auto scaled = points;
        for (EdgePoint& p : scaled) p.s *= factor;
        const auto layer = flow::boundary_layer(points, {1e-6, 0.02});
        const auto same = flow::boundary_layer(scaled, {1e-6 * factor, 0.02 * factor});
        for (std::size_t i = 0; i < points.size(); ++i) {
            EXPECT_EQ(same[i].momentum, layer[i].momentum * factor);
            EXPECT_EQ(same[i].displacement, layer[i].displacement * factor);
            EXPECT_EQ(same[i].thickness, layer[i].thickness * factor);
            EXPECT_EQ(same[i].shape, layer[i].shape);
            EXPECT_EQ(same[i].skin_friction, layer[i].skin_friction);
            EXPECT_EQ(same[i].state, layer[i].state);
        }
    }
}

void expect_sound(const std::vector<LayerPoint>& layer, const std::string& what) {
    BoundaryLayerState state = BoundaryLayerState::laminar;
    for (std::size_t i = 0; i < layer.size(); ++i) {
        const LayerPoint& p = layer[i];
        for (double number : {p.momentum, p.displacement, p.thickness, p.shape, p.skin_friction}) {
            ASSERT_TRUE(std::isfinite(number)) << what << " at " << i;
            ASSERT_GE(number, 0) << what << " at " << i;
        }
        ASSERT_GE(p.thickness, p.displacement) << what << " at " << i;
        ASSERT_GE(p.displacement, p.momentum) << what << " at " << i;
        if (state != BoundaryLayerState::laminar) {
            ASSERT_NE(p.state, BoundaryLayerState::laminar) << what << " at " << i;
        }
        state = p.state;
    }
}

TEST(BoundaryLayer, AnySpeedsGiveFiniteLayers) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int run = 0; run < 4000; ++run) {
        const auto number = static_cast<int>(uniform(random) * 60);
        const double zeros = run % 3 == 0 ? 0.3 : 0.0, spread = run % 5, roughness = run % 7 == 0 ? 0.05 : 1.0;
        std::vector<EdgePoint> points;
        double s = 0;
        for (int i = 0; i < number; ++i) {
            double speed = 1 + roughness * (uniform(random) - 0.5) * 2;
            if (uniform(random) < zeros) speed = 0;
            speed *= std::pow(10.0, spread * (uniform(random) - 0.7));
            points.push_back({s, i == 0 && run % 2 == 0 ? 0.0 : speed});
            if (run % 11 > 0 || uniform(random) > 0.2) s += std::pow(10.0, -spread * uniform(random));
        }
        const double viscosity = std::pow(10.0, 3 - 15 * uniform(random));
        const std::optional<double> transition =
            run % 4 == 0 ? std::optional<double>(uniform(random) * s) : std::nullopt;
        const auto layer = flow::boundary_layer(points, {viscosity, transition});
        ASSERT_EQ(layer.size(), points.size());
        expect_sound(layer, "run " + std::to_string(run));
    }
}

TEST(BoundaryLayer, DegenerateInputGivesFiniteLayers) {
    using Points = std::vector<EdgePoint>;
    const std::vector<Points> cases{{},
                                    {{0, 0}},
                                    {{0, 1}},
                                    {{0, 0}, {1, 0}},
                                    {{0, 0}, {0, 0}},
                                    {{0, 0}, {0, 1}, {1, 1}},
                                    {{0, 1}, {0, 1}, {1, 1}},
                                    {{0, 0}, {1, 0}, {2, 0}, {3, 1}, {4, 1}},
                                    {{0, 0}, {1, 1}, {1, 0.01}, {1, 1}, {2, 1}},
                                    {{0, 0}, {1, 1}, {2, 0}, {3, 1}, {4, 0}, {5, 1e9}},
                                    {{0, 0}, {1e-300, 1e-300}, {1, 1}},
                                    {{0, 1e-9}, {1e60, 1}, {2e60, 1}}};
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (double viscosity : {1e-60, 1e-7, 1.0, 1e60}) {
            const auto layer = flow::boundary_layer(cases[i], {viscosity, {}});
            ASSERT_EQ(layer.size(), cases[i].size());
            expect_sound(layer, "case " + std::to_string(i) + " viscosity " + std::to_string(viscosity));
        }
    }
}

TEST(FlatPlate, LawsAreThoseOfTheBooks) {
    for (double s : {1e-3, 1.0, 40.0}) {
        const LayerPoint laminar = flow::flat_plate(s, 1e-5, false);
        EXPECT_NEAR(laminar.skin_friction, laminar.momentum / s, 1e-15);  // of cf = 2 dtheta / ds
        EXPECT_NEAR(laminar.displacement / laminar.momentum, laminar.shape, 2e-3);
    }
    const LayerPoint turbulent = flow::flat_plate(2.0, 2e-7, true);
    EXPECT_NEAR(turbulent.skin_friction, 0.0027, 1e-12);
    EXPECT_NEAR(turbulent.thickness, 0.032, 1e-12);
    EXPECT_NEAR(turbulent.displacement / turbulent.momentum, turbulent.shape, 1e-12);
    EXPECT_EQ(turbulent.state, BoundaryLayerState::turbulent);
    EXPECT_EQ(flow::flat_plate(1e-3, 1e-5, true).state, BoundaryLayerState::laminar);  // too short for turbulence
    EXPECT_EQ(flow::flat_plate(0, 1e-5, true).thickness, 0);
    EXPECT_EQ(flow::flat_plate(0, 1e-5, true).skin_friction, 0);
}

TEST(FlatPlate, TurbulenceThickensAndRubs) {
    for (double reynolds = 1e2; reynolds < 1e10; reynolds *= 1.5) {
        const LayerPoint laminar = flow::flat_plate(1, 1 / reynolds, false),
                         turbulent = flow::flat_plate(1, 1 / reynolds, true);
        EXPECT_GE(turbulent.skin_friction, laminar.skin_friction);
        EXPECT_GE(turbulent.momentum, laminar.momentum);
        EXPECT_GE(turbulent.thickness, laminar.thickness);
    }
}

TEST(Wake, GrowsFromBothLayersToTheSelfSimilarWidth) {
    EXPECT_DOUBLE_EQ(flow::wake_thickness(0.02, 0.01, 0.004, 0), 0.03);
    double before = 0;
    for (double distance = 0; distance < 100; distance += 0.5) {
        const double thickness = flow::wake_thickness(0.02, 0.01, 0.004, distance);
        EXPECT_GT(thickness, before);
        before = thickness;
    }
    // The half-width of Schlichting's wake, where half of the largest defect is left, is 0.25 sqrt(x cd d), that is
    // 0.441 of the width to where it ends.
    const double distance = 1000, momentum = 0.005;
    const double half_width = 0.25 * std::sqrt(distance * 2 * momentum);
    EXPECT_NEAR(flow::wake_thickness(0.02, 0.01, momentum, distance) / (2 * half_width / 0.441), 1, 0.01);
    EXPECT_EQ(flow::wake_thickness(0, 0, 0, 1), 0);
}

}  // namespace
}  // namespace lamina
