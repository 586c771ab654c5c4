// Writes OpenFOAM's polyMesh: a folder with the files points, faces, owner, neighbour and boundary, in ASCII. The mesh
// stands on the x-y plane (extrusion.hpp). Source: OpenFOAM user guide, "Mesh description".
//
//    b'------a'       A side face stands on the edge a -> b of its owner, the cell on the left of the edge. Its corners
//    |       |        are a, b, b', a', so that its normal points out of the owner. The points a', b' ... are those of
//    b-------a        the next plane.
//
// Internal faces come first, in upper-triangular order: by owner (the lower of the two cells), then by neighbour, which
// for each cell but those at the last plane ends with the face to the next plane. The patches follow: the faces of each
// marker, from plane to plane in the order of its edges, then the back of all cells at the first plane, then the front
// of those at the last one. For plane flow both are one patch, `frontAndBack`, of type empty.
//
// A mesh with a line of symmetry called `axis` becomes a wedge of 2.5 degrees about y = 0: both planes are turned about
// it by half of that, and are patches of type wedge. Points on the axis are in both planes, sides with one end on it
// are triangles, and those on it are no faces.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>
#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "core/reproducible_math.hpp"
#include "io/extrusion.hpp"
#include "io/formats.hpp"
#include "io/mesh_faces.hpp"
#include "io/mesh_parts.hpp"
#include "io/text_output.hpp"
#include "mesh/partition.hpp"
#include "mesh/periodic.hpp"

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
        case MarkerKind::internal:
        case MarkerKind::other:
        case MarkerKind::periodic:
            break;
    }
    return "patch";
}

/// Returns the marker on the axis of a mesh round one, or null.
const Marker* axis_of(const MeshView& mesh) {
    const auto axis = std::find_if(mesh.markers.begin(), mesh.markers.end(), is_axis<Marker>);
    return axis == mesh.markers.end() ? nullptr : &*axis;
}

/// Returns the periodic borders of a mesh, if it has such.
std::optional<mesh::PeriodicPair> pair_of(const MeshView& mesh) {
    return mesh::find_periodic_pair(mesh.points, mesh.markers).pair;
}

/// Returns the markers with the edges of periodic borders in the same order on both, as OpenFOAM wants them.
std::vector<Marker> markers_in_pairs(const MeshView& mesh) {
    std::vector<Marker> markers(mesh.markers.begin(), mesh.markers.end());
    if (const auto pair = pair_of(mesh))
        for (std::size_t i = 0; i < pair->edges.size(); ++i) {
            markers[pair->first].edges[i] = mesh.markers[pair->first].edges[pair->edges[i].first];
            markers[pair->second].edges[i] = mesh.markers[pair->second].edges[pair->edges[i].second];
        }
    return markers;
}

/// Writes vectors of the vertices in each plane, with the third components of the planes.
void write_planes(std::ostream& out, std::span<const Point> points, const std::vector<double>& heights) {
    std::vector<std::string> ends;
    ends.reserve(heights.size());
    for (const double height : heights) ends.push_back(fmt::format("{})", height));
    write_list(out, heights.size() * points.size(), [&](LineText& line, std::size_t i) {
        line.tight("(") << points[i % points.size()] << ends[i / points.size()];
    });
}

/// Returns the heights of the planes.
std::vector<double> heights_of(const Extrusion& extrusion) {
    std::vector<double> heights;
    for (std::size_t k = 0; k < extrusion.planes(); ++k) heights.push_back(extrusion.height(k));
    return heights;
}

class PolyMeshWriter {
public:
    /// `lines` are the internal markers; the mesh is without them.
    PolyMeshWriter(const MeshView& mesh, std::span<const Marker> lines, const fs::path& file,
                   const Extrusion& extrusion)
        : mesh_(mesh),
          lines_(lines),
          file_(file),
          extrusion_(extrusion),
          faces_(find_faces(mesh, file, "OpenFOAM")),
          axis_(axis_of(mesh)),
          pair_(pair_of(mesh)) {
        if (pair_) {
            upper_first_ = faces_.internal;
            for (std::size_t m = 0; m < pair_->second; ++m) upper_first_ += mesh.markers[m].edges.size();
        }
        if (extrusion.cells > 1) order_faces();
        if (axis_ != nullptr) collapse_axis();
    }

