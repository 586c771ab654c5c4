#include "app/check_run.hpp"

#include <cstdint>
#include <span>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "app/check_report.hpp"
#include "app/marker_lookup.hpp"
#include "app/report.hpp"
#include "app/run_files.hpp"
#include "app/standard_output.hpp"
#include "app/summary.hpp"

namespace lamina::app {

namespace {

/// Gives the marker of this name its kind, whatever the file says. Adds a shortcoming where it is missing or empty.
void require_marker(std::vector<Marker>& markers, const std::string& name, MarkerKind kind,
                    Shortcomings& shortcomings) {
    Marker* const marker = find_marker(markers, name, kind);
    if (marker == nullptr || marker->edges.empty()) {
        shortcomings.push_back("no marker '" + name + "'");
    } else {
        marker->kind = kind;
    }
}

std::string defect_lines(std::span<const MeshDefect> defects, std::size_t count) {
    std::string text;
    for (const MeshDefect& defect : defects)
        text += summary_line("defect", fmt::format("{} at ({}, {})", defect.description, defect.at.x, defect.at.y));
    if (count > defects.size()) text += summary_line("defect", fmt::format("and {} more", count - defects.size()));
    return text;
}

std::string check_summary(const std::string& file, const MeshView& mesh, const MeshCheck& check,
                          const CurvedCheck& curved, RegionOrigin regions, const Shortcomings& shortcomings) {
    std::string text = fmt::format("{}: {}\n", file, check.valid() && curved.valid() ? "valid" : "not valid");
    text += defect_lines(check.defects, check.defect_count) + defect_lines(curved.defects, curved.defect_count);
    for (const std::string& shortcoming : shortcomings) text += summary_line("required", shortcoming);
    text +=
        summary_line("mesh", fmt::format("{} vertices, {} triangles, {} quads, {} boundary loops", mesh.points.size(),
                                         mesh.triangles.size(), mesh.quads.size(), check.boundary_loops));
    for (const Marker& marker : mesh.markers)
        text += summary_line(
            "marker", fmt::format("{} ({}), {} edges", marker.name, kind_name(marker.kind), marker.edges.size()));
    if (regions == RegionOrigin::estimate)
        text += summary_line("regions", fmt::format("none in the file: {} thin cells that hang together with a wall "
                                                    "are taken for the boundary layer; others of its cells count as "
                                                    "isotropic",
                                                    check.layer.cells));
    if (regions == RegionOrigin::none)
        text +=
            summary_line("regions", "none in the file, and no thin cells at a wall: every cell counts as isotropic");
    return text + quality_summary(check);
}

/// Accepts exempt angles, which lie in sharp corners of frozen edges, as long as they are few.
void require_angles(const QualitySummary& isotropic, double min_angle_deg, Shortcomings& shortcomings) {
    constexpr double max_exempt_share = 0.001;
    if (const std::size_t narrow = isotropic.unexcused(); narrow > 0)
        shortcomings.push_back(fmt::format("{} triangles have an angle below {} degrees", narrow, min_angle_deg));
    if (static_cast<double>(isotropic.exempt) > max_exempt_share * static_cast<double>(isotropic.cells))
        shortcomings.push_back(
            fmt::format("{} of {} triangles have an angle below {} degrees at a sharp corner of frozen edges",
                        isotropic.exempt, isotropic.cells, min_angle_deg));
}

}  // namespace

void run_check(const CheckSettings& settings) {
    require_format(settings.mesh, settings.format, "--input-format");
    const std::string name = input_name(settings.mesh);
    // A third of the memory is left to the mesh itself, of which large files keep in memory what the system has room
    // for.
    const std::size_t memory = with_default_limits(settings.limits).max_memory_bytes.value_or(SIZE_MAX);
    StoredMesh stored =
        read_stored_mesh(settings.mesh, {.format = settings.format, .max_bytes_in_memory = memory / 4, .curved = true});
    MeshCheckOptions options = settings.options;
    options.max_memory_bytes = memory / 3 * 2;
    Shortcomings shortcomings;
    for (const std::string& wall : settings.walls)
        require_marker(stored.markers(), wall, MarkerKind::wall, shortcomings);
    if (!settings.far_field.empty()) {
        require_marker(stored.markers(), settings.far_field, MarkerKind::far_field, shortcomings);
    }
    const RegionOrigin regions = require_regions(stored);
    const MeshView mesh = stored.view();
    const MeshCheck result = check_file_mesh(mesh, regions, options);
    const CurvedNodes& nodes = stored.curved();
    // Proofs take a valid mesh for granted.
    const bool is_curved = nodes.order > 1 && result.valid();
    const CurvedCheck curved = is_curved ? check_curved(mesh, nodes) : CurvedCheck{};
    if (settings.require_delaunay && result.delaunay_violations > 0) {
        shortcomings.push_back(fmt::format("{} edges between isotropic triangles violate the Delaunay property",
                                           result.delaunay_violations));
    }
    if (settings.require_angles) require_angles(result.isotropic, options.min_angle_deg, shortcomings);

    if (settings.json) {
        Json report = check_report(mesh, result, regions, shortcomings);
        report["valid"] = result.valid() && curved.valid();
        if (is_curved) report["curved"] = curved_check_report(nodes.order, curved);
        print_result(to_text(report));
    } else {
        print_result(check_summary(name, mesh, result, curved, regions, shortcomings) +
                     (is_curved ? curved_line(nodes.order, curved) : ""));
    }
    for (const auto& [count, defects] :
         {std::pair(result.defect_count, &result.defects), std::pair(curved.defect_count, &curved.defects)})
        if (count > 0)
            throw MeshError(
                fmt::format("{}: not valid, {} defects; the first: {}", name, count, defects->front().description));
    if (!shortcomings.empty()) throw MeshError(name + ": " + shortcomings.front());
}

}  // namespace lamina::app
