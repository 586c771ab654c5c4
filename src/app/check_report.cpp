#include "app/check_report.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/version.hpp>

namespace lamina::app {

namespace {

const char* origin_name(RegionOrigin origin) {
    if (origin == RegionOrigin::none) return "none";
    return origin == RegionOrigin::file ? "file" : "estimate";
}

}  // namespace

RegionOrigin require_regions(Mesh& mesh) {
    if (!mesh.region.empty()) return RegionOrigin::file;
    mesh.region = estimate_regions(mesh);
    return mesh.region.empty() ? RegionOrigin::none : RegionOrigin::estimate;
}

RegionOrigin require_regions(StoredMesh& mesh) {
    if (!mesh.view().region.empty()) return RegionOrigin::file;
    mesh.set_region(estimate_regions(mesh.view()));
    return mesh.view().region.empty() ? RegionOrigin::none : RegionOrigin::estimate;
}

MeshCheck check_file_mesh(const MeshView& mesh, RegionOrigin regions, const MeshCheckOptions& options) {
    MeshCheck check = check_mesh(mesh, options);
    // The last thin cell of a layer is rarely the last one.
    if (regions == RegionOrigin::estimate) check.transition = {};
    return check;
}

Mesh read_valid_mesh(const std::string& file, const std::string& format) {
    Mesh mesh = read_mesh(file, {.format = format});
    const MeshCheck check = check_mesh(mesh);
    if (check.valid()) return mesh;
    const MeshDefect& first = check.defects.front();
    throw MeshError(fmt::format("{}: not valid: {}", input_name(file), first.description), first.at);
}

const char* kind_name(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::wall:
            return "wall";
        case MarkerKind::far_field:
            return "far field";
        case MarkerKind::symmetry:
            return "symmetry";
        case MarkerKind::periodic:
            return "periodic";
        case MarkerKind::internal:
            return "internal";
        case MarkerKind::other:
            break;
    }
    return "other";
}

namespace {

Json list_of_defects(const std::vector<MeshDefect>& defects) {
    Json list = Json::array();
    for (const MeshDefect& defect : defects)
        list.push_back({{"what", defect.description}, {"at", {defect.at.x, defect.at.y}}});
    return list;
}

}  // namespace

Json check_report(const MeshView& mesh, const MeshCheck& check, RegionOrigin regions,
                  const Shortcomings& shortcomings) {
    Json markers = Json::array();
    for (const Marker& marker : mesh.markers) {
        markers.push_back({{"name", marker.name}, {"kind", kind_name(marker.kind)}, {"edges", marker.edges.size()}});
    }
    return {{"version", LAMINA_VERSION},
            {"valid", check.valid()},
            {"defect_count", check.defect_count},
            {"defects", list_of_defects(check.defects)},
            {"shortcomings", shortcomings},
            {"vertices", mesh.points.size()},
            {"triangles", mesh.triangles.size()},
            {"quads", mesh.quads.size()},
            {"markers", markers},
            {"area", check.area},
            {"euler_characteristic", check.euler_characteristic},
            {"boundary_loops", check.boundary_loops},
            {"regions", origin_name(regions)},
            {"quality", quality_report(check)},
            {"hash", mesh_hash(mesh)}};
}

Json curved_check_report(unsigned order, const CurvedCheck& check) {
    return {{"order", order},
            {"valid", check.valid()},
            {"defect_count", check.defect_count},
            {"defects", list_of_defects(check.defects)},
            {"invalid", check.invalid},
            {"unproved", check.unproved},
            {"min_scaled_jacobian", check.min_scaled_jacobian},
            {"p01_scaled_jacobian", check.p01_scaled_jacobian}};
}

}  // namespace lamina::app
