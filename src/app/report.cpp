#include "app/report.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include <lamina/version.hpp>

#include "app/conditions_block.hpp"
#include "app/coverage_share.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

Json coverage_report(const LayerCoverage& coverage) {
    return {{"rays", coverage.rays},
            {"incomplete_rays", coverage.incomplete_rays},
            {"requested", coverage.requested_cells},
            {"made", coverage.made_cells},
            {"share", made_share(coverage)}};
}

Json coverage_report(const ElementCoverage& coverage) {
    Json report = coverage_report(coverage.all);
    report["open"] = coverage_report(coverage.open);
    return report;
}

Json layer_cells_report(const MeshResult& result) {
    Json report = coverage_report(total_coverage(result));
    report["elements"] = Json::array();
    for (std::size_t e = 0; e < result.layer_coverage.size(); ++e) {
        report["elements"].push_back(coverage_report(result.layer_coverage[e]));
        report["elements"].back()["name"] = result.geometry.elements[e].name;
    }
    for (const OuterWallLayer& wall : result.outer_walls) {
        Json& row = report["outer_walls"].emplace_back(coverage_report(wall.coverage));
        row["name"] = wall.name;
        row["first_height"] = wall.first_height;
    }
    return report;
}

Json input_report(const Geometry& geometry) {
    Json input = Json::array();
    for (const Element& element : geometry.elements) {
        input.push_back({{"name", element.name},
                         {"file", element.file},
                         {"format", element.format},
                         {"points", element.points.size()},
                         {"points_read", element.points_read},
                         {"repairs", element.repairs},
                         {"transformations", element.transformations},
                         {"surface", element.surface_notes}});
    }
    return input;
}

Json curved_report(const MeshResult& result) {
    const bool is_even = result.curved.distribution == NodeDistribution::equidistant;
    return {{"order", result.curved.order},
            {"node_distribution", is_even ? "equidistant" : "gauss-lobatto"},
            {"wall_edges", result.curving.wall_edges},
            {"curved_wall_edges", result.curving.curved_edges},
            {"reduced_wall_edges", result.curving.reduced_edges},
            {"reduced_distance", result.curving.reduced_distance},
            {"wall_distance", result.curving.wall_distance},
            {"min_scaled_jacobian", result.curved_check.min_scaled_jacobian},
            {"p01_scaled_jacobian", result.curved_check.p01_scaled_jacobian},
            {"min_scaled_jacobian_at",
             {result.curved_check.min_scaled_jacobian_at.x, result.curved_check.min_scaled_jacobian_at.y}},
            {"straight_min_scaled_jacobian", result.curving.straight_min_scaled_jacobian},
            {"seconds", result.seconds.curving}};
}

Json seconds_report(const StageSeconds& seconds, double write_seconds) {
    return {{"flow", seconds.flow},
            {"geometry", seconds.geometry},
            {"layers", seconds.layers},
            {"decomposition", seconds.decomposition},
            {"layer_triangulation", seconds.layer_triangulation},
            {"sizing", seconds.sizing},
            {"decoupling", seconds.decoupling},
            {"refinement", seconds.refinement},
            {"assembly", seconds.assembly},
            {"check", seconds.check},
            {"write", write_seconds},
            {"total", seconds.total + write_seconds}};
}

Json threads_report(const std::vector<ThreadSeconds>& threads) {
    Json report = {{"decomposition", Json::array()},
                   {"layer_triangulation", Json::array()},
                   {"refinement", Json::array()},
                   {"check", Json::array()}};
    for (const ThreadSeconds& thread : threads) {
        report["decomposition"].push_back({{"busy", thread.decomposition}});
        report["layer_triangulation"].push_back({{"busy", thread.layer_triangulation}});
        report["refinement"].push_back({{"busy", thread.refinement}, {"idle", thread.idle}});
        report["check"].push_back({{"busy", thread.check}});
    }
    return report;
}

Json first_heights_report(std::span<const FirstHeights> heights) {
    Json report = Json::array();
    for (const FirstHeights& on_marker : heights)
        report.push_back({{"marker", on_marker.marker},
                          {"cells", on_marker.cells},
                          {"median", on_marker.median},
                          {"share_of_kept", on_marker.share_of_kept}});
    return report;
}

