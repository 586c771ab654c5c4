// OpenFOAM's polyMesh: a folder with points, faces, owner, neighbour, boundary, in ASCII. The mesh lies in the x-y
// plane and is one cell thick in z, with the patch `frontAndBack` of type empty. Source: OpenFOAM user guide, "Mesh
// description".
//
//    b'------a'       A side face stands on an edge a -> b of its owner (the cell on the left): a, b, b', a', so that
//   /|      /|        the normal points out of the owner. Points with z = 0 are numbered as in the mesh, those with
//  b-+-----a |        z = 1 behind them.
//
// Internal faces come first, in upper-triangular order: by owner (the lower of the two cells), then by neighbour. Then
// the patches: each marker's faces in the order of its edges, the back (z = 0) and the front of each cell.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/atomic_file.hpp"
#include "core/parallel.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// Directed edges of cells, numbered as in CellEdges: each is a side face, seen from its owner.
using EdgeList = std::vector<std::uint32_t>;

/// By owner, then neighbour: each face once, on the edge of its lower cell.
EdgeList internal_faces(const mesh::CellEdges& edges, const mesh::Adjacency& adjacency) {
    constexpr std::size_t grain = 1 << 14;
    const auto faces_of = [&](std::size_t begin, std::size_t end) {
        EdgeList faces;
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
    EdgeList all;
    for (const EdgeList& faces : core::parallel_blocks(edges.cells(), grain, faces_of))
        all.insert(all.end(), faces.begin(), faces.end());
    return all;
}

/// The edges of the cells that the markers' edges are, marker by marker.
EdgeList marker_faces(const Mesh& mesh, const mesh::CellEdges& edges, const mesh::Adjacency& adjacency,
                      const fs::path& file) {
    std::vector<Segment> marked;
    for (const Marker& marker : mesh.markers) marked.insert(marked.end(), marker.edges.begin(), marker.edges.end());
    EdgeList faces = mesh::find_edges(mesh, marked);
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
    PolyMeshWriter(const Mesh& mesh, const fs::path& file)
        : mesh_(mesh), file_(file), edges_(mesh), adjacency_(mesh::find_adjacency(mesh)) {
        if (!adjacency_.overused.empty())
            throw MeshError(fmt::format("{}: OpenFOAM cannot hold a mesh that is not conforming", file.string()));
        sides_ = internal_faces(edges_, adjacency_);
        internal_ = sides_.size();
        const EdgeList marked = marker_faces(mesh, edges_, adjacency_, file);
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
            out << fmt::format(
                "FoamFile\n{{\n    version     2.0;\n    format      ascii;\n    class       {};\n{}"
                "    location    \"constant/polyMesh\";\n    object      {};\n}}\n\n",
                type, note, name);
            write(out);
        });
    }
    template <class F>
    static void write_list(std::ostream& out, std::size_t n, F&& put_line) {
        out << n << "\n(\n";
        write_lines(out, n, put_line);
        out << ")\n";
    }

    void write_points(std::ostream& out) const {
        const std::size_t n = mesh_.points.size();
        write_list(out, 2 * n, [&](LineText& line, std::size_t i) {
            line.tight("(") << mesh_.points[i < n ? i : i - n] << (i < n ? "0)" : "1)");
        });
    }
    void write_faces(std::ostream& out, std::size_t faces) const {
        const std::size_t n = mesh_.points.size(), cells = edges_.cells();
        write_list(out, faces, [&](LineText& line, std::size_t f) {
            std::size_t corner[4], corners = 4;
            if (f < sides_.size()) {
                const std::size_t a = edges_.origin(sides_[f]).index(), b = edges_.target(sides_[f]).index();
                const std::size_t side[4] = {a, b, n + b, n + a};
                std::copy(side, side + 4, corner);
            } else {
                const bool back = f < sides_.size() + cells;
                const std::size_t cell = f - sides_.size() - (back ? 0 : cells);
                corners = edges_.corners(cell);
                for (std::size_t k = 0; k < corners; ++k)
                    corner[k] =
                        back ? edges_.corner(cell, corners - 1 - k).index() : n + edges_.corner(cell, k).index();
            }
            line.tight(corners == 3 ? "3(" : "4(");
            for (std::size_t k = 0; k < corners; ++k) line << corner[k];
            line.take_back() << ")";
        });
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

    const Mesh& mesh_;
    const fs::path& file_;
    mesh::CellEdges edges_;
    mesh::Adjacency adjacency_;
    EdgeList sides_;  ///< internal ones, then those of the markers
    std::size_t internal_ = 0;
};

}  // namespace

fs::path poly_mesh_folder(const fs::path& file) {
    const fs::path folder = file.has_filename() ? file : file.parent_path();
    return folder.filename().string().ends_with("polyMesh") ? folder : folder / "constant" / "polyMesh";
}

void check_openfoam_writable(const fs::path& file) {
    const fs::path folder = poly_mesh_folder(file);
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
        throw IoError(folder.string(), "cannot write: is a file, not a folder");
    // It gives way to the new one with all that is in it: nothing but a mesh may be lost so.
    if (fs::is_directory(folder, ignored) && !fs::is_empty(folder, ignored) && !fs::exists(folder / "faces", ignored) &&
        !fs::exists(folder / "faces.gz", ignored))
        throw IoError(folder.string(), "cannot write: the folder holds something, but no mesh");
    fs::path made = folder;  // the outermost folder that is missing
    while (made.has_parent_path() && !fs::exists(made.parent_path(), ignored)) made = made.parent_path();
    check_folder_writable(made == folder ? folder.parent_path() / "points" : made);
}

void write_openfoam(const Mesh& mesh, const fs::path& file) {
    require_marker_names(mesh, file, "OpenFOAM", " \"'/;{}()$#", 1000);
    for (const Marker& marker : mesh.markers)
        if (marker.name == front_and_back)
            throw UsageError(fmt::format("{}: OpenFOAM needs the name '{}' for the sides", file.string(), marker.name));
    const PolyMeshWriter writer(mesh, file);
    core::write_folder_atomically(poly_mesh_folder(file), [&](const fs::path& folder) { writer.write(folder); });
}

}  // namespace lamina::io
