// Writes and reads meshes as the files of Triangle: .node, .ele, .edge and .poly of one stem. Markers are numbered from
// 1 on; comments at the head of the .poly file, "# marker NUMBER KIND NAME", hold their kinds and names. The .poly file
// has the edges of the markers as segments, and no holes.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/triangle_files.hpp>

#include "core/marker_names.hpp"
#include "io/file_names.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/triangle_elements.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

fs::path stem_of(const fs::path& file) { return fs::path(file).replace_extension(); }

/// Adds each edge of the mesh once, from its smaller vertex, with the number of its marker.
void add_edges(const MeshView& mesh, TriangleOutput& output) {
    const mesh::Adjacency adjacency = mesh::find_adjacency(mesh);
    const mesh::CellEdges edges(mesh);
    std::map<std::pair<VertexId, VertexId>, long> markers;
    for (std::size_t m = 0; m < mesh.markers.size(); ++m)
        for (const Segment& edge : mesh.markers[m].edges)
            markers[std::minmax(edge.a, edge.b)] = static_cast<long>(m + 1);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const bool inner = adjacency.twin[e] != mesh::no_edge;
        if (inner && adjacency.twin[e] < e) continue;
        const auto [a, b] = std::minmax({edges.origin(e), edges.target(e)});
        const auto marker = inner ? markers.end() : markers.find({a, b});
        output.edges.push_back({a, b});
        output.edge_markers.push_back(marker == markers.end() ? 0 : marker->second);
    }
}

/// Reads the names and kinds of markers from the comments at the head of a .poly file.
std::map<long, core::NamedMarker> read_names(const fs::path& file) {
    std::map<long, core::NamedMarker> names;
    const std::string bytes = read_file(file);
    std::string_view rest = bytes;
    while (rest.starts_with("# marker ")) {
        std::string_view line = rest.substr(9, std::min(rest.find('\n'), rest.size()) - 9);
        rest.remove_prefix(std::min(rest.find('\n'), rest.size() - 1) + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        long number = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), number);
        line.remove_prefix(static_cast<std::size_t>(end - line.data()));
        for (std::size_t kind = 0; kind < core::marker_kind_count; ++kind) {
            const std::string prefix = fmt::format(" {} ", core::marker_kind_words[kind]);
            if (error == std::errc{} && line.starts_with(prefix))
                names[number] = {std::string(line.substr(prefix.size())), static_cast<MarkerKind>(kind)};
        }
    }
    return names;
}

}  // namespace

std::vector<fs::path> triangle_mesh_files(const fs::path& file) {
    std::vector<fs::path> files = triangle_files(stem_of(file), true);
    files.push_back(with_suffix(stem_of(file), ".edge"));
    return files;
}

void write_triangle_mesh(const MeshView& mesh, const fs::path& file) {
    require_marker_names(mesh.markers, file, "Triangle's .poly", "", 1000);
    if (!mesh.quads.empty())
        throw UsageError(fmt::format("{}: Triangle's files cannot hold quadrilaterals", file.string()));
    TriangleOutput output;
    output.points.assign(mesh.points.begin(), mesh.points.end());
    output.markers.assign(mesh.points.size(), 0);
    output.triangles.assign(mesh.triangles.begin(), mesh.triangles.end());
    for (const Region region : mesh.region) output.triangle_attributes.push_back(static_cast<double>(region));
    for (std::size_t m = mesh.markers.size(); m-- > 0;)  // a vertex gets the first of its markers
        for (const Segment& edge : mesh.markers[m].edges)
            output.markers[edge.a.index()] = output.markers[edge.b.index()] = static_cast<long>(m + 1);
    for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
        const Marker& marker = mesh.markers[m];
        output.comments.push_back(fmt::format("marker {} {} {}", m + 1, core::word_of(marker.kind), marker.name));
        output.segments.insert(output.segments.end(), marker.edges.begin(), marker.edges.end());
        output.segment_markers.insert(output.segment_markers.end(), marker.edges.size(), static_cast<long>(m + 1));
    }
    add_edges(mesh, output);
    write_triangle_files(output, stem_of(file), true);
}

Mesh read_triangle_mesh(const fs::path& file) {
    const fs::path poly = with_suffix(stem_of(file), ".poly");
    std::error_code ignored;
    const bool has_poly = fs::exists(poly, ignored);
    TriangleInput input = read_triangle_files(has_poly ? poly : with_suffix(stem_of(file), ".node"));
    Mesh mesh;
    mesh.triangles = read_triangle_elements(with_suffix(stem_of(file), ".ele"), input.first_index, input.points.size());
    mesh.points = std::move(input.points);
    if (!has_poly) return mesh;
    const std::map<long, core::NamedMarker> names = read_names(poly);
    std::map<long, std::size_t> marker_of;
    for (std::size_t i = 0; i < input.segment_markers.size(); ++i) {
        const long number = input.segment_markers[i];
        if (number == 0) continue;  // a segment inside the mesh
        const auto [found, is_new] = marker_of.try_emplace(number, mesh.markers.size());
        if (is_new) {
            const auto named = names.find(number);
            mesh.markers.push_back({fmt::format("marker{}", number), MarkerKind::other, {}});
            if (named != names.end()) {
                mesh.markers.back().name = named->second.name;
                mesh.markers.back().kind = named->second.kind;
            }
        }
        mesh.markers[found->second].edges.push_back(input.segments[i]);
    }
    orient_markers(mesh);
    return mesh;
}

}  // namespace lamina::io
