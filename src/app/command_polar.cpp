// lamina polar: forces at many angles of attack, by a flow solver or by lamina's own flow.
#include <algorithm>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "app/commands.hpp"
#include "app/mesh_command_options.hpp"
#include "app/polar_run.hpp"
#include "app/standard_output.hpp"
#include "app/table_option.hpp"
#include "app/transition_options.hpp"

namespace lamina::app {

namespace {

constexpr const char* own_flow = "flow";

struct PolarArguments {
    std::string solver = own_flow, folder, turbulence;
    std::map<std::string, std::string> transition;
    GivenOptions mesh;
};

void polar(const PolarArguments& arguments) {
    MeshCase mesh_case = case_of_command_line(arguments.mesh);
    if (!mesh_case.options.conditions.alphas)
        throw UsageError("option --alpha: a polar needs a range of angles, such as -4:18:1");
    mesh_case.outputs.clear();
    for (const auto& [file, option] : files_beside_mesh) (mesh_case.*file).clear();
    const PolarSettings settings{arguments.folder, fmt::format("\n{}\n{}", arguments.solver, arguments.turbulence)};
    SolverCaseOptions options;
    set_by_name(option_table<SolverCaseOptions>(), "turbulence", arguments.turbulence, options);
    const TransitionOptions transition = transition_options(arguments.transition);
    if (arguments.solver != own_flow && transition != TransitionOptions{})
        throw UsageError("options --ncrit, --trip, --trip-lower: are those of --solver flow");
    const auto& [conditions, rows] =
        arguments.solver == own_flow
            ? run_polar_of_flow(settings, mesh_case, transition)
            : run_polar_of_solver(settings, mesh_case, *adapt_solver(arguments.solver, options));
    if (!mesh_case.quiet) print_result(polar_summary(conditions, rows));
    const auto loose = std::count_if(rows.begin(), rows.end(), [](const PolarRow& row) { return !row.steady; });
    if (loose > 0)
        throw MeshError(fmt::format("{} of {} angles are not steady; {}/polar.csv says which", loose, rows.size(),
                                    arguments.folder));
}

}  // namespace

void add_polar_command(CLI::App& app) {
    CLI::App* command = add_command(app, "polar", "compute lift and drag at many angles of attack");
    auto arguments = std::make_shared<PolarArguments>();
    add_option(*command, "--solver", arguments->solver,
               "flow: a panel method with boundary layers, without a mesh; openfoam, su2, or a "
               "command, as for lamina adapt: on one mesh that serves all angles, each from the flow of the one "
               "before [flow]")
        .type_name("flow|openfoam|su2|COMMAND")
        .group("Polar");
    add_option(*command, "-o,--output", arguments->folder,
               "folder of the cases, alpha_N, and of polar.csv, polar.json and, by flow, polar.txt, which is as XFOIL "
               "writes it; angles that are there are kept")
        .required()
        .type_name("FOLDER")
        .group("Polar");
    add_table_option(*command, option_table<SolverCaseOptions>(), "turbulence", arguments->turbulence).group("Polar");
    add_transition_options(*command, arguments->transition);
    arguments->mesh =
        add_mesh_options(*command, {"output", "format", "order", "parts", "span", "span-cells", "span-ends",
                                    "wall-distance", "stream", "wall-data", "report", "html"});
    set_footer(*command, "Exit code 4: an angle is not steady, separated, stalled, or failed; its row says so.");
    run_with(*command, [arguments] { polar(*arguments); });
}

}  // namespace lamina::app
