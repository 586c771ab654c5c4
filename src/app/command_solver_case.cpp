// lamina case: makes a mesh and writes it with everything that a flow solver needs beside it.
#include <memory>
#include <string>

#include <lamina/error.hpp>
#include <lamina/solver_case.hpp>

#include "app/commands.hpp"
#include "app/family_run.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/solver_case_run.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct CaseArguments {
    std::string solver, folder, turbulence;
    bool overwrite = false, unsteady = false;
    GivenOptions mesh;
    std::shared_ptr<FamilyArguments> family;
};

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
    prepare_case(solver, options, mesh_case);
    if (arguments.family->levels == 1) {
        run_mesh(mesh_case, destination_of_case(solver, mesh_case, options));
        return;
    }
    run_family(*arguments.family, mesh_case,
               [&](const MeshCase& level) { return destination_of_case(solver, level, options); });
}

}  // namespace

void add_case_command(CLI::App& app) {
    CLI::App* command = add_command(app, "case", "make a mesh and a case of a flow solver, ready to run");
    auto arguments = std::make_shared<CaseArguments>();
    add_option(*command, "SOLVER", arguments->solver,
               "openfoam: simpleFoam, or rhoSimpleFoam with --mach, or pimpleFoam with --unsteady, run by "
               "DIR/Allrun; su2: SU2_CFD, run by "
               "DIR/Allrun; pyfr: PyFR on curved cells (--order, 3 unless given), laminar, run by DIR/Allrun")
        .required()
        .type_name("openfoam|su2|pyfr");
    add_option(*command, "-o,--output", arguments->folder,
               "folder to write the mesh and the case into; of several levels: {level} stands for the number")
        .type_name("DIR")
        .group("Case");
    add_table_option(*command, option_table<SolverCaseOptions>(), "turbulence", arguments->turbulence).group("Case");
    const auto& table = option_table<SolverCaseOptions>();
    add_table_flag(*command, table, "unsteady", arguments->unsteady).group("Case");
    add_table_flag(*command, table, "overwrite", arguments->overwrite).group("Case");
    arguments->family = add_family_options(*command, 1);
    for (const char* const name : {"--ratio", "--base-level", "--table"}) option_of(*command, name).needs("--levels");
    arguments->mesh =
        add_mesh_options(*command, {"output", "format", "parts", "span", "span-cells", "span-ends", "wall-distance"});
    run_with(*command, [arguments] { make_case(*arguments); });
}

}  // namespace lamina::app
