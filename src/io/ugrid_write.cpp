// Writes UGRID files, plane or in space, with their .mapbc. ugrid.hpp describes the format.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"
#include "io/binary_output.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"
#include "io/ugrid.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

MapbcCode code_of(const MeshView& mesh, const Marker& marker) {
    switch (marker.kind) {
        case MarkerKind::wall:
            return mapbc_viscous_wall;
        case MarkerKind::far_field:
            return mapbc_far_field;
        case MarkerKind::symmetry: {
            // A line of symmetry of the plane mesh is x = constant or y = constant, which is z in three dimensions.
            Box box;
            for (const Segment& edge : marker.edges) box.include(mesh.points[edge.a.index()]);
            return box.width() < box.height() ? mapbc_symmetry_x : mapbc_symmetry_z;
        }
        case MarkerKind::periodic:
        case MarkerKind::internal:
        case MarkerKind::other:
            break;
    }
    return mapbc_unknown;  // the user has to fill in the condition
}

/// Writes the conditions of the markers and, of a mesh in space, of the planes.
void write_mapbc(const MeshView& mesh, const Extrusion* extrusion, std::ostream& out) {
    out << mesh.markers.size() + (extrusion != nullptr ? 2 : 0) << '\n';
    std::size_t number = 0;
    for (const Marker& marker : mesh.markers)
        out << fmt::format("{} {} {}\n", ++number, int{code_of(mesh, marker)}, marker.name);
    if (extrusion == nullptr) return;
    const MapbcCode code = extrusion->periodic ? mapbc_periodic : mapbc_symmetry_y;
    out << fmt::format("{} {} y0\n", ++number, int{code});
    out << fmt::format("{} {} y1\n", ++number, int{code});
}

void write_plane(const MeshView& mesh, std::ostream& out) {
    out << fmt::format("{} {} {} 0 0 0 0\n", mesh.points.size(), mesh.triangles.size(), mesh.quads.size());
    write_lines(out, mesh.points.size(), [&](LineText& line, std::size_t i) { line << mesh.points[i] << "0"; });
    write_lines(out, mesh.triangles.size(), [&](LineText& line, std::size_t i) {
        for (const VertexId v : mesh.triangles[i].v) line << v.index() + 1;
    });
    write_lines(out, mesh.quads.size(), [&](LineText& line, std::size_t i) {
        for (const VertexId v : mesh.quads[i].v) line << v.index() + 1;
    });
    write_lines(out, mesh.triangles.size() + mesh.quads.size(), [](LineText& line, std::size_t) { line << "1"; });
    out << count_marker_edges(mesh) << '\n';
    for (std::size_t m = 0; m < mesh.markers.size(); ++m)
        write_lines(out, mesh.markers[m].edges.size(), [&](LineText& line, std::size_t i) {
            const Segment& edge = mesh.markers[m].edges[i];
            line << edge.a.index() + 1 << edge.b.index() + 1 << m + 1;
        });
}

/// Writes lists of numbers as lines or as binary records.
class NumberWriter {
public:
    NumberWriter(std::ostream& out, UgridEncoding encoding) : out_(out), encoding_(encoding) {}

    /// Writes n entries of `each` numbers of type T. put(i, emit) calls emit(value) for the numbers of entry i.
    template <class T, class Put>
    void write_list(std::size_t n, std::size_t each, Put&& put) {
        if (encoding_ == UgridEncoding::ascii) {
            write_lines(out_, n, [&](LineText& line, std::size_t i) { put(i, [&](T value) { line << value; }); });
            return;
        }
        using Stored = std::conditional_t<std::is_same_v<T, double>, double, std::int32_t>;
        const ByteOrder order = encoding_ == UgridEncoding::big_endian ? ByteOrder::big : ByteOrder::little;
        write_records(out_, n, each * sizeof(Stored), [&](char* p, std::size_t i) {
            put(i, [&](T value) { p = store(p, static_cast<Stored>(value), order); });
        });
    }

private:
    std::ostream& out_;
    UgridEncoding encoding_;
};

/// Writes a mesh in space.
class ThickMeshWriter {
public:
    ThickMeshWriter(const MeshView& mesh, const Extrusion& extrusion, UgridEncoding encoding, std::ostream& out)
        : mesh_(mesh), extrusion_(extrusion), points_(mesh.points.size()), writer_(out, encoding) {}

