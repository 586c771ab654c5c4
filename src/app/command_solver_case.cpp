// lamina case: makes a mesh and writes it with everything that a flow solver needs beside it.
#include <algorithm>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/solver_case.hpp>

#include "app/commands.hpp"
#include "app/family_run.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/presets.hpp"
#include "app/table_option.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

struct CaseArguments {
    std::string solver, folder, turbulence;
    bool overwrite = false, unsteady = false;
    GivenOptions mesh;
    std::shared_ptr<FamilyArguments> family;
};

FlowSolver solver_of_name(const std::string& name) {
    std::vector<std::string> names;
    for (const auto& [known, solver] : flow_solvers()) {
        if (known == name) return solver;
        names.push_back(known);
    }
    throw UsageError("SOLVER: " + unknown_choice(name, names));
}

/// The y+ from which on walls get wall functions: the end of the viscous sublayer.
constexpr double least_y_plus_of_wall_functions = 5;

SolverConditions solver_conditions(const MeshResult& result, const CaseOptions& options) {
    SolverConditions conditions{
        .reference = result.conditions,
        .velocity = options.conditions.velocity,
        .wall_functions = result.y_plus && result.y_plus->y_plus > least_y_plus_of_wall_functions};
    const FarFieldOptions& far_field = options.far_field;
    if (far_field.ground && far_field.ground_wall != OuterWallKind::slip) conditions.outer_walls.push_back("ground");
    if (far_field.ground_wall == OuterWallKind::moving) conditions.moving_walls = conditions.outer_walls;
    if (far_field.tunnel && far_field.tunnel_walls != OuterWallKind::slip) {
        if (!far_field.ground) conditions.outer_walls.push_back("floor");
        conditions.outer_walls.push_back("ceiling");
    }
    conditions.axisymmetric = far_field.axisymmetric;
    return conditions;
}

/// Returns what the solver makes of the mesh and of the speed.
std::vector<Warning> warnings_of_case(FlowSolver solver, const MeshResult& result, const SolverCaseOptions& options) {
    std::vector<Warning> warnings = find_solver_warnings(solver, result.mesh);
    if (solver == FlowSolver::openfoam && !options.compressible) return warnings;
    std::vector<Warning> of_speed =
        find_speed_warnings(result.conditions.mach.value_or(default_case_mach), result.flow ? &*result.flow : nullptr,
                            result.decisions.knows_shocks);
    std::move(of_speed.begin(), of_speed.end(), std::back_inserter(warnings));
    return warnings;
}

MeshDestination destination_of_case(FlowSolver solver, const MeshCase& mesh_case, const SolverCaseOptions& options) {
    const std::string folder = mesh_case.outputs.front();
    MeshDestination destination;
    for (const auto& file : solver_case_outputs(solver, folder, options))
        destination.files.push_back({file, "option --output " + folder});
    destination.require_writable = [=] { check_solver_case_writable(solver, folder, options); };
    destination.warnings = [=](const MeshResult& result) { return warnings_of_case(solver, result, options); };
    destination.write = [=, &mesh_case](const MeshResult& result) {
        write_solver_case(solver, result.mesh, solver_conditions(result, mesh_case.options), folder, options);
    };
    return destination;
}

/// Sets what the solver prefers where neither a case file nor the command line says otherwise.
void apply_preferences(FlowSolver solver, MeshCase& mesh_case) {
    // Cells far away cost iterations and change little: drag by 0.2 % (docs/decisions/0038).
    constexpr double gradation = 0.13;
    prefer_quads(mesh_case);
    CaseOptions& options = mesh_case.options;
    if (!is_given(mesh_case, "far-field") && !options.far_field.tunnel && !options.far_field.pitch)
        options.far_field.size = Length{far_field_for(solver, options.conditions.mach.value_or(default_case_mach))};
    // Some presets have one of their own.
    if (!is_given(mesh_case, "gradation") && options.sizing.gradation == SizingOptions{}.gradation)
        options.sizing.gradation = gradation;
}

void make_case(const CaseArguments& arguments) {
    const FlowSolver solver = solver_of_name(arguments.solver);
    SolverCaseOptions options;
    set_by_name(option_table<SolverCaseOptions>(), "turbulence", arguments.turbulence, options);
    options.overwrite = arguments.overwrite;
    options.unsteady = arguments.unsteady;
    MeshCase mesh_case = case_of_command_line(arguments.mesh);
    if (arguments.folder.empty()) throw UsageError("no output: give -o DIR");
    mesh_case.outputs = {arguments.folder};
    mesh_case.format.clear();
    options.compressible = mesh_case.options.conditions.mach.has_value();
    validate(solver, options, mesh_case.options.conditions.mach);
    apply_preferences(solver, mesh_case);
    require_consistent(mesh_case);
    if (const LayerOptions& layer = mesh_case.options.layer;
        solver == FlowSolver::su2 && layer.enabled && layer.topology != LayerTopology::quads)
        throw OptionError("layer-topology", "must be quads in a case of SU2, which finds wrong forces on triangles");
    if (const FlowConditions& flow = mesh_case.options.conditions; !flow.reynolds && !flow.velocity)
        throw OptionError("reynolds", "a case needs it, or velocity and viscosity");
    if (arguments.family->levels == 1) {
        run_mesh(mesh_case, destination_of_case(solver, mesh_case, options));
        return;
    }
    run_family(*arguments.family, mesh_case,
               [&](const MeshCase& level) { return destination_of_case(solver, level, options); });
}

}  // namespace

void add_case_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("case", "make a mesh and a case of a flow solver, ready to run");
    auto arguments = std::make_shared<CaseArguments>();
    command
        ->add_option("SOLVER", arguments->solver,
                     "openfoam: simpleFoam, or rhoSimpleFoam with --mach, or pimpleFoam with --unsteady, run by "
                     "DIR/Allrun; su2: SU2_CFD, run by "
                     "DIR/Allrun")
        ->required()
        ->type_name("openfoam|su2");
    command
        ->add_option("-o,--output", arguments->folder,
                     "folder to write the mesh and the case into; of several levels: {level} stands for the number")
        ->type_name("DIR")
        ->group("Case");
    add_table_option(*command, option_table<SolverCaseOptions>(), "turbulence", arguments->turbulence)->group("Case");
    const auto add_flag = [&](const char* name, bool& given) {
        const auto& row = find_row(option_table<SolverCaseOptions>(), name);
        command->add_flag(fmt::format("--{}", name), given, help_with_range(row))->group("Case");
    };
    add_flag("unsteady", arguments->unsteady);
    add_flag("overwrite", arguments->overwrite);
    arguments->family = add_family_options(*command, 1);
    for (const char* const name : {"--ratio", "--base-level", "--table"})
        command->get_option(name)->needs(command->get_option("--levels"));
    arguments->mesh =
        add_mesh_options(*command, {"output", "format", "parts", "span", "span-cells", "span-ends", "wall-distance"});
    command->callback([arguments] { make_case(*arguments); });
}

}  // namespace lamina::app
