// Writes Ansys Fluent's mesh format, ASCII and binary. fluent.hpp describes the format.
//
// Zone 1 holds the nodes, zone 2, `fluid`, the cells, zone 3, `interior`, the faces between cells, and each marker has
// a zone of its own. Nodes and cells keep their order. Coordinates in ASCII have 17 digits: OpenFOAM rounds what it
// reads twice, and misses some numbers of the fewest digits.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

#include <lamina/error.hpp>

#include "io/binary_output.hpp"
#include "io/fluent.hpp"
#include "io/formats.hpp"
#include "io/mesh_faces.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"

namespace lamina::io {

namespace {

constexpr std::size_t node_zone = 1, cell_zone = 2, interior_zone = 3, first_marker_zone = 4;

/// Returns the type of a marker's zone: Fluent's own default, a wall, where the kind is not known.
FluentZoneType type_of(const Marker& marker) {
    if (marker.kind == MarkerKind::symmetry) return fluent_symmetry;
    if (marker.kind != MarkerKind::far_field) return fluent_wall;
    if (marker.name == "inlet") return fluent_velocity_inlet;
    return marker.name == "outlet" ? fluent_pressure_outlet : fluent_far_field;
}

class FluentWriter {
public:
    /// `lines` are the internal markers; the mesh is without them.
    FluentWriter(const MeshView& mesh, std::span<const Marker> lines, MeshFaces faces, bool binary, std::ostream& out)
        : mesh_(mesh), lines_(lines), faces_(std::move(faces)), binary_(binary), out_(out) {
        put_lines_last();
    }

    void write() {
        out_ << fmt::format("(0 \"a mesh of lamina\")\n({} 2)\n", int{fluent_dimension});
        if (binary_) out_ << fmt::format("({} ({} 0 0 1 2 4 4 4 8 8 4))\n", int{fluent_machine}, fluent_little_endian);
        const std::size_t cells = faces_.edges.cells();
        out_ << fmt::format("({} (0 1 {:x} 0 2))\n", int{fluent_nodes}, mesh_.points.size());
        out_ << fmt::format("({} (0 1 {:x} 0))\n", int{fluent_cells}, cells);
        out_ << fmt::format("({} (0 1 {:x} 0))\n", int{fluent_faces}, faces_.faces.size());
        write_nodes();
        write_cells();
        std::size_t first = faces_.internal;
        for (const std::size_t count : on_line_) first -= count;
        write_faces(interior_zone, fluent_interior, 0, first);
        const std::size_t first_line_zone = first_marker_zone + mesh_.markers.size();
        for (std::size_t k = 0; k < lines_.size(); ++k) {
            write_faces(first_line_zone + k, fluent_interior, first, on_line_[k]);
            first += on_line_[k];
        }
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
            write_faces(first_marker_zone + m, type_of(mesh_.markers[m]), first, mesh_.markers[m].edges.size());
            first += mesh_.markers[m].edges.size();
        }
        write_zone(cell_zone, "fluid", "fluid");
        write_zone(interior_zone, fluent_interior.name, "interior");
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m)
            write_zone(first_marker_zone + m, type_of(mesh_.markers[m]).name, mesh_.markers[m].name);
        for (std::size_t k = 0; k < lines_.size(); ++k)
            write_zone(first_line_zone + k, fluent_interior.name, lines_[k].name);
    }

private:
    /// Orders the faces between cells so that those on lines come last, line by line.
    void put_lines_last() {
        if (lines_.empty()) return;
        std::vector<std::uint32_t> line_of(faces_.edges.size(), 0);  // from 1
        for (std::size_t k = 0; k < lines_.size(); ++k)
            for (const std::uint32_t edge : mesh::find_edges(mesh_, lines_[k].edges)) {
                if (edge == mesh::no_edge) continue;
                line_of[edge] = static_cast<std::uint32_t>(k + 1);
                if (const std::uint32_t twin = faces_.adjacency.twin[edge]; twin != mesh::no_edge)
                    line_of[twin] = static_cast<std::uint32_t>(k + 1);
            }
        const auto end = faces_.faces.begin() + static_cast<std::ptrdiff_t>(faces_.internal);
        std::stable_sort(faces_.faces.begin(), end,
                         [&](std::uint32_t a, std::uint32_t b) { return line_of[a] < line_of[b]; });
        on_line_.assign(lines_.size(), 0);
        for (auto face = faces_.faces.begin(); face != end; ++face)
            if (line_of[*face] > 0) ++on_line_[line_of[*face] - 1];
    }
    void write_nodes() {
        const std::size_t n = mesh_.points.size();
        begin(fluent_nodes, fluent_doubles, fmt::format("{:x} 1 {:x} 1 2", node_zone, n));
        if (binary_)
            write_records(out_, n, 2 * sizeof(double),
                          [&](char* p, std::size_t i) { store(store(p, mesh_.points[i].x), mesh_.points[i].y); });
        else
            write_lines(out_, n, [&](LineText& line, std::size_t i) { line << mesh_.points[i]; });
        end(fluent_nodes, fluent_doubles);
    }

