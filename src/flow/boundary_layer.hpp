// The boundary layer of incompressible flow along one side of a body, by integral methods: from the speed at its edge
// to its thicknesses and the skin friction. It serves to choose the heights of a mesh, so it returns finite numbers for
// whatever speeds it is given.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/flow.hpp>

namespace lamina::flow {

/// A point of the edge of a boundary layer.
struct EdgePoint {
    double s;      ///< arc length from the stagnation point, or from the leading edge of a plate
    double speed;  ///< speed at the edge over that of the free stream, >= 0
};

/// The boundary layer at one point. Lengths have the unit of EdgePoint::s.
struct LayerPoint {
    double momentum = 0;       ///< momentum thickness
    double displacement = 0;   ///< displacement thickness
    double thickness = 0;      ///< distance from the wall at which 0.99 of the edge speed is reached
    double shape = 0;          ///< shape factor: displacement thickness over momentum thickness
    double skin_friction = 0;  ///< shear stress at the wall over the dynamic pressure of the free stream
    BoundaryLayerState state = BoundaryLayerState::laminar;  ///< as it is at the point
};

/// The shape factor at which the turbulent layer separates. It rises so fast there that any value from 1.8 to 2.4 gives
/// nearly the same place (Cebeci, Bradshaw). The last one lets layers live on that recover.
inline constexpr double separation_shape = 2.4;

struct BoundaryLayerOptions {
    /// Kinematic viscosity over the speed of the free stream, a length in the unit of EdgePoint::s: the inverse of the
    /// Reynolds number of one unit. It is > 0.
    double viscosity = 1e-6;
    /// The place of a trip, which makes the layer turbulent if it can be there (sustaining_reynolds). Without a
    /// value the layer is turbulent as soon as it can be, as it is where a Reynolds-averaged computation has no model
    /// of transition. A value beyond the last point leaves the layer laminar until it separates.
    std::optional<double> transition{};
    /// Whether the layer can be turbulent at all. One that cannot separates where its laminar solution
    /// does, and does not reattach.
    bool turbulent = true;
};

/// The smallest Reynolds number, made with momentum thickness and edge speed, at which a boundary layer becomes
/// turbulent. It is the limit of stability of the laminar plate, below which no disturbance of the free stream has been
/// seen to cause transition (B. J. Abu-Ghannam, R. Shaw, J. Mech. Eng. Sci. 22 (1980), 213-228).
inline constexpr double sustaining_reynolds = 163;

/// Returns the boundary layer at each of the points, whose s ascends from 0. A first speed of 0 is a stagnation point,
/// a larger one the leading edge of a plate. At the latter, where the skin friction is infinite, its mean up to the
/// second point is returned.
///
/// The layer is laminar first (Thwaites 1949) and becomes turbulent (Head 1958) where the options say, or where it
/// would separate otherwise. Once the turbulent layer separates it keeps its momentum thickness, spreads like a free
/// shear layer, and has no skin friction. It reattaches, as a turbulent layer of the same thickness, where the edge
/// speed exceeds that of separation. Points at the s of the point before repeat its layer.
LAMINA_EXPORT std::vector<LayerPoint> boundary_layer(std::span<const EdgePoint> points,
                                                     const BoundaryLayerOptions& options);

/// Returns the boundary layer of a plate in a stream of speed 1 at distance s from its leading edge: the Blasius
/// solution, or for a turbulent one the law of the 1/7 power (F. M. White, Fluid Mechanics, 5th ed. (2003), section
/// 7.4) from where the layer sustains turbulence. At s = 0 lengths and skin friction are 0.
LAMINA_EXPORT LayerPoint flat_plate(double s, double viscosity, bool turbulent);

/// Returns the thickness of the wake at a distance behind a trailing edge where two layers of the given thicknesses and
/// of the given sum of momentum thicknesses meet. The square of the thickness grows linearly from that of the sum of
/// both, as that of a self-similar plane wake does: its full width is 1.61 sqrt(distance momentum_total)
/// (H. Schlichting, Boundary-Layer Theory, 7th ed. (1979), chapter XXIV: b = 0.57 sqrt(x cd d), where cd d is twice the
/// momentum thickness).
LAMINA_EXPORT double wake_thickness(double thickness_upper, double thickness_lower, double momentum_total,
                                    double distance);

/// Returns whether flow round sections is taken for laminar: below a Reynolds number of 1e4.
inline bool is_laminar(const ReferenceConditions& conditions) {
    constexpr double laminar_reynolds = 1e4;
    return conditions.reynolds && *conditions.reynolds < laminar_reynolds;
}

}  // namespace lamina::flow
