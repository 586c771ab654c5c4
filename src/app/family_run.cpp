// Similar meshes in one run, for a study of convergence.
#include "app/family_run.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/pipeline.hpp>

#include "app/case_inputs.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "core/option_builders.hpp"

namespace lamina::app {

namespace {

/// What stands for the number of the level in names of files.
const std::string level_mark = "{level}";

constexpr int most_levels = 12;

/// One mesh of the family: what is asked for, and what was made.
struct Member {
    int level;
    double divisor;  ///< lengths are those of the given options divided by this
    MeshCase mesh_case;
    std::size_t vertices = 0, cells = 0, wall_edges = 0;
    double h = 0;  ///< the root of the area per cell
    std::vector<double> first_heights{};
};

std::string at_level(std::string text, int level) {
    for (std::size_t at = 0; (at = text.find(level_mark, at)) != std::string::npos;)
        text.replace(at, level_mark.size(), std::to_string(level));
    return text;
}

/// Throws UsageError where several levels would be written to one file.
void require_level_mark(const std::string& file, const std::string& option) {
    if (file.find(level_mark) == std::string::npos)
        throw UsageError(fmt::format("option {}: '{}' must hold {}, which stands for the number of the level", option,
                                     file, level_mark));
}

void require_level_marks(const MeshCase& mesh_case) {
    for (const std::string& output : mesh_case.outputs) require_level_mark(output, "--output");
    for (const auto& [name, option] : files_beside_mesh)
        if (!(mesh_case.*name).empty()) require_level_mark(mesh_case.*name, option);
}

MeshCase case_of_level(MeshCase mesh_case, int level) {
    for (std::string& output : mesh_case.outputs) output = at_level(output, level);
    for (const auto& [name, option] : files_beside_mesh) mesh_case.*name = at_level(mesh_case.*name, level);
    return mesh_case;
}

void require_arguments(const FamilyArguments& arguments) {
    require_in_range(numbers_from_to(1, most_levels), arguments.levels, "option --levels");
    require_in_range(numbers_above_up_to(1, 10), arguments.ratio, "option --ratio");
    if (arguments.base_level)
        require_in_range(numbers_from_to(0, arguments.levels - 1), *arguments.base_level, "option --base-level");
}

std::string table_file(const FamilyArguments& arguments, const MeshCase& mesh_case) {
    if (!arguments.table.empty()) return arguments.table;
    const std::string& output = mesh_case.outputs.front();
    return output.substr(0, output.find(level_mark)) + "family.csv";
}

/// Makes and writes the mesh of one level.
void make_member(const Geometry& geometry, const DestinationOfLevel& destination_of_level, ProgressPrinter& progress,
                 Member& member, std::size_t& warnings) {
    MeshResult result =
        generate_mesh(geometry, member.mesh_case.options, [&](const auto& event) { progress.begin(event); });
    const MeshDestination destination = destination_of_level(member.mesh_case);
    report_warnings(member.mesh_case, destination, result);
    warnings += result.warnings.size();
    progress.begin({"writing"});
    write_outputs(member.mesh_case, destination, result);
    member.vertices = result.mesh.points.size();
    member.cells = result.mesh.triangles.size() + result.mesh.quads.size();
    for (const Marker& marker : result.mesh.markers)
        if (marker.kind == MarkerKind::wall) member.wall_edges += marker.edges.size();
    member.h = std::sqrt(result.check.area / static_cast<double>(member.cells));
    member.first_heights = result.first_heights;
}

std::string family_table(const std::vector<Member>& members) {
    std::string text =
        "level,h,h_over_finest,cells_power_minus_half,lengths_divided_by,vertices,cells,wall_edges,"
        "first_height,growth,layers,file\n";
    for (const Member& member : members) {
        const LayerOptions& layer = member.mesh_case.options.layer;
        const auto& heights = member.first_heights;
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", member.level, member.h,
                            member.h / members.back().h, 1 / std::sqrt(static_cast<double>(member.cells)),
                            member.divisor, member.vertices, member.cells, member.wall_edges,
                            heights.empty() ? "" : fmt::format("{}", *std::min_element(heights.begin(), heights.end())),
                            layer.enabled ? fmt::format("{}", layer.growth) : "",
                            !layer.enabled ? "0"
                            : layer.layers ? fmt::format("{}", *layer.layers)
                                           : "auto",
                            member.mesh_case.outputs.front());
    }
    return text;
}

std::string family_summary(const std::vector<Member>& members, const std::string& table) {
    std::string text = fmt::format(
        "family of {} meshes; h is the root of the mean area of the cells\n  {:>5} {:>10} "
        "{:>10} {:>6} {:>10} {:>9} {:>12}  {}\n",
        members.size(), "level", "vertices", "cells", "wall", "h", "h/finest", "first height", "file");
    for (const Member& member : members) {
        const auto& heights = member.first_heights;
        text += fmt::format(
            "  {:>5} {:>10} {:>10} {:>6} {:>10.4g} {:>9.4f} {:>12}  {}\n", member.level, member.vertices, member.cells,
            member.wall_edges, member.h, member.h / members.back().h,
            heights.empty() ? "-" : fmt::format("{:.4g}", *std::min_element(heights.begin(), heights.end())),
            member.mesh_case.outputs.front());
    }
    return text + summary_line("wrote", table);
}

/// Returns ratio^power by products, so that every machine has the same bits.
double whole_power(double ratio, int power) {
    double product = 1;
    for (int k = 0; k < std::abs(power); ++k) product *= ratio;
    return power < 0 ? 1 / product : product;
}

/// Returns the members of the family, the coarsest first, none of them made.
std::vector<Member> plan_members(const FamilyArguments& arguments, const MeshCase& mesh_case,
                                 const Geometry& geometry) {
    const int base = arguments.base_level.value_or(arguments.levels / 2);
    CaseOptions options = options_with_files(mesh_case);
    // A number of vertices or cells is that of the base level.
    if (options.vertices || options.cells) {
        CaseOptions straight = options;  // which has the same vertices and cells
        straight.order = 1;
        options = with_scale(options, generate_mesh(geometry, straight).scale);
    }
    const ReferenceConditions conditions = reference_conditions(options.conditions, geometry);
    std::vector<Member> members;
    for (int level = 0; level < arguments.levels; ++level) {
        const double divisor = whole_power(arguments.ratio, level - base);
        members.push_back({level, divisor, case_of_level(mesh_case, level)});
        members.back().mesh_case.options = refined(options, divisor, conditions);
    }
    return members;
}

}  // namespace

