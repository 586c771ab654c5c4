#include "flow/euler/residual.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/reproducible_math.hpp"
#include "flow/euler/flux.hpp"

namespace lamina::flow::euler {

namespace {

void compute_gradients(const DualMesh& mesh, std::span<const Four> states,
                       std::vector<std::array<Four, 2>>& gradients) {
    gradients.assign(mesh.points.size(), {});
    for (const DualEdge& e : mesh.edges) {
        const Point d = mesh.points[e.j] - mesh.points[e.i];
        const Point weighted = (1 / squared_length(d)) * d;
        for (std::size_t m = 0; m < 4; ++m) {
            const double change = states[e.j][m] - states[e.i][m];
            gradients[e.i][0][m] += weighted.x * change;
            gradients[e.i][1][m] += weighted.y * change;
            gradients[e.j][0][m] += weighted.x * change;
            gradients[e.j][1][m] += weighted.y * change;
        }
    }
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
        const auto& [xx, xy, yy] = mesh.gradient_inverses[v];
        auto& [dx, dy] = gradients[v];
        for (std::size_t m = 0; m < 4; ++m) {
            const double x = dx[m], y = dy[m];
            dx[m] = xx * x + xy * y;
            dy[m] = xy * x + yy * y;
        }
    }
}

/// Returns the mean of two changes along an edge that van Albada's limiter takes, 0 where they have opposite signs.
/// Changes much below the root of `threshold` are not limited.
double limited_mean(double ahead, double across, double threshold) {
    const double a2 = ahead * ahead, c2 = across * across;
    const double mean = ((a2 + threshold) * across + (c2 + threshold) * ahead) / (a2 + c2 + 2 * threshold);
    return across > 0 ? std::max(mean, 0.0) : std::min(mean, 0.0);
}

/// Returns the state at the middle of an edge, seen from the end that has this state and gradient. `across` is the
/// change to the other end, which is `d` away.
Four reconstructed(const Four& state, const std::array<Four, 2>& gradient, const Four& across, Point d,
                   double threshold) {
    constexpr double least = 0.02;  // of the free stream's density, and as a pressure
    Four result;
    for (std::size_t m = 0; m < 4; ++m) {
        const double along = gradient[0][m] * d.x + gradient[1][m] * d.y;
        result[m] = state[m] + 0.5 * limited_mean(2 * along - across[m], across[m], threshold);
    }
    return result[0] > least && result[3] > least ? result : state;
}

void add_inner_fluxes(const DualMesh& mesh, std::span<const Four> states, int order, ResidualMemory& memory,
                      std::vector<Four>& sums) {
    constexpr double threshold_factor = 1e-4;
    if (order == 2) compute_gradients(mesh, states, memory.gradients);
    for (const DualEdge& e : mesh.edges) {
        Four left = states[e.i], right = states[e.j];
        if (order == 2) {
            const Point d = mesh.points[e.j] - mesh.points[e.i];
            const double threshold = threshold_factor * squared_length(d);
            const Four across = right - left;
            left = reconstructed(left, memory.gradients[e.i], across, d, threshold);
            right = reconstructed(right, memory.gradients[e.j], -1 * across, -d, threshold);
        }
        const Four flux = hllc_flux(left, right, e.normal);
        sums[e.i] = sums[e.i] + flux;
        sums[e.j] = sums[e.j] - flux;
    }
}

/// Returns the flux out of half an edge of a base.
Four base_flux(const Four& state, const Four& free_stream, Point normal) {
    constexpr double speed_share = 0.8, least_temperature = 0.2;
    const double speed = speed_share * length(velocity(free_stream));
    const double temperature =
        std::max((heat_ratio - 1) * (total_enthalpy(free_stream) - 0.5 * speed * speed), least_temperature);
    const Point v = -(speed / length(normal)) * normal;
    return flux_of({heat_ratio * state[3] / temperature, v.x, v.y, state[3]}, normal);
}

void add_boundary_fluxes(const DualMesh& mesh, std::span<const Four> states, const FarFlow& far,
                         std::vector<Four>& sums) {
    for (const BoundaryEdge& e : mesh.boundary) {
        const Point normal = 0.5 * e.normal;
        for (const auto& [v, other] : {std::array{e.a, e.b}, std::array{e.b, e.a}}) {
            Four flux{};
            if (e.kind == BoundaryKind::wall) {
                const double pressure = (5 * states[v][3] + states[other][3]) / 6;
                flux = {0, pressure * normal.x, pressure * normal.y, 0};
            } else if (e.kind == BoundaryKind::base) {
                flux = base_flux(states[v], far.free_stream, normal);
            } else {
                flux = hllc_flux(states[v], far_state(far, mesh.points[v]), normal);
            }
            sums[v] = sums[v] + flux;
        }
    }
}

}  // namespace

Four far_state(const FarFlow& far, Point at) {
    const Point stream = velocity(far.free_stream);
    const double speed2 = squared_length(stream);
    if (speed2 >= 1 || far.lift == 0) return far.free_stream;
    const Point d = at - far.vortex;
    const double r2 = squared_length(d), across = cross(stream, d);
    const double b2 = 1 - speed2;
    // The circulation is lift x speed / 2. Distances across the stream count less the faster it is.
    const double strength = far.lift * std::sqrt(speed2 * b2) / (4 * core::pi * (r2 - across * across));
    const Point v = stream + strength * Point{d.y, -d.x};
    const double a2 = (heat_ratio - 1) * (total_enthalpy(far.free_stream) - 0.5 * squared_length(v));
    const double density = a2 * a2 * std::sqrt(a2);
    return {density, v.x, v.y, density * a2 / heat_ratio};
}

void residual(const DualMesh& mesh, std::span<const Four> states, const FarFlow& far, int order, ResidualMemory& memory,
              std::vector<Four>& sums) {
    sums.assign(mesh.points.size(), Four{});
    add_inner_fluxes(mesh, states, order, memory, sums);
    add_boundary_fluxes(mesh, states, far, sums);
}

void wave_sums(const DualMesh& mesh, std::span<const Four> states, std::vector<double>& sums) {
    sums.assign(mesh.points.size(), 0);
    for (const DualEdge& e : mesh.edges) {
        const Four &l = states[e.i], &r = states[e.j];
        const Point v = 0.5 * (velocity(l) + velocity(r));
        const double sound = std::sqrt(heat_ratio * (l[3] + r[3]) / (l[0] + r[0]));
        const double wave = std::abs(dot(v, e.normal)) + sound * length(e.normal);
        sums[e.i] += wave;
        sums[e.j] += wave;
    }
    for (const BoundaryEdge& e : mesh.boundary)
        for (const std::uint32_t v : {e.a, e.b})
            sums[v] += 0.5 * (sound_speed(states[v]) * length(e.normal) + std::abs(dot(velocity(states[v]), e.normal)));
}

}  // namespace lamina::flow::euler
