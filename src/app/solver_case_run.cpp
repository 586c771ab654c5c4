#include "app/solver_case_run.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "app/options.hpp"
#include "app/presets.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

/// The y+ from which on walls get wall functions: the end of the viscous sublayer.
constexpr double least_y_plus_of_wall_functions = 5;

/// Sets what the solver prefers where neither a case file nor the command line says otherwise.
void apply_preferences(FlowSolver solver, MeshCase& mesh_case) {
    // Cells far away cost iterations and change little: drag by 0.2 % (docs/decisions/0038).
    constexpr double gradation = 0.13;
    prefer_quads(mesh_case);
    CaseOptions& options = mesh_case.options;
    constexpr unsigned order_in_pyfr = 3;
    if (solver == FlowSolver::pyfr && !is_given(mesh_case, "order")) options.order = order_in_pyfr;
    if (!is_given(mesh_case, "far-field") && !options.far_field.tunnel && !options.far_field.pitch)
        options.far_field.size = Length{far_field_for(solver, options.conditions.mach.value_or(default_case_mach))};
    // Some presets have one of their own.
    if (!is_given(mesh_case, "gradation") && options.sizing.gradation == SizingOptions{}.gradation)
        options.sizing.gradation = gradation;
}

}  // namespace

FlowSolver solver_of_name(const std::string& name) {
    std::vector<std::string> names;
    for (const auto& [known, solver] : flow_solvers()) {
        if (known == name) return solver;
        names.push_back(known);
    }
    throw UsageError("SOLVER: " + unknown_choice(name, names));
}

std::vector<Warning> warnings_of_case(FlowSolver solver, const MeshResult& result, const SolverCaseOptions& options) {
    std::vector<Warning> warnings = find_solver_warnings(solver, result.mesh, result.conditions);
    if (solver == FlowSolver::openfoam && !options.compressible) return warnings;
    std::vector<Warning> of_speed =
        find_speed_warnings(result.conditions.mach.value_or(default_case_mach), result.flow ? &*result.flow : nullptr,
                            result.decisions.knows_shocks);
    std::move(of_speed.begin(), of_speed.end(), std::back_inserter(warnings));
    return warnings;
}

SolverConditions solver_conditions(const MeshResult& result, const CaseOptions& options) {
    SolverConditions conditions{
        .reference = result.conditions,
        .velocity = options.conditions.velocity,
        .wall_functions = result.y_plus && result.y_plus->y_plus > least_y_plus_of_wall_functions};
    const FarFieldOptions& far_field = options.far_field;
    if (far_field.ground && far_field.ground_wall != OuterWallKind::slip) conditions.outer_walls.push_back("ground");
    if (far_field.ground_wall == OuterWallKind::moving) conditions.moving_walls = conditions.outer_walls;
    if (far_field.tunnel && far_field.tunnel_walls != OuterWallKind::slip) {
        if (!far_field.ground && !far_field.symmetry) conditions.outer_walls.push_back("floor");
        conditions.outer_walls.push_back("ceiling");
    }
    conditions.axisymmetric = far_field.axisymmetric;
    return conditions;
}

MeshDestination destination_of_case(FlowSolver solver, const MeshCase& mesh_case, const SolverCaseOptions& options) {
    const std::string folder = mesh_case.outputs.front();
    MeshDestination destination;
    destination.holds_curved_cells = true;  // prepare_case() refuses them where they are not
    for (const auto& file : solver_case_outputs(solver, folder, options))
        destination.files.push_back({file, "option --output " + folder});
    destination.require_writable = [=] { check_solver_case_writable(solver, folder, options); };
    destination.warnings = [=](const MeshResult& result) { return warnings_of_case(solver, result, options); };
    destination.write = [=, &mesh_case](const MeshResult& result) {
        write_solver_case(solver, result.mesh, solver_conditions(result, mesh_case.options), folder, options,
                          result.curved);
    };
    return destination;
}

void prepare_case(FlowSolver solver, SolverCaseOptions& options, MeshCase& mesh_case) {
    if (mesh_case.options.conditions.alphas)
        throw OptionError("alpha", "a case is for one angle of attack; lamina polar runs a range of them");
    if (solver != FlowSolver::pyfr && mesh_case.options.order > 1)
        throw OptionError("order", "the cells of a case are straight, but for those of pyfr");
    if (mesh_case.options.node_distribution != NodeDistribution::equidistant)
        throw OptionError("node_distribution", "the mesh of a case is MSH, whose nodes are evenly spaced");
    options.compressible = mesh_case.options.conditions.mach.has_value();
    validate(solver, options, mesh_case.options.conditions.mach);
    if (mesh_case.options.far_field.pitch && mesh_case.options.conditions.mach.value_or(0) >= 1)
        throw OptionError("mach", "must be below 1 at a row of blades");
    apply_preferences(solver, mesh_case);
    require_consistent(mesh_case);
    if (const LayerOptions& layer = mesh_case.options.layer;
        solver == FlowSolver::su2 && layer.enabled && layer.topology != LayerTopology::quads)
        throw OptionError("layer-topology", "must be quads in a case of SU2, which finds wrong forces on triangles");
    if (const FlowConditions& flow = mesh_case.options.conditions; !flow.reynolds && !flow.velocity)
        throw OptionError("reynolds", "a case needs it, or velocity and viscosity");
}

}  // namespace lamina::app
