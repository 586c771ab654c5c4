#include "app/delaunay_report.hpp"

#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/io.hpp>
#include <lamina/mesh.hpp>
#include <lamina/threads.hpp>
#include <lamina/version.hpp>

#include "app/report.hpp"

namespace lamina::app {

namespace {

Json thread_seconds_report(const std::vector<TriangulationThread>& threads) {
    Json report = {{"decomposition", Json::array()}, {"triangulation", Json::array()}};
    for (const TriangulationThread& thread : threads) {
        report["decomposition"].push_back({{"busy", thread.cutting}});
        report["triangulation"].push_back({{"busy", thread.triangulating}, {"idle", thread.idle}});
    }
    return report;
}

std::string hash_of(const TriangleOutput& output) {
    Mesh mesh;
    mesh.points = output.points;
    mesh.triangles = output.triangles;
    return mesh_hash(mesh);
}

}  // namespace

std::string delaunay_report(const DelaunayResult& result, const DelaunayRunFacts& facts) {
    Json report = {{"version", LAMINA_VERSION},
                   {"threads", facts.threads == 0 ? thread_count() : facts.threads},
                   {"vertices", result.output.points.size()},
                   {"triangles", result.output.triangles.size()},
                   {"min_angle_deg", facts.smallest_angle_deg},
                   {"angles_below_bound", result.refinement.below_bound},
                   {"angles_exempt", result.refinement.exempt},
                   {"oversized", result.refinement.oversized},
                   {"refused_points", result.refinement.refused},
                   {"warnings", warnings_report(result.warnings)},
                   {"estimate", estimate_report(result.estimate)},
                   {"merged_points", result.merged_points},
                   {"dropped_triangles", result.dropped_triangles},
                   {"zero_length_segments", result.zero_length_segments},
                   {"repeated_segments", result.repeated_segments},
                   {"seconds",
                    {{"read", facts.read_seconds},
                     {"triangulation", result.triangulation_seconds},
                     {"refinement", result.refinement_seconds},
                     {"write", facts.write_seconds},
                     {"total", facts.total_seconds}}},
                   {"hash", hash_of(result.output)}};
    if (result.decomposition) {
        report["decomposition"] = decomposition_report(*result.decomposition);
        report["thread_seconds"] = thread_seconds_report(result.threads);
    }
    return to_text(report);
}

std::string delaunay_summary(const DelaunayResult& result, const DelaunayRunFacts& facts) {
    const RefineStats& stats = result.refinement;
    std::string text = fmt::format("{}.node, .ele{}: {} vertices, {} triangles, smallest angle {:.2f} degrees\n",
                                   facts.stem.string(), facts.with_poly ? ", .poly" : "", result.output.points.size(),
                                   result.output.triangles.size(), facts.smallest_angle_deg);
    if (stats.below_bound > 0)
        text += fmt::format(
            "  {} triangles have an angle below the bound ({} of them in sharp corners of the input, or between "
            "segments that nearly coincide, where no triangulation of few triangles can keep it)\n",
            stats.below_bound, stats.exempt);
    if (result.merged_points > 0)
        text += fmt::format("  {} points were merged with earlier ones; no triangle has them\n", result.merged_points);
    if (result.dropped_triangles > 0)
        text += fmt::format("  {} flat triangles at the hull were dropped\n", result.dropped_triangles);
    if (result.zero_length_segments > 0)
        text += fmt::format("  {} segments from a vertex to itself were left out\n", result.zero_length_segments);
    if (result.repeated_segments > 0)
        text += fmt::format("  {} segments lie on earlier ones and change nothing\n", result.repeated_segments);
    if (stats.oversized > 0) text += fmt::format("  {} triangles are larger than asked for\n", stats.oversized);
    return text;
}

}  // namespace lamina::app