void run_family(const FamilyArguments& arguments, const MeshCase& mesh_case,
                const DestinationOfLevel& destination_of_level) {
    require_arguments(arguments);
    require_consistent(mesh_case);
    require_whole(mesh_case);
    require_inputs(mesh_case);
    require_level_marks(mesh_case);
    const std::string table = table_file(arguments, mesh_case);
    std::vector<RunFile> outputs{{table, "option --table"}};
    for (int level = 0; level < arguments.levels; ++level) {
        const MeshCase at = case_of_level(mesh_case, level);
        const MeshDestination destination = destination_of_level(at);
        require_outputs(at, destination);
        const std::vector<RunFile> more = files_written(at, destination);
        outputs.insert(outputs.end(), more.begin(), more.end());
    }
    check_folder_writable(table);
    require_distinct(files_of_case(mesh_case), outputs);
    const SignalGuard guard(outputs);

    const Geometry geometry = read_geometry(mesh_case.inputs, mesh_case.options.geometry);
    std::vector<Member> members = plan_members(arguments, mesh_case, geometry);
    ProgressPrinter progress(mesh_case.progress, mesh_case.quiet);
    std::size_t warnings = 0;
    // The finest mesh comes first: what it asks too much of fails before anything is written.
    std::for_each(members.rbegin(), members.rend(),
                  [&](Member& member) { make_member(geometry, destination_of_level, progress, member, warnings); });
    write_file(table, family_table(members));
    if (!mesh_case.quiet) print_summary(family_summary(members, table), outputs);
    if (warnings > 0 && mesh_case.strict)
        throw MeshError(fmt::format("{} warnings, of which --strict allows none", warnings));
}

std::shared_ptr<FamilyArguments> add_family_options(CLI::App& command, int levels) {
    auto arguments = std::make_shared<FamilyArguments>(FamilyArguments{.levels = levels, .ratio = std::sqrt(2.0)});
    add_option(command, "--levels", arguments->levels,
               fmt::format("number of meshes; level 0 is the coarsest [{}]", levels))
        .group("Family")
        .type_name("N");
    add_option(command, "--ratio", arguments->ratio,
               "ratio of all lengths from one level to the next; with 2, two new layers lie in one old one "
               "[sqrt 2]")
        .group("Family")
        .type_name("R");
    add_option(command, "--base-level", arguments->base_level,
               "level with the lengths that the other options ask for; 0: all others are finer; N - 1: all "
               "others are coarser [N / 2, rounded down]")
        .group("Family")
        .type_name("LEVEL");
    add_option(command, "--table", arguments->table,
               "CSV file to write: h and counts of each level [the first output up to {level}, and family.csv]")
        .group("Family")
        .type_name("FILE");
    return arguments;
}

}  // namespace lamina::app
