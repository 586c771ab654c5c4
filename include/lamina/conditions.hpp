// The conditions of the flow that a mesh is made for.
//
// Guarantees:
//  1. Conditions turn no body: the flow comes at the angle of attack. None of them changes the mesh by itself.
// Example:
//     const Box section{{0, -0.06}, {2, 0.06}};
//     const ReferenceConditions c = reference_conditions({.velocity = 30.0, .viscosity = 1.5e-5}, section);
//     assert(c.chord == 2 && std::abs(*c.reynolds - 4e6) < 1);
#pragma once

#include <optional>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/point.hpp>
#include <lamina/value_range.hpp>

namespace lamina {

/// The conditions as they are given.
struct FlowConditions {
    double alpha_deg = 0;              ///< angle of attack: the flow comes from the left and rises at this angle
    std::optional<double> reynolds{};  ///< Reynolds number of the free stream, based on the chord
    std::optional<double> mach{};      ///< Mach number of the free stream
    std::optional<double> chord{};     ///< reference chord in units of the input; empty: an extent in x
    std::string chord_element{};       ///< without a chord: the element whose extent in x it is; empty: of all together
    std::optional<double> velocity{};  ///< of the free stream, in units of the input per second
    std::optional<double> viscosity{};  ///< kinematic viscosity, in squared units of the input per second
    /// Angles of attack that one mesh is to serve, in degrees; alpha_deg is one of them, where a single one is needed.
    /// The option `alpha` sets both. Empty: alpha_deg alone.
    std::optional<ValueRange> alphas{};
};

/// Throws OptionError for an option out of range, and for velocity or viscosity alone or beside the Reynolds number.
LAMINA_EXPORT void validate(const FlowConditions& conditions);

/// Returns the conditions of each angle of attack, in ascending order; the given ones where there is one alone.
LAMINA_EXPORT std::vector<FlowConditions> conditions_of_angles(const FlowConditions& conditions);

/// The conditions that the stages use.
struct ReferenceConditions {
    double chord = 1;                  ///< reference chord in units of the input: what lengths in chords count
    double alpha_deg = 0;              ///< FlowConditions::alpha_deg
    std::optional<double> reynolds{};  ///< based on the chord
    std::optional<double> mach{};      ///< FlowConditions::mach
};

/// Returns the conditions of the flow round bodies in this box. The chord is the extent of the box in x unless it is
/// given. The Reynolds number is the given one, or velocity x chord / viscosity. Throws as validate() does, and
/// OptionError for a chord that is to be that of an element: reference_conditions() of geometry.hpp knows them.
LAMINA_EXPORT ReferenceConditions reference_conditions(const FlowConditions& conditions, const Box& bodies);

}  // namespace lamina
