// Writes a mesh in parts, for readers that divide their work: NAME_0.vtu, NAME_1.vtu ... hold the parts, NAME.pvtu
// lists them. Each part is a VTU file by itself (vtu_write.cpp). Vertices between parts stand in each of them; the
// point data `vertex`, marked as the global ids, hold the numbers of the vertices in the mesh. Source: VTK User's
// Guide, "VTK File Formats", XML, parallel formats.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/markup.hpp"
#include "io/formats.hpp"
#include "io/pvtu.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/partition.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// Cuts a mesh into parts, one after the other.
class PartCutter {
public:
    PartCutter(const MeshView& mesh, std::size_t parts)
        : mesh_(mesh), cells_of_part_(parts), edges_of_part_(parts), local_(mesh.points.size()) {
        const std::vector<std::uint32_t> part_of_cell = mesh::partition_cells(mesh, parts);
        for (std::size_t c = 0; c < part_of_cell.size(); ++c)
            cells_of_part_[part_of_cell[c]].push_back(static_cast<std::uint32_t>(c));
        sort_marker_edges(part_of_cell);
    }

    PartMesh cut(std::size_t part) {
        const mesh::CellEdges cells(mesh_);
        PartMesh cut;
        for (const std::uint32_t c : cells_of_part_[part])
            for (std::size_t i = 0; i < cells.corners(c); ++i) cut.vertices.push_back(cells.corner(c, i));
        std::sort(cut.vertices.begin(), cut.vertices.end());
        cut.vertices.erase(std::unique(cut.vertices.begin(), cut.vertices.end()), cut.vertices.end());
        for (std::size_t i = 0; i < cut.vertices.size(); ++i) {
            local_[cut.vertices[i].index()] = VertexId{i};
            cut.mesh.points.push_back(mesh_.points[cut.vertices[i].index()]);
        }
        for (const std::uint32_t c : cells_of_part_[part]) {
            const auto corner = [&](std::size_t i) { return local_[cells.corner(c, i).index()]; };
            if (cells.corners(c) == 3)
                cut.mesh.triangles.push_back({corner(0), corner(1), corner(2)});
            else
                cut.mesh.quads.push_back({corner(0), corner(1), corner(2), corner(3)});
            if (!mesh_.region.empty()) cut.mesh.region.push_back(mesh_.region[c]);
            if (!mesh_.piece.empty()) cut.mesh.piece.push_back(mesh_.piece[c]);
            if (!mesh_.layer.empty()) cut.mesh.layer.push_back(mesh_.layer[c]);
        }
        for (const Marker& marker : mesh_.markers) cut.mesh.markers.push_back({marker.name, marker.kind, {}});
        for (const MarkerEdge& edge : edges_of_part_[part])
            cut.mesh.markers[edge.marker].edges.push_back({local_[edge.ends.a.index()], local_[edge.ends.b.index()]});
        return cut;
    }

private:
    struct MarkerEdge {
        std::size_t marker;
        Segment ends;
    };
    MeshView mesh_;
    std::vector<std::vector<std::uint32_t>> cells_of_part_;
    std::vector<std::vector<MarkerEdge>> edges_of_part_;
    std::vector<VertexId> local_;  ///< the number of a vertex in the part that is being cut

    /// An edge of a marker goes to the part of its cell. One without a cell is left out.
    void sort_marker_edges(const std::vector<std::uint32_t>& part_of_cell) {
        std::vector<MarkerEdge> edges;
        std::vector<Segment> ends;
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            for (const Segment& edge : mesh_.markers[m].edges) {
                edges.push_back({m, edge});
                ends.push_back(edge);
            }
        const std::vector<std::uint32_t> found = mesh::find_edges(mesh_, ends);
        const mesh::CellEdges cells(mesh_);
        for (std::size_t i = 0; i < edges.size(); ++i)
            if (found[i] != mesh::no_edge) edges_of_part_[part_of_cell[cells.cell_of(found[i])]].push_back(edges[i]);
    }
};

}  // namespace

fs::path part_file(const fs::path& file, std::size_t part) {
    return file.parent_path() / fmt::format("{}_{}.vtu", file.stem().string(), part);
}

std::string list_of_parts(const MeshView& arrays, const fs::path& file, std::size_t parts) {
    std::string text =
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "  <PUnstructuredGrid GhostLevel=\"0\">\n"
        "    <PPointData GlobalIds=\"vertex\">\n"
        "      <PDataArray type=\"Int64\" Name=\"vertex\"/>\n"
        "    </PPointData>\n"
        "    <PCellData>\n";
    const auto announce = [&](const char* type, const char* name) {
        text += fmt::format("      <PDataArray type=\"{}\" Name=\"{}\"/>\n", type, name);
    };
    if (!arrays.region.empty()) announce("UInt8", "region");
    if (!arrays.piece.empty()) announce("UInt32", "piece");
    if (!arrays.layer.empty()) announce("UInt16", "layer");
    announce("UInt32", "marker");
    announce("Float32", "quality");
    text +=
        "    </PCellData>\n"
        "    <PPoints>\n"
        "      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n"
        "    </PPoints>\n";
    for (std::size_t part = 0; part < parts; ++part)
        text += fmt::format("    <Piece Source=\"{}\"/>\n",
                            core::escaped_markup(part_file(file, part).filename().string()));
    return text + "  </PUnstructuredGrid>\n</VTKFile>\n";
}

std::vector<fs::path> pvtu_files(const fs::path& file, std::size_t parts) {
    std::vector<fs::path> files{file};
    for (std::size_t part = 0; part < parts; ++part) files.push_back(part_file(file, part));
    return files;
}

void write_pvtu(const MeshView& mesh, const fs::path& file, std::size_t parts) {
    // The list gets its name when all parts have theirs.
    std::vector<fs::path> targets = pvtu_files(file, parts);
    std::rotate(targets.begin(), targets.begin() + 1, targets.end());
    PartCutter cutter(mesh, parts);
    core::write_files_atomically(targets, [&](std::span<const fs::path> temporary) {
        for (std::size_t part = 0; part < parts; ++part) {
            const PartMesh cut = cutter.cut(part);
            core::write_stream(temporary[part], targets[part],
                               [&](std::ostream& out) { write_vtu_part(cut.mesh, cut.vertices, out); });
        }
        core::write_stream(temporary[parts], file, [&](std::ostream& out) { out << list_of_parts(mesh, file, parts); });
    });
}

}  // namespace lamina::io
