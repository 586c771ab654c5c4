#include "app/report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include <lamina/version.hpp>

namespace lamina::app {

namespace {

std::size_t triangles_in(const Mesh& mesh, Region region) {
    const auto first = mesh.region.begin();
    const auto end = first + static_cast<std::ptrdiff_t>(std::min(mesh.region.size(), mesh.triangles.size()));
    return static_cast<std::size_t>(std::count(first, end, region));
}

double made_share(const LayerCoverage& coverage) {
    if (coverage.requested_cells == 0) return 1;
    return static_cast<double>(coverage.made_cells) / static_cast<double>(coverage.requested_cells);
}

ElementCoverage total_coverage(const MeshResult& result) {
    ElementCoverage total;
    for (const ElementCoverage& element : result.layer_coverage) total += element;
    return total;
}

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
                         {"surface", element.surface_notes}});
    }
    return input;
}

Json seconds_report(const StageSeconds& seconds, double write_seconds) {
    return {{"geometry", seconds.geometry},
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
    Json report = {
        {"decomposition", Json::array()}, {"layer_triangulation", Json::array()}, {"refinement", Json::array()}};
    for (const ThreadSeconds& thread : threads) {
        report["decomposition"].push_back({{"busy", thread.decomposition}});
        report["layer_triangulation"].push_back({{"busy", thread.layer_triangulation}});
        report["refinement"].push_back({{"busy", thread.refinement}, {"idle", thread.idle}});
    }
    return report;
}

/// The first height in force, and the flow it was made for, if it was.
Json first_height_report(const MeshResult& result) {
    Json report = {{"height", result.first_height}};
    if (const auto& flow = result.y_plus; flow) {
        report["y_plus"] = flow->y_plus;
        report["reynolds"] = flow->reynolds;
        report["chord"] = *flow->chord;
    }
    return report;
}

}  // namespace

Json decomposition_report(const DecompositionStats& stats) {
    return {{"pieces", stats.pieces},
            {"piece_vertices", stats.piece_vertices},
            {"largest_piece_vertices", stats.largest_piece},
            {"rejected_cuts", {{"crossing", stats.crossing_cuts}, {"unbalanced", stats.unbalanced_cuts}}},
            {"uncut_pieces", stats.uncut},
            {"sequential_fallbacks", stats.fallbacks}};
}

Json quality_report(const MeshCheck& check) {
    const QualitySummary& isotropic = check.isotropic;
    const QualitySummary& layer = check.layer;
    return {{"isotropic",
             {{"cells", isotropic.cells},
              {"min_angle_deg", isotropic.min_angle_deg},
              {"mean_min_angle_deg", isotropic.mean_min_angle_deg},
              {"max_angle_deg", isotropic.max_angle_deg},
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
              {"edges_without_first_layer", check.edges_without_first_layer}}},
            {"hand_over",
             {{"edges", check.transition.edges},
              {"p01_area_ratio", check.transition.p01_area_ratio},
              {"median_area_ratio", check.transition.median_area_ratio},
              {"p99_area_ratio", check.transition.p99_area_ratio}}},
            {"delaunay", {{"interior_edges", check.interior_edges}, {"violations", check.delaunay_violations}}}};
}

Json mesh_report(const MeshResult& result, double write_seconds) {
    Json quality = quality_report(result.check);
    quality["layer"]["incomplete_rays"] = total_coverage(result).all.incomplete_rays;
    quality["isotropic"]["oversized"] = result.refinement.oversized;
    quality["isotropic"]["refused_points"] = result.refinement.refused;
    return {{"version", LAMINA_VERSION},
            {"threads", result.threads},
            {"input", input_report(result.geometry)},
            {"vertices", result.mesh.points.size()},
            {"triangles", result.mesh.triangles.size()},
            {"quads", result.mesh.quads.size()},
            {"layer_triangles", triangles_in(result.mesh, Region::layer)},
            {"isotropic_triangles", triangles_in(result.mesh, Region::isotropic)},
            {"surface_vertices", result.surface_vertices},
            {"decomposition", decomposition_report(result.decomposition)},
            {"pieces",
             {{"layer", result.layer_pieces},
              {"inviscid", result.inviscid_pieces},
              {"largest_inviscid", result.largest_inviscid_piece},
              {"estimates_within_15_percent", result.estimates_within_15_percent}}},
            {"first_layer", first_height_report(result)},
            {"layer_cells", layer_cells_report(result)},
            {"seconds", seconds_report(result.seconds, write_seconds)},
            {"thread_seconds", threads_report(result.thread_seconds)},
            {"quality", quality},
            {"hash", mesh_hash(result.mesh)}};
}

