// Turbulent boundary layers and wakes of compressible flow by the lag-entrainment method: three ordinary differential
// equations, for the momentum thickness, the shape factor and the entrainment. The third one lets the turbulence lag
// behind changes of the pressure, as it does at shocks.
// Source: J. E. Green, D. J. Weeks, J. W. F. Brooman, Prediction of turbulent boundary layers and wakes in compressible
// flow by a lag-entrainment method, ARC R&M 3791 (1973).
#pragma once

namespace lamina::flow::euler {

/// Ratio of the temperature that a wall without heat flux has above that of the edge to that of gas at rest.
inline constexpr double recovery_factor = 0.89;

/// The state of a turbulent layer.
struct ShearLayer {
    double momentum = 0;     ///< momentum thickness
    double shape = 0;        ///< shape factor of the velocity profile alone, without the change of density
    double entrainment = 0;  ///< rate at which gas enters, over that along the edge
};

/// The flow at the edge of a layer.
struct LayerEdge {
    double mach = 0;           ///< Mach number
    double unit_reynolds = 0;  ///< density x speed / viscosity
};

/// Whether a layer has a wall on one side.
enum class LayerKind {
    wall,  ///< it has one
    wake,  ///< it is half of a wake
};

/// A rate of change along the layer. It depends on how fast the edge accelerates: `steady + per_acceleration x`, where
/// x is momentum thickness x gradient of the speed / speed.
struct LayerRate {
    double steady = 0;
    double per_acceleration = 0;

    double at(double acceleration) const { return steady + per_acceleration * acceleration; }
};

/// The rates of change of a layer along its edge.
struct LayerRates {
    double shape = 0;          ///< displacement thickness over momentum thickness
    double friction = 0;       ///< wall shear stress over the dynamic pressure at the edge
    LayerRate momentum;        ///< of ShearLayer::momentum
    LayerRate transformed;     ///< of ShearLayer::shape
    LayerRate entrainment;     ///< of ShearLayer::entrainment
    LayerRate displaced_flux;  ///< of density x speed x displacement thickness, over density x speed
};

/// Returns the rates. They are finite for all layers of limited().
LayerRates layer_rates(const ShearLayer& layer, const LayerEdge& edge, LayerKind kind);

/// Returns displacement thickness over momentum thickness.
double compressible_shape(double shape, double mach);

/// Returns the layer of this momentum thickness that stays in equilibrium on a plate.
ShearLayer plate_layer(double momentum, const LayerEdge& edge);

/// Returns the layer with numbers that the closures are made for.
ShearLayer limited(ShearLayer layer);

}  // namespace lamina::flow::euler
