#include "flow/coupled/interval.hpp"

#include <algorithm>
#include <cmath>

namespace lamina::flow::coupled {

namespace {

/// A station whose numbers carry derivatives.
struct DualStation {
    Dual x, shear, momentum, displacement, speed;
    double base;
};

DualStation dual(const Station& s, Slot first) {
    return {variable(s.x, shift),
            variable(s.shear, first),
            variable(s.momentum, first + 1),
            variable(s.displacement, first + 2),
            variable(s.speed, first + 3),
            s.base};
}

Closure close_station(const DualStation& s, Regime regime, double viscosity) {
    return close_layer(s.shear, s.momentum, s.displacement - s.base, s.speed, viscosity, regime);
}

Dual mean(const Dual& a, const Dual& b) { return 0.5 * (a + b); }

/// Returns the weight of the second station: a half, and more where the shape factor changes fast, so that the solution
/// does not swing there.
Dual upwind_weight(const Closure& a, const Closure& b, Regime regime) {
    constexpr double largest = 15;
    const double strength = regime == Regime::wake ? 1 : 5;
    const Dual ratio = log((b.shape - 1) / (a.shape - 1));
    return 1 - 0.5 * exp(-(strength * at_most(squared(ratio), largest)) / squared(b.shape));
}

Dual weighted(const Dual& weight, const Dual& a, const Dual& b) { return a + weight * (b - a); }

/// The lag of the shear stress behind its equilibrium.
Dual lag_equation(const DualStation& p, const DualStation& q, const Closure& a, const Closure& b, const Dual& weight,
                  Regime regime) {
    constexpr double lag = 5.6;
    const double stretch = regime == Regime::wake ? 0.9 : 1;  // of the dissipation length
    const Dual way = q.x - p.x;
    const Dual shear = weighted(weight, p.shear, q.shear), balance = weighted(weight, a.equilibrium, b.equilibrium),
               friction = weighted(weight, a.friction, b.friction), shape = weighted(weight, a.shape, b.shape);
    const Dual thickness = mean(a.thickness, b.thickness),
               displacement = mean(p.displacement - p.base, q.displacement - q.base), slip = mean(a.slip, b.slip),
               reynolds = mean(a.reynolds, b.reynolds);
    const Dual h = shape_of_shear(shape, reynolds, regime) / (locus_a * stretch * shape);
    const Dual acceleration = (0.5 * friction - squared(h)) / (locus_b * displacement);
    const Dual rate = lag * (4.0 / 3) / (1 + slip);
    return rate * (balance - stretch * shear) * way - 2 * thickness * log(q.shear / p.shear) +
           2 * thickness * (acceleration * way - log(q.speed / p.speed));
}

/// The growth of waves.
Dual wave_equation(const DualStation& p, const DualStation& q, const Closure& a, const Closure& b) {
    const Dual rate_a = amplification_rate(p.momentum, a.shape, a.reynolds),
               rate_b = amplification_rate(q.momentum, b.shape, b.reynolds);
    const Dual mean_square = 0.5 * (squared(rate_a) + squared(rate_b));
    const Dual rate = mean_square.value > 0 ? sqrt(mean_square) : Dual(0);
    return q.shear - p.shear - rate * (q.x - p.x);
}

Equations equations(const DualStation& p, const DualStation& q, Regime regime, double viscosity) {
    const Closure a = close_station(p, regime, viscosity), b = close_station(q, regime, viscosity);
    const Dual weight = upwind_weight(a, b, regime);
    const Dual way = log(q.x / p.x), faster = log(q.speed / p.speed);
    const Dual shape = mean(a.shape, b.shape);
    const Dual base = mean(p.base / p.momentum, q.base / q.momentum);
    const Dual per_a = p.x / p.momentum, per_b = q.x / q.momentum;

    const Dual middle = skin_friction(shape, mean(a.reynolds, b.reynolds), regime);
    const Dual friction =
        0.5 * middle * mean(p.x, q.x) / mean(p.momentum, q.momentum) + 0.25 * (a.friction * per_a + b.friction * per_b);
    const Dual momentum = log(q.momentum / p.momentum) + (shape + 2 + base) * faster - 0.5 * way * friction;

    const Dual work = 0.5 * weighted(weight, a.friction * per_a, b.friction * per_b) -
                      weighted(weight, a.dissipation * per_a, b.dissipation * per_b);
    const Dual energy = log(b.energy_shape / a.energy_shape) + (1 - shape - base) * faster + way * work;

    return {regime == Regime::laminar ? wave_equation(p, q, a, b) : lag_equation(p, q, a, b, weight, regime), momentum,
            energy};
}

DualStation between(const DualStation& p, const DualStation& q, const Dual& share) {
    return {weighted(share, p.x, q.x),
            0,
            weighted(share, p.momentum, q.momentum),
            weighted(share, p.displacement, q.displacement),
            weighted(share, p.speed, q.speed),
            0};
}

/// Returns by how much the exponent of waves is above the critical one after a share of the interval.
Dual excess(const DualStation& p, const DualStation& q, const Dual& share, const LayerConditions& conditions) {
    DualStation t = between(p, q, share);
    t.shear = conditions.critical_exponent;
    return -wave_equation(p, t, close_station(p, Regime::laminar, conditions.viscosity),
                          close_station(t, Regime::laminar, conditions.viscosity));
}

/// Returns the share of the interval after which waves reach the critical exponent, by the method of Illinois (M.
/// Dowell, P. Jarratt, BIT 11 (1971)).
double critical_share(const DualStation& p, const DualStation& q, const LayerConditions& conditions) {
    constexpr int most_steps = 40;
    constexpr double tolerance = 1e-10;
    const auto value = [&](double share) { return excess(p, q, share, conditions).value; };
    double low = 0, high = 1, below = p.shear.value - conditions.critical_exponent, above = value(1);
    if (!(above > 0)) return 1;
    int last = 0;
    for (int i = 0; i < most_steps && high - low > tolerance; ++i) {
        const double share = std::clamp(low - below * (high - low) / (above - below), low, high), here = value(share);
        if (std::abs(here) < tolerance) return share;
        if (here < 0) {
            low = share;
            below = here;
            if (last < 0) above *= 0.5;
            last = -1;
        } else {
            high = share;
            above = here;
            if (last > 0) below *= 0.5;
            last = 1;
        }
    }
    return 0.5 * (low + high);
}

/// Returns the share of the interval after which the layer becomes turbulent, with its derivatives.
Dual transition_share(const DualStation& p, const DualStation& q, std::optional<double> trip,
                      const LayerConditions& conditions) {
    constexpr std::size_t slot = Dual::slots - 1;
    const bool waves = grown_exponent({p.x.value, p.shear.value, p.momentum.value, p.displacement.value, p.speed.value},
                                      {q.x.value, 0, q.momentum.value, q.displacement.value, q.speed.value},
                                      conditions) >= conditions.critical_exponent;
    const double share = waves ? critical_share(p, q, conditions) : 1.0;
    if (trip && (!waves || *trip < p.x.value + share * (q.x.value - p.x.value)))
        return at_least(at_most((variable(*trip, shift) - p.x) / (q.x - p.x), 1.0), 0.0);
    const Dual left = excess(p, q, variable(share, slot), conditions);
    if (!(left.by[slot] > 0)) return share;
    Dual result = chain(left, share, -1 / left.by[slot]);
    result.by[slot] = 0;
    return result;
}

}  // namespace

double grown_exponent(const Station& a, const Station& b, const LayerConditions& conditions) {
    const auto rate = [&](const Station& s) {
        return amplification_rate(s.momentum, std::max(s.shape(), 1.05), s.speed * s.momentum / conditions.viscosity);
    };
    const double first = rate(a), second = rate(b);
    return a.shear + std::sqrt(0.5 * (first * first + second * second)) * (b.x - a.x);
}

Equations first_equations(const Station& a, const LayerConditions& conditions) {
    const DualStation q = dual(a, shear2);
    const Closure c = close_station(q, Regime::laminar, conditions.viscosity);
    const Dual way = q.x / q.momentum;
    return {q.shear, c.shape + 2 - 0.5 * c.friction * way, 1 - c.shape + (0.5 * c.friction - c.dissipation) * way};
}

Equations interval_equations(const Station& a, const Station& b, Regime regime, const LayerConditions& conditions) {
    return equations(dual(a, shear1), dual(b, shear2), regime, conditions.viscosity);
}

Equations transition_equations(const Station& a, const Station& b, std::optional<double> trip,
                               const LayerConditions& conditions) {
    const DualStation p = dual(a, shear1), q = dual(b, shear2);
    DualStation t = between(p, q, transition_share(p, q, trip, conditions));
    // The part ahead of the place is laminar, that behind it turbulent; the equations of both are added.
    constexpr double least_part = 1e-6;  // of the interval, which is a part at all
    const bool ahead = t.x.value - a.x > least_part * (b.x - a.x), behind = b.x - t.x.value > least_part * (b.x - a.x);
    Equations sum{};
    if (ahead) sum = equations(p, t, Regime::laminar, conditions.viscosity);
    t.shear = 1;
    const Closure c = close_station(t, Regime::turbulent, conditions.viscosity);
    t.shear = c.equilibrium * shear_at_transition(c.shape);
    sum[0] = q.shear - t.shear;
    if (!behind) return sum;
    const Equations second = equations(t, q, Regime::turbulent, conditions.viscosity);
    return {second[0], sum[1] + second[1], sum[2] + second[2]};
}

double transition_place(const Station& a, const Station& b, std::optional<double> trip,
                        const LayerConditions& conditions) {
    return a.x + transition_share(dual(a, shear1), dual(b, shear2), trip, conditions).value * (b.x - a.x);
}

}  // namespace lamina::flow::coupled
