// Turbulent layers of compressible flow, and flow that they displace, against theory and published values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "flow/euler/euler.hpp"
#include "flow/euler/interaction.hpp"
#include "flow/euler/lag_entrainment.hpp"
#include "flow/euler/triangles_at_edges.hpp"
#include "flow/euler/wall_flow.hpp"
#include "flow/euler_meshes.hpp"

namespace lamina::test {
namespace {

using namespace flow::euler;

/// Gas of this Mach number far away and this Reynolds number of the unit of length.
OuterGas gas_of(double mach, double reynolds) { return {total_enthalpy({1, mach, 0, 1 / 1.4}), mach / reynolds}; }

/// Stations from s = 0.1 to 1.1 at which nothing is displaced yet.
template <class Speed>
std::vector<Station> stations_of(Speed speed, const OuterGas& gas, std::size_t count = 101) {
    std::vector<Station> stations;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = static_cast<double>(i) / static_cast<double>(count - 1), u = speed(x);
        const double t = 0.4 * (gas.total_enthalpy - 0.5 * u * u);
        stations.push_back({0.1 + x, u, t * t * std::sqrt(t), 0});
    }
    return stations;
}

ShearLayer first_layer(const Station& station, const OuterGas& gas) {
    return plate_layer(3e-4, edge_of(station, station.speed, gas));
}

TEST(LagEntrainment, HasTheFrictionOfPlates) {
    // Karman and Schoenherr: 1 / cf = 17.08 log10(Re)^2 + 25.11 log10(Re) + 6.012, with the momentum thickness in Re.
    for (const double reynolds : {1e6, 1e7, 1e8}) {
        const OuterGas gas = gas_of(0.1, reynolds);
        const std::vector<Station> stations = stations_of([](double) { return 0.1; }, gas);
        const StationLayer end = march(stations, first_layer(stations[0], gas), gas, {}).back();
        const double log = std::log10(end.layer.momentum * reynolds);
        const double exact = 1 / (17.08 * log * log + 25.11 * log + 6.012);
        EXPECT_NEAR(end.friction, exact, 0.03 * exact) << reynolds;
        EXPECT_GT(end.shape, 1.2);
        EXPECT_LT(end.shape, 1.5);
    }
    // At Mach 2 the friction at one Reynolds number of the momentum thickness is about 0.7 of that of slow flow.
    const auto friction_at = [](double mach) {
        return layer_rates({1e-3, 1.3, 0.01}, {mach, 1e7}, LayerKind::wall).friction;
    };
    EXPECT_NEAR(friction_at(2) / friction_at(0.01), 0.7, 0.05);
}

TEST(LagEntrainment, KeepsTheBalanceOfMomentum) {
    // d(density u^2 momentum) / ds + displaced flux du / ds = density u^2 cf / 2, by von Karman.
    const OuterGas gas = gas_of(0.7, 1e7);
    const std::vector<Station> stations = stations_of([](double x) { return 0.9 - 0.1 * x * x; }, gas, 401);
    const std::vector<StationLayer> layers = march(stations, first_layer(stations[0], gas), gas, {});
    const auto flux = [&](std::size_t i) {
        return layers[i].density * layers[i].speed * layers[i].speed * layers[i].layer.momentum;
    };
    for (std::size_t i = 20; i + 1 < layers.size(); i += 20) {
        const double way = stations[i + 1].s - stations[i - 1].s;
        const double gained =
            (flux(i + 1) - flux(i - 1)) / way + layers[i].displaced * (layers[i + 1].speed - layers[i - 1].speed) / way;
        const double rubbed = 0.5 * layers[i].friction * layers[i].density * layers[i].speed * layers[i].speed;
        EXPECT_NEAR(gained, rubbed, 1e-3 * rubbed) << i;
        EXPECT_NEAR(layers[i].speed, stations[i].speed, 1e-6);
    }
}

TEST(LagEntrainment, RatesOfTheDisplacedFluxAreThoseOfTheLayer) {
    const LayerEdge edge{0.8, 1e7};
    const ShearLayer layer{1e-3, 1.6, 0.03};
    const double x = -2e-3, step = 1e-6, u = 0.8;
    const LayerRates rates = layer_rates(layer, edge, LayerKind::wall);
    // Along a step the Mach number changes by M (1 + 0.2 M^2) du / u, the density by -M^2 du / u.
    const double du = x / layer.momentum * step;
    const ShearLayer next{layer.momentum + step * rates.momentum.at(x), layer.shape + step * rates.transformed.at(x),
                          layer.entrainment};
    const double mach = edge.mach + edge.mach * (1 + 0.2 * edge.mach * edge.mach) * du;
    const double before = u * layer.momentum * compressible_shape(layer.shape, edge.mach);
    const double behind =
        u * (1 + du) * (1 - edge.mach * edge.mach * du) * next.momentum * compressible_shape(next.shape, mach);
    EXPECT_NEAR((behind - before) / step / u, rates.displaced_flux.at(x), 1e-5 * std::abs(rates.displaced_flux.at(x)));
}

TEST(Interaction, LeavesTheSpeedAloneWhereLayerAndFlowAgree) {
    const OuterGas gas = gas_of(0.5, 1e7);
    std::vector<Station> stations = stations_of([](double x) { return 0.6 - 0.1 * x; }, gas);
    const ShearLayer first = first_layer(stations[0], gas);
    const MarchOptions answering{.answer_length = 0.03};
    const std::vector<StationLayer> given = march(stations, first, gas, {});
    for (std::size_t i = 0; i < stations.size(); ++i) stations[i].displaced = given[i].displaced;
    const std::vector<StationLayer> layers = march(stations, first, gas, answering);
    for (std::size_t i = 0; i < stations.size(); ++i) {
        EXPECT_NEAR(layers[i].speed, stations[i].speed, 2e-4 * stations[i].speed);
        EXPECT_NEAR(layers[i].displaced, given[i].displaced, 5e-3 * given[i].displaced);
    }
}

TEST(Interaction, PassesSeparation) {
    // In a flow that loses most of its speed the layer alone would become arbitrarily thick.
    const OuterGas gas = gas_of(0.3, 1e7);
    const std::vector<Station> stations = stations_of([](double x) { return 0.3 - 0.2 * x; }, gas);
    const std::vector<StationLayer> layers =
        march(stations, first_layer(stations[0], gas), gas, {.answer_length = 0.1});
    EXPECT_LT(std::min_element(layers.begin(), layers.end(),
                               [](const auto& a, const auto& b) { return a.friction < b.friction; })
                  ->friction,
              3e-4);
    for (const StationLayer& layer : layers) {
        EXPECT_TRUE(std::isfinite(layer.displaced) && std::isfinite(layer.speed));
        EXPECT_LT(layer.layer.momentum, 0.05);
    }
    EXPECT_GT(layers.back().speed, stations.back().speed);
}

/// Round corners of bluff bodies the speed jumps up and down, and what was displaced does not fit. Thousands of steps,
/// each of which may make the layer half as thick again, led to no numbers.
TEST(Interaction, StaysFiniteInWildFlow) {
    const OuterGas gas = gas_of(0.7, 3e5);
    std::mt19937 random(3);
    const auto share = [&] { return static_cast<double>(random()) / 0x1p32; };
    for (int round = 0; round < 20; ++round) {
        std::vector<Station> stations = stations_of([&](double) { return 0.02 + 2 * share(); }, gas, 800);
        for (Station& station : stations) station.displaced = share();
        for (const LayerKind kind : {LayerKind::wall, LayerKind::wake}) {
            const std::vector<StationLayer> layers =
                march(stations, first_layer(stations[0], gas), gas, {.kind = kind, .answer_length = 0.01});
            for (const StationLayer& layer : layers)
                ASSERT_TRUE(std::isfinite(layer.displaced) && std::isfinite(layer.speed) &&
                            std::isfinite(layer.layer.momentum) && std::isfinite(layer.friction));
        }
    }
}

TEST(TrianglesAtEdges, AreThoseOnBothSides) {
    const std::vector<Triangle> triangles{{{VertexId{0u}, VertexId{1u}, VertexId{2u}}},
                                          {{VertexId{2u}, VertexId{1u}, VertexId{3u}}}};
    const TrianglesAtEdges at(triangles);
    EXPECT_EQ(at.beside(1, 2, 0u), 1u);
    EXPECT_EQ(at.beside(2, 1, 1u), 0u);
    EXPECT_EQ(at.beside(0, 1), 0u);
    EXPECT_EQ(at.beside(0, 1, 0u), std::nullopt);
    EXPECT_EQ(at.beside(0, 3), std::nullopt);
}

TEST(DisplacementLayers, HaveTheDragOfNaca0012) {
    // Fully turbulent at a Reynolds number of 6e6: 0.0081 to 0.0083 at low speed (NASA's turbulence modelling
    // resource).
    const SectionMesh mesh = mesh_round(naca_0012(), 144, 50, 3);
    const EulerSolution flow = solve_euler(mesh.view(), {.mach = 0.4, .reynolds = 6e6});
    ASSERT_TRUE(flow.converged);
    ASSERT_EQ(flow.layers.size(), 1u);
    EXPECT_NEAR(viscous_drag(flow), 0.0083, 0.0008);
    EXPECT_NEAR(flow.lift, 0, 2e-3);
    // Both sides are alike.
    const std::vector<WallLayer>& layers = flow.layers[0].layers;
    ASSERT_EQ(layers.size(), mesh.wall.sides_end + 1);
    for (std::size_t k = 0; k < layers.size(); ++k)
        EXPECT_NEAR(layers[k].momentum, layers[layers.size() - 1 - k].momentum, 2e-4) << k;
    EXPECT_NEAR(layers.front().momentum, 0.0025, 0.001);
    EXPECT_EQ(layers[layers.size() / 2].momentum, 0);
}

TEST(DisplacementLayers, TakeLiftAndMoveShocksForward) {
    for (const Section& section : {naca_0012(), blunt_0012()}) {
        const SectionMesh mesh = mesh_round(section, 144, 50, 3);
        const EulerOptions without{.mach = 0.75, .alpha_deg = 2};
        EulerOptions with = without;
        with.reynolds = 6e6;
        const EulerSolution a = solve_euler(mesh.view(), without), b = solve_euler(mesh.view(), with);
        ASSERT_TRUE(a.converged && b.converged);
        ASSERT_TRUE(a.layers.empty());
        ASSERT_EQ(b.layers.size(), 1u);
        EXPECT_LT(b.lift, 0.95 * a.lift);
        EXPECT_GT(b.lift, 0.6 * a.lift);
        const WallShock before = wall_flows(mesh.view(), a, without)[0].upper.shocks.at(0),
                        behind = wall_flows(mesh.view(), b, with)[0].upper.shocks.at(0);
        EXPECT_LT(behind.position, before.position - 0.01);
        EXPECT_GT(behind.position, before.position - 0.1);
    }
}

TEST(DisplacementLayers, AreLeftOutWhereTheyDoNotSettle) {
    // Far beyond the stall.
    const SectionMesh mesh = mesh_round(cambered(), 96, 30, 3);
    const EulerSolution flow = solve_euler(mesh.view(), {.mach = 0.75, .alpha_deg = 9, .reynolds = 6e6});
    EXPECT_TRUE(flow.layers.empty());
    EXPECT_TRUE(std::isfinite(flow.lift) && std::isfinite(flow.drag));
}

}  // namespace
}  // namespace lamina::test
