// The flow round bodies and their boundary layers solved together: lift, drag and moment before there is a mesh.
//
// Guarantees:
//  1. Layers and outer flow agree where CoupledFlow::converged; where they do not, the flow is that of solve_flow().
//  2. The same input gives the same bits on any number of threads.
// Limits:
//  1. Incompressible flow of at most five elements outside of rows of blades. Behind stall, wakes are too narrow, and
//     lift is too large. Layers do not merge in slots.
//  2. One angle takes 20 ms for one element, 0.2 to 0.5 s for two and more, and several times as long where it is reached
//     in steps from another angle, or not found.
// Example:
//     const Geometry section = make_geometry({naca_airfoil("0012", 200)});
//     const std::vector<FlowConditions> conditions{{.alpha_deg = 4, .reynolds = 1e6}};
//     assert(can_be_coupled(section, reference_conditions(conditions[0], section)));
//     const CoupledFlow found = solve_coupled_flow(section, conditions).front();
//     assert(found.converged && found.forces.lift > 0.41 && found.forces.lift < 0.45);
//     assert(found.forces.drag > 0.006 && found.forces.drag < 0.008);
//     assert(found.transitions[0].upper < found.transitions[0].lower);
//
// Source: M. Drela, M. B. Giles, AIAA J. 25 (1987), 1347-1355; M. Drela, XFOIL, in Low Reynolds Number Aerodynamics
// (1989); M. Drela, AIAA paper 90-1470 (1990), for several elements and coves.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/flow.hpp>

namespace lamina {

/// The options that decide where layers become turbulent.
struct TransitionOptions {
    double critical_exponent = 9;  ///< of the most amplified wave at which a layer becomes turbulent, N
    /// The place where the layers are turbulent at the latest, as a share of each element's extent in x.
    std::optional<double> trip{};
    std::optional<double> trip_lower{};                         ///< the same on the lower side; empty: `trip`
    bool operator==(const TransitionOptions&) const = default;  ///< whether all are equal
};

/// Throws OptionError for an option out of range.
LAMINA_EXPORT void validate(const TransitionOptions& options);

/// The places where the layers of an element become turbulent, as shares of its extent in x.
struct TransitionPlaces {
    double upper = 1;  ///< on the upper side; 1 where they stay laminar
    double lower = 1;  ///< on the lower side
};

/// The flow with boundary layers that displace it.
struct CoupledFlow {
    /// Speeds, pressures and layers at the nodes of the panels; the lift of pressures. Flow::panels are of potential
    /// flow.
    Flow flow;
    FlowForces forces;                            ///< drag after Squire and Young at the ends of the wakes
    std::vector<TransitionPlaces> transitions{};  ///< per element, where layers and flow agree
    bool converged = false;                       ///< whether they agree
    int steps = 0;                                ///< of Newton's method
};

/// Returns whether layers displace the flow: of at most five elements outside of rows of blades, at Reynolds numbers at
/// which layers do not stay laminar throughout, 1e4 or more.
LAMINA_EXPORT bool can_be_coupled(const Geometry& geometry, const ReferenceConditions& reference,
                                  const FlowWalls& walls = {});

/// Returns the flow between walls at each of the conditions. Layers follow the equations of momentum, kinetic energy
/// and lag of the shear stress, waves grow along the envelope of those of all frequencies, and wakes end one chord
/// behind the rearmost trailing edge. Walls of coves are faired: points there are not on them. A flow that is not found
/// from layers without displacement is reached in steps from the last one found. Preconditions: can_be_coupled() at
/// each of the conditions, and all have the same chord. Throws OptionError for conditions or options out of range.
LAMINA_EXPORT std::vector<CoupledFlow> solve_coupled_flow(const Geometry& geometry,
                                                          std::span<const FlowConditions> conditions,
                                                          const TransitionOptions& transition = {},
                                                          const FlowWalls& walls = {});

}  // namespace lamina