    void write(const fs::path& folder) const {
        const std::string note =
            fmt::format("    note        \"nPoints:{}  nCells:{}  nFaces:{}  nInternalFaces:{}\";\n", points(),
                        extrusion_.cells * cells(), all_faces(), internal_faces());
        write_part(folder, "points", "vectorField", "", [&](std::ostream& out) { write_points(out); });
        write_part(folder, "faces", "faceList", "", [&](std::ostream& out) { write_faces(out); });
        write_part(folder, "owner", "labelList", note, [&](std::ostream& out) { write_owners(out); });
        write_part(folder, "neighbour", "labelList", note, [&](std::ostream& out) { write_neighbours(out); });
        write_part(folder, "boundary", "polyBoundaryMesh", "", [&](std::ostream& out) { write_patches(out); });
        if (!lines_.empty())
            write_part(folder, "faceZones", "regIOobject", "", [&](std::ostream& out) { write_zones(out); });
    }

private:
    /// A face of the mesh: a side of the plane mesh between a plane and the next, or a cell of it in a plane.
    struct FoamFace {
        bool is_side;
        std::size_t number;  ///< of the side among the faces of the plane mesh, or of the cell
        std::size_t plane;   ///< the lower plane of a side
    };

    std::size_t cells() const { return faces_.edges.cells(); }
    std::size_t internal_faces() const { return extrusion_.cells * (faces_.internal + cells()) - cells(); }
    std::size_t side_patches() const {
        const std::size_t on_axis = axis_ == nullptr ? 0 : axis_->edges.size();
        return extrusion_.cells * (faces_.faces.size() - faces_.internal - on_axis);
    }
    std::size_t points() const {
        return axis_ == nullptr ? extrusion_.planes() * mesh_.points.size() : mesh_.points.size() + off_axis_.size();
    }
    /// Returns the node of a point in a plane.
    std::size_t node(VertexId point, std::size_t plane) const {
        if (axis_ == nullptr) return plane * mesh_.points.size() + point.index();
        return plane == 0 ? point.index() : turned_[point.index()];
    }

