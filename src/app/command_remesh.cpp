// lamina remesh: a mesh adapted to a metric.
#include <cassert>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/metric.hpp>
#include <lamina/remesh.hpp>

#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct RemeshArguments {
    std::string mesh, input_format, metric, output;
    WriteOptions options;
    std::map<std::string, std::string> values;  ///< values by the names of option_table<RemeshOptions>()
};

std::string remesh_summary(const RemeshedMesh& made, const MeshCheck& check, const RemeshArguments& arguments) {
    std::string text = fmt::format("{} by the metric of {}\n", arguments.mesh, arguments.metric);
    text += summary_line(
        "mesh", fmt::format("{} vertices, {} triangles beyond the layer", made.mesh.points.size(), made.triangles));
    text += summary_line("edges",
                         fmt::format("{:.1f} % are between 0.7 and 1.4 long in the metric", 100 * made.unit_edges));
    text += summary_line("quality", fmt::format("{:.4g} in the metric, mean of 4 sqrt(3) area / sum of squared edges",
                                                made.mean_quality));
    return text + quality_summary(check) + summary_line("wrote", arguments.output);
}

void remesh_file(const RemeshArguments& arguments) {
    RemeshOptions options;
    for (const auto& [name, value] : arguments.values) set_by_name(option_table<RemeshOptions>(), name, value, options);
    validate(options);
    require_format(arguments.mesh, arguments.input_format, "--input-format");
    require_format(arguments.output, arguments.options.format, "--format");
    check_writable(arguments.output, arguments.options);
    std::vector<RunFile> inputs = files_of_mesh(arguments.mesh, arguments.input_format);
    inputs.push_back({arguments.metric, "option --metric"});
    const std::vector<RunFile> outputs = files_of_output(arguments.output, arguments.options);
    require_distinct(inputs, outputs);
    const SignalGuard guard(outputs);
    const Mesh mesh = read_valid_mesh(arguments.mesh, arguments.input_format);
    const RemeshedMesh made = remesh(mesh, read_metric(arguments.metric), options);
    const MeshCheck check = check_mesh(made.mesh);
    assert(check.valid());
    print_warnings(lost_marker_warnings(made.mesh.markers, arguments.output, arguments.options));
    write_mesh(made.mesh, arguments.output, arguments.options);
    print_summary(remesh_summary(made, check, arguments), outputs);
}

}  // namespace

void add_remesh_command(CLI::App& app) {
    CLI::App* command = add_command(app, "remesh", "adapt the triangles of a mesh to a metric; its layer stays");
    auto arguments = std::make_shared<RemeshArguments>();
    add_option(*command, "MESH", arguments->mesh, "mesh file; - for standard input").required();
    add_input_format(*command, arguments->input_format);
    add_option(*command, "--metric", arguments->metric,
               "tensors or sizes at the vertices of MESH: Medit file (.sol), or VTU file with the point data "
               "'metric'")
        .required()
        .type_name("FILE");
    for (const char* name : {"vertices", "gradation", "max-ratio"})
        add_table_option(*command, option_table<RemeshOptions>(), name, arguments->values[name]);
    add_table_flag(*command, option_table<RemeshOptions>(), "divide-borders", arguments->values["divide-borders"]);
    add_option(*command, "--format", arguments->options.format, "format of the output").type_name(format_names());
    add_option(*command, "-o,--output", arguments->output,
               "mesh file to write; its extension says the format, unless --format does; - for standard output")
        .required()
        .type_name("FILE");
    set_footer(*command, format_help());
    run_with(*command, [arguments] { remesh_file(*arguments); });
}

}  // namespace lamina::app
