#include "io/mesh_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include <lamina/error.hpp>

namespace lamina::io {

std::vector<CellBlock> cell_blocks(const Mesh& mesh) {
    constexpr std::array<const char*, 2> names{"layer", "isotropic"};
    std::vector<CellBlock> blocks;
    const auto add_blocks = [&](std::size_t corners, std::size_t first, std::size_t count) {
        std::array<CellBlock, 2> of_region;
        for (std::size_t r = 0; r < of_region.size(); ++r)
            of_region[r] = {mesh.region.empty() ? "fluid" : names[r], corners, {}};
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t r = mesh.region.empty() ? 0 : static_cast<std::size_t>(mesh.region[first + i]);
            of_region[r].cells.push_back(static_cast<std::uint32_t>(i));
        }
        for (CellBlock& block : of_region)
            if (!block.cells.empty()) blocks.push_back(std::move(block));
    };
    add_blocks(3, 0, mesh.triangles.size());
    add_blocks(4, mesh.triangles.size(), mesh.quads.size());
    return blocks;
}

bool region_of_name(std::string_view name, Region& region) {
    region = name == "layer" ? Region::layer : Region::isotropic;
    return name == "layer" || name == "isotropic";
}

MarkerKind kind_of_name(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (std::isalpha(static_cast<unsigned char>(c)))
            letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (letters == "farfield" || letters == "far") return MarkerKind::far_field;
    if (letters == "symmetry" || letters == "symmetryplane") return MarkerKind::symmetry;
    if (letters == "wall" || letters == "airfoil") return MarkerKind::wall;
    return MarkerKind::other;
}

void require_marker_names(const Mesh& mesh, const std::filesystem::path& file, const char* format,
                          std::string_view forbidden, std::size_t longest) {
    std::vector<std::string_view> names;
    for (const Marker& marker : mesh.markers) {
        names.push_back(marker.name);
        const bool unfit = std::any_of(marker.name.begin(), marker.name.end(), [&](char c) {
            return static_cast<unsigned char>(c) < ' ' || forbidden.find(c) != std::string_view::npos;
        });
        if (marker.name.empty() || marker.name.size() > longest || unfit)
            throw UsageError(fmt::format("{}: {} cannot hold a marker named '{}'", file.string(), format, marker.name));
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end())
        throw UsageError(fmt::format("{}: {} cannot hold two markers named '{}'", file.string(), format, *twice));
}

void orient_markers(Mesh& mesh) {
    // Cells have far more edges than the boundary: look only at those with both ends on a marker.
    std::vector<bool> on_marker(mesh.points.size(), false);
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges) on_marker[edge.a.index()] = on_marker[edge.b.index()] = true;
    std::vector<Segment> of_cells;
    const auto look_at = [&](VertexId a, VertexId b) {
        if (on_marker[a.index()] && on_marker[b.index()]) of_cells.push_back({a, b});
    };
    for (const Triangle& t : mesh.triangles)
        for (int i = 0; i < 3; ++i) look_at(t.v[i], t.v[(i + 1) % 3]);
    for (const Quad& q : mesh.quads)
        for (int i = 0; i < 4; ++i) look_at(q.v[i], q.v[(i + 1) % 4]);
    std::sort(of_cells.begin(), of_cells.end());

    const auto has = [&](VertexId a, VertexId b) {
        return std::binary_search(of_cells.begin(), of_cells.end(), Segment{a, b});
    };
    for (Marker& marker : mesh.markers)
        for (Segment& edge : marker.edges)
            if (!has(edge.a, edge.b) && has(edge.b, edge.a)) std::swap(edge.a, edge.b);
}

}  // namespace lamina::io