    /// Numbers the nodes of the second plane of a wedge. Throws UsageError where the axis is not y = 0, or a point is
    /// below it.
    void collapse_axis() {
        if (extrusion_.cells > 1 || extrusion_.periodic || extrusion_.length != openfoam_span)
            throw UsageError(file_.string() +
                             ": a mesh with a marker 'axis' becomes a wedge, which has no span: leave --span out");
        std::vector<char> on_axis(mesh_.points.size(), 0);
        for (const Segment& edge : axis_->edges) on_axis[edge.a.index()] = on_axis[edge.b.index()] = 1;
        turned_.resize(mesh_.points.size());
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            const double y = mesh_.points[i].y;
            if (on_axis[i] ? y != 0 : !(y > 0))
                throw UsageError(file_.string() + ": a marker 'axis' must lie on y = 0, and all other points above it");
            turned_[i] = on_axis[i] ? i : mesh_.points.size() + off_axis_.size();
            if (!on_axis[i]) off_axis_.push_back(i);
        }
    }
    std::size_t all_faces() const { return internal_faces() + side_patches() + 2 * cells(); }

    /// Orders the internal sides between two planes and the cells in the upper one by their owners.
    void order_faces() {
        order_.reserve(faces_.internal + cells());
        std::size_t side = 0;
        for (std::size_t cell = 0; cell < cells(); ++cell) {
            for (; side < faces_.internal && faces_.owner(side) == cell; ++side)
                order_.push_back(static_cast<std::uint32_t>(side));
            order_.push_back(static_cast<std::uint32_t>(faces_.internal + cell));
        }
    }
    /// Returns an internal face.
    FoamFace internal_face(std::size_t face) const {
        const std::size_t between_planes = faces_.internal + cells(), plane = face / between_planes;
        if (plane + 1 == extrusion_.cells) return {true, face % between_planes, plane};
        const std::size_t number = order_[face % between_planes];
        if (number < faces_.internal) return {true, number, plane};
        return {false, number - faces_.internal, plane + 1};
    }
    FoamFace face_at(std::size_t face) const {
        if (face < internal_faces()) return internal_face(face);
        face -= internal_faces();
        if (face >= side_patches()) {
            face -= side_patches();
            return {false, face % cells(), face < cells() ? 0 : extrusion_.cells};
        }
        std::size_t first = faces_.internal;
        for (const Marker& marker : mesh_.markers) {
            const std::size_t edges = marker.edges.size();
            if (&marker == axis_) {
                first += edges;
                continue;
            }
            if (face < extrusion_.cells * edges) return {true, first + face % edges, face / edges};
            face -= extrusion_.cells * edges;
            first += edges;
        }
        return {true, first, 0};
    }
    /// Returns the cell of which the normal of the face points out.
    std::size_t owner(const FoamFace& face) const {
        if (face.is_side) return face.plane * cells() + faces_.owner(face.number);
        return (face.plane == 0 ? 0 : face.plane - 1) * cells() + face.number;
    }
    std::size_t neighbour(const FoamFace& face) const {
        return face.plane * cells() + (face.is_side ? faces_.neighbour(face.number) : face.number);
    }

    void write_part(const fs::path& folder, const char* name, const char* type, const std::string& note,
                    const std::function<void(std::ostream&)>& write) const {
        core::write_stream(folder / name, file_, [&](std::ostream& out) {
            out << foam_header(type, note, "constant/polyMesh", name);
            write(out);
        });
    }

    void write_points(std::ostream& out) const {
        const std::size_t n = mesh_.points.size();
        if (axis_ != nullptr) {
            const double turn = core::radians(foam_wedge_deg / 2);
            const double c = core::cos_reproducible(turn), s = core::sin_reproducible(turn);
            write_list(out, points(), [&](LineText& line, std::size_t i) {
                const Point p = mesh_.points[i < n ? i : off_axis_[i - n]];
                line.tight("(") << p.x << c * p.y << fmt::format("{})", p.y == 0 ? 0 : (i < n ? -s : s) * p.y);
            });
            return;
        }
        write_planes(out, mesh_.points, heights_of(extrusion_));
    }
    void write_faces(std::ostream& out) const {
        write_list(out, all_faces(), [&](LineText& line, std::size_t f) {
            const FoamFace face = face_at(f);
            if (face.is_side)
                put_side(line, face);
            else if (face.plane == 0)
                put_back(line, face.number);
            else
                put_front(line, face);
            line.take_back() << ")";
        });
    }
    void put_side(LineText& line, const FoamFace& face) const {
        const VertexId a = faces_.origin(face.number), b = faces_.target(face.number);
        if (pair_ && face.number >= upper_first_ && face.number < upper_first_ + pair_->edges.size()) {
            // Begins with the twin of the vertex that the face on the other border begins with.
            line.tight("4(") << node(b, face.plane) << node(b, face.plane + 1) << node(a, face.plane + 1)
                             << node(a, face.plane);
            return;
        }
        const std::size_t upper_a = node(a, face.plane + 1), upper_b = node(b, face.plane + 1);
        const bool has_a = upper_a != node(a, face.plane), has_b = upper_b != node(b, face.plane);
        line.tight(has_a && has_b ? "4(" : "3(") << node(a, face.plane) << node(b, face.plane);
        if (has_b) line << upper_b;
        if (has_a) line << upper_a;
    }
    /// Puts a face whose normal points down. Where it is periodic, it begins with the same corner as the one above.
    void put_back(LineText& line, std::size_t cell) const {
        const std::size_t corners = faces_.edges.corners(cell), first = extrusion_.periodic ? 0 : corners - 1;
        line.tight(corners == 3 ? "3(" : "4(");
        for (std::size_t k = 0; k < corners; ++k)
            line << faces_.edges.corner(cell, (first + corners - k) % corners).index();
    }
    void put_front(LineText& line, const FoamFace& face) const {
        line.tight(faces_.edges.corners(face.number) == 3 ? "3(" : "4(");
        for (std::size_t k = 0; k < faces_.edges.corners(face.number); ++k)
            line << node(faces_.edges.corner(face.number, k), face.plane);
    }
    void write_owners(std::ostream& out) const {
        write_list(out, all_faces(), [&](LineText& line, std::size_t f) { line << owner(face_at(f)); });
    }
    void write_neighbours(std::ostream& out) const {
        write_list(out, internal_faces(), [&](LineText& line, std::size_t f) { line << neighbour(internal_face(f)); });
    }
    /// One patch of the file boundary; `more` holds further lines of its dictionary.
    struct Patch {
        std::string name;
        const char* type;
        std::size_t faces;
        std::string more;
    };

    void write_patches(std::ostream& out) const {
        std::vector<Patch> patches;
        for (const Marker& marker : mesh_.markers)
            if (&marker != axis_) patches.push_back(patch_of(marker));
        add_patches_of_planes(patches);
        out << patches.size() << "\n(\n";
        std::size_t start = internal_faces();
        for (const Patch& patch : patches) {
            out << fmt::format(
                "    {}\n    {{\n        type            {};\n        nFaces          {};\n        startFace       "
                "{};\n{}"
                "    }}\n",
                patch.name, patch.type, patch.faces, start, patch.more);
            start += patch.faces;
        }
        out << ")\n";
    }

    Patch patch_of(const Marker& marker) const {
        const std::size_t faces = extrusion_.cells * marker.edges.size();
        if (!pair_ || marker.kind != MarkerKind::periodic) return {marker.name, patch_type(marker.kind), faces, {}};
        const bool is_first = &marker == &mesh_.markers[pair_->first];
        const Point t = Point{} + (is_first ? 1.0 : -1.0) * pair_->translation;  // without -0
        return {marker.name, "cyclic", faces,
                fmt::format(
                    "        neighbourPatch  {};\n        transform       translational;\n        separationVector ({} "
                    "{} 0);\n        matchTolerance  0.0001;\n",
                    mesh_.markers[is_first ? pair_->second : pair_->first].name, t.x, t.y)};
    }

    /// Adds the patches of the planes between which the mesh lies.
    void add_patches_of_planes(std::vector<Patch>& patches) const {
        if (axis_ == nullptr && extrusion_.is_plane_flow()) {
            patches.push_back({front_and_back, "empty", 2 * cells(), {}});
            return;
        }
        const bool is_cyclic = axis_ == nullptr && extrusion_.periodic;
        const char* const type = axis_ != nullptr ? "wedge" : is_cyclic ? "cyclic" : "symmetryPlane";
        const auto twin = [&](const char* plane) {
            return is_cyclic ? fmt::format("        neighbourPatch  {};\n", plane) : std::string();
        };
        patches.push_back({first_plane, type, cells(), twin(last_plane)});
        patches.push_back({last_plane, type, cells(), twin(first_plane)});
    }

    /// Writes the faces on lines as zones. A face is flipped where its owner is not on the left of the line.
    void write_zones(std::ostream& out) const {
        std::vector<std::size_t> face_of(faces_.edges.size(), no_face);
        for (std::size_t f = 0; f < internal_faces(); ++f)
            if (const FoamFace face = internal_face(f); face.is_side && face.plane == 0)
                face_of[faces_.faces[face.number]] = f;
        out << lines_.size() << "\n(\n";
        for (const Marker& line : lines_) {
            std::vector<std::size_t> labels;
            std::vector<char> flips;
            const std::vector<std::uint32_t> edges = mesh::find_edges(mesh_, line.edges);
            for (std::size_t i = 0; i < edges.size(); ++i) {
                const std::uint32_t edge = edges[i];
                if (edge == mesh::no_edge || faces_.adjacency.twin[edge] == mesh::no_edge)
                    throw MeshError(fmt::format("{}: marker '{}' holds an edge that is not between two cells",
                                                file_.string(), line.name));
                const std::uint32_t of_owner = face_of[edge] != no_face ? edge : faces_.adjacency.twin[edge];
                const bool flips_here = faces_.edges.origin(of_owner) != line.edges[i].a;
                const std::size_t face = face_of[of_owner];
                for (std::size_t plane = 0; plane < extrusion_.cells; ++plane) {
                    labels.push_back(face + plane * (faces_.internal + cells()));
                    flips.push_back(flips_here ? 1 : 0);
                }
            }
            std::vector<std::size_t> order(labels.size());
            std::iota(order.begin(), order.end(), std::size_t{0});
            std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return labels[a] < labels[b]; });
            out << fmt::format("{}\n{{\n    type faceZone;\n    faceLabels List<label>\n", line.name);
            write_list(out, order.size(), [&](LineText& text, std::size_t i) { text << labels[order[i]]; });
            out << ";\n    flipMap List<bool>\n";
            write_list(out, order.size(), [&](LineText& text, std::size_t i) { text << std::size_t(flips[order[i]]); });
            out << ";\n}\n";
        }
        out << ")\n";
    }

    static constexpr std::size_t no_face = std::numeric_limits<std::size_t>::max();
    MeshView mesh_;
    std::span<const Marker> lines_;
    const fs::path& file_;
    const Extrusion& extrusion_;
    MeshFaces faces_;  ///< those of the plane mesh
    std::vector<std::uint32_t>
        order_;           ///< internal sides, and behind their number cells, for more than one cell across
    const Marker* axis_;  ///< null where the mesh becomes no wedge
    std::optional<mesh::PeriodicPair> pair_;
    std::size_t upper_first_ = 0;          ///< the first face of the upper one of the pair
    std::vector<std::size_t> off_axis_{};  ///< the points beside the axis, of a wedge
    std::vector<std::size_t> turned_{};    ///< per point: its node in the second plane of a wedge
};

