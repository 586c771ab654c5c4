// lamina mesh: makes a mesh round airfoils and writes it.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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
#include "app/options.hpp"
#include "app/presets.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/stopwatch.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

/// The options of the table, each with the option of CLI11 that reads it from the command line.
using GivenOptions = std::vector<std::pair<const Option<MeshCase>*, CLI::Option*>>;

CLI::Option* add_option(CLI::App& command, const Option<MeshCase>& option) {
    const std::string help = help_text(option);
    if (option.kind == OptionKind::flag) return command.add_flag(command_line_name(option), help)->group(option.group);

    // The option is set only once the case file is read, so nothing is done with its value here.
    CLI::Option* given = command.add_option(
        command_line_name(option), [](const CLI::results_t&) { return true; }, help);
    given->group(option.group)->type_name(option.metavar);
    if (option.kind == OptionKind::words) return given->delimiter(',')->expected(1, -1)->allow_extra_args(false);
    if (option.kind == OptionKind::repeated)
        return given->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (option.kind != OptionKind::paths) return given->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
    return given->expected(1, -1)->allow_extra_args(given->get_positional());
}

/// Returns the preset that the command line names.
std::optional<std::string> preset_of_command_line(const GivenOptions& options) {
    for (const auto& [option, given] : options)
        if (option->name == preset_option && given->count() > 0) return given->results().back();
    return {};
}

/// Returns whether the command line says the Reynolds number.
bool has_reynolds(const GivenOptions& options) {
    return std::any_of(options.begin(), options.end(), [](const auto& entry) {
        const auto& [option, given] = entry;
        return given->count() > 0 && std::find(std::begin(reynolds_options), std::end(reynolds_options),
                                               option->name) != std::end(reynolds_options);
    });
}

/// Returns the case that the command line describes. Its options override those of the case file.
MeshCase case_of_command_line(const GivenOptions& options) {
    MeshCase mesh_case;
    for (const auto& [option, given] : options) {
        if (given->get_positional()) {
            mesh_case = case_of_inputs(given->results(), preset_of_command_line(options), has_reynolds(options));
        } else if (given->count() > 0) {
            const std::string origin = "option --" + option->name;
            assign(*option, mesh_case, value_of_text(option->kind, given->results(), origin), origin);
        }
    }
    return mesh_case;
}

WriteOptions write_options(const MeshCase& mesh_case) {
    return {.format = mesh_case.format, .wall_distance = mesh_case.wall_distance};
}

std::vector<RunFile> files_read(const MeshCase& mesh_case) {
    std::vector<RunFile> files;
    for (const std::string& input : mesh_case.inputs) files.push_back({input, "INPUT"});
    if (!mesh_case.case_file.empty()) files.push_back({mesh_case.case_file, "INPUT"});
    if (!mesh_case.background.empty()) files.push_back({mesh_case.background, "option --background"});
    return files;
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

/// Throws where standard input is asked for what it cannot give.
void require_inputs(const MeshCase& mesh_case) {
    if (std::count_if(mesh_case.inputs.begin(), mesh_case.inputs.end(), is_standard_stream) > 1)
        throw UsageError("INPUT: '-' is given twice, but standard input can be read only once");
    if (is_standard_stream(mesh_case.background))
        throw UsageError("option --background: must be a file: standard input holds sections alone");
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
    CaseOptions options = mesh_case.options;
    if (!mesh_case.background.empty())
        options.sizing.background = std::make_shared<const SizedMesh>(read_sizes(mesh_case.background));
    options.limits = with_default_limits(options.limits);
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
    auto options = std::make_shared<GivenOptions>();
    for (const Option<MeshCase>& option : mesh_options()) options->emplace_back(&option, add_option(*command, option));
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
