#include "app/morph_run.hpp"

#include <cstddef>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>
#include <lamina/pipeline.hpp>
#include <lamina/remesh.hpp>

#include "app/case.hpp"
#include "app/case_inputs.hpp"
#include "app/check_report.hpp"
#include "app/mesh_run.hpp"
#include "app/morph_sequence.hpp"
#include "app/options.hpp"
#include "app/progress.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

bool is_case_to_morph(const std::string& file) { return file.ends_with(".toml"); }

MeshCase case_to_morph(const std::string& file) {
    MeshCase mesh_case = case_of_inputs({file});
    require_whole(mesh_case);
    require_straight(mesh_case);
    require_consistent(mesh_case);
    return mesh_case;
}

/// Reads the mesh, or makes that of a case file.
Mesh reference_mesh(const MorphSettings& settings) {
    if (is_case_to_morph(settings.mesh)) {
        const MeshCase mesh_case = case_to_morph(settings.mesh);
        return generate_mesh(mesh_case.inputs, options_with_files(mesh_case)).mesh;
    }
    return read_valid_mesh(settings.mesh, settings.mesh_format);
}

/// Returns where the wall vertices go.
std::vector<Point> wall_targets(const MorphMap& map, const MorphSettings& settings) {
    if (!settings.displacements.empty()) return displaced_wall_points(map, settings.displacements);
    if (settings.shapes.empty()) return moved_wall_points(map, settings.geometry.transformations);
    return wall_points_on(map, read_geometry(settings.shapes, settings.geometry));
}

std::string morph_summary(const MorphSettings& settings, const MorphResult& result, const MorphReport& report) {
    std::string text = fmt::format("{} morphed: {} vertices\n", input_name(settings.mesh), result.points.size());
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
    return text + summary_line("wrote", settings.output);
}

/// Throws UsageError unless the settings say in one way where the walls go.
void require_one_way(const MorphSettings& settings) {
    const bool by_shape = !settings.shapes.empty() || !settings.geometry.transformations.empty();
    if (by_shape + !settings.displacements.empty() + !settings.sequence.turns.empty() != 1)
        throw UsageError("give --to SHAPE..., --transform, or both, or else --displacements or --sequence");
}

std::vector<RunFile> files_to_read(const MorphSettings& settings) {
    std::vector<RunFile> files = is_case_to_morph(settings.mesh) ? files_of_case(case_to_morph(settings.mesh))
                                                                 : files_of_mesh(settings.mesh, settings.mesh_format);
    for (const std::string& shape : settings.shapes)
        if (!shape.starts_with("naca:")) files.push_back({shape, "option --to"});
    if (!settings.displacements.empty()) files.push_back({settings.displacements, "option --displacements"});
    return files;
}

void require_files(const MorphSettings& settings) {
    if (!is_case_to_morph(settings.mesh)) require_format(settings.mesh, settings.mesh_format, "--input-format");
    require_format(settings.output, settings.write.format, "--format");
    if (!settings.report.empty()) check_folder_writable(settings.report);
}

/// Writes the meshes of all times.
void run_sequence(const MorphSettings& settings) {
    require_files(settings);
    const MorphSequence sequence = plan_sequence(settings.sequence, settings.output, settings.write);
    std::vector<RunFile> outputs = sequence.outputs;
    if (!settings.report.empty()) outputs.push_back({settings.report, "option --report"});
    require_distinct(files_to_read(settings), outputs);
    const SignalGuard guard(outputs);
    const Mesh reference = reference_mesh(settings);
    const MorphMap map(reference);
    const Json report = write_sequence(map, sequence, settings.morph);
    if (!settings.report.empty()) write_file(settings.report, to_text(report));
    print_summary(sequence_summary(input_name(settings.mesh), report, settings.output), outputs);
}

}  // namespace

void run_morph(const MorphSettings& settings) {
    require_one_way(settings);
    if (!settings.sequence.turns.empty()) return run_sequence(settings);
    require_files(settings);
    check_writable(settings.output, settings.write);
    std::vector<RunFile> outputs = files_of_output(settings.output, settings.write);
    if (!settings.report.empty()) outputs.push_back({settings.report, "option --report"});
    require_distinct(files_to_read(settings), outputs);
    const SignalGuard guard(outputs);

    const Mesh reference = reference_mesh(settings);
    const MorphMap map(reference);
    const MorphResult result = morph(map, wall_targets(map, settings), settings.morph);
    Mesh morphed = reference;
    morphed.points = result.points;
    if (settings.reconnect) morphed = reconnect(morphed);
    const MorphReport report = compare_morphed(map, morphed);
    print_warnings(lost_marker_warnings(reference.markers, settings.output, settings.write));
    write_mesh(morphed, settings.output, settings.write);
    if (!settings.report.empty()) write_file(settings.report, to_text(morph_json(result, report)));
    print_summary(morph_summary(settings, result, report), outputs);
}

}  // namespace lamina::app