/// Writes the part of each cell of so many copies of the mesh.
void write_parts(const MeshView& mesh, std::size_t copies, std::size_t parts, const fs::path& target) {
    const std::vector<std::uint32_t> part_of_cell = mesh::partition_cells(mesh, parts);
    core::write_stream_atomically(target, [&](std::ostream& out) {
        out << foam_header("labelList", "", "constant", "cellDecomposition");
        write_list(out, copies * part_of_cell.size(),
                   [&](LineText& line, std::size_t c) { line << std::size_t{part_of_cell[c % part_of_cell.size()]}; });
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

void write_openfoam(const MeshView& mesh, const fs::path& file, const Extrusion& extrusion, std::size_t parts) {
    require_legal_marker_names(mesh.markers, file, "OpenFOAM");
    const std::vector<Marker> paired = markers_in_pairs(mesh), boundary = markers_of_kind(paired, false),
                              lines = markers_of_kind(paired, true);
    MeshView boundary_alone = mesh;
    boundary_alone.markers = boundary;
    const PolyMeshWriter writer(boundary_alone, lines, file, extrusion);
    core::write_folder_atomically(poly_mesh_folder(file), [&](const fs::path& folder) { writer.write(folder); });
    if (parts > 1) write_parts(mesh, extrusion.cells, parts, openfoam_parts_file(file));
}

std::vector<fs::path> openfoam_time_files(const fs::path& folder) {
    return {folder / "polyMesh" / "points", folder / "displacement"};
}

void write_openfoam_time(const MeshView& reference, std::span<const Point> points, const fs::path& folder) {
    const std::vector<double> heights = heights_of({});
    const std::vector<fs::path> files = openfoam_time_files(folder);
    core::NewFolders folders;
    for (const fs::path& file : files) folders.create_above(file);
    core::write_stream_atomically(files[0], [&](std::ostream& out) {
        out << foam_header("vectorField", "", (folder.filename() / "polyMesh").c_str(), "points");
        write_planes(out, points, heights);
    });
    std::vector<Point> displacement;
    for (std::size_t i = 0; i < points.size(); ++i) displacement.push_back(points[i] - reference.points[i]);
    core::write_stream_atomically(files[1], [&](std::ostream& out) {
        out << foam_header("pointVectorField", "", folder.filename().c_str(), "displacement")
            << "dimensions      [0 1 0 0 0 0 0];\ninternalField   nonuniform List<vector>\n";
        write_planes(out, displacement, std::vector<double>(heights.size(), 0));
        out << ";\nboundaryField\n{\n    \".*\"\n    {\n        type            calculated;\n    }\n}\n";
    });
    folders.keep();
}

}  // namespace lamina::io
