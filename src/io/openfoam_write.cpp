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

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "io/formats.hpp"
#include "io/mesh_faces.hpp"
#include "io/mesh_parts.hpp"
#include "io/openfoam_span.hpp"
#include "io/text_output.hpp"
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
        : mesh_(mesh), file_(file), faces_(find_faces(mesh, file, "OpenFOAM")) {}

    void write(const fs::path& folder) const {
        const std::size_t n = mesh_.points.size(), cells = faces_.edges.cells();
        const std::size_t faces = faces_.faces.size() + 2 * cells;
        const std::string note =
            fmt::format("    note        \"nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}\";\n", 2 * n, cells,
                        faces, faces_.internal);
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
        const std::size_t cells = faces_.edges.cells(), sides = faces_.faces.size();
        write_list(out, faces, [&](LineText& line, std::size_t f) {
            if (f < sides)
                put_side(line, f);
            else if (f < sides + cells)
                put_back(line, f - sides);
            else
                put_front(line, f - sides - cells);
            line.take_back() << ")";
        });
    }
    void put_side(LineText& line, std::size_t side) const {
        const std::size_t n = mesh_.points.size();
        const std::size_t a = faces_.origin(side).index(), b = faces_.target(side).index();
        line.tight("4(") << a << b << n + b << n + a;
    }
    void put_back(LineText& line, std::size_t cell) const {
        line.tight(faces_.edges.corners(cell) == 3 ? "3(" : "4(");
        for (std::size_t k = faces_.edges.corners(cell); k-- > 0;) line << faces_.edges.corner(cell, k).index();
    }
    void put_front(LineText& line, std::size_t cell) const {
        line.tight(faces_.edges.corners(cell) == 3 ? "3(" : "4(");
        for (std::size_t k = 0; k < faces_.edges.corners(cell); ++k)
            line << mesh_.points.size() + faces_.edges.corner(cell, k).index();
    }
    void write_owners(std::ostream& out, std::size_t faces) const {
        const std::size_t cells = faces_.edges.cells(), sides = faces_.faces.size();
        write_list(out, faces,
                   [&](LineText& line, std::size_t f) { line << (f < sides ? faces_.owner(f) : (f - sides) % cells); });
    }
    void write_neighbours(std::ostream& out) const {
        write_list(out, faces_.internal, [&](LineText& line, std::size_t f) { line << faces_.neighbour(f); });
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
        std::size_t start = faces_.internal;
        for (const Marker& marker : mesh_.markers) {
            write_patch(marker.name, patch_type(marker.kind), marker.edges.size(), start);
            start += marker.edges.size();
        }
        write_patch(front_and_back, "empty", 2 * faces_.edges.cells(), start);
        out << ")\n";
    }

    MeshView mesh_;
    const fs::path& file_;
    MeshFaces faces_;  ///< the side faces
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
