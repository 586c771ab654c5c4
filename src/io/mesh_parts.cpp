#include "io/mesh_parts.hpp"
#include "core/marker_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include <lamina/error.hpp>

namespace lamina::io {

std::vector<CellBlock> cell_blocks(const MeshView& mesh) {
    constexpr std::array<const char*, 2> names{"layer", "isotropic"};
    std::vector<CellBlock> blocks;
    const auto add_blocks = [&](std::size_t corners, std::size_t first, std::size_t count) {
        std::array<CellBlock, 2> by_region;
        for (std::size_t r = 0; r < by_region.size(); ++r)
            by_region[r] = {mesh.region.empty() ? "fluid" : names[r], corners, {}};
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t r = mesh.region.empty() ? 0 : static_cast<std::size_t>(mesh.region[first + i]);
            by_region[r].cells.push_back(static_cast<std::uint32_t>(i));
        }
        for (CellBlock& block : by_region)
            if (!block.cells.empty()) blocks.push_back(std::move(block));
    };
    add_blocks(3, 0, mesh.triangles.size());
    add_blocks(4, mesh.triangles.size(), mesh.quads.size());
    return blocks;
}

std::size_t count_marker_edges(const MeshView& mesh) {
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    return edges;
}

bool region_of_name(std::string_view name, Region& region) {
    region = name == "layer" ? Region::layer : Region::isotropic;
    return name == "layer" || name == "isotropic";
}

void require_marker_names(std::span<const Marker> markers, const std::filesystem::path& file, const char* format,
                          std::string_view forbidden, std::size_t max_bytes) {
    std::vector<std::string_view> names;
    for (const Marker& marker : markers) {
        names.push_back(marker.name);
        const bool unfit = std::any_of(marker.name.begin(), marker.name.end(), [&](char c) {
            return static_cast<unsigned char>(c) < ' ' || forbidden.find(c) != std::string_view::npos;
        });
        if (marker.name.empty() || marker.name.size() > max_bytes || unfit)
            throw UsageError(fmt::format("{}: {} cannot hold a marker named '{}'", file.string(), format, marker.name));
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw UsageError(fmt::format("{}: {} cannot hold two markers named '{}'", file.string(), format, *twice));
}

void require_legal_marker_names(std::span<const Marker> markers, const std::filesystem::path& file,
                                const char* format) {
    std::vector<core::NamedMarker> named;
    for (const Marker& marker : markers) named.push_back({marker.name, marker.kind});
    const std::vector<std::string> legal = core::legal_marker_names(named);
    for (std::size_t i = 0; i < legal.size(); ++i)
        if (legal[i] != named[i].name)
            throw UsageError(fmt::format("{}: {} cannot hold a marker named '{}' beside the others: call it '{}'",
                                         file.string(), format, named[i].name, legal[i]));
}

void orient_markers(const MeshView& mesh, std::vector<Marker>& markers) {
    // Cells have far more edges than the boundary, so only those with both ends on a marker are kept.
    std::vector<bool> on_marker(mesh.points.size(), false);
    for (const Marker& marker : markers)
        for (const Segment& edge : marker.edges) on_marker[edge.a.index()] = on_marker[edge.b.index()] = true;
    std::vector<Segment> cell_edges;
    const auto add = [&](VertexId a, VertexId b) {
        if (on_marker[a.index()] && on_marker[b.index()]) cell_edges.push_back({a, b});
    };
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) add(t.v[i], t.v[(i + 1) % 3]);
    for (const Quad& q : mesh.quads)
        for (int i = 0; i < 4; ++i) add(q.v[i], q.v[(i + 1) % 4]);
    std::sort(cell_edges.begin(), cell_edges.end());

    const auto has = [&](VertexId a, VertexId b) {
        return std::binary_search(cell_edges.begin(), cell_edges.end(), Segment{a, b});
    };
    for (Marker& marker : markers) {
        bool is_internal = !marker.edges.empty();
        for (Segment& edge : marker.edges) {
            const bool on_left = has(edge.a, edge.b), on_right = has(edge.b, edge.a);
            if (!on_left && on_right) std::swap(edge.a, edge.b);
            is_internal = is_internal && on_left && on_right;
        }
        if (is_internal) marker.kind = MarkerKind::internal;
    }
}

std::vector<Marker> markers_of_kind(std::span<const Marker> markers, bool internal) {
    std::vector<Marker> result;
    for (const Marker& marker : markers)
        if ((marker.kind == MarkerKind::internal) == internal) result.push_back(marker);
    return result;
}

bool find_lower_edge(std::span<const VertexId> corners, Segment& edge) {
    const auto lower = std::count_if(corners.begin(), corners.end(), [](VertexId v) { return v.valid(); });
    if (lower != 2 || corners.size() != 4) return false;
    for (std::size_t k = 0; k < 4; ++k) {
        edge = {corners[k], corners[(k + 1) % 4]};
        if (edge.a.valid() && edge.b.valid()) return true;
    }
    return false;
}

}  // namespace lamina::io
