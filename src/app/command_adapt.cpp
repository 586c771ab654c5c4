// lamina adapt: meshes, solves and meshes again, until the forces stay.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>
#include <lamina/remesh.hpp>

#include "app/adapt_run.hpp"
#include "app/commands.hpp"
#include "app/mesh_command_options.hpp"
#include "app/options.hpp"
#include "app/table_option.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

struct AdaptArguments {
    std::string solver, folder, goal = "fields", turbulence, anisotropy = "none";
    std::vector<double> sequence;
    std::map<std::string, std::string> sizes;  ///< values by the names of option_table<SolutionSizeOptions>()
    AdaptSettings settings;
    GivenOptions mesh;
};

/// Returns the force that is to be found well; nothing where it is the fields. Throws UsageError where there is no
/// adjoint solution of it.
std::optional<AdjointGoal> goal_of(const AdaptArguments& arguments, const MeshCase& mesh_case) {
    const std::string& goal = arguments.goal;
    if (goal == "fields") return {};
    if (goal != "drag" && goal != "lift")
        throw UsageError("option --goal: " + unknown_choice(goal, {"fields", "drag", "lift"}));
    const bool is_su2 = arguments.solver == "su2", is_openfoam = arguments.solver == "openfoam";
    if (is_su2 || (is_openfoam && mesh_case.options.conditions.mach))
        throw UsageError(
            fmt::format("option --goal: {0} needs an adjoint solution of the {0}, which {1}: give fields, {2}", goal,
                        is_su2 ? "cases of SU2 do not find" : "OpenFOAM finds in incompressible flow alone",
                        is_su2 ? "or openfoam as the solver" : "or leave --mach out"));
    return goal == "lift" ? AdjointGoal::lift : AdjointGoal::drag;
}

/// Returns the largest ratio of the lengths of triangles; nothing where they are isotropic.
std::optional<double> ratio_of(const AdaptArguments& arguments) {
    if (arguments.anisotropy == "none") return {};
    const std::string origin = "option --anisotropy";
    const double ratio = std::get<double>(value_of_text(OptionKind::number, {arguments.anisotropy}, origin));
    require_in_range(numbers_from_to(1, RemeshOptions{}.max_ratio), ratio, origin);
    return ratio;
}

void adapt(const AdaptArguments& arguments) {
    AdaptSettings settings = arguments.settings;
    settings.folder = arguments.folder;
    require_in_range(numbers_from_to(1, 100), settings.rounds, "option --rounds");
    require_in_range(positive_numbers, settings.tolerance, "option --tolerance");
    for (const auto& [name, value] : arguments.sizes)
        set_by_name(option_table<SolutionSizeOptions>(), name, value, settings.sizes);
    validate(settings.sizes);
    settings.vertices = arguments.sequence;
    for (const double vertices : settings.vertices)
        require_in_range(numbers_from_to(10, 4e9), vertices, "option --sequence");
    if (!arguments.sizes.at("vertices").empty()) settings.vertices = {settings.sizes.vertices};
    SolverCaseOptions options;
    set_by_name(option_table<SolverCaseOptions>(), "turbulence", arguments.turbulence, options);
    const MeshCase mesh_case = case_of_command_line(arguments.mesh);
    options.adjoint = goal_of(arguments, mesh_case);
    if (options.adjoint) settings.sizes.goal.emplace();
    if (options.adjoint && (!settings.fields.empty() || !arguments.sizes.at("norm").empty()))
        throw UsageError("option --goal: a force decides which errors count, without --field and --norm");
    if (is_given(mesh_case, "gradation")) settings.sizes.gradation = mesh_case.options.sizing.gradation;
    settings.identity = fmt::format("\n{}\n{}\n{}", arguments.solver, arguments.turbulence, arguments.goal);
    MeshCase without_outputs = mesh_case;
    // Case files may have them; a loop of meshes has numbers of vertices of its own.
    if (mesh_case.options.cells)
        throw OptionError("cells", "the loop aims at vertices: leave cells out of the case file");
    if (settings.vertices.empty() && mesh_case.options.vertices)
        settings.vertices = {static_cast<double>(*mesh_case.options.vertices)};
    without_outputs.options.vertices.reset();
    without_outputs.outputs.clear();
    for (const auto& [file, option] : files_beside_mesh) (without_outputs.*file).clear();
    const std::unique_ptr<AdaptSolver> solver = adapt_solver(arguments.solver, options);
    settings.max_ratio = ratio_of(arguments);
    run_adapt(settings, without_outputs, *solver);
}

