// lamina mesh: makes a mesh round airfoils and writes it.
#include <memory>
#include <string>
#include <vector>

#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/case_file.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/mesh_command_options.hpp"
#include "app/mesh_outputs.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

void mesh(const MeshCase& mesh_case) {
    require_consistent(mesh_case);
    require_inputs(mesh_case);
    require_outputs(mesh_case);
    const std::vector<RunFile> outputs = files_written(mesh_case);
    const SignalGuard guard(outputs);
    const CaseOptions options = options_with_files(mesh_case);
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet);
    const MeshResult result =
        generate_mesh(mesh_case.inputs, options, [&](const auto& event) { progress.begin(event); });
    print_warnings(result.warnings);
    require_promised_angles(result.check, mesh_case.allow_defects);

    progress.begin({"writing"});
    Stopwatch watch;
    write_outputs(mesh_case, result);
    const double write_seconds = watch.lap();
    if (!mesh_case.quiet) print_summary(mesh_summary(mesh_case, result, write_seconds), outputs);
    require_no_warnings(result.warnings, mesh_case.strict);
}

}  // namespace

void add_mesh_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("mesh", "make a mesh round airfoils and write it");
    auto options = std::make_shared<const GivenOptions>(add_mesh_options(*command));
    command->footer(format_help());
    auto dump = std::make_shared<bool>(false), markdown = std::make_shared<bool>(false);
    command->add_flag("--dump-config", *dump, "print the options in force as a case file, and do nothing else")
        ->group("Run");
    command->add_flag("--options-as-markdown", *markdown, "print a table of all options, and do nothing else")
        ->group("Run");
    command->callback([options, dump, markdown] {
        if (*markdown) return print_result(options_as_markdown());
        const MeshCase mesh_case = case_of_command_line(*options);
        if (!*dump) return mesh(mesh_case);
        require_consistent(mesh_case);
        print_result(dump_case(mesh_case));
    });
}

}  // namespace lamina::app
