// lamina mesh: makes a mesh round airfoils and writes it.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/core.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>

#include "app/case.hpp"
#include "app/case_file.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/mesh_command_options.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

WriteOptions write_options(const MeshCase& mesh_case) {
    return {.format = mesh_case.format, .wall_distance = mesh_case.wall_distance};
}

std::vector<RunFile> files_written(const MeshCase& mesh_case) {
    std::vector<RunFile> files;
    for (const std::string& output : mesh_case.outputs)
        for (const std::filesystem::path& file : output_files(output, write_options(mesh_case)))
            files.push_back({file, "option --output " + output});
    if (!mesh_case.wall_data.empty()) files.push_back({mesh_case.wall_data, "option --wall-data"});
    if (!mesh_case.report.empty()) files.push_back({mesh_case.report, "option --report"});
    return files;
}

/// Throws where an output is missing or certainly cannot be written, before the work begins.
void require_outputs(const MeshCase& mesh_case) {
    if (mesh_case.outputs.empty()) throw UsageError("no output: give -o FILE");
    for (const std::string& output : mesh_case.outputs) {
        require_format(output, mesh_case.format, "--format");
        check_writable(output, write_options(mesh_case));
    }
    if (!mesh_case.wall_data.empty()) check_folder_writable(mesh_case.wall_data);
    if (!mesh_case.report.empty()) check_folder_writable(mesh_case.report);
    require_distinct(files_read(mesh_case), files_written(mesh_case));
}

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
    for (const std::string& output : mesh_case.outputs) write_mesh(result.mesh, output, write_options(mesh_case));
    if (!mesh_case.wall_data.empty()) write_wall_data(result.mesh, mesh_case.wall_data);
    const double write_seconds = watch.lap();

    if (!mesh_case.report.empty()) write_file(mesh_case.report, to_text(mesh_report(mesh_case, result, write_seconds)));
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
