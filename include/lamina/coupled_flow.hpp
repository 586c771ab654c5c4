// The flow round one section and its boundary layers solved together: lift, drag and moment before there is a mesh.
//
// Guarantees:
//  1. Layers and outer flow agree where CoupledFlow::converged; where they do not, the flow is that of solve_flow().
//  2. The same input gives the same bits on any number of threads.
// Limits:
//  1. One section alone, without walls, in incompressible flow. Behind stall, wakes are too narrow, and lift is too large.
// Example:
//     const Geometry section = make_geometry({naca_airfoil("0012", 200)});
//     const std::vector<FlowConditions> conditions{{.alpha_deg = 4, .reynolds = 1e6}};
//     assert(can_be_coupled(section, reference_conditions(conditions[0], section)));
//     const CoupledFlow found = solve_coupled_flow(section, conditions).front();
//     assert(found.converged && found.forces.lift > 0.41 && found.forces.lift < 0.45);
//     assert(found.forces.drag > 0.006 && found.forces.drag < 0.008 && found.transition_upper < found.transition_lower);
//
// Source: M. Drela, M. B. Giles, AIAA J. 25 (1987), 1347-1355; M. Drela, XFOIL, in Low Reynolds Number Aerodynamics (1989).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/flow.hpp>

namespace lamina {

/// The options that decide where layers become turbulent.
struct TransitionOptions {
    double critical_exponent = 9;  ///< of the most amplified wave at which a layer becomes turbulent, N
    /// The place where the layers are turbulent at the latest, as a share of the section's extent in x.
    std::optional<double> trip{};
    std::optional<double> trip_lower{};                         ///< the same on the lower side; empty: `trip`
    bool operator==(const TransitionOptions&) const = default;  ///< whether all are equal
};

/// Throws OptionError for an option out of range.
LAMINA_EXPORT void validate(const TransitionOptions& options);

/// The flow with boundary layers that displace it.
struct CoupledFlow {
    Flow flow;  ///< speeds, pressures and layers at the nodes of the panels; Flow::panels are those of potential flow
    FlowForces forces;            ///< drag after Squire and Young at the end of the wake
    double transition_upper = 1;  ///< where the layer becomes turbulent, as a share of the section's extent in x
    double transition_lower = 1;  ///< the same on the lower side
    bool converged = false;       ///< whether layers and flow agree
    int steps = 0;                ///< of Newton's method
};

/// Returns whether layers displace the flow of these bodies: one section without walls, at a Reynolds number at which its
/// layers do not stay laminar throughout, 1e4 or more.
LAMINA_EXPORT bool can_be_coupled(const Geometry& geometry, const ReferenceConditions& reference,
                                  const FlowWalls& walls = {});

/// Returns the flow round one section at each of the conditions. Layers follow the equations of momentum, kinetic energy and
/// lag of the shear stress, waves grow along the envelope of those of all frequencies, and the wake is one chord long. A flow
/// that is not found from layers without displacement begins with the last one found. Preconditions: can_be_coupled() at each
/// of the conditions, and all have the same chord. Throws OptionError for conditions or options out of range.
LAMINA_EXPORT std::vector<CoupledFlow> solve_coupled_flow(const Geometry& geometry,
                                                          std::span<const FlowConditions> conditions,
                                                          const TransitionOptions& transition = {});

}  // namespace lamina