    /// Writes a list of shapes, or the one shape that all cells have.
    void write_cells() {
        const std::size_t cells = faces_.edges.cells();
        const auto shape = [&](std::size_t cell) {
            return faces_.edges.corners(cell) == 3 ? fluent_triangle : fluent_quad;
        };
        if (mesh_.triangles.empty() || mesh_.quads.empty()) {
            if (cells > 0)
                out_ << fmt::format("({} ({:x} 1 {:x} 1 {}))\n", int{fluent_cells}, cell_zone, cells, int{shape(0)});
            return;
        }
        begin(fluent_cells, fluent_floats, fmt::format("{:x} 1 {:x} 1 {}", cell_zone, cells, int{fluent_mixed}));
        constexpr std::size_t in_line = 32;
        if (binary_)
            write_records(out_, cells, sizeof(std::int32_t),
                          [&](char* p, std::size_t i) { store(p, std::int32_t{shape(i)}); });
        else
            write_lines(out_, (cells + in_line - 1) / in_line, [&](LineText& line, std::size_t i) {
                for (std::size_t c = in_line * i; c < std::min(cells, in_line * (i + 1)); ++c)
                    line << static_cast<std::size_t>(shape(c));
            });
        end(fluent_cells, fluent_floats);
    }

    void write_faces(std::size_t zone, const FluentZoneType& type, std::size_t first, std::size_t count) {
        if (count == 0) return;
        begin(fluent_faces, fluent_floats,
              fmt::format("{:x} {:x} {:x} {:x} {}", zone, first + 1, first + count, type.code, int{fluent_edge}));
        const auto numbers = [&](std::size_t i) {
            const std::size_t face = first + i;
            return std::array{faces_.origin(face).index() + 1, faces_.target(face).index() + 1, faces_.owner(face) + 1,
                              face < faces_.internal ? faces_.neighbour(face) + 1 : 0};
        };
        if (binary_)
            write_records(out_, count, 4 * sizeof(std::int32_t), [&](char* p, std::size_t i) {
                for (const std::size_t number : numbers(i)) p = store(p, static_cast<std::int32_t>(number));
            });
        else
            write_lines(out_, count, [&](LineText& line, std::size_t i) {
                for (const std::size_t number : numbers(i)) line.hexadecimal(number);
            });
        end(fluent_faces, fluent_floats);
    }

    void write_zone(std::size_t zone, const char* type, const std::string& name) {
        out_ << fmt::format("({} ({} {} {})())\n", int{fluent_zone}, zone, type, name);
    }

    /// Begins a section with a list. In binary files the parenthesis begins a line: meshio reads the line with the
    /// header as text, and VTK takes what follows the parenthesis for the first number.
    void begin(int section, int binary_kind, const std::string& header) {
        if (binary_)
            out_ << fmt::format("({} ({})\n(", binary_kind + section, header);
        else
            out_ << fmt::format("({} ({})(\n", section, header);
    }
    void end(int section, int binary_kind) {
        if (binary_)
            out_ << fmt::format(")\nEnd of Binary Section   {})\n", binary_kind + section);
        else
            out_ << "))\n";
    }

    MeshView mesh_;
    std::span<const Marker> lines_;
    std::vector<std::size_t> on_line_{};  ///< per line: number of its faces
    MeshFaces faces_;
    bool binary_;
    std::ostream& out_;
};

}  // namespace

void write_fluent(const MeshView& mesh, const std::filesystem::path& file, bool binary, std::ostream& out) {
    require_legal_marker_names(mesh.markers, file, "Fluent");
    const std::vector<Marker> boundary = markers_of_kind(mesh.markers, false),
                              lines = markers_of_kind(mesh.markers, true);
    MeshView boundary_alone = mesh;
    boundary_alone.markers = boundary;
    MeshFaces faces = find_faces(boundary_alone, file, "Fluent");
    if (faces.faces.size() > std::numeric_limits<std::int32_t>::max())
        throw UsageError(fmt::format("{}: Fluent numbers no more than 2^31 faces", file.string()));
    FluentWriter(boundary_alone, lines, std::move(faces), binary, out).write();
}

}  // namespace lamina::io
