// lamina sizes: the edge lengths that a solution asks for.
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/solution.hpp>
#include <lamina/solution_sizes.hpp>

#include "app/case.hpp"
#include "app/case_inputs.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct SizesArguments {
    std::string solution, mesh, case_file, velocity, output;
    std::vector<std::string> fields;
    std::map<std::string, std::string> options;  ///< values by the names of option_table<SolutionSizeOptions>()
};

/// Returns what is known of the flow along walls, by the conditions of a case. Throws UsageError where it has no
/// Reynolds number.
WallFlowOptions wall_flow_of(const std::string& velocity, const MeshCase& mesh_case) {
    const CaseOptions options = options_with_files(mesh_case);
    const ReferenceConditions conditions =
        reference_conditions(options.conditions, read_geometry(mesh_case.inputs, options.geometry));
    if (!conditions.reynolds) throw UsageError("option --velocity needs a case with a Reynolds number");
    return {velocity, conditions.chord / *conditions.reynolds};
}

/// Returns the function that makes the next mesh by a case file, and counts its vertices.
VertexCount count_by_case(const MeshCase& mesh_case) {
    const CaseOptions options = options_with_files(mesh_case);
    auto geometry = std::make_shared<const Geometry>(read_geometry(mesh_case.inputs, options.geometry));
    return [options, geometry](const SizedMesh& sizes) {
        CaseOptions next = options;
        next.sizing.background = std::make_shared<const SizedMesh>(sizes);
        return generate_mesh(*geometry, next).mesh.points.size();
    };
}

std::string sizes_summary(const SolutionSizes& made, const SizesArguments& arguments,
                          const SolutionSizeOptions& options, bool regions_known) {
    const auto [low, high] = std::minmax_element(made.sizes.sizes.begin(), made.sizes.sizes.end());
    std::string text = fmt::format("sizes from {}: {}\n", arguments.solution, fmt::join(arguments.fields, ", "));
    text += summary_line(
        "solution", fmt::format("{} vertices, {} of them inside the layer{}", made.vertices_before, made.layer_vertices,
                                regions_known ? "" : ", by the shapes of cells: VTU files of lamina (--mesh) know it"));
    for (std::size_t i = 0; i < made.errors.size(); ++i)
        text += summary_line("error", fmt::format("{:.4g} in {}: estimate for linear interpolation beyond the layer, "
                                                  "in the norm L^{}",
                                                  made.errors[i], arguments.fields[i], options.norm));
    text += summary_line(
        "next",
        fmt::format("{} vertices, where {:.0f} are wanted ({}, {} rounds)", made.vertices, options.vertices,
                    arguments.case_file.empty() ? "with the layers of the solution's mesh" : "with those of the case",
                    made.rounds));
    text += summary_line("sizes", fmt::format("from {:.4g} to {:.4g} units of the input, growing by {} per unit", *low,
                                              *high, *made.sizes.gradation));
    return text + summary_line("wrote", arguments.output);
}

/// Returns the files that a solution consists of: a VTU file, or OpenFOAM's folders of fields and of the mesh.
std::vector<RunFile> files_of_solution(const SizesArguments& arguments) {
    std::vector<RunFile> files{{arguments.solution, "SOLUTION"}};
    const auto add = [&](const std::vector<RunFile>& more) { files.insert(files.end(), more.begin(), more.end()); };
    add(files_in(arguments.solution, "SOLUTION"));
    if (!arguments.mesh.empty())
        add(files_of_mesh(arguments.mesh, ""));
    else if (std::filesystem::is_directory(arguments.solution))
        add(files_of_mesh(path_behind_links(arguments.solution).parent_path().string(), "openfoam"));
    return files;
}

void sizes(const SizesArguments& arguments) {
    SolutionSizeOptions options;
    for (const auto& [name, value] : arguments.options)
        set_by_name(option_table<SolutionSizeOptions>(), name, value, options);
    validate(options);
    std::vector<RunFile> inputs = files_of_solution(arguments);
    std::optional<MeshCase> mesh_case;
    if (!arguments.case_file.empty()) {
        mesh_case = case_of_inputs({arguments.case_file});
        require_consistent(*mesh_case);
        if (mesh_case->options.vertices || mesh_case->options.cells)
            throw OptionError(mesh_case->options.vertices ? "vertices" : "cells",
                              "the sizes decide how many there are: leave the option out of the case file");
        const std::vector<RunFile> of_case = files_of_case(*mesh_case);
        inputs.insert(inputs.end(), of_case.begin(), of_case.end());
    }
    const std::vector<RunFile> outputs{{arguments.output, "option --output"}};
    require_distinct(inputs, outputs);
    check_folder_writable(arguments.output);
    VertexCount count;
    std::vector<std::string> fields = arguments.fields;
    if (mesh_case) {
        count = count_by_case(*mesh_case);
        options.keep_borders = false;
    }
    if (!arguments.velocity.empty()) {
        options.walls = wall_flow_of(arguments.velocity, *mesh_case);
        for (const std::string& component : options.walls->components()) fields.push_back(component);
    }
    const SignalGuard guard(outputs);
    const Solution solution = read_solution(arguments.solution, fields, arguments.mesh);
    const SolutionSizes made = solution_sizes(solution, options, count);
    write_sizes(made.sizes, arguments.output);
    print_summary(sizes_summary(made, arguments, options, !solution.mesh.region.empty()), outputs);
}

}  // namespace

void add_sizes_command(CLI::App& app) {
    CLI::App* command = add_command(app, "sizes", "find the edge lengths that a solution asks for");
    auto arguments = std::make_shared<SizesArguments>();
    add_option(*command, "SOLUTION", arguments->solution,
               "VTU file with point data or cell data, CGNS file with values at vertices, restart file of SU2, "
               "or folder of "
               "an OpenFOAM case or of one of its times")
        .required();
    add_option(*command, "--mesh", arguments->mesh,
               "mesh of the solution, in any format that can be read; else that of SOLUTION")
        .type_name("FILE");
    add_option(*command, "--field", arguments->fields,
               "fields to interpolate well: NAME, a component such as U:x, or the length of vectors, mag(U)")
        .required()
        .delimiter(',')
        .type_name("NAME[,NAME...]");
    for (const char* name : {"vertices", "norm", "gradation", "max-change"})
        add_table_option(*command, option_table<SolutionSizeOptions>(), name, arguments->options[name]);
    option_of(*command, "--vertices").required();
    add_option(*command, "--case", arguments->case_file,
               "case file of the next mesh (lamina mesh --dump-config), which is made to count its vertices; "
               "sizes may then divide the borders of layers, too; else the layers are those of the solution")
        .type_name("FILE");
    add_option(*command, "--velocity", arguments->velocity,
               "vectors of velocity or momentum: walls get spacings, first heights and layers by the solution, too")
        .type_name("NAME")
        .needs("--case");
    add_option(*command, "-o,--output", arguments->output,
               "VTU file to write, for lamina mesh --background; - for standard output")
        .required()
        .type_name("FILE");
    run_with(*command, [arguments] { sizes(*arguments); });
}

}  // namespace lamina::app
