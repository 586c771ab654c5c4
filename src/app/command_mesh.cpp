// lamina mesh: makes a mesh round airfoils and writes it.
#include <memory>
#include <string>

#include "app/arguments.hpp"
#include "app/case_file.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_run.hpp"
#include "app/options.hpp"
#include "app/standard_output.hpp"

namespace lamina::app {

void add_mesh_command(CLI::App& app, Ranks* ranks) {
    CLI::App* command = add_command(app, "mesh", "make a mesh round airfoils and write it");
    auto options = std::make_shared<GivenOptions>(add_mesh_options(*command));
    set_footer(*command, format_help());
    auto dump = std::make_shared<bool>(false);
    add_flag(*command, "--dump-config", *dump, "print the options in force as a case file, and do nothing else")
        .group("Run" + std::string(further_options));
    auto dry_run = std::make_shared<bool>(false);
    add_flag(*command, "--dry-run", *dry_run,
             "say first height, y+, thickness, cells, memory and time without a mesh, and write no file but the "
             "report")
        .group("Run");
    run_with(*command, [options, dump, dry_run, ranks] {
        MeshCase mesh_case = case_of_command_line(*options);
        prefer_quads_for_openfoam(mesh_case);
        require_consistent(mesh_case);
        if (*dump) return print_result(dump_case(mesh_case));
        if (*dry_run) return forecast_mesh_of_case(mesh_case);
        const MeshDestination destination = destination_of_outputs(mesh_case);
        if (ranks != nullptr && ranks->size() > 1) return share_mesh_of_case(mesh_case, destination, *ranks);
        (mesh_case.stream ? stream_mesh_of_case : run_mesh)(mesh_case, destination);
    });
}

}  // namespace lamina::app
