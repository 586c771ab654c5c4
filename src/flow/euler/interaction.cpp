#include "flow/euler/interaction.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/reproducible_math.hpp"

namespace lamina::flow::euler {

namespace {

/// Slower flow at the edge counts as this one, over the speed of sound of the free stream.
constexpr double least_speed = 0.02;

/// Colder gas at the edge counts as this cold, over the temperature of the free stream.
constexpr double least_edge_temperature = 0.05;

double temperature(const OuterGas& gas, double speed) {
    return std::max((heat_ratio - 1) * (gas.total_enthalpy - 0.5 * speed * speed), least_edge_temperature);
}

/// Returns the speed of the coldest gas.
double largest_speed(const OuterGas& gas) {
    return std::sqrt(2 * std::max(gas.total_enthalpy - least_edge_temperature / (heat_ratio - 1), 0.0));
}

/// Sutherland's law for air of 288.15 K.
double viscosity(const OuterGas& gas, double temperature) {
    constexpr double constant = 110.4 / 288.15;
    return gas.viscosity * temperature * std::sqrt(temperature) * (1 + constant) / (temperature + constant);
}

/// Returns the density of gas of this speed and of the entropy of the station.
double density_at(const Station& station, double speed, const OuterGas& gas) {
    const double ratio = temperature(gas, speed) / temperature(gas, station.speed);
    return station.density * ratio * ratio * std::sqrt(ratio);
}

/// Returns how much the speed changes with the displaced flux.
double answer(const Station& station, const OuterGas& gas, double length) {
    constexpr double least = 0.2;  // of |1 - M^2|: near the speed of sound the law of thin bodies has no limit
    if (length <= 0) return 0;
    const double mach2 = station.speed * station.speed / temperature(gas, station.speed);
    return 1 / (core::pi * length * station.density * std::sqrt(std::max(std::abs(1 - mach2), least)));
}

Station mean(const Station& a, const Station& b, double t) {
    const auto mix = [t](double x, double y) { return x + t * (y - x); };
    return {mix(a.s, b.s), mix(a.speed, b.speed), mix(a.density, b.density), mix(a.displaced, b.displaced)};
}

/// The layer and the speed at its edge on their way.
struct State {
    ShearLayer layer;
    double speed;
};

/// Returns what lies behind a step of these rates. No step more than doubles or halves anything, and many of them, as
/// round bluff bodies, where layers and flow do not become steady together, leave numbers finite.
State advanced(const State& state, const State& rates, double step, double fastest) {
    constexpr double thickest = 1;  // momentum thickness, in chords
    const double momentum = state.layer.momentum, speed = state.speed;
    const double grown = std::clamp(momentum + step * rates.layer.momentum, 0.7 * momentum, 1.5 * momentum);
    return {limited({std::min(grown, thickest), state.layer.shape + step * rates.layer.shape,
                     state.layer.entrainment + step * rates.layer.entrainment}),
            std::clamp(std::clamp(speed + step * rates.speed, 0.8 * speed, 1.25 * speed), least_speed, fastest)};
}

/// The part of the way between two stations.
class Interval {
public:
    Interval(const Station& a, const Station& b, const OuterGas& gas, const MarchOptions& options)
        : a_(a),
          b_(b),
          gas_(gas),
          options_(options),
          answer_a_(answer(a, gas, options.answer_length)),
          answer_b_(answer(b, gas, options.answer_length)) {}

    /// Leads the layer to the second station by the midpoint rule.
    State lead(State state) const {
        constexpr double step_in_momentum = 8, most_steps = 60;
        const double length = b_.s - a_.s;
        const auto steps =
            static_cast<int>(std::clamp(length / (step_in_momentum * state.layer.momentum), 1.0, most_steps)) + 1;
        const double step = length / steps, fastest = largest_speed(gas_);
        for (int k = 0; k < steps; ++k) {
            const State half = advanced(state, rates(state, static_cast<double>(k) / steps), 0.5 * step, fastest);
            state = advanced(state, rates(half, (k + 0.5) / steps), step, fastest);
        }
        return state;
    }

private:
    /// Returns the rates of change. The law u - c flux = r, where r is known, closes those of the layer: with
    /// d flux / ds = density u (A + B x) and du / ds = u x / momentum it gives x.
    State rates(const State& state, double t) const {
        const Station here = mean(a_, b_, t);
        const double length = b_.s - a_.s, c = answer_a_ + t * (answer_b_ - answer_a_);
        const double known = ((b_.speed - answer_b_ * b_.displaced) - (a_.speed - answer_a_ * a_.displaced)) / length;
        const LayerRates layer = layer_rates(state.layer, edge_of(here, state.speed, gas_), options_.kind);
        const double momentum = state.layer.momentum;
        const double mass = options_.layers * density_at(here, state.speed, gas_) * state.speed;
        const double flux = mass * momentum * layer.shape;
        const double x = momentum *
                         (known + (answer_b_ - answer_a_) / length * flux + c * mass * layer.displaced_flux.steady) /
                         (state.speed - c * mass * momentum * layer.displaced_flux.per_acceleration);
        return {{layer.momentum.at(x), layer.transformed.at(x), layer.entrainment.at(x)}, state.speed * x / momentum};
    }

    const Station &a_, &b_;
    const OuterGas& gas_;
    const MarchOptions& options_;
    double answer_a_, answer_b_;
};

StationLayer layer_at(const Station& station, const State& state, const OuterGas& gas, const MarchOptions& options) {
    const LayerEdge edge = edge_of(station, state.speed, gas);
    const LayerRates rates = layer_rates(state.layer, edge, options.kind);
    const double density = density_at(station, state.speed, gas);
    return {state.layer,
            state.speed,
            density,
            edge.mach,
            rates.shape,
            rates.friction,
            options.layers * density * state.speed * state.layer.momentum * rates.shape};
}

double first_speed(const Station& station, const ShearLayer& layer, const OuterGas& gas, const MarchOptions& options) {
    if (options.first_speed > 0) return options.first_speed;
    const double flux = layer_at(station, {layer, station.speed}, gas, options).displaced;
    return std::max(station.speed + answer(station, gas, options.answer_length) * (flux - station.displaced),
                    least_speed);
}

}  // namespace

LayerEdge edge_of(const Station& station, double speed, const OuterGas& gas) {
    const double t = temperature(gas, speed);
    return {speed / std::sqrt(t), density_at(station, speed, gas) * speed / viscosity(gas, t)};
}

std::vector<StationLayer> march(std::span<const Station> stations, const ShearLayer& first, const OuterGas& gas,
                                const MarchOptions& options) {
    std::vector<StationLayer> layers;
    if (stations.empty()) return layers;
    State state{limited(first), first_speed(stations[0], first, gas, options)};
    layers.push_back(layer_at(stations[0], state, gas, options));
    for (std::size_t i = 1; i < stations.size(); ++i) {
        state = Interval(stations[i - 1], stations[i], gas, options).lead(state);
        layers.push_back(layer_at(stations[i], state, gas, options));
    }
    return layers;
}

}  // namespace lamina::flow::euler
