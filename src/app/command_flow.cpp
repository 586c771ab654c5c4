// lamina flow: the flow round airfoils before there is a mesh.
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/flow.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/plot.hpp>

#include "app/case.hpp"
#include "app/commands.hpp"
#include "app/flow_run.hpp"
#include "app/flow_text.hpp"
#include "app/options.hpp"
#include "app/polar.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "app/table_option.hpp"
#include "app/transition_options.hpp"

namespace lamina::app {

namespace {

struct FlowArguments {
    std::vector<std::string> inputs;
    /// Values by the names of option_table<GeometryOptions>().
    std::map<std::string, std::vector<std::string>> geometry;
    std::map<std::string, std::string> conditions;  ///< values by the names of option_table<FlowConditions>()
    std::map<std::string, std::string> walls;       ///< likewise, of option_table<FarFieldOptions>()
    std::map<std::string, std::string> transition;  ///< likewise, of option_table<TransitionOptions>()
    std::string table, picture, mach_picture;
};

std::vector<RunFile> files_written(const FlowArguments& arguments) {
    std::vector<RunFile> files;
    if (!arguments.table.empty()) files.push_back({arguments.table, "option --output"});
    if (!arguments.picture.empty()) files.push_back({arguments.picture, "option --picture"});
    if (!arguments.mach_picture.empty()) files.push_back({arguments.mach_picture, "option --mach-picture"});
    return files;
}

/// Computes the flow at each angle of attack, and prints and writes the polar.
void write_flow_polar(const FlowArguments& arguments, const CaseOptions& options, const TransitionOptions& transition,
                      const Geometry& geometry, std::span<const RunFile> outputs) {
    if (!arguments.mach_picture.empty())
        throw UsageError("option --mach-picture: shows one flow: give one angle of attack");
    const auto& [conditions, rows] = flow_polar(geometry, options, transition);
    if (!arguments.table.empty()) write_file(arguments.table, polar_text(arguments.table, conditions, rows));
    if (!arguments.picture.empty()) {
        ChartCurve lift{"lift coefficient", {}};
        for (const PolarRow& row : rows)
            if (row.cl) lift.points.push_back({row.alpha_deg, *row.cl});
        plot_chart(std::vector{lift}, arguments.picture, {.x_label = "angle of attack", .y_label = "lift coefficient"});
    }
    print_summary(polar_summary(conditions, rows), outputs);
}

void flow(const FlowArguments& arguments) {
    MeshCase mesh_case = case_of_inputs(arguments.inputs);
    for (const auto& [name, value] : arguments.walls)
        set_by_name(option_table<FarFieldOptions>(), name, value, mesh_case.options.far_field);
    for (const auto& [name, values] : arguments.geometry)
        set_by_name(option_table<GeometryOptions>(), name, values, mesh_case.options.geometry);
    require_any_body(mesh_case);
    require_consistent(mesh_case);
    FlowConditions conditions = mesh_case.options.conditions;
    for (const auto& [name, value] : arguments.conditions)
        set_by_name(option_table<FlowConditions>(), name, value, conditions);
    validate(conditions);
    const TransitionOptions transition = transition_options(arguments.transition);
    const std::vector<RunFile> outputs = files_written(arguments);
    require_distinct(files_of_case(mesh_case), outputs);
    for (const RunFile& output : outputs) check_folder_writable(output.path);
    for (const std::string& picture : {arguments.picture, arguments.mach_picture})
        if (!picture.empty()) check_picture_format(picture);
    if (!arguments.mach_picture.empty() && !conditions.mach)
        throw UsageError("option --mach-picture needs a Mach number (--mach)");
    const SignalGuard guard(outputs);

    CaseOptions& options = mesh_case.options;
    options.conditions = conditions;
    const Geometry geometry = read_geometry(mesh_case.inputs, options.geometry);
    print_warnings_of_reader(geometry);
    if (conditions.alphas) return write_flow_polar(arguments, options, transition, geometry, outputs);
    const FlowText text = flow_text(find_flow(geometry, options, transition), conditions.mach);
    if (!arguments.mach_picture.empty() && !text.compressible)
        throw UsageError(
            "option --mach-picture: at this Mach number the flow is slower than sound, but for short peaks");
    if (!arguments.table.empty()) write_file(arguments.table, text.table);
    if (!arguments.picture.empty())
        plot_chart(text.curves, arguments.picture,
                   {.x_label = "x", .y_label = "pressure coefficient", .y_downwards = true, .y_range = text.pressures});
    if (text.compressible && !arguments.mach_picture.empty())
        draw_mach_numbers(*text.compressible, arguments.mach_picture);
    print_summary(text.summary, outputs);
}

}  // namespace

void add_flow_command(CLI::App& app) {
    CLI::App* command = add_command(app, "flow", "compute the flow round airfoils, without a mesh");
    auto arguments = std::make_shared<FlowArguments>();
    add_option(*command, "INPUT", arguments->inputs, input_help);
    for (const char* name : {"transform", "sheet"})
        add_repeated_table_option(*command, option_table<GeometryOptions>(), name, arguments->geometry[name]);
    for (const char* name : {"alpha", "mach", "reynolds", "velocity", "viscosity", "chord"})
        add_table_option(*command, option_table<FlowConditions>(), name, arguments->conditions[name]);
    add_transition_options(*command, arguments->transition);
    for (const char* name : {"ground", "tunnel", "periodic"})
        add_table_option(*command, option_table<FarFieldOptions>(), name, arguments->walls[name]);
    add_option(*command, "-o,--output", arguments->table,
               "CSV file to write: speed, pressure and boundary layer along each side, or pressure, "
               "Mach number and boundary layer where it is faster than sound; of a range of angles the polar, as "
               "XFOIL writes it, or .csv or .json; - for standard output")
        .type_name("FILE");
    add_option(*command, "--picture", arguments->picture,
               "picture of the pressure coefficients, or of a polar's lift, to write; its extension says the "
               "format: .png, "
               ".svg or .pdf")
        .type_name("FILE");
    add_option(*command, "--mach-picture", arguments->mach_picture,
               "picture of the Mach numbers round the bodies to write, where the flow is faster than sound: .png, "
               ".svg or .pdf")
        .type_name("FILE");
    run_with(*command, [arguments] { flow(*arguments); });
}

}  // namespace lamina::app
