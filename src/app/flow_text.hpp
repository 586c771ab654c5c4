// The flow before there is a mesh, as `lamina flow` tells it: a table, a summary, and pictures.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <lamina/compressible_flow.hpp>
#include <lamina/plot.hpp>

#include "app/flow_run.hpp"

namespace lamina::app {

/// The flow as `lamina flow` writes it (a table and curves of pressure) and prints it (a summary).
struct FlowText {
    std::string table, summary;
    std::vector<ChartCurve> curves;
    std::array<double, 2> pressures;
    std::optional<CompressibleFlow> compressible{};  ///< where the flow is faster than sound
};

/// Prints the warnings of the flow, and returns its text.
FlowText flow_text(FoundFlow found, const std::optional<double>& mach);

/// Draws the Mach number round the bodies, with the line where the flow is as fast as sound.
void draw_mach_numbers(const CompressibleFlow& flow, const std::string& file);

}  // namespace lamina::app
