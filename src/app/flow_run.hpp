// The flow round bodies before there is a mesh: what `lamina flow` and the Python package have in common.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <lamina/compressible_flow.hpp>
#include <lamina/coupled_flow.hpp>
#include <lamina/flow.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

/// The flow that its conditions ask for.
struct FoundFlow {
    Flow flow;          ///< incompressible flow; with a Mach number, its pressures are compressible
    FlowForces forces;  ///< of it
    std::vector<TransitionPlaces> transitions{};     ///< per element, where flow and layers were solved together
    std::optional<CompressibleFlow> compressible{};  ///< with shocks, where the flow is faster than sound
    bool has_layers = false;                         ///< whether a Reynolds number is known
    bool loose = false;  ///< whether flow and layers were to be solved together, and no solution was found
    bool is_coupled() const { return !transitions.empty(); }
};

/// Returns whether there are layers, and they do not displace the flow.
bool is_undisplaced(const FoundFlow& found);
/// What is to be said of such flows, in a line.
inline constexpr const char* undisplaced_line =
    "layers do not displace this flow: its lift is too high, by up to a fifth on the sections that were measured\n";

/// Returns the bodies as one blade of a row, where the options ask for it.
Geometry in_row(Geometry geometry, const CaseOptions& options);

/// Solves compressible flow where it is faster than sound, else incompressible flow, whose pressures are those of
/// compressible flow where there is a Mach number. Boundary layers displace the flow where they can (can_be_coupled(),
/// solve_coupled_flow()). Throws OptionError for options out of range, and for those of transition where layers do not
/// displace the flow.
FoundFlow find_flow(Geometry geometry, const CaseOptions& options, const TransitionOptions& transition = {});
/// Finds the flow at each of these conditions, of one chord, in their order.
std::vector<FoundFlow> find_flows(Geometry geometry, const CaseOptions& options,
                                  std::span<const FlowConditions> conditions, const TransitionOptions& transition);

}  // namespace lamina::app
