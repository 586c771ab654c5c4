// lamina morph: the same mesh round other shapes.
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/morph.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/remesh.hpp>

#include "app/case.hpp"
#include "app/case_inputs.hpp"
#include "app/check_report.hpp"
#include "app/commands.hpp"
#include "app/format_help.hpp"
#include "app/mesh_run.hpp"
#include "app/morph_sequence.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"
#include "app/table_option.hpp"

namespace lamina::app {

namespace {

struct MorphArguments {
    std::string mesh, mesh_format, displacements, output, report;
    std::vector<std::string> shapes, transformations;
    SequenceArguments sequence;
    WriteOptions options;
    MorphOptions morph;
    bool reconnect = false;
};

bool is_case_to_morph(const std::string& file) { return file.ends_with(".toml"); }

MeshCase case_to_morph(const std::string& file) {
    MeshCase mesh_case = case_of_inputs({file});
    require_whole(mesh_case);
    require_straight(mesh_case);
    require_consistent(mesh_case);
    return mesh_case;
}

/// Reads the mesh, or makes that of a case file.
Mesh reference_mesh(const MorphArguments& arguments) {
    if (is_case_to_morph(arguments.mesh)) {
        const MeshCase mesh_case = case_to_morph(arguments.mesh);
        return generate_mesh(mesh_case.inputs, options_with_files(mesh_case)).mesh;
    }
    return read_valid_mesh(arguments.mesh, arguments.mesh_format);
}

/// Returns where the wall vertices go.
std::vector<Point> wall_targets(const MorphMap& map, const MorphArguments& arguments, const GeometryOptions& options) {
    if (!arguments.displacements.empty()) return displaced_wall_points(map, arguments.displacements);
    if (arguments.shapes.empty()) return moved_wall_points(map, options.transformations);
    return wall_points_on(map, read_geometry(arguments.shapes, options));
}

std::string morph_summary(const MorphArguments& arguments, const MorphResult& result, const MorphReport& report) {
    std::string text = fmt::format("{} morphed: {} vertices\n", input_name(arguments.mesh), result.points.size());
    if (result.stop)
        text += summary_line("motion", fmt::format("{:.3g} % of it: beyond that, {} at ({:.6g}, {:.6g}) turns over",
                                                   100 * result.fraction, result.stop->description, result.stop->at.x,
                                                   result.stop->at.y));
    text +=
        summary_line("heights", fmt::format("of first cells change by at most {:.2g} %, at ({:.6g}, {:.6g})",
                                            100 * report.max_first_height_change, report.max_first_height_change_at.x,
                                            report.max_first_height_change_at.y));
    const auto change = [](const char* what, double before, double after) {
        return fmt::format("{} {:.4g} before, {:.4g} after", what, before, after);
    };
    text += summary_line(
        "angles", change("smallest", report.before.min_angle_deg, report.after.min_angle_deg) +
                      change("; mean smallest", report.before.mean_min_angle_deg, report.after.mean_min_angle_deg));
    text += summary_line(
        "Jacobian", change("smallest, scaled:", report.before.min_scaled_jacobian, report.after.min_scaled_jacobian));
    return text + summary_line("wrote", arguments.output);
}

/// Throws UsageError unless the arguments say in one way where the walls go.
void require_one_way(const MorphArguments& arguments) {
    const bool by_shape = !arguments.shapes.empty() || !arguments.transformations.empty();
    if (by_shape + !arguments.displacements.empty() + !arguments.sequence.turns.empty() != 1)
        throw UsageError("give --to SHAPE..., --transform, or both, or else --displacements or --sequence");
}

std::vector<RunFile> files_to_read(const MorphArguments& arguments) {
    std::vector<RunFile> files = is_case_to_morph(arguments.mesh)
                                     ? files_of_case(case_to_morph(arguments.mesh))
                                     : files_of_mesh(arguments.mesh, arguments.mesh_format);
    for (const std::string& shape : arguments.shapes)
        if (!shape.starts_with("naca:")) files.push_back({shape, "option --to"});
    if (!arguments.displacements.empty()) files.push_back({arguments.displacements, "option --displacements"});
    return files;
}

void require_files(const MorphArguments& arguments) {
    if (!is_case_to_morph(arguments.mesh)) require_format(arguments.mesh, arguments.mesh_format, "--input-format");
    require_format(arguments.output, arguments.options.format, "--format");
    if (!arguments.report.empty()) check_folder_writable(arguments.report);
}

/// Writes the meshes of all times.
void run_sequence(const MorphArguments& arguments) {
    require_files(arguments);
    const MorphSequence sequence = plan_sequence(arguments.sequence, arguments.output, arguments.options);
    std::vector<RunFile> outputs = sequence.outputs;
    if (!arguments.report.empty()) outputs.push_back({arguments.report, "option --report"});
    require_distinct(files_to_read(arguments), outputs);
    const SignalGuard guard(outputs);
    const Mesh reference = reference_mesh(arguments);
    const MorphMap map(reference);
    const Json report = write_sequence(map, sequence, arguments.morph);
    if (!arguments.report.empty()) write_file(arguments.report, to_text(report));
    print_summary(sequence_summary(input_name(arguments.mesh), report, arguments.output), outputs);
}

void run_morph(const MorphArguments& arguments) {
    require_one_way(arguments);
    if (!arguments.sequence.turns.empty()) return run_sequence(arguments);
    GeometryOptions geometry;
    set_by_name(option_table<GeometryOptions>(), "transform", arguments.transformations, geometry);
    require_files(arguments);
    check_writable(arguments.output, arguments.options);
    std::vector<RunFile> outputs = files_of_output(arguments.output, arguments.options);
    if (!arguments.report.empty()) outputs.push_back({arguments.report, "option --report"});
    require_distinct(files_to_read(arguments), outputs);
    const SignalGuard guard(outputs);

    const Mesh reference = reference_mesh(arguments);
    const MorphMap map(reference);
    const MorphResult result = morph(map, wall_targets(map, arguments, geometry), arguments.morph);
    Mesh morphed = reference;
    morphed.points = result.points;
    if (arguments.reconnect) morphed = reconnect(morphed);
    const MorphReport report = compare_morphed(map, morphed);
    print_warnings(lost_marker_warnings(reference.markers, arguments.output, arguments.options));
    write_mesh(morphed, arguments.output, arguments.options);
    if (!arguments.report.empty()) write_file(arguments.report, to_text(morph_json(result, report)));
    print_summary(morph_summary(arguments, result, report), outputs);
}

}  // namespace

void add_morph_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("morph", "move a mesh to other shapes of its bodies, with the same cells");
    auto arguments = std::make_shared<MorphArguments>();
    command->add_option("MESH", arguments->mesh, "mesh file, or a case file (.toml), whose mesh is made first")
        ->required();
    add_input_format(*command, arguments->mesh_format);
    command
        ->add_option(
            "--to", arguments->shapes,
            "airfoil files or naca:DIGITS, one for each body, in the order of the bodies of the mesh; vertices "
            "keep their shares of the arc length between corners")
        ->type_name("SHAPE...");
    add_repeated_table_option(*command, option_table<GeometryOptions>(), "transform", arguments->transformations)
        ->description("change the bodies, which are named by their markers, or the shapes of --to: as for lamina mesh");
    command
        ->add_option("--displacements", arguments->displacements,
                     "CSV file with a line 'vertex,dx,dy' for each wall vertex that moves, numbered as --wall-data of "
                     "lamina mesh does")
        ->type_name("FILE");
    command
        ->add_option(
            "--sequence", arguments->sequence.turns,
            "bodies that turn as time goes on: ELEMENT:pitch:MEAN:AMPLITUDE:FREQUENCY[:X,Y] by mean + amplitude "
            "sin(2 pi frequency time), or ELEMENT:deflect:DEG:DURATION[:X,Y] from rest to rest; degrees, nose up, "
            "about the origin or X,Y; may be given several times. NEW is a case of OpenFOAM or, with --format su2 "
            "where the whole mesh pitches, of SU2, or holds {step}")
        ->type_name("TURN")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    command
        ->add_option("--until", arguments->sequence.until,
                     "time at which the sequence ends; else the longest period or duration")
        ->needs("--sequence")
        ->type_name("TIME");
    command->add_option("--steps", arguments->sequence.steps, "number of times of the sequence after the first one")
        ->check(CLI::Range(1, 100'000))
        ->needs("--sequence")
        ->capture_default_str()
        ->type_name("N");
    command->add_flag("--as-far-as-possible", arguments->morph.as_far_as_possible,
                      "write a mesh that gets only a part of the way, since a cell would turn over beyond it");
    command->add_flag("--incremental", arguments->morph.incremental,
                      "where a cell would turn over, go on from a mesh half as far, in as many steps as it takes");
    command
        ->add_flag(
            "--reconnect", arguments->reconnect,
            "swap diagonals and move vertices beyond the layer afterwards, where triangles get better: the cells are "
            "no longer those of MESH")
        ->excludes("--sequence");
    command->add_option("-o,--output", arguments->output, "mesh file to write")->required()->type_name("NEW");
    command->add_option("--format", arguments->options.format, "format of NEW")->type_name(format_names());
    command->add_option("--report", arguments->report, "JSON file to write: the quality before and after")
        ->type_name("FILE");
    command->footer(format_help());
    command->callback([arguments] { run_morph(*arguments); });
}

}  // namespace lamina::app
