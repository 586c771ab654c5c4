// Reads an OpenFOAM polyMesh in ASCII that holds a mesh one cell thick: prisms and hexahedra between two planes of
// constant z. Source: OpenFOAM user guide, "Mesh description".
//
// The faces with all points in the lower plane are the cells. The other faces of patches stand on the edges of markers.
// Points of the lower plane keep their order, and cells the order of their numbers. Patches of type empty make no
// markers.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <lamina/error.hpp>

#include "core/marker_names.hpp"
#include "io/foam_words.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"

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
        if (const std::size_t internal = read_cells("neighbour").size();
            internal != (patches_.empty() ? owner_.size() : patches_.front().start))
            throw InputError({(folder_ / "neighbour").string(), 0, {}},
                             fmt::format("{} internal faces, but the first patch begins elsewhere", internal));
        read_faces();
        gather_cells();
        return {std::move(mesh_), std::move(numbers_)};
    }

private:
    /// Makes vertices of the points in the lower plane.
    void read_points() {
        FoamWords in(folder_ / "points");
        in.read_header("vectorField");
        const std::size_t n = in.begin_list("number of points", std::string_view("(0 0 0)").size());
        std::vector<std::array<double, 3>> points(n);
        for (auto& point : points) {
            in.expect("(");
            for (double& c : point) {
                c = in.number<double>("coordinate");
                if (!std::isfinite(c)) in.fail("coordinate is not a finite number");
            }
            in.expect(")");
        }
        in.end_list();
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const auto& point : points) low = std::min(low, point[2]), high = std::max(high, point[2]);
        vertex_.resize(n);
        for (std::size_t i = 0; i < n; ++i) {
            const auto& [x, y, z] = points[i];
            if (z != low && z != high)
                in.fail(
                    fmt::format("point {} lies between the planes z = {} and z = {}: the mesh is not one cell thick", i,
                                low, high));
            if (z == high) continue;
            vertex_[i] = VertexId(mesh_.points.size());
            mesh_.points.push_back({x, y});
        }
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
            const FoamFace face = read_face(in, f);
            if (f < boundary) continue;
            while (patch < patches_.size() && f >= patches_[patch].start + patches_[patch].faces) ++patch;
            if (patch == patches_.size() || f < patches_[patch].start)
                in.fail(fmt::format("face {} is in no patch", f));
            add_face(in, f, patches_[patch], face);
        }
        in.end_list();
    }
    /// The vertices of a face; those in the upper plane are invalid.
    struct FoamFace {
        std::array<VertexId, 4> v;
        std::size_t corners;

        std::span<VertexId> vertices() { return {v.data(), corners}; }
    };
    FoamFace read_face(FoamWords& in, std::size_t number) const {
        const auto corners = in.number<std::size_t>("number of corners");
        if (corners != 3 && corners != 4) in.fail(fmt::format("face {} has {} corners, not 3 or 4", number, corners));
        in.expect("(");
        FoamFace face{{}, corners};
        for (VertexId& v : face.vertices()) {
            const auto point = in.number<std::size_t>("point");
            if (point >= vertex_.size()) in.fail(fmt::format("point {} where there are {}", point, vertex_.size()));
            v = vertex_[point];
        }
        in.expect(")");
        return face;
    }
    /// Adds a face of the boundary as a cell, as an edge of a marker, or, in the upper plane, not at all. The normals
    /// of faces point outward: faces in the lower plane run clockwise, and the lower edge of a side has its cell on the
    /// left.
    void add_face(const FoamWords& in, std::size_t number, const FoamPatch& patch, FoamFace face) {
        const auto& v = face.v;
        const std::span<VertexId> vertices = face.vertices();
        const auto is_lower = [](VertexId vertex) { return vertex.valid(); };
        if (std::all_of(vertices.begin(), vertices.end(), is_lower)) {
            std::reverse(vertices.begin(), vertices.end());
            if (face.corners == 3)
                triangles_.push_back({owner_[number], {{v[0], v[1], v[2]}}});
            else
                quads_.push_back({owner_[number], {{v[0], v[1], v[2], v[3]}}});
        } else if (std::any_of(vertices.begin(), vertices.end(), is_lower)) {
            Segment edge;
            if (!find_lower_edge(vertices, edge)) in.fail(fmt::format("face {} does not stand on an edge", number));
            if (patch.type == "empty")
                in.fail(fmt::format("face {} is in patch '{}', of type empty", number, patch.name));
            if (mesh_.markers.empty() || mesh_.markers.back().name != patch.name)
                mesh_.markers.push_back({patch.name, kind_of(patch), {}});
            mesh_.markers.back().edges.push_back(edge);
        }
    }

    void gather_cells() {
        const auto by_number = [](const auto& a, const auto& b) { return a.first < b.first; };
        std::stable_sort(triangles_.begin(), triangles_.end(), by_number);
        std::stable_sort(quads_.begin(), quads_.end(), by_number);
        for (const auto& [cell, triangle] : triangles_) {
            mesh_.triangles.push_back(triangle);
            numbers_.push_back(cell);
        }
        for (const auto& [cell, quad] : quads_) {
            mesh_.quads.push_back(quad);
            numbers_.push_back(cell);
        }
        // Where a face of either plane is internal or missing, the number of cells does not fit.
        const std::size_t cells = owner_.empty() ? 0 : std::size_t{1} + *std::max_element(owner_.begin(), owner_.end());
        if (triangles_.size() + quads_.size() != cells)
            throw InputError({folder_.string(), 0, {}},
                             fmt::format("{} cells, but {} faces in the lower plane: the mesh is not one cell thick",
                                         cells, triangles_.size() + quads_.size()));
    }

    fs::path folder_;
    std::vector<VertexId> vertex_;      ///< per point: its vertex; invalid in the upper plane
    std::vector<std::uint32_t> owner_;  ///< per face: its cell, or the lower one of its two cells
    std::vector<FoamPatch> patches_;
    std::vector<std::pair<std::uint32_t, Triangle>> triangles_;  ///< with the numbers of the cells
    std::vector<std::pair<std::uint32_t, Quad>> quads_;
    Mesh mesh_;
    std::vector<std::uint32_t> numbers_;  ///< of the cells of the mesh
};

}  // namespace

Mesh read_openfoam(const fs::path& file) { return read_numbered_openfoam(file).mesh; }

NumberedCells read_numbered_openfoam(const fs::path& file) { return PolyMeshReader(poly_mesh_folder(file)).read(); }

}  // namespace lamina::io