    void write() {
        write_counts();
        write_nodes();
        write_plane_faces<Triangle>(mesh_.triangles);
        for (const Marker& marker : mesh_.markers) write_side_faces(marker);
        write_plane_faces<Quad>(mesh_.quads);
        write_marker_numbers();
        write_volumes<Triangle>(mesh_.triangles);
        write_volumes<Quad>(mesh_.quads);
    }

private:
    void write_counts() {
        const std::size_t triangles = mesh_.triangles.size(), quads = mesh_.quads.size();
        const std::size_t cells = extrusion_.cells, sides = cells * count_marker_edges(mesh_);
        const std::array<std::size_t, 7> counts{
            extrusion_.planes() * points_, 2 * triangles, sides + 2 * quads, 0, 0, cells * triangles, cells * quads};
        writer_.write_list<std::size_t>(1, counts.size(), [&](std::size_t, auto emit) {
            for (const std::size_t count : counts) emit(count);
        });
    }
    void write_nodes() {
        writer_.write_list<double>(extrusion_.planes() * points_, 3, [&](std::size_t i, auto emit) {
            const Point p = mesh_.points[i % points_];
            emit(p.x);
            emit(extrusion_.height(i / points_));
            emit(p.y);
        });
    }

    template <class Cell>
    static constexpr std::size_t corners_of = std::extent_v<decltype(Cell::v)>;

    /// Writes the faces at the first plane, which run clockwise in x-z, and those at the last, which run the other way.
    template <class Cell>
    void write_plane_faces(std::span<const Cell> cells) {
        constexpr std::size_t corners = corners_of<Cell>;
        writer_.write_list<std::size_t>(cells.size(), corners, [&](std::size_t i, auto emit) {
            for (std::size_t k = corners; k-- > 0;) emit(cells[i].v[k].index() + 1);
        });
        writer_.write_list<std::size_t>(cells.size(), corners, [&](std::size_t i, auto emit) {
            for (std::size_t k = 0; k < corners; ++k) emit(extrusion_.cells * points_ + cells[i].v[k].index() + 1);
        });
    }
    void write_side_faces(const Marker& marker) {
        const std::size_t edges = marker.edges.size();
        writer_.write_list<std::size_t>(extrusion_.cells * edges, 4, [&](std::size_t i, auto emit) {
            const Segment& edge = marker.edges[i % edges];
            const std::size_t first = i / edges * points_ + 1;
            const std::size_t a = first + edge.a.index(), b = first + edge.b.index();
            for (const std::size_t node : {a, b, points_ + b, points_ + a}) emit(node);
        });
    }
    /// Writes for each face the number of its marker or plane.
    void write_marker_numbers() {
        const auto write = [&](std::size_t count, std::size_t number) {
            writer_.write_list<std::size_t>(count, 1, [&](std::size_t, auto emit) { emit(number); });
        };
        const std::size_t triangles = mesh_.triangles.size(), quads = mesh_.quads.size();
        const std::size_t markers = mesh_.markers.size();
        write(triangles, markers + 1);
        write(triangles, markers + 2);
        for (std::size_t m = 0; m < markers; ++m) write(extrusion_.cells * mesh_.markers[m].edges.size(), m + 1);
        write(quads, markers + 1);
        write(quads, markers + 2);
    }
    template <class Cell>
    void write_volumes(std::span<const Cell> cells) {
        constexpr std::size_t corners = corners_of<Cell>;
        writer_.write_list<std::size_t>(extrusion_.cells * cells.size(), 2 * corners, [&](std::size_t i, auto emit) {
            const Cell& cell = cells[i % cells.size()];
            const std::size_t first = i / cells.size() * points_;
            for (const std::size_t shift : {first + points_, first})
                for (std::size_t k = 0; k < corners; ++k) emit(shift + cell.v[k].index() + 1);
        });
    }

    MeshView mesh_;
    const Extrusion& extrusion_;
    std::size_t points_;
    NumberWriter writer_;
};

/// Writes a plane mesh, or one in space.
void write_with_mapbc(const MeshView& mesh, const fs::path& file, const Extrusion* extrusion) {
    require_legal_marker_names(mesh.markers, file, "UGRID");
    if (mesh.points.size() > std::numeric_limits<std::int32_t>::max() / 2)
        throw UsageError(fmt::format("{}: UGRID numbers no more than 2^31 nodes", file.string()));
    const std::vector<fs::path> targets = ugrid_files(file);
    core::write_files_atomically(targets, [&](std::span<const fs::path> temporaries) {
        core::write_stream(temporaries[0], targets[0], [&](std::ostream& out) {
            if (extrusion != nullptr)
                ThickMeshWriter(mesh, *extrusion, encoding_of(file), out).write();
            else
                write_plane(mesh, out);
        });
        core::write_stream(temporaries[1], targets[1], [&](std::ostream& out) { write_mapbc(mesh, extrusion, out); });
    });
}

}  // namespace

void write_ugrid(const MeshView& mesh, const fs::path& file) { write_with_mapbc(mesh, file, nullptr); }

void write_fun3d(const MeshView& mesh, const fs::path& file, const Extrusion& extrusion) {
    write_with_mapbc(mesh, file, &extrusion);
}

}  // namespace lamina::io
