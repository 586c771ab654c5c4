// Mach numbers for which the meshes of the cases are not made.
#include <string>

#include <fmt/format.h>

#include <lamina/flow.hpp>
#include <lamina/solver_case.hpp>

#include "flow/potential.hpp"

namespace lamina {

namespace {

Warning unsuited_speed(double mach, const std::string& why) {
    return {.code = WarningCode::unsuited_speed,
            .number = mach,
            .unit = "Mach number",
            .message = fmt::format("Mach number {:.4g}{}", mach, why)};
}

}  // namespace

std::vector<Warning> find_speed_warnings(double mach, const Flow* flow, bool knows_shocks) {
    // Up to Mach 0.5 pressures are within 15 % of those of the incompressible flow that the mesh is made for (Prandtl,
    // Glauert). The CRM-HL at Mach 0.2 is supersonic along 0.026 chords by this measure, and its cases run.
    constexpr double largest_mach = 0.5, longest = 0.05;
    if (knows_shocks) return {};
    if (mach >= 1) return {unsuited_speed(mach, ": sizes follow no shocks: compare with finer meshes (lamina family)")};
    double length = 0;
    if (flow != nullptr && !flow->estimated && mach > 0) length = flow::supersonic_length(*flow, mach);
    if (mach <= largest_mach && length <= longest) return {};
    const std::string where =
        length > longest
            ? fmt::format(", where the flow is expected to be supersonic along {:.2f} chords of the walls", length)
            : "";
    return {unsuited_speed(mach, where + ": sizes follow no shocks: compare with finer meshes (lamina family)")};
}

}  // namespace lamina
