// Writes OpenFOAM's polyMesh: a folder with the files points, faces, owner, neighbour and boundary, in ASCII. The mesh
// lies in the x-y plane and is one cell thick in z, with the patch `frontAndBack` of type empty. Source: OpenFOAM user
// guide, "Mesh description".
//
//    b'------a'       A side face stands on the edge a -> b of its owner, the cell on the left of the edge. Its corners
//    |       |        are a, b, b', a', so that its normal points out of the owner. The points a, b ... with z = 0 are
//    b-------a        numbered as in the mesh; the points a', b' ... with z = openfoam_span follow.
//
// Internal faces come first, in upper-triangular order: by owner (the lower of the two cells), then by neighbour. The
// patches follow: the faces of each marker in the order of its edges, then the back (z = 0) of all cells, then the
// front.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "core/parallel.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/openfoam_span.hpp"
#include "io/text_output.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/partition.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

std::string foam_header(const char* type, const std::string& note, const char* location, const char* name) {
    return fmt::format(
        "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n{}"
        "    location    \"{}\";\n    object      {};\n}}\n\n",
        type, note, location, name);
}

template <class F>
void write_list(std::ostream& out, std::size_t n, F&& put_line) {
    out << n << "\n(\n";
    write_lines(out, n, put_line);
    out << ")\n";
}

/// Side faces, each given by the directed edge of its owner that it stands on (CellEdges).
using SideFaces = std::vector<std::uint32_t>;

/// Returns each internal face once, on the edge of the lower cell, sorted by owner, then by neighbour.
SideFaces internal_faces(const mesh::CellEdges& edges, const mesh::Adjacency& adjacency) {
    constexpr std::size_t grain = 1 << 14;
    const auto faces_of = [&](std::size_t begin, std::size_t end) {
        SideFaces faces;
        for (std::size_t cell = begin; cell < end; ++cell) {
            const auto first = static_cast<std::ptrdiff_t>(faces.size());
            for (std::size_t e = edges.first(cell); e < edges.first(cell) + edges.corners(cell); ++e)
                if (adjacency.twin[e] != mesh::no_edge && edges.cell_of(adjacency.twin[e]) > cell)
                    faces.push_back(static_cast<std::uint32_t>(e));
            std::sort(faces.begin() + first, faces.end(), [&](std::uint32_t a, std::uint32_t b) {
                return edges.cell_of(adjacency.twin[a]) < edges.cell_of(adjacency.twin[b]);
            });
        }
        return faces;
    };
    SideFaces all;
    for (const SideFaces& faces : core::parallel_blocks(edges.cells(), grain, faces_of))
        all.insert(all.end(), faces.begin(), faces.end());
    return all;
}

/// Returns the faces on the edges of the markers, marker by marker. Throws MeshError where such an edge is not on the
/// boundary or has its cell on the right.
SideFaces marker_faces(const MeshView& mesh, const mesh::CellEdges& edges, const mesh::Adjacency& adjacency,
                       const fs::path& file) {
    std::vector<Segment> marked;
    for (const Marker& marker : mesh.markers) marked.insert(marked.end(), marker.edges.begin(), marker.edges.end());
    SideFaces faces = mesh::find_edges(mesh, marked);
    std::size_t i = 0;
    for (const Marker& marker : mesh.markers)
        for (const Segment& edge : marker.edges) {
            const std::uint32_t e = faces[i++];
            if (e != mesh::no_edge && adjacency.twin[e] == mesh::no_edge && edges.origin(e) == edge.a) continue;
            const Point at = mesh.points[edge.a.index()];
            throw MeshError(
                fmt::format("{}: OpenFOAM cannot hold an edge of marker '{}' at ({}, {}) that is not on "
                            "the boundary, with its cell on the left",
                            file.string(), marker.name, at.x, at.y));
        }
    return faces;
}

const char* patch_type(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::wall:
            return "wall";
        case MarkerKind::symmetry:
            return "symmetry";
        case MarkerKind::far_field:
        case MarkerKind::other:
            break;
    }
    return "patch";
}

class PolyMeshWriter {
public:
    PolyMeshWriter(const MeshView& mesh, const fs::path& file)
        : mesh_(mesh), file_(file), edges_(mesh), adjacency_(mesh::find_adjacency(mesh)) {
        if (!adjacency_.overused.empty())
            throw MeshError(fmt::format("{}: OpenFOAM cannot hold a mesh that is not conforming", file.string()));
        sides_ = internal_faces(edges_, adjacency_);
        internal_ = sides_.size();
        const SideFaces marked = marker_faces(mesh, edges_, adjacency_, file);
        sides_.insert(sides_.end(), marked.begin(), marked.end());
        if (sides_.size() - internal_ != adjacency_.boundary.size())
            throw MeshError(
                fmt::format("{}: OpenFOAM wants every edge of the boundary in exactly one marker", file.string()));
    }

    void write(const fs::path& folder) const {
        const std::size_t n = mesh_.points.size(), cells = edges_.cells();
        const std::size_t faces = sides_.size() + 2 * cells;
        const std::string note =
            fmt::format("    note        \"nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}\";\n", 2 * n, cells,
                        faces, internal_);
        write_part(folder, "points", "vectorField", "", [&](std::ostream& out) { write_points(out); });
        write_part(folder, "faces", "faceList", "", [&](std::ostream& out) { write_faces(out, faces); });
        write_part(folder, "owner", "labelList", note, [&](std::ostream& out) { write_owners(out, faces); });
        write_part(folder, "neighbour", "labelList", note, [&](std::ostream& out) { write_neighbours(out); });
        write_part(folder, "boundary", "polyBoundaryMesh", "", [&](std::ostream& out) { write_patches(out); });
    }

private:
    void write_part(const fs::path& folder, const char* name, const char* type, const std::string& note,
                    const std::function<void(std::ostream&)>& write) const {
        core::write_stream(folder / name, file_, [&](std::ostream& out) {
            out << foam_header(type, note, "constant/polyMesh", name);
            write(out);
        });
    }

