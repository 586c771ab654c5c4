// Reads UGRID files, plane or extruded in y, in ASCII or binary. Markers take their names and kinds from the .mapbc
// file where there is one. ugrid.hpp describes the format.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/marker_names.hpp"
#include "io/byte_reader.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "io/plane_of_extrusion.hpp"
#include "io/ugrid.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// A line of a .mapbc file.
struct BoundaryCondition {
    std::string name;
    MarkerKind kind = MarkerKind::other;
};

MarkerKind kind_of_code(int code) {
    if (code == mapbc_viscous_wall || code == mapbc_wall) return MarkerKind::wall;
    if (code == mapbc_far_field) return MarkerKind::far_field;
    if (code >= mapbc_symmetry_x && code <= mapbc_symmetry_z) return MarkerKind::symmetry;
    return MarkerKind::other;
}

/// Returns the boundary conditions by their numbers; none where the file does not exist.
std::map<int, BoundaryCondition> read_mapbc(const fs::path& file) {
    std::map<int, BoundaryCondition> conditions;
    std::error_code ignored;
    if (!fs::exists(file, ignored)) return conditions;
    const std::string bytes = read_file(file);
    ByteReader in(bytes, file.string());
    const auto n = in.ascii_number<std::size_t>("number of boundaries");
    for (std::size_t i = 0; i < n; ++i) {
        const auto number = in.ascii_number<int>("number of a boundary");
        const auto code = in.ascii_number<int>("boundary condition");
        BoundaryCondition condition{std::string(in.rest_of_line()), kind_of_code(code)};
        condition.kind = core::kind_or_periodic(condition.kind, condition.name);
        if (condition.name.empty()) in.fail("name of the boundary expected");
        if (!conditions.emplace(number, condition).second) in.fail(fmt::format("boundary {} stands twice", number));
    }
    if (!in.at_end()) in.fail("something follows the last boundary");
    return conditions;
}

class UgridReader {
public:
    UgridReader(const std::string& bytes, const fs::path& file)
        : in_(bytes, file.string()), file_(file), conditions_(read_mapbc(mapbc_of(file))) {
        const UgridEncoding encoding = encoding_of(file);
        if (encoding != UgridEncoding::ascii)
            in_.set_binary(encoding == UgridEncoding::big_endian ? ByteOrder::big : ByteOrder::little);
    }

    Mesh read() {
        std::array<std::size_t, 7> counts;
        for (std::size_t& count : counts) {
            const auto value = in_.number<std::int32_t>("count");
            if (value < 0) in_.fail("negative count");
            count = in_.checked_count(static_cast<std::size_t>(value), 4, "count");
        }
        const auto [nodes, triangles, quads, tetrahedra, pyramids, prisms, hexahedra] = counts;
        if (tetrahedra + pyramids > 0) in_.fail("tetrahedra and pyramids: the mesh is not an extruded plane one");
        read_nodes(nodes);
        const std::vector<UgridFace> faces = read_faces(triangles, quads);
        if (prisms + hexahedra == 0)
            gather_plane(faces);
        else
            gather_extrusion(faces, prisms, hexahedra);
        if (!in_.at_end()) in_.fail("something follows the last number");
        name_markers();
        orient_markers(mesh_);
        return std::move(mesh_);
    }

private:
    struct UgridFace {
        std::size_t corners = 3;
        std::array<std::uint32_t, 4> nodes{};
        int surface = 0;  ///< number of its marker or plane
    };
    void read_nodes(std::size_t count) {
        in_.checked_count(count, 24, "number of nodes");
        for (std::size_t i = 0; i < count; ++i)
            for (double& c : nodes_.emplace_back()) {
                c = in_.number<double>("coordinate");
                if (!std::isfinite(c)) in_.fail("coordinate is not a finite number");
            }
    }
    std::uint32_t read_node_number() {
        const auto number = in_.number<std::int32_t>("node");
        if (number < 1 || static_cast<std::size_t>(number) > nodes_.size())
            in_.fail(fmt::format("node {} where there are {}", number, nodes_.size()));
        return static_cast<std::uint32_t>(number - 1);
    }
    std::vector<UgridFace> read_faces(std::size_t triangles, std::size_t quads) {
        std::vector<UgridFace> faces;
        for (std::size_t i = 0; i < triangles + quads; ++i) {
            UgridFace& face = faces.emplace_back();
            face.corners = i < triangles ? 3 : 4;
            for (std::size_t k = 0; k < face.corners; ++k) face.nodes[k] = read_node_number();
        }
        for (UgridFace& face : faces) face.surface = in_.number<std::int32_t>("number of a surface");
        return faces;
    }
    void gather_plane(const std::vector<UgridFace>& faces) {
        for (const auto& [x, y, z] : nodes_) mesh_.points.push_back({x, y});
        for (const auto& [corners, nodes, surface] : faces) {
            std::array<VertexId, 4> v;
            for (std::size_t k = 0; k < corners; ++k) v[k] = VertexId(nodes[k]);
            if (corners == 3)
                mesh_.triangles.push_back({{v[0], v[1], v[2]}});
            else
                mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
        }
        const auto edges = in_.number<std::int32_t>("number of edges of the boundary");
        for (std::int32_t i = 0; i < edges; ++i) {
            const VertexId a(read_node_number()), b(read_node_number());
            edges_[in_.number<std::int32_t>("number of a boundary")].push_back({a, b});
        }
    }

    /// Reads the plane mesh whose copies across y the file holds.
    void gather_extrusion(const std::vector<UgridFace>& faces, std::size_t prisms, std::size_t hexahedra) {
        SpaceMesh space;
        for (const auto& [x, y, z] : nodes_) {
            space.points.push_back({x, z});
            space.heights.push_back(y);
        }
        for (std::size_t i = 0; i < prisms + hexahedra; ++i) {
            SpaceMesh::Volume& volume = space.volumes.emplace_back();
            volume.corners = i < prisms ? 3 : 4;
            for (std::size_t k = 0; k < 2 * volume.corners; ++k) volume.nodes[k] = read_node_number();
        }
        std::map<int, std::size_t> markers;
        for (const UgridFace& face : faces) {
            const std::size_t marker = markers.emplace(face.surface, markers.size()).first->second;
            space.faces.push_back({face.corners, face.nodes, marker});
        }
        PlaneOfExtrusion plane = plane_of_extrusion(space, markers.size(), file_);
        mesh_.points = std::move(plane.points);
        mesh_.triangles = std::move(plane.triangles);
        mesh_.quads = std::move(plane.quads);
        for (const auto& [surface, marker] : markers)
            if (!plane.edges[marker].empty()) edges_[surface] = std::move(plane.edges[marker]);
    }

    void name_markers() {
        for (auto& [number, edges] : edges_) {
            const auto found = conditions_.find(number);
            BoundaryCondition condition{fmt::format("boundary{}", number), MarkerKind::other};
            if (found != conditions_.end()) condition = found->second;
            mesh_.markers.push_back({condition.name, condition.kind, std::move(edges)});
        }
    }

    ByteReader in_;
    fs::path file_;
    std::map<int, BoundaryCondition> conditions_;
    std::vector<std::array<double, 3>> nodes_;
    std::map<int, std::vector<Segment>> edges_;  ///< edges of the boundary by the number of their marker
    Mesh mesh_;
};

}  // namespace

Mesh read_ugrid(const std::string& bytes, const fs::path& file) { return UgridReader(bytes, file).read(); }

}  // namespace lamina::io