constexpr const char* group_of_adapt = "Adaptation";

/// Adds the solver and the folder.
void add_solver_and_folder(CLI::App& command, AdaptArguments& arguments) {
    add_option(command, "--solver", arguments.solver,
               "openfoam, su2, or a command, whose words blanks divide and quotes keep together. It runs in the "
               "folder of the round, without a shell, where mesh.vtu, mesh.su2, case.toml and, from round 1 on, "
               "start.vtu are, and leaves solution.vtu or solution.cgns, and forces.csv with the columns CL, CD "
               "and steady (and "
               "CM, y_plus, iterations, residual); {case} stands for the folder")
        .required()
        .type_name("openfoam|su2|COMMAND")
        .group(group_of_adapt);
    add_option(command, "-o,--output", arguments.folder,
               "folder of the rounds, round_0, round_1, ..., and of adapt.csv and adapt.html; rounds that are "
               "there are kept")
        .required()
        .type_name("FOLDER")
        .group(group_of_adapt);
}

/// Adds the options of how many rounds there are, and of how many vertices.
void add_round_options(CLI::App& command, AdaptArguments& arguments) {
    add_option(command, "--rounds", arguments.settings.rounds, "number of meshes at most [5]")
        .type_name("N")
        .group(group_of_adapt);
    add_table_option(command, option_table<SolutionSizeOptions>(), "vertices", arguments.sizes["vertices"])
        .group(group_of_adapt);
    add_option(command, "--sequence", arguments.sequence,
               "numbers of vertices of the first rounds; the last one is that of all further rounds")
        .delimiter(',')
        .type_name("N,...")
        .group(group_of_adapt)
        .excludes("--vertices");
    add_option(command, "--tolerance", arguments.settings.tolerance,
               "the loop ends where lift and drag change by a smaller share in two rounds in a row [0.001]")
        .type_name("T")
        .group(group_of_adapt);
}

/// Adds the options of what is solved, and what sizes follow.
void add_goal_options(CLI::App& command, AdaptArguments& arguments) {
    add_option(command, "--goal", arguments.goal,
               "what is to be found well; for drag and lift an adjoint solution weighs the errors of the flow: "
               "openfoam finds "
               "it in incompressible flow, and a command leaves U, p, Ua and pa, as OpenFOAM names them [fields]")
        .type_name("fields|drag|lift")
        .group(group_of_adapt);
    add_table_option(command, option_table<SolutionSizeOptions>(), "norm", arguments.sizes["norm"])
        .group(group_of_adapt);
    add_option(command, "--field", arguments.settings.fields,
               "fields to interpolate well, as in lamina sizes [openfoam: mag(U),p; else Mach,Pressure]")
        .delimiter(',')
        .type_name("NAME[,NAME...]")
        .group(group_of_adapt);
    add_table_option(command, option_table<SolutionSizeOptions>(), "max-change", arguments.sizes["max-change"])
        .group(group_of_adapt);
    add_option(command, "--anisotropy", arguments.anisotropy,
               "largest ratio of the lengths of triangles beyond the layer, which are short where the fields "
               "bend; none: they are isotropic")
        .show_default()
        .type_name("RATIO|none")
        .group(group_of_adapt);
    add_table_option(command, option_table<SolverCaseOptions>(), "turbulence", arguments.turbulence)
        .group(group_of_adapt);
    add_flag(command, "--dry-run", arguments.settings.dry_run, "say what would be done, and do nothing")
        .group(group_of_adapt);
}

}  // namespace

void add_adapt_command(CLI::App& app) {
    CLI::App* command = add_command(app, "adapt", "mesh, solve and mesh again by the solution, in one loop");
    auto arguments = std::make_shared<AdaptArguments>();
    add_solver_and_folder(*command, *arguments);
    add_round_options(*command, *arguments);
    add_goal_options(*command, *arguments);
    arguments->mesh = add_mesh_options(
        *command, {"output", "format", "order", "parts", "span", "span-cells", "span-ends", "wall-distance",
                   "background", "stream", "wall-data", "report", "html", "vertices", "cells"});
    run_with(*command, [arguments] { adapt(*arguments); });
}

}  // namespace lamina::app
