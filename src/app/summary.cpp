#include "app/summary.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "app/conditions_block.hpp"
#include "app/coverage_share.hpp"

namespace lamina::app {

namespace {

std::string isotropic_lines(const QualitySummary& isotropic, bool has_layer) {
    std::string text = summary_line(
        "isotropic",
        fmt::format(
            "{} cells{}: angles from {:.2f} to {:.2f} deg, mean smallest angle {:.2f} deg, {:.2f} % below 40 deg, "
            "mean ratio {:.3f}, areas of neighbours differ by a factor of at most {:.2f}",
            isotropic.cells, has_layer ? " outside the boundary layer" : "", isotropic.min_angle_deg,
            isotropic.max_angle_deg, isotropic.mean_min_angle_deg, 100 * isotropic.share_below_40_deg,
            isotropic.mean_ratio, isotropic.max_neighbour_area_ratio));
    std::string below_bound =
        fmt::format("{} isotropic cells have an angle below the bound (--min-angle)", isotropic.angles_below_bound);
    if (isotropic.exempt > 0)
        below_bound += fmt::format("; {} of them lie in sharp corners, where no mesh can keep it", isotropic.exempt);
    return text + summary_line("angles", below_bound);
}

std::string layer_lines(const MeshCheck& check) {
    const QualitySummary& layer = check.layer;
    std::string text = summary_line(
        "layer",
        fmt::format("{} cells in the boundary layer: aspect ratios up to {:.4g}, angles up to {:.2f} deg, mean "
                    "largest angle {:.2f} deg",
                    layer.cells, layer.max_aspect_ratio, layer.max_angle_deg, layer.mean_max_angle_deg));
    const Point at = layer.max_neighbour_area_ratio_at;
    text += summary_line("layer", fmt::format("areas of neighbours differ by a factor of at most {:.4g}, at ({:.6g}, "
                                              "{:.6g})",
                                              layer.max_neighbour_area_ratio, at.x, at.y));
    if (check.edges_without_first_layer > 0)
        text += summary_line("layer", fmt::format("the first height is not kept on {} wall edges (--layer-topology "
                                                  "layered or quads keeps it on all)",
                                                  check.edges_without_first_layer));
    return text;
}

/// Returns the median height of first cells, or those of each marker where they differ.
std::string median_heights(const WallSummary& walls) {
    const auto [least, most] =
        std::minmax_element(walls.first_heights.begin(), walls.first_heights.end(),
                            [](const FirstHeights& a, const FirstHeights& b) { return a.median < b.median; });
    if (most->median <= (1 + first_height_tolerance) * least->median)
        return fmt::format("{:.4g} high (median)", walls.median_first_height);
    std::string text;
    for (const FirstHeights& heights : walls.first_heights)
        text += fmt::format("{}{:.4g} ({})", text.empty() ? "" : ", ", heights.median, heights.marker);
    return text + " high (medians)";
}

std::string wall_lines(const WallSummary& walls) {
    std::string text = summary_line(
        "walls", fmt::format("{} edges: neighbours differ in length by a factor of at most {:.2f}, at ({:.6g}, {:.6g})",
                             walls.edges, walls.max_ratio, walls.max_ratio_at.x, walls.max_ratio_at.y));
    if (walls.bare_edges > 0)
        text += summary_line("walls", fmt::format("{} edges have no layer, as at ({:.6g}, {:.6g})", walls.bare_edges,
                                                  walls.bare_at.x, walls.bare_at.y));
    if (walls.first_cells == 0) return text;
    return text + summary_line("walls", fmt::format("first cells are {}, {:.2f} % of them within {} % "
                                                    "of the height wanted; the worst has {:.3f} of it",
                                                    median_heights(walls), 100 * walls.share_of_kept_heights,
                                                    100 * first_height_tolerance, walls.worst_first_height));
}

std::string element_lines(const Element& element) {
    std::string text = fmt::format("{}: {} points on the wall, from {} (format {})\n", element.name,
                                   element.points.size(), element.file, element.format);
    for (const std::string& repair : element.repairs) text += summary_line("repaired", repair);
    for (const std::string& change : element.transformations) text += summary_line("transformed", change);
    for (const std::string& note : element.surface_notes) text += summary_line("surface", note);
    return text;
}

/// Returns what makes neighbours differ less where rays fan out, if they differ much and no warning says why.
std::string fan_line(const MeshResult& result) {
    constexpr double much = 50;
    const bool is_warned_of = std::any_of(result.warnings.begin(), result.warnings.end(),
                                          [](const Warning& w) { return w.code == WarningCode::area_jump; });
    if (result.check.layer.max_neighbour_area_ratio <= much || is_warned_of) return {};
    return summary_line(
        "layer",
        fmt::format("the first cells round sharp corners are that much smaller than those on the wall beside them: "
                    "edges of two first heights even them out at trailing edges (--surface resample --spacing-te "
                    "{:.2g}), refining rays at other corners (--corners refine)",
                    2 * result.first_heights.front() / result.conditions.chord));
}

std::string coverage_line(const ElementCoverage& coverage) {
    const LayerCoverage& all = coverage.all;
    return summary_line(
        "coverage",
        fmt::format("{:.2f} % of the requested layer cells were made, {:.2f} % outside slots and coves; {} of "
                    "{} wall-normal rays are cut short for lack of room",
                    100 * made_share(all), 100 * made_share(coverage.open), all.incomplete_rays, all.rays));
}

std::string border_line(const BorderSteps& steps) {
    return summary_line("border", fmt::format("{:.2f} % of the columns of the layer differ at their ends by "
                                              "more than a third of a cell, the worst by {:.2f}",
                                              100 * static_cast<double>(steps.uneven_columns) /
                                                  static_cast<double>(std::max<std::size_t>(1, steps.columns)),
                                              steps.max_step));
}

/// Returns what a summary says before the mesh: of the inputs, and of the options in force.
std::string given_lines(const MeshCase& mesh_case, const MeshResult& result) {
    std::string text;
    for (const Element& element : result.geometry.elements) text += element_lines(element);
    return text + conditions_summary(mesh_case, result);
}

/// Returns the line on the scale that a number of vertices or cells asked for.
std::string scale_line(const CaseOptions& options, double scale) {
    if (!options.vertices && !options.cells) return "";
    return summary_line(
        "scale", fmt::format("{:.4g}, found for the number of {}", scale, options.vertices ? "vertices" : "cells"));
}

/// Returns the lines on the columns of the layer; empty without one.
std::string coverage_lines(const MeshResult& result) {
    const ElementCoverage coverage = total_coverage(result);
    return coverage.all.requested_cells > 0 ? coverage_line(coverage) + border_line(result.border_steps) : "";
}

std::string wrote_line(const std::string& file) {
    return summary_line("wrote", file == "-" ? "standard output" : file);
}

std::string wall_line(const WallForecast& wall, double chord) {
    std::string text = summary_line("thickness", fmt::format("{:.4g} chords, {:.4g} units of the input at most on {}",
                                                             wall.thickness / chord, wall.thickness, wall.element));
    if (const auto& y_plus = wall.y_plus)
        text += summary_line("y+", fmt::format("{:.3g} to {:.3g} along {}, {:.3g} in the middle of its length",
                                               y_plus->smallest, y_plus->largest, wall.element, y_plus->median));
    return text;
}

}  // namespace

std::string summary_line(const std::string& label, const std::string& text) {
    return fmt::format("  {:<11} {}\n", label, text);
}

std::string quality_summary(const MeshCheck& check) {
    std::string text;
    const bool has_layer = check.layer.cells > 0;
    if (check.isotropic.cells > 0) text += isotropic_lines(check.isotropic, has_layer);
    if (has_layer) text += layer_lines(check);
    if (check.walls.edges > 0) text += wall_lines(check.walls);
    if (const TransitionSummary& transition = check.transition; transition.edges > 0)
        text += summary_line(
            "transition",
            fmt::format("area ratio between the last layer cell and the first outer cell (ideal 1): "
                        "{:.2f} (1st percentile), {:.2f} (median), {:.2f} (99th percentile); the outer cell is {:.2f} "
                        "times as high (90th percentile)",
                        transition.p01_area_ratio, transition.median_area_ratio, transition.p99_area_ratio,
                        transition.p90_height_ratio));
    return text + summary_line("delaunay",
                               fmt::format("{} of {} edges between isotropic triangles violate the Delaunay property",
                                           check.delaunay_violations, check.interior_edges));
}

std::string curved_line(unsigned order, const CurvedCheck& check) {
    const std::string verdict = check.valid()
                                    ? "each proved valid"
                                    : fmt::format("{} invalid and {} not proved valid", check.invalid, check.unproved);
    return summary_line("curved",
                        fmt::format("cells of order {}, {}; scaled Jacobian at least {:.3f} at ({:.6g}, {:.6g}), "
                                    "1st percentile {:.2f}",
                                    order, verdict, check.min_scaled_jacobian, check.min_scaled_jacobian_at.x,
                                    check.min_scaled_jacobian_at.y, check.p01_scaled_jacobian));
}

std::string mesh_summary(const MeshCase& mesh_case, const MeshResult& result, const MeshCounts& counts,
                         double write_seconds) {
    std::string text = given_lines(mesh_case, result);
    text += fmt::format("mesh: {} vertices, {} triangles, {}made in {} pieces\n", counts.vertices, counts.triangles,
                        counts.quads > 0 ? fmt::format("{} quads, ", counts.quads) : "",
                        result.layer_pieces + result.inviscid_pieces);
    text += scale_line(mesh_case.options, result.scale);
    text += quality_summary(result.check);
    if (result.curved.order > 1)
        text += curved_line(result.curved.order, result.curved_check) +
                summary_line(
                    "walls",
                    fmt::format("{} of {} edges within {:.2g} of the curve, {} of smaller bend within {:.2g}",
                                result.curving.curved_edges, result.curving.wall_edges, result.curving.wall_distance,
                                result.curving.reduced_edges, result.curving.reduced_distance));
    text += fan_line(result) + coverage_lines(result);
    text += summary_line(
        "time", fmt::format("{:.3f} s to make and check the mesh, {:.3f} s to write it, on {} thread{}",
                            result.seconds.total, write_seconds, result.threads, result.threads == 1 ? "" : "s"));
    std::vector<std::string> files = mesh_case.outputs;
    for (const FileBesideMesh& beside : files_beside_mesh)
        if (const std::string& name = mesh_case.*beside.name; !name.empty()) files.push_back(name);
    for (const std::string& file : files) text += wrote_line(file);
    return text;
}

std::string forecast_summary(const MeshCase& mesh_case, const MeshForecast& forecast) {
    const MeshResult& result = forecast.result;
    std::string text = given_lines(mesh_case, result);
    text += fmt::format("forecast: about {:.0f} vertices, {:.0f} cells in the layer, about {:.0f} beyond it\n",
                        forecast.vertices, forecast.layer_cells, forecast.cells_beyond);
    text += scale_line(mesh_case.options, result.scale);
    for (const WallForecast& wall : forecast.walls) text += wall_line(wall, result.conditions.chord);
    text += coverage_lines(result);
    text += summary_line("estimate", estimate_text(result.estimate));
    text += summary_line("time", fmt::format("{:.3f} s without a mesh", result.seconds.total));
    if (!mesh_case.report.empty()) text += wrote_line(mesh_case.report);
    return text;
}

std::string traffic_line(unsigned processes, const RankTraffic& traffic, std::size_t pieces) {
    const auto each = static_cast<double>(traffic.bytes) / static_cast<double>(std::max<std::size_t>(pieces, 1));
    return summary_line("processes", fmt::format("{}, which sent {} messages of {} bytes in all: {:.0f} bytes a piece",
                                                 processes, traffic.messages, traffic.bytes, each));
}

}  // namespace lamina::app
