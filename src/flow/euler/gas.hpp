// A calorically perfect gas in the units of the solver: the free stream has the density 1 and the speed of sound 1, so
// that its pressure is 1 / 1.4 and its speed the Mach number.
#pragma once

#include <array>
#include <cmath>

#include <lamina/point.hpp>

namespace lamina::flow::euler {

inline constexpr double heat_ratio = 1.4;  ///< ratio of the specific heats of air

/// Four numbers per vertex. A state holds density, velocity in x, velocity in y and pressure; conserved quantities are
/// density, momentum in x, momentum in y and total energy, all per area; a flux is that of these four.
using Four = std::array<double, 4>;

inline Four operator+(const Four& a, const Four& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]}; }
inline Four operator-(const Four& a, const Four& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]}; }
inline Four operator*(double s, const Four& a) { return {s * a[0], s * a[1], s * a[2], s * a[3]}; }

inline Point velocity(const Four& state) { return {state[1], state[2]}; }
inline double sound_speed(const Four& state) { return std::sqrt(heat_ratio * state[3] / state[0]); }
inline double mach_number(const Four& state) { return length(velocity(state)) / sound_speed(state); }
/// Returns the total energy per area.
inline double energy(const Four& state) {
    return state[3] / (heat_ratio - 1) + 0.5 * state[0] * squared_length(velocity(state));
}
/// Returns the total enthalpy per mass.
inline double total_enthalpy(const Four& state) { return (energy(state) + state[3]) / state[0]; }

inline Four conserved_of(const Four& state) {
    return {state[0], state[0] * state[1], state[0] * state[2], energy(state)};
}

inline Four state_of(const Four& conserved) {
    const double u = conserved[1] / conserved[0], v = conserved[2] / conserved[0];
    return {conserved[0], u, v, (heat_ratio - 1) * (conserved[3] - 0.5 * conserved[0] * (u * u + v * v))};
}

/// Returns the flux through a face with this normal, whose length is that of the face.
inline Four flux_of(const Four& state, Point normal) {
    const double through = dot(velocity(state), normal);
    return {state[0] * through, state[0] * state[1] * through + state[3] * normal.x,
            state[0] * state[2] * through + state[3] * normal.y, (energy(state) + state[3]) * through};
}

}  // namespace lamina::flow::euler