    void write_points(std::ostream& out) const {
        const std::size_t n = mesh_.points.size();
        const std::string front = fmt::format("{})", io::openfoam_span);
        write_list(out, 2 * n, [&](LineText& line, std::size_t i) {
            line.tight("(") << mesh_.points[i < n ? i : i - n] << (i < n ? std::string_view("0)") : front);
        });
    }
    void write_faces(std::ostream& out, std::size_t faces) const {
        const std::size_t cells = edges_.cells();
        write_list(out, faces, [&](LineText& line, std::size_t f) {
            if (f < sides_.size())
                put_side(line, sides_[f]);
            else if (f < sides_.size() + cells)
                put_back(line, f - sides_.size());
            else
                put_front(line, f - sides_.size() - cells);
            line.take_back() << ")";
        });
    }
    void put_side(LineText& line, std::size_t edge) const {
        const std::size_t n = mesh_.points.size();
        const std::size_t a = edges_.origin(edge).index(), b = edges_.target(edge).index();
        line.tight("4(") << a << b << n + b << n + a;
    }
    void put_back(LineText& line, std::size_t cell) const {
        line.tight(edges_.corners(cell) == 3 ? "3(" : "4(");
        for (std::size_t k = edges_.corners(cell); k-- > 0;) line << edges_.corner(cell, k).index();
    }
    void put_front(LineText& line, std::size_t cell) const {
        line.tight(edges_.corners(cell) == 3 ? "3(" : "4(");
        for (std::size_t k = 0; k < edges_.corners(cell); ++k)
            line << mesh_.points.size() + edges_.corner(cell, k).index();
    }
    void write_owners(std::ostream& out, std::size_t faces) const {
        const std::size_t cells = edges_.cells();
        write_list(out, faces, [&](LineText& line, std::size_t f) {
            line << (f < sides_.size() ? edges_.cell_of(sides_[f]) : (f - sides_.size()) % cells);
        });
    }
    void write_neighbours(std::ostream& out) const {
        write_list(out, internal_,
                   [&](LineText& line, std::size_t f) { line << edges_.cell_of(adjacency_.twin[sides_[f]]); });
    }
    void write_patches(std::ostream& out) const {
        const auto write_patch = [&](const std::string& name, const char* type, std::size_t faces, std::size_t start) {
            out << fmt::format(
                "    {}\n    {{\n        type            {};\n        nFaces          {};\n        startFace       "
                "{};\n"
                "    }}\n",
                name, type, faces, start);
        };
        out << mesh_.markers.size() + 1 << "\n(\n";
        std::size_t start = internal_;
        for (const Marker& marker : mesh_.markers) {
            write_patch(marker.name, patch_type(marker.kind), marker.edges.size(), start);
            start += marker.edges.size();
        }
        write_patch(front_and_back, "empty", 2 * edges_.cells(), start);
        out << ")\n";
    }

    MeshView mesh_;
    const fs::path& file_;
    mesh::CellEdges edges_;
    mesh::Adjacency adjacency_;
    SideFaces sides_;           ///< the internal faces, then those of the markers
    std::size_t internal_ = 0;  ///< number of internal faces
};

/// Writes the part of each cell.
void write_parts(const MeshView& mesh, std::size_t parts, const fs::path& target) {
    const std::vector<std::uint32_t> part_of_cell = mesh::partition_cells(mesh, parts);
    core::write_stream_atomically(target, [&](std::ostream& out) {
        out << foam_header("labelList", "", "constant", "cellDecomposition");
        write_list(out, part_of_cell.size(),
                   [&](LineText& line, std::size_t c) { line << std::size_t{part_of_cell[c]}; });
    });
}

}  // namespace

fs::path poly_mesh_folder(const fs::path& file) {
    const fs::path folder = file.has_filename() ? file : file.parent_path();
    return folder.filename().string().ends_with("polyMesh") ? folder : folder / "constant" / "polyMesh";
}

bool holds_openfoam_mesh(const fs::path& file) {
    std::error_code ignored;
    return fs::exists(poly_mesh_folder(file) / "faces", ignored);
}

fs::path openfoam_parts_file(const fs::path& file) {
    return poly_mesh_folder(file).parent_path() / "cellDecomposition";
}

void check_openfoam_writable(const fs::path& file) {
    const fs::path folder = poly_mesh_folder(file);
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        throw IoError(folder.string(), "cannot write: is a file, not a folder");
    // The folder is replaced with all that is in it, so it may hold nothing but a mesh.
    if (fs::is_directory(folder, ignored) && !fs::is_empty(folder, ignored) && !fs::exists(folder / "faces", ignored) &&
        !fs::exists(folder / "faces.gz", ignored))
        throw IoError(folder.string(), "cannot write: the folder holds something, but no mesh");
    fs::path outermost_missing = folder;
    while (outermost_missing.has_parent_path() && !fs::exists(outermost_missing.parent_path(), ignored))
        outermost_missing = outermost_missing.parent_path();
    check_folder_writable(outermost_missing == folder ? folder.parent_path() / "points" : outermost_missing);
}

void write_openfoam(const MeshView& mesh, const fs::path& file, std::size_t parts) {
    require_legal_marker_names(mesh.markers, file, "OpenFOAM");
    const PolyMeshWriter writer(mesh, file);
    core::write_folder_atomically(poly_mesh_folder(file), [&](const fs::path& folder) { writer.write(folder); });
    if (parts > 1) write_parts(mesh, parts, openfoam_parts_file(file));
}

}  // namespace lamina::io
