// Closures of the two-equation integral boundary layer: what follows from momentum thickness, displacement thickness
// and edge speed.
// Source: M. Drela, M. B. Giles, Viscous-inviscid analysis of transonic and low Reynolds number airfoils, AIAA J. 25
// (1987), 1347-1355; M. Drela, XFOIL: an analysis and design system for low Reynolds number airfoils, in Low Reynolds
// Number Aerodynamics (1989), Lecture Notes in Engineering 54.
#pragma once

#include <lamina/export.hpp>

#include "flow/coupled/dual.hpp"

namespace lamina::flow::coupled {

/// The state of a stretch of a layer.
enum class Regime {
    laminar,    ///< along a wall
    turbulent,  ///< along a wall
    wake,       ///< turbulent, both halves together
};

/// What equations of a layer take from one station. Lengths are in chords, speeds over that of the free stream.
struct Closure {
    Dual shape;         ///< displacement over momentum thickness, H
    Dual reynolds;      ///< of the momentum thickness
    Dual energy_shape;  ///< kinetic energy thickness over momentum thickness, H*
    Dual friction;      ///< skin friction over the dynamic pressure at the edge, C_f
    Dual dissipation;   ///< 2 C_D / H*
    Dual slip;          ///< speed at which the outer layer slides, over that at the edge, U_s
    Dual thickness;     ///< of the layer, delta
    Dual equilibrium;   ///< root of the shear stress coefficient in equilibrium
};

/// Returns the closure of a layer. `shear` is the root of its largest shear stress coefficient; laminar layers have
/// none.
Closure close_layer(const Dual& shear, const Dual& momentum, const Dual& displacement, const Dual& speed,
                    double viscosity, Regime regime);

/// Returns the skin friction over the dynamic pressure at the edge.
LAMINA_EXPORT Dual skin_friction(const Dual& shape, const Dual& reynolds, Regime regime);

/// Returns the root of the shear stress coefficient with which a layer becomes turbulent, over that in equilibrium.
Dual shear_at_transition(const Dual& shape);

/// Returns by how much the exponent of the most amplified wave grows per unit of length, by the envelope of Drela and
/// Giles (1987), eqs. (28) to (31), smoothed where waves begin to grow. Numbers are
/// doubles, or Duals.
template <class Number>
Number amplification_rate(const Number& momentum, const Number& shape, const Number& reynolds);

/// Returns the shape factor less that of a layer without friction at infinite Reynolds number: what the shear stress in
/// equilibrium grows with.
Dual shape_of_shear(const Dual& shape, const Dual& reynolds, Regime regime);

/// Constants of the locus of equilibrium, G = a sqrt(1 + b beta).
inline constexpr double locus_a = 6.7, locus_b = 0.75;

}  // namespace lamina::flow::coupled
