// Fluxes through a face between two states, and their derivatives with respect to conserved quantities. All normals
// point from the first state to the second, and are as long as the face.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flow/euler/gas.hpp"

namespace lamina::flow::euler {

/// A matrix of 4 x 4 numbers by rows.
using Matrix4 = std::array<double, 16>;

/// The averages of P. L. Roe, J. Comput. Phys. 43 (1981).
struct RoeAverage {
    Point velocity;
    double enthalpy, sound_speed;
};

inline RoeAverage roe_average(const Four& left, const Four& right) {
    const double weight = std::sqrt(right[0] / left[0]), share = 1 / (1 + weight);
    const Point mean = share * (velocity(left) + weight * velocity(right));
    const double enthalpy = (total_enthalpy(left) + weight * total_enthalpy(right)) * share;
    const double squared = (heat_ratio - 1) * (enthalpy - 0.5 * squared_length(mean));
    return {mean, enthalpy, std::sqrt(std::max(squared, 1e-12))};
}

/// Returns the flux of the approximate Riemann solver HLLC, with the wave speeds of Einfeldt.
/// Source: E. F. Toro, M. Spruce, W. Speares, Shock Waves 4 (1994); B. Einfeldt, SIAM J. Numer. Anal. 25 (1988).
inline Four hllc_flux(const Four& left, const Four& right, Point normal) {
    const double area = length(normal);
    const Point n = (1 / area) * normal;
    const double ul = dot(velocity(left), n), ur = dot(velocity(right), n);
    const RoeAverage roe = roe_average(left, right);
    const double un = dot(roe.velocity, n);
    const double slowest = std::min(ul - sound_speed(left), un - roe.sound_speed),
                 fastest = std::max(ur + sound_speed(right), un + roe.sound_speed);
    if (slowest >= 0) return flux_of(left, normal);
    if (fastest <= 0) return flux_of(right, normal);
    const double fl = left[0] * (slowest - ul), fr = right[0] * (fastest - ur);
    const double contact = (right[3] - left[3] + fl * ul - fr * ur) / (fl - fr);
    const bool of_left = contact >= 0;
    const Four& side = of_left ? left : right;
    const double wave = of_left ? slowest : fastest, u = of_left ? ul : ur;
    const double density = side[0] * (wave - u) / (wave - contact);
    const double star_energy =
        density * (energy(side) / side[0] + (contact - u) * (contact + side[3] / (side[0] * (wave - u))));
    const Four star{density, density * (side[1] + (contact - u) * n.x), density * (side[2] + (contact - u) * n.y),
                    star_energy};
    return area * (flux_of(side, n) + wave * (star - conserved_of(side)));
}

/// Returns the derivative of flux_of().
inline Matrix4 flux_jacobian(const Four& state, Point normal) {
    constexpr double g1 = heat_ratio - 1;
    const double u = state[1], v = state[2], nx = normal.x, ny = normal.y, un = u * nx + v * ny;
    const double phi = 0.5 * g1 * (u * u + v * v), h = total_enthalpy(state);
    return {0,
            nx,
            ny,
            0,
            phi * nx - u * un,
            un + (2 - heat_ratio) * u * nx,
            u * ny - g1 * v * nx,
            g1 * nx,
            phi * ny - v * un,
            v * nx - g1 * u * ny,
            un + (2 - heat_ratio) * v * ny,
            g1 * ny,
            un * (phi - h),
            h * nx - g1 * u * un,
            h * ny - g1 * v * un,
            heat_ratio * un};
}

/// Returns the absolute value of the Jacobian at Roe's average. Eigenvalues near 0 are rounded off.
/// Source: A. Harten, J. Comput. Phys. 49 (1983).
inline Matrix4 absolute_jacobian(const Four& left, const Four& right, Point normal) {
    constexpr double g1 = heat_ratio - 1, rounded_share = 0.1;
    const double area = length(normal);
    const Point n = (1 / area) * normal;
    const RoeAverage roe = roe_average(left, right);
    const double u = roe.velocity.x, v = roe.velocity.y, a = roe.sound_speed, un = dot(roe.velocity, n);
    const double least = rounded_share * (std::abs(un) + a);
    const auto rounded = [&](double x) { return x < least ? 0.5 * (x * x / least + least) : x; };
    const double convected = rounded(std::abs(un)), up = rounded(std::abs(un + a)), down = rounded(std::abs(un - a));
    const double c1 = 0.5 * (up + down) - convected, c2 = 0.5 * (up - down);
    const Four of_pressure{0.5 * g1 * (u * u + v * v), -g1 * u, -g1 * v, g1}, of_velocity{-un, n.x, n.y, 0};
    const Four e1{1, u, v, roe.enthalpy}, e2{0, n.x, n.y, un};
    Matrix4 m;
    for (std::size_t j = 0; j < 4; ++j) {
        const double s1 = area * (c1 * of_pressure[j] / (a * a) + c2 * of_velocity[j] / a),
                     s2 = area * (c1 * of_velocity[j] + c2 * of_pressure[j] / a);
        for (std::size_t i = 0; i < 4; ++i) m[4 * i + j] = s1 * e1[i] + s2 * e2[i];
    }
    for (std::size_t i = 0; i < 4; ++i) m[5 * i] += area * convected;
    return m;
}

}  // namespace lamina::flow::euler
