#include "flow/euler/lag_entrainment.hpp"

#include <algorithm>
#include <cmath>

#include "core/reproducible_math.hpp"

namespace lamina::flow::euler {

namespace {

/// The friction and the shape factor of a plate.
struct Plate {
    double friction, shape;
};

Plate plate_of(double reynolds, double mach2) {
    constexpr double decades = 1 / 2.302585092994046, least_reynolds = 150;
    const double compressed = std::max((1 + 0.056 * mach2) * reynolds, least_reynolds);
    const double logarithm = decades * core::log_reproducible(compressed);
    const double friction = (0.01013 / (logarithm - 1.02) - 0.00075) / std::sqrt(1 + 0.2 * mach2);
    return {friction, 1 / (1 - 6.55 * std::sqrt(0.5 * friction * (1 + 0.04 * mach2)))};
}

/// Returns the shear stress coefficient of a layer with this entrainment.
double shear_stress(double entrainment, double plate_friction, double mach2) {
    return std::max((0.024 * entrainment + 1.2 * entrainment * entrainment + 0.32 * plate_friction) * (1 + 0.1 * mach2),
                    0.0);
}

}  // namespace

double compressible_shape(double shape, double mach) {
    return (shape + 1) * (1 + 0.2 * recovery_factor * mach * mach) - 1;
}

LayerRates layer_rates(const ShearLayer& layer, const LayerEdge& edge, LayerKind kind) {
    const bool wall = kind == LayerKind::wall;
    const double mach2 = edge.mach * edge.mach, heated = 1 + 0.2 * recovery_factor * mach2, cooled = 1 + 0.2 * mach2;
    const double t = layer.shape - 1, ce = layer.entrainment;  // t > 0
    const Plate plate = wall ? plate_of(edge.unit_reynolds * layer.momentum, mach2) : Plate{0, 1};
    const double h = compressible_shape(layer.shape, edge.mach);
    const double h1 = 3.15 + 1.72 / t - 0.01 * t * t, slope = -t * t / (1.72 + 0.02 * t * t * t);
    const double friction = wall ? plate.friction * (0.9 / (layer.shape / plate.shape - 0.4) - 0.5) : 0.0;

    // Equilibrium without and with the secondary effects of a wake, whose eddies are twice as large.
    const double lambda = wall ? 1.0 : 0.5;
    const double c0 = t / (6.432 * layer.shape);
    const double acceleration0 = 1.25 / h * (0.5 * friction - c0 * c0 / (1 + 0.04 * mach2));
    const double entrainment0 = h1 * (0.5 * friction - (h + 1) * acceleration0);
    const double stress0 = shear_stress(entrainment0, plate.friction, mach2);
    const double c = stress0 / ((1 + 0.1 * mach2) * lambda * lambda) - 0.32 * plate.friction;
    const double entrainment_eq = std::sqrt(std::max(c / 1.2 + 0.0001, 0.0)) - 0.01;
    const double acceleration_eq = (0.5 * friction - entrainment_eq / h1) / (h + 1);
    const double lag = (0.02 * ce + ce * ce + 0.8 / 3 * plate.friction) / (0.01 + ce);

    const double stress = shear_stress(ce, plate.friction, mach2);
    const double way = 1 / layer.momentum;
    LayerRates rates;
    rates.shape = h;
    rates.friction = friction;
    rates.momentum = {0.5 * friction, -(h + 2 - mach2)};
    rates.transformed = {way * slope * (ce - 0.5 * h1 * friction), way * slope * h1 * (h + 1)};
    rates.entrainment = {
        way * lag * (2.8 / (h + h1) * (std::sqrt(stress0) - lambda * std::sqrt(stress)) + acceleration_eq),
        -way * lag * (1 + 0.075 * mach2 * cooled / (1 + 0.1 * mach2))};
    // d(density x speed x momentum x h) / (density x speed), with dM = M (1 + 0.2 M^2) d(speed) / speed.
    rates.displaced_flux = {layer.momentum * heated * rates.transformed.steady + h * rates.momentum.steady,
                            layer.momentum * heated * rates.transformed.per_acceleration +
                                0.4 * recovery_factor * (layer.shape + 1) * mach2 * cooled +
                                h * (rates.momentum.per_acceleration + 1 - mach2)};
    return rates;
}

ShearLayer plate_layer(double momentum, const LayerEdge& edge) {
    const double mach2 = edge.mach * edge.mach;
    const Plate plate = plate_of(edge.unit_reynolds * momentum, mach2);
    const double t = plate.shape - 1;
    // The shape stays where what enters is what the growth of the layer wants.
    return limited({momentum, plate.shape, 0.5 * plate.friction * (3.15 + 1.72 / t - 0.01 * t * t)});
}

ShearLayer limited(ShearLayer layer) {
    constexpr double least_shape = 1.05, largest_shape = 6, least_entrainment = -0.005, largest_entrainment = 0.3;
    layer.shape = std::clamp(layer.shape, least_shape, largest_shape);
    layer.entrainment = std::clamp(layer.entrainment, least_entrainment, largest_entrainment);
    return layer;
}

}  // namespace lamina::flow::euler
