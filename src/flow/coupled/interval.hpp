// The equations of a layer between two neighbouring stations.
// Source: M. Drela, M. B. Giles, AIAA J. 25 (1987), 1347-1355; M. Drela, XFOIL (1989), sections 3 and 4: von Karman's
// equation, the equation of the kinetic energy thickness, and the growth of waves or the lag of the shear stress.
#pragma once

#include <array>
#include <optional>

#include <lamina/export.hpp>

#include "flow/coupled/closures.hpp"

namespace lamina::flow::coupled {

/// A layer at one place. Lengths are in chords, speeds over that of the free stream.
struct Station {
    double x = 0;         ///< arc length from the stagnation point
    double shear = 0;     ///< root of the largest shear stress coefficient; of a laminar layer the exponent of waves
    double momentum = 0;  ///< momentum thickness
    double displacement = 0;  ///< displacement thickness, with `base`
    double speed = 0;         ///< at the edge
    double base = 0;          ///< width of the fluid at rest in a wake behind a base
    double shape() const { return (displacement - base) / momentum; }
};

/// What all layers of a flow have in common.
struct LayerConditions {
    double viscosity;          ///< kinematic, over speed of the free stream x chord
    double critical_exponent;  ///< of waves at which a layer becomes turbulent
};

/// The slots of derivatives: by the numbers of the first and of the second station in the order below, and by the
/// arc length of both, which changes where the stagnation point moves.
enum Slot : std::size_t { shear1, momentum1, displacement1, speed1, shear2, momentum2, displacement2, speed2, shift };

/// What an interval must make zero.
using Equations = std::array<Dual, 3>;

/// Returns the exponent of waves at the second station of a laminar interval.
double grown_exponent(const Station& a, const Station& b, const LayerConditions& conditions);

/// Returns the equations of the first station, behind a stagnation point, whose speed grows linearly.
Equations first_equations(const Station& a, const LayerConditions& conditions);
/// Returns the equations of an interval in one regime. In laminar ones the third says how waves grow.
LAMINA_EXPORT Equations interval_equations(const Station& a, const Station& b, Regime regime,
                                           const LayerConditions& conditions);
/// Returns the equations of an interval in which a laminar layer becomes turbulent: where waves reach the critical
/// exponent, or at a trip ahead of that. Precondition: one of the two lies in the interval.
LAMINA_EXPORT Equations transition_equations(const Station& a, const Station& b, std::optional<double> trip,
                                             const LayerConditions& conditions);
/// Returns where the layer becomes turbulent in such an interval.
double transition_place(const Station& a, const Station& b, std::optional<double> trip,
                        const LayerConditions& conditions);

}  // namespace lamina::flow::coupled
