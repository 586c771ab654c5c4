// The flow round bodies before there is a mesh: what `lamina flow` and the Python package have in common.
#pragma once

#include <optional>

#include <lamina/compressible_flow.hpp>
#include <lamina/flow.hpp>
#include <lamina/pipeline.hpp>

namespace lamina::app {

/// The flow that its conditions ask for.
struct FoundFlow {
    Flow flow;  ///< potential flow; with a Mach number, its pressures are compressible
    std::optional<CompressibleFlow> compressible{};  ///< with shocks, where the flow is faster than sound
    bool has_layers = false;                         ///< whether a Reynolds number is known
};

/// Returns the bodies as one blade of a row, where the options ask for it.
Geometry in_row(Geometry geometry, const CaseOptions& options);

/// Solves compressible flow where it is faster than sound, else potential flow with boundary layers, whose pressures are
/// those of compressible flow where there is a Mach number. Throws OptionError for options out of range.
FoundFlow find_flow(Geometry geometry, const CaseOptions& options);
/// Finds the flow at conditions beside those of the options. `given` are the bodies as read, in_row(), and `prepared` those with smooth walls.
FoundFlow find_flow(const Geometry& given, const Geometry& prepared, const FlowConditions& conditions,
                    const FlowWalls& walls);

}  // namespace lamina::app
