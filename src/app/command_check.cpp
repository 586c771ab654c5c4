// lamina check: checks whether a mesh file is valid, and measures its quality.
#include <memory>
#include <string>

#include <lamina/pipeline.hpp>

#include "app/check_run.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct CheckArguments {
    CheckSettings settings;
    std::string min_angle, first_height, max_memory;  ///< values by the names of tables of options
};

/// Throws UsageError where a value is none of its option.
CheckSettings settings_of(const CheckArguments& arguments) {
    CheckSettings settings = arguments.settings;
    set_by_name(option_table<MeshCheckOptions>(), "min-angle", arguments.min_angle, settings.options);
    set_by_name(option_table<MeshCheckOptions>(), "first-height", arguments.first_height, settings.options);
    settings.require_angles = !arguments.min_angle.empty();
    CaseOptions options;
    set_by_name(option_table<CaseOptions>(), "max-memory", arguments.max_memory, options);
    settings.limits = options.limits;
    return settings;
}

}  // namespace

void add_check_command(CLI::App& app) {
    CLI::App* command = add_command(app, "check", "check a mesh and measure its quality; exit code 0 only if valid");
    auto arguments = std::make_shared<CheckArguments>();
    add_option(*command, "MESH", arguments->settings.mesh, "mesh file; - for standard input").required();
    add_input_format(*command, arguments->settings.format);
    add_flag(*command, "--json", arguments->settings.json, "print the result as one JSON object");
    add_option(*command, "--wall", arguments->settings.walls, "require a marker of this name, and take it for a wall")
        .type_name("NAME");
    add_option(*command, "--far", arguments->settings.far_field,
               "require a marker of this name, and take it for the far field")
        .type_name("NAME");
    add_flag(*command, "--require-delaunay", arguments->settings.require_delaunay,
             "require the Delaunay property of all edges between isotropic triangles (exact test)");
    add_table_option(*command, option_table<MeshCheckOptions>(), "min-angle", arguments->min_angle);
    add_table_option(*command, option_table<MeshCheckOptions>(), "first-height", arguments->first_height);
    add_option(*command, "--max-memory", arguments->max_memory,
               "memory that the check may take, such as 500M or 2G: the arrays of larger files lie in temporary "
               "files, in the folder that TMPDIR names or in /var/tmp; default: 80 % of what is free")
        .type_name("SIZE");
    run_with(*command, [arguments] { run_check(settings_of(*arguments)); });
}

}  // namespace lamina::app
