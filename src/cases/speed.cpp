// Mach numbers for which the settings of the cases are not made.
#include <fmt/format.h>

#include <lamina/flow.hpp>
#include <lamina/solver_case.hpp>

namespace lamina {

std::vector<Warning> find_speed_warnings(FlowSolver solver, double mach, const Flow* flow) {
    // Up to Mach 0.5 pressures are within 15 % of those of the incompressible flow that the mesh is made for (Prandtl,
    // Glauert). The CRM-HL at Mach 0.2 is supersonic along 0.026 chords by this measure, and its cases run.
    constexpr double largest_mach = 0.5, longest = 0.05;
    double length = 0;
    if (flow != nullptr && !flow->estimated && mach > 0 && mach < 1) length = supersonic_length(*flow, mach);
    if (mach <= largest_mach && length <= longest) return {};
    const std::string where =
        length > longest
            ? fmt::format(", where the flow is expected to be supersonic along {:.2f} chords of the walls", length)
            : "";
    const std::string advice =
        solver == FlowSolver::su2
            ? std::string(
                  "sizes follow shocks of flow without boundary layers, which has them up to 9 % of the chord too far "
                  "back: compare with finer meshes (lamina family)")
            : fmt::format(
                  "the settings of the case and sizes are those of Mach {}, without shocks: give "
                  "system/fvSchemes schemes and limiters for them",
                  default_case_mach);
    return {{.code = WarningCode::unsuited_speed,
             .number = mach,
             .unit = "Mach number",
             .message = fmt::format("Mach number {:.4g}{}: {}", mach, where, advice)}};
}

}  // namespace lamina
