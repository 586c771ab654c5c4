// Reads an OpenFOAM polyMesh in ASCII that holds a plane mesh in copies: prisms and hexahedra between planes of
// constant z. Source: OpenFOAM user guide, "Mesh description".
//
// Points of the lowest plane keep their order, and cells the order of their numbers. Patches in the lowest or in the
// highest plane make no markers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/marker_names.hpp"
#include "io/foam_words.hpp"
#include "io/formats.hpp"
#include "io/plane_of_extrusion.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// A part of the boundary: the faces [start, start + faces).
struct FoamPatch {
    std::string name, type;
    std::size_t faces = 0, start = 0;
};

MarkerKind kind_of(const FoamPatch& patch) {
    if (patch.type == "wall") return MarkerKind::wall;
    if (patch.type == "symmetry" || patch.type == "symmetryPlane") return MarkerKind::symmetry;
    const MarkerKind by_name = core::kind_of_name(patch.name);
    if (patch.type == "cyclic") return by_name == MarkerKind::periodic ? by_name : MarkerKind::other;
    return by_name == MarkerKind::far_field ? by_name : MarkerKind::other;
}

class PolyMeshReader {
public:
    explicit PolyMeshReader(fs::path folder) : folder_(std::move(folder)) {}

    /// Returns the mesh and, for each of its cells, the number in the files.
    NumberedCells read() {
        read_points();
        owner_ = read_cells("owner");
        read_patches();
        neighbour_ = read_cells("neighbour");
        if (neighbour_.size() != (patches_.empty() ? owner_.size() : patches_.front().start))
            throw InputError({(folder_ / "neighbour").string(), 0, {}},
                             fmt::format("{} internal faces, but the first patch begins elsewhere", neighbour_.size()));
        read_faces();
        gather_volumes();
        gather_plane();
        return {std::move(mesh_), std::move(numbers_), space_.volumes.size()};
    }

private:
    void read_points() {
        FoamWords in(folder_ / "points");
        in.read_header("vectorField");
        const std::size_t n = in.begin_list("number of points", std::string_view("(0 0 0)").size());
        space_.points.resize(n);
        space_.heights.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            in.expect("(");
            for (double* const c : {&space_.points[i].x, &space_.points[i].y, &space_.heights[i]}) {
                *c = in.number<double>("coordinate");
                if (!std::isfinite(*c)) in.fail("coordinate is not a finite number");
            }
            in.expect(")");
        }
        in.end_list();
    }
    /// Reads the file `owner` or `neighbour`: one cell per face.
    std::vector<std::uint32_t> read_cells(const char* name) {
        FoamWords in(folder_ / name);
        in.read_header("labelList");
        std::vector<std::uint32_t> cells(in.begin_list("number of faces", std::string_view("0 ").size()));
        for (std::uint32_t& cell : cells) cell = in.number<std::uint32_t>("cell");
        in.end_list();
        return cells;
    }
    void read_patches() {
        FoamWords in(folder_ / "boundary");
        in.read_header("polyBoundaryMesh");
        patches_.resize(in.begin_list("number of patches", std::string_view("a{nFaces 0;startFace 0;}").size()));
        for (FoamPatch& patch : patches_) {
            patch = read_patch(in);
            if (patch.start > owner_.size() || patch.faces > owner_.size() - patch.start)
                in.fail(fmt::format("patch '{}' goes beyond the faces", patch.name));
        }
        in.end_list();
        std::sort(patches_.begin(), patches_.end(),
                  [](const FoamPatch& a, const FoamPatch& b) { return a.start < b.start; });
    }

    static FoamPatch read_patch(FoamWords& in) {
        FoamPatch patch;
        bool has_faces = false, has_start = false;
        patch.name = in.next();
        in.expect("{");
        for (std::string_view key; (key = in.next()) != "}";) {
            if (key == "type")
                patch.type = in.next();
            else if (has_faces |= key == "nFaces"; key == "nFaces")
                patch.faces = in.number<std::size_t>("nFaces");
            else if (has_start |= key == "startFace"; key == "startFace")
                patch.start = in.number<std::size_t>("startFace");
            for (std::string_view rest; (rest = in.next()) != ";";)
                if (rest.empty()) in.fail("the patch does not end");
        }
        if (!has_faces || !has_start) in.fail(fmt::format("patch '{}' has no nFaces or no startFace", patch.name));
        return patch;
    }

    void read_faces() {
        FoamWords in(folder_ / "faces");
        in.read_header("faceList");
        const std::size_t n = in.begin_list("number of faces", std::string_view("3(0 0 0)").size());
        if (n != owner_.size()) in.fail(fmt::format("{} faces, but {} owners", n, owner_.size()));
        const std::size_t boundary = patches_.empty() ? n : patches_.front().start;
        std::size_t patch = 0;
        for (std::size_t f = 0; f < n; ++f) {
            faces_.push_back(read_face(in, f));
            if (f < boundary) continue;
            while (patch < patches_.size() && f >= patches_[patch].start + patches_[patch].faces) ++patch;
            if (patch == patches_.size() || f < patches_[patch].start)
                in.fail(fmt::format("face {} is in no patch", f));
            faces_.back().marker = patch;
        }
        in.end_list();
        space_.faces.assign(faces_.begin() + static_cast<std::ptrdiff_t>(boundary), faces_.end());
    }
    SpaceMesh::Face read_face(FoamWords& in, std::size_t number) const {
        SpaceMesh::Face face;
        face.corners = in.number<std::size_t>("number of corners");
        if (face.corners != 3 && face.corners != 4)
            in.fail(fmt::format("face {} has {} corners, not 3 or 4", number, face.corners));
        in.expect("(");
        for (std::size_t k = 0; k < face.corners; ++k) {
            face.nodes[k] = in.number<std::uint32_t>("point");
            if (face.nodes[k] >= space_.points.size())
                in.fail(fmt::format("point {} where there are {}", face.nodes[k], space_.points.size()));
        }
        in.expect(")");
        return face;
    }

    /// Makes each cell of its face that lies lower in a plane and of the points above that face's corners.
    void gather_volumes() {
        const std::size_t cells = owner_.empty() ? 0 : std::size_t{1} + *std::max_element(owner_.begin(), owner_.end());
        if (cells > owner_.size()) fail(fmt::format("{} cells, but {} faces", cells, owner_.size()));
        std::vector<std::uint32_t> above(space_.points.size(), no_point), faces_in_planes(cells, 0);
        for (const SpaceMesh::Face& face : faces_) find_points_above(face, above);
        space_.volumes.resize(cells);
        for (std::size_t f = 0; f < faces_.size(); ++f) {
            if (!lies_in_plane(faces_[f])) continue;
            add_to_volume(f, owner_[f], faces_in_planes);
            if (f >= neighbour_.size()) continue;
            if (neighbour_[f] >= cells) fail(fmt::format("cell {} where there are {}", neighbour_[f], cells));
            add_to_volume(f, neighbour_[f], faces_in_planes);
        }
        for (std::size_t c = 0; c < cells; ++c) {
            SpaceMesh::Volume& volume = space_.volumes[c];
            if (faces_in_planes[c] != 2) fail(fmt::format("cell {} has {} faces in planes", c, faces_in_planes[c]));
            for (std::size_t k = 0; k < volume.corners; ++k) {
                const std::uint32_t node = above[volume.nodes[k]];
                if (node == no_point) fail(fmt::format("there is no face above point {}", volume.nodes[k]));
                volume.nodes[volume.corners + k] = node;
            }
        }
    }
    bool lies_in_plane(const SpaceMesh::Face& face) const {
        const double height = space_.heights[face.nodes[0]];
        return std::all_of(face.nodes.begin(), face.nodes.begin() + static_cast<std::ptrdiff_t>(face.corners),
                           [&](std::uint32_t node) { return space_.heights[node] == height; });
    }
    /// Notes the point that each edge of an upright face leads up to.
    void find_points_above(const SpaceMesh::Face& face, std::vector<std::uint32_t>& above) const {
        if (face.corners != 4 || lies_in_plane(face)) return;
        for (std::size_t k = 0; k < 4; ++k) {
            std::uint32_t low = face.nodes[k], high = face.nodes[(k + 1) % 4];
            if (space_.heights[low] > space_.heights[high]) std::swap(low, high);
            if (space_.heights[low] < space_.heights[high]) above[low] = high;
        }
    }
    /// Takes a face of a cell that lies in a plane for the cell's lower face where it is the first or lies lower.
    void add_to_volume(std::size_t f, std::uint32_t cell, std::vector<std::uint32_t>& faces_in_planes) {
        SpaceMesh::Volume& volume = space_.volumes[cell];
        if (++faces_in_planes[cell] > 1 && space_.heights[volume.nodes[0]] < space_.heights[faces_[f].nodes[0]]) return;
        volume.corners = faces_[f].corners;
        std::copy_n(faces_[f].nodes.begin(), volume.corners, volume.nodes.begin());
    }

    void gather_plane() {
        PlaneOfExtrusion plane = plane_of_extrusion(space_, patches_.size(), folder_);
        mesh_.points = std::move(plane.points);
        mesh_.triangles = std::move(plane.triangles);
        mesh_.quads = std::move(plane.quads);
        numbers_ = std::move(plane.volumes);
        for (std::size_t p = 0; p < patches_.size(); ++p) {
            if (plane.edges[p].empty()) continue;
            if (patches_[p].type == "empty")
                fail(fmt::format("patch '{}', of type empty, has faces that stand upright", patches_[p].name));
            mesh_.markers.push_back({patches_[p].name, kind_of(patches_[p]), std::move(plane.edges[p])});
        }
    }
    [[noreturn]] void fail(const std::string& reason) const { throw InputError({folder_.string(), 0, {}}, reason); }

    static constexpr std::uint32_t no_point = std::numeric_limits<std::uint32_t>::max();
    fs::path folder_;
    std::vector<std::uint32_t> owner_, neighbour_;  ///< per face: its cells; a face of the boundary has no second one
    std::vector<FoamPatch> patches_;
    std::vector<SpaceMesh::Face> faces_;  ///< all faces
    SpaceMesh space_;                     ///< its faces are those of the boundary, its markers the patches
    Mesh mesh_;
    std::vector<std::uint32_t> numbers_;  ///< of the cells of the mesh
};

}  // namespace

Mesh read_openfoam(const fs::path& file) { return read_numbered_openfoam(file).mesh; }

NumberedCells read_numbered_openfoam(const fs::path& file) { return PolyMeshReader(poly_mesh_folder(file)).read(); }

}  // namespace lamina::io
