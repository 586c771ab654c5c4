#include "flow/coupled/closures.hpp"

namespace lamina::flow::coupled {

namespace {

// Laminar layers: fits to the profiles of Falkner and Skan.

Dual laminar_energy_shape(const Dual& h) {
    constexpr double least_at = 4.35, least = 1.528;
    const Dual t = h - least_at;
    if (h.value >= least_at) return 0.015 * squared(t) / h + least;
    return squared(t) * (0.0111 - 0.0278 * t) / (h + 1) + least - 0.0002 * squared(t * h);
}

Dual laminar_friction(const Dual& h, const Dual& reynolds) {
    constexpr double change = 5.5;
    if (h.value < change) {
        const Dual t = change - h;
        return (0.0727 * t * squared(t) / (h + 1) - 0.07) / reynolds;
    }
    return (0.015 * squared(1 - 1 / (h - 4.5)) - 0.07) / reynolds;
}

Dual laminar_dissipation(const Dual& h, const Dual& reynolds) {
    constexpr double change = 4;
    const Dual t = h - change;
    if (h.value < change) return (0.00205 * power(-t, 5.5) + 0.207) / reynolds;
    return (0.207 - 0.0016 * squared(t) / (1 + 0.02 * squared(t))) / reynolds;
}

Dual laminar_wake_dissipation(const Dual& h, const Dual& energy_shape, const Dual& reynolds) {
    return 2.2 * squared(1 - 1 / h) / (h * energy_shape * reynolds);
}

// Turbulent layers.

Dual turbulent_energy_shape(const Dual& h, const Dual& reynolds) {
    constexpr double least = 1.5, least_reynolds = 200, low_reynolds = 400;
    const Dual re = at_least(reynolds, least_reynolds);
    const Dual separation = reynolds.value < low_reynolds ? Dual(4) : 3 + low_reynolds / reynolds;
    if (h.value < separation.value) {
        const Dual r = (separation - h) / (separation - 1);
        return (2 - least - 4 / re) * squared(r) * 1.5 / (h + 0.5) + least + 4 / re;
    }
    const Dual logarithm = log(re), beyond = h - separation;
    const Dual slope = 0.007 * logarithm / squared(beyond + 4 / logarithm) + 0.015 / h;
    return squared(beyond) * slope + least + 4 / re;
}

/// White's friction with the term of Swafford, AIAA J. 21 (1983), for separated flow.
Dual turbulent_friction(const Dual& h, const Dual& reynolds) {
    constexpr double decades = 1 / 2.302585092994046, least_logarithm = 3;
    const Dual logarithm = decades * at_least(log(reynolds), least_logarithm);
    return 0.3 * exp(at_least(-1.33 * h, -20) - (1.74 + 0.31 * h) * log(logarithm)) +
           1.1e-4 * (tanh(4 - h * (1 / 0.875)) - 1);
}

Dual slip_speed(const Dual& h, const Dual& energy_shape, Regime regime) {
    const Dual slip = 0.5 * energy_shape * (1 - (h - 1) / (locus_b * h));
    if (regime == Regime::wake) return at_most(slip, 0.99995);
    return slip.value > 0.95 ? Dual(0.98) : slip;
}

/// Returns 2 C_D / H* of the part of a layer next to its wall. Layers of low shape factor have less of it.
Dual wall_dissipation(const Closure& c) {
    const Dual least_shape = 1 + 2.1 / log(c.reynolds);
    const Dual share = 0.5 + 0.5 * tanh((c.shape - 1) / (least_shape - 1));
    return turbulent_friction(c.shape, c.reynolds) * c.slip / c.energy_shape * share;
}

/// Returns 2 C_D / H* of the outer part: of turbulent and of laminar shear.
Dual outer_dissipation(const Dual& shear, const Closure& c) {
    const Dual deficit = 0.995 - c.slip;
    return 2 * (squared(shear) * deficit + 0.15 * squared(deficit) / c.reynolds) / c.energy_shape;
}

Dual turbulent_dissipation(const Dual& shear, const Closure& c, Regime regime) {
    const Dual outer = outer_dissipation(shear, c);
    if (regime == Regime::wake) return 2 * larger(outer, laminar_wake_dissipation(c.shape, c.energy_shape, c.reynolds));
    return larger(wall_dissipation(c) + outer, laminar_dissipation(c.shape, c.reynolds));
}

}  // namespace

Dual skin_friction(const Dual& shape, const Dual& reynolds, Regime regime) {
    if (regime == Regime::wake) return 0;
    const Dual laminar = laminar_friction(shape, reynolds);
    return regime == Regime::laminar ? laminar : larger(turbulent_friction(shape, reynolds), laminar);
}

Dual shape_of_shear(const Dual& shape, const Dual& reynolds, Regime regime) {
    constexpr double of_sublayer = 18, least = 0.01;
    if (regime == Regime::wake) return shape - 1;
    return at_least(shape - 1 - of_sublayer / reynolds, least);
}

Closure close_layer(const Dual& shear, const Dual& momentum, const Dual& displacement, const Dual& speed,
                    double viscosity, Regime regime) {
    constexpr double thickest = 12;  // in momentum thicknesses
    Closure c;
    c.shape = at_least(displacement / momentum, regime == Regime::wake ? 1.00005 : 1.05);
    c.reynolds = speed * momentum * (1 / viscosity);
    c.thickness = at_most(3.15 + 1.72 / (c.shape - 1) + c.shape, thickest) * momentum;
    c.friction = skin_friction(c.shape, c.reynolds, regime);
    if (regime == Regime::laminar) {
        c.energy_shape = laminar_energy_shape(c.shape);
        c.dissipation = laminar_dissipation(c.shape, c.reynolds);
        return c;
    }
    c.energy_shape = turbulent_energy_shape(c.shape, c.reynolds);
    c.slip = slip_speed(c.shape, c.energy_shape, regime);
    c.dissipation = turbulent_dissipation(shear, c, regime);
    constexpr double factor = 0.5 / (locus_a * locus_a * locus_b);
    const Dual h = shape_of_shear(c.shape, c.reynolds, regime);
    c.equilibrium =
        sqrt(factor * c.energy_shape * (c.shape - 1) * squared(h) / ((1 - c.slip) * c.shape * squared(c.shape)));
    return c;
}

Dual shear_at_transition(const Dual& shape) { return 1.8 * exp(-3.3 / (shape - 1)); }

template <class Number>
Number amplification_rate(const Number& momentum, const Number& shape, const Number& reynolds) {
    constexpr double decades = 1 / 2.302585092994046, ramp = 0.08;
    const Number x = 1 / (shape - 1);
    const Number critical = 2.492 * power(x, 0.43) + 0.7 * (tanh(14 * x - 9.24) + 1);
    const Number place = (decades * log(reynolds) - (critical - ramp)) / (2 * ramp);
    if (value_of(place) <= 0) return 0;
    const Number onset = value_of(place) >= 1 ? Number(1) : squared(place) * (3 - 2 * place);
    const Number rate = 0.028 * (shape - 1) - 0.0345 * exp(-squared(3.87 * x - 2.52));
    const Number m = -0.05 + 2.7 * x - 5.5 * squared(x) + 3 * x * squared(x) + 0.1 * exp(-20 * x);
    return m * rate / momentum * onset;
}
template Dual amplification_rate(const Dual& momentum, const Dual& shape, const Dual& reynolds);
template double amplification_rate(const double& momentum, const double& shape, const double& reynolds);

}  // namespace lamina::flow::coupled
