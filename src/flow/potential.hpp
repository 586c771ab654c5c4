// Functions of potential flow for other stages, and the limits beyond which it counts as a failure.
#pragma once

#include <lamina/export.hpp>
#include <lamina/flow.hpp>

namespace lamina::flow {

/// Returns the flow along the same walls in which all elements have this share of their lift, as viscous flow has less
/// than potential flow. Only the panels differ: the means of sheets with and without lift, weighted by the share, since
/// potential flows may be added. With another share than 1 the flow turns round trailing edges.
LAMINA_EXPORT Flow with_share_of_lift(Flow flow, double share);

/// Faster flow, as a multiple of the free stream's speed, is taken for a failure of the panel method.
inline constexpr double max_flow_speed = 100;

/// So is a larger velocity through the panels of an element, as the median over their middles and a multiple of the
/// free stream's speed.
inline constexpr double max_flow_leak = 0.02;

/// At the corners of a base walls have this many times the skin friction of the boundary layer. Solutions on CRM-HL
/// have 3.8 to 3.9 times as much. With less y+ is 1.1 times the request at one edge, and layers are not finer than that
/// needs (docs/decisions/0036).
inline constexpr double friction_rise_at_corners = 3.2;

/// Returns the momentum thickness far behind a side, by Squire and Young. It follows from the last place where the
/// layer is attached: at the trailing edge itself the speed of potential flow falls to rest, which that of viscous flow
/// does not.
LAMINA_EXPORT double momentum_far_behind(const std::vector<FlowPoint>& side);

/// Returns the pressure coefficient of subsonic flow of this Mach number where incompressible flow has
/// `incompressible`, or minus infinity where the formula has none. Precondition: 0 <= mach < 1.
/// Source: T. von Karman, J. Aeronaut. Sci. 8 (1941), after H. S. Tsien.
LAMINA_EXPORT double compressed_pressure_coefficient(double incompressible, double mach);

/// Returns the length of all walls, in chords, along which flow of a Mach number is expected to be faster than sound
/// by compressed_pressure_coefficient(). Precondition: 0 < mach < 1.
double supersonic_length(const Flow& flow, double mach);

}  // namespace lamina::flow