Json walls_report(const WallSummary& walls) {
    return {{"edges", walls.edges},
            {"max_ratio", walls.max_ratio},
            {"max_ratio_at", {walls.max_ratio_at.x, walls.max_ratio_at.y}},
            {"uneven_vertices", walls.uneven_vertices},
            {"bare_edges", walls.bare_edges},
            {"first_cells", walls.first_cells},
            {"first_heights", first_heights_report(walls.first_heights)},
            {"median_first_height", walls.median_first_height},
            {"share_of_kept_heights", walls.share_of_kept_heights},
            {"worst_first_height", walls.worst_first_height},
            {"worst_first_height_at", {walls.worst_first_height_at.x, walls.worst_first_height_at.y}}};
}

Json forecast_report(const WallForecast& wall, double chord) {
    Json report = {{"element", wall.element},
                   {"first_height", both_units(wall.first_height, chord)},
                   {"thickness", both_units(wall.thickness, chord)},
                   {"y_plus", nullptr}};
    if (const auto& y_plus = wall.y_plus)
        report["y_plus"] = {{"smallest", y_plus->smallest}, {"median", y_plus->median}, {"largest", y_plus->largest}};
    return report;
}

Json border_report(const BorderSteps& steps) {
    return {{"columns", steps.columns},
            {"full_columns", steps.full_columns},
            {"uneven_columns", steps.uneven_columns},
            {"max_step", steps.max_step},
            {"max_step_at", {steps.max_step_at.x, steps.max_step_at.y}}};
}

}  // namespace

Json decomposition_report(const DecompositionStats& stats) {
    return {{"pieces", stats.pieces},
            {"piece_vertices", stats.piece_vertices},
            {"largest_piece_vertices", stats.largest_piece},
            {"rejected_cuts",
             {{"crossing", stats.crossing_cuts}, {"unbalanced", stats.unbalanced_cuts}, {"long", stats.long_cuts}}},
            {"uncut_pieces", stats.uncut},
            {"sequential_fallbacks", stats.fallbacks}};
}

Json warnings_report(std::span<const Warning> warnings) {
    Json report = Json::array();
    for (const Warning& warning : warnings) {
        report.push_back({{"code", warning_name(warning.code)},
                          {"element", warning.element},
                          {"at", nullptr},
                          {"number", warning.number},
                          {"unit", warning.unit},
                          {"message", warning.message}});
        if (const auto& at = warning.at) report.back()["at"] = {at->x, at->y};
    }
    return report;
}

Json estimate_report(const RunEstimate& estimate) {
    return {{"triangles", estimate.triangles}, {"memory_bytes", estimate.memory_bytes}, {"seconds", estimate.seconds}};
}

Json quality_report(const MeshCheck& check) {
    const QualitySummary& isotropic = check.isotropic;
    const QualitySummary& layer = check.layer;
    return {
        {"isotropic",
         {{"cells", isotropic.cells},
          {"min_angle_deg", isotropic.min_angle_deg},
          {"mean_min_angle_deg", isotropic.mean_min_angle_deg},
          {"max_angle_deg", isotropic.max_angle_deg},
          {"mean_ratio", isotropic.mean_ratio},
          {"share_below_40_deg", isotropic.share_below_40_deg},
          {"angles_below_bound", isotropic.angles_below_bound},
          {"exempt", isotropic.exempt},
          {"max_neighbour_area_ratio", isotropic.max_neighbour_area_ratio},
          {"p999_neighbour_area_ratio", isotropic.p999_neighbour_area_ratio},
          {"angle_histogram", isotropic.angle_histogram}}},
        {"layer",
         {{"cells", layer.cells},
          {"max_aspect_ratio", layer.max_aspect_ratio},
          {"max_angle_deg", layer.max_angle_deg},
          {"mean_max_angle_deg", layer.mean_max_angle_deg},
          {"max_neighbour_area_ratio", layer.max_neighbour_area_ratio},
          {"max_neighbour_area_ratio_at", {layer.max_neighbour_area_ratio_at.x, layer.max_neighbour_area_ratio_at.y}},
          {"edges_without_first_layer", check.edges_without_first_layer}}},
        {"walls", walls_report(check.walls)},
        {"transition",
         {{"edges", check.transition.edges},
          {"p01_area_ratio", check.transition.p01_area_ratio},
          {"median_area_ratio", check.transition.median_area_ratio},
          {"p99_area_ratio", check.transition.p99_area_ratio},
          {"p90_height_ratio", check.transition.p90_height_ratio}}},
        {"delaunay", {{"interior_edges", check.interior_edges}, {"violations", check.delaunay_violations}}}};
}

