// Turbulent layers that are led along a flow without friction and push it away while it answers: where they would
// separate in the given flow they change it. Source: A. E. P. Veldman, AIAA J. 19 (1981), for solving layer and answer
// at once; J. Eng. Math. 65 (2009), for an answer by the flux at the same place alone.
#pragma once

#include <span>
#include <vector>

#include "flow/euler/gas.hpp"
#include "flow/euler/lag_entrainment.hpp"

namespace lamina::flow::euler {

/// The gas outside of layers.
struct OuterGas {
    double total_enthalpy;
    double viscosity;  ///< that of the free stream
};

/// A place along a layer: the flow without friction there, and the flux that the layer displaced when it was found.
struct Station {
    double s;               ///< arc length
    double speed, density;  ///< of the flow without friction
    double displaced;       ///< density x speed x displacement thickness
};

/// A layer at one station.
struct StationLayer {
    ShearLayer layer;      ///< the state
    double speed = 0;      ///< at its edge
    double density = 0;    ///< at its edge
    double mach = 0;       ///< at its edge
    double shape = 0;      ///< displacement thickness over momentum thickness
    double friction = 0;   ///< wall shear stress over the dynamic pressure at the edge
    double displaced = 0;  ///< density x speed x displacement thickness
};

/// How a layer is led.
struct MarchOptions {
    LayerKind kind = LayerKind::wall;
    /// Number of layers of this state beside each other: 1 at a wall, 2 for both halves of a wake.
    double layers = 1;
    /// Length of the changes of the displaced flux for which the flow answers as the law says; 0 where it does not
    /// answer.
    double answer_length = 0;
    /// Speed at the first station; 0: as the law says.
    double first_speed = 0;
};

/// Leads a layer from the first station to the last one. The speed at its edge is
///
///     u = speed + c (flux - displaced),      c = 1 / (pi answer_length density sqrt(|1 - M^2|)),
///
/// which is what thin bodies do to flow of Mach number M. Once layer and flow agree, flux and `displaced` are equal,
/// and c is without effect. Returns one layer per station; all numbers are finite.
std::vector<StationLayer> march(std::span<const Station> stations, const ShearLayer& first, const OuterGas& gas,
                                const MarchOptions& options);

/// Returns the flow at the edge of a layer where flow without friction of the same entropy has another speed.
LayerEdge edge_of(const Station& station, double speed, const OuterGas& gas);

}  // namespace lamina::flow::euler