std::string to_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

std::string quality_summary(const MeshCheck& check) {
    std::string text;
    if (check.isotropic.cells > 0) {
        text += fmt::format(
            "  isotropic {} cells, angles {:.2f} to {:.2f} deg, mean smallest {:.2f} deg, {} below bound ({} exempt), "
            "neighbour areas within {:.2f}\n",
            check.isotropic.cells, check.isotropic.min_angle_deg, check.isotropic.max_angle_deg,
            check.isotropic.mean_min_angle_deg, check.isotropic.angles_below_bound, check.isotropic.exempt,
            check.isotropic.max_neighbour_area_ratio);
    }
    if (check.layer.cells > 0) {
        text += fmt::format(
            "  layer     {} cells, aspect ratios up to {:.4g}, angles up to {:.2f} deg, mean largest {:.2f} deg\n",
            check.layer.cells, check.layer.max_aspect_ratio, check.layer.max_angle_deg, check.layer.mean_max_angle_deg);
        if (check.edges_without_first_layer > 0)
            text += fmt::format("  layer     {} wall edges without a cell of first height (see --layer-topology)\n",
                                check.edges_without_first_layer);
    }
    if (const TransitionSummary& to = check.transition; to.edges > 0) {
        text +=
            fmt::format("  hand-over {} edges, layer to isotropic areas {:.2f} (1 %), {:.2f} (median), {:.2f} (99 %)\n",
                        to.edges, to.p01_area_ratio, to.median_area_ratio, to.p99_area_ratio);
    }
    return text + fmt::format("  delaunay  {} of {} edges violate the property\n", check.delaunay_violations,
                              check.interior_edges);
}

std::string mesh_summary(const MeshResult& result, const std::vector<std::string>& outputs, double write_seconds) {
    std::string text;
    for (const Element& element : result.geometry.elements) {
        text += fmt::format("{}: {} points of {} ({})\n", element.name, element.points.size(), element.file,
                            element.format);
        for (const std::string& repair : element.repairs) text += "  repaired  " + repair + "\n";
        for (const std::string& note : element.surface_notes) text += "  surface   " + note + "\n";
    }
    const std::size_t quads = result.mesh.quads.size();
    text += fmt::format("mesh: {} vertices, {} triangles, {}{} pieces\n", result.mesh.points.size(),
                        result.mesh.triangles.size(), quads > 0 ? fmt::format("{} quads, ", quads) : "",
                        result.layer_pieces + result.inviscid_pieces);
    text += quality_summary(result.check);
    if (const auto& flow = result.y_plus; flow) {
        text += fmt::format("  y+        {} at Re {}, chord {}: first height {:.4g}\n", flow->y_plus, flow->reynolds,
                            *flow->chord, result.first_height);
    }
    if (const auto [all, open] = total_coverage(result); all.requested_cells > 0) {
        text += fmt::format(
            "  rays      {} of {} cut short; {:.2f} % of the requested layer cells made, {:.2f} % in the open\n",
            all.incomplete_rays, all.rays, 100 * made_share(all), 100 * made_share(open));
    }
    text += fmt::format("  time      {:.3f} s, and {:.3f} s for writing, on {} thread{}\n", result.seconds.total,
                        write_seconds, result.threads, result.threads == 1 ? "" : "s");
    for (const std::string& output : outputs) text += "  wrote     " + output + "\n";
    return text;
}

}  // namespace lamina::app