MeshFacts facts_of(const Mesh& mesh) {
    const auto first = mesh.region.begin();
    const auto end = first + static_cast<std::ptrdiff_t>(std::min(mesh.region.size(), mesh.triangles.size()));
    return {{mesh.points.size(), mesh.triangles.size(), mesh.quads.size(),
             static_cast<std::size_t>(std::count(first, end, Region::layer))},
            mesh_hash(mesh)};
}

Json mesh_report(const MeshCase& mesh_case, const MeshResult& result, const MeshFacts& facts, double write_seconds) {
    Json quality = quality_report(result.check);
    quality["layer"]["border"] = border_report(result.border_steps);
    quality["layer"]["incomplete_rays"] = total_coverage(result).all.incomplete_rays;
    quality["isotropic"]["oversized"] = result.refinement.oversized;
    quality["isotropic"]["refused_points"] = result.refinement.refused;
    quality["isotropic"]["mean_edge_over_size"] = result.mean_edge_over_size;
    Json report = {{"version", LAMINA_VERSION},
                   {"threads", result.threads},
                   {"input", input_report(result.geometry)},
                   {"conditions", conditions_report(mesh_case, result)},
                   {"vertices", facts.counts.vertices},
                   {"triangles", facts.counts.triangles},
                   {"quads", facts.counts.quads},
                   {"layer_triangles", facts.counts.layer_triangles},
                   {"isotropic_triangles", facts.counts.triangles - facts.counts.layer_triangles},
                   {"surface_vertices", result.surface_vertices},
                   {"scale", result.scale},
                   {"decomposition", decomposition_report(result.decomposition)},
                   {"pieces",
                    {{"layer", result.layer_pieces},
                     {"inviscid", result.inviscid_pieces},
                     {"largest_inviscid", result.largest_inviscid_piece},
                     {"estimates_within_15_percent", result.estimates_within_15_percent}}},
                   {"layer_cells", layer_cells_report(result)},
                   {"warnings", warnings_report(result.warnings)},
                   {"estimate", estimate_report(result.estimate)},
                   {"seconds", seconds_report(result.seconds, write_seconds)},
                   {"thread_seconds", threads_report(result.thread_seconds)},
                   {"quality", quality},
                   {"hash", facts.hash}};
    if (result.curved.order > 1) report["curved"] = curved_report(result);
    return report;
}

Json forecast_report(const MeshCase& mesh_case, const MeshForecast& forecast) {
    const MeshResult& result = forecast.result;
    Json walls = Json::array();
    for (const WallForecast& wall : forecast.walls) walls.push_back(forecast_report(wall, result.conditions.chord));
    return {{"version", LAMINA_VERSION},
            {"threads", result.threads},
            {"input", input_report(result.geometry)},
            {"conditions", conditions_report(mesh_case, result)},
            {"surface_vertices", result.surface_vertices},
            {"scale", result.scale},
            {"forecast",
             {{"vertices", forecast.vertices},
              {"layer_cells", forecast.layer_cells},
              {"cells_beyond", forecast.cells_beyond},
              {"walls", walls}}},
            {"layer_cells", layer_cells_report(result)},
            {"warnings", warnings_report(result.warnings)},
            {"estimate", estimate_report(result.estimate)},
            {"seconds", seconds_report(result.seconds, 0)}};
}

std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace lamina::app
