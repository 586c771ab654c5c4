// Writes CGNS files: one base with one unstructured zone; sections TRI_3 and QUAD_4 for each region, and one section
// BAR_2 for each marker. Source: CGNS Standard Interface Data Structures 3.4; the CGNS mid-level library.
//
// Programs look for a marker in different places, so it stands in all of them under one name:
//  - a section of bars, where SU2 looks;
//  - a boundary condition in ZoneBC over the range of these bars, located at edge centres;
//  - the family that the boundary condition points to, which holds the kind of boundary.
// Sections of cells are named REGION_triangles and REGION_quads. The numbers of elements run from the cells on to the
// bars.
//
// A mesh in space (extrusion.hpp) has sections PENTA_6 and HEXA_8 in their place, REGION_prisms and REGION_hexahedra, a
// section QUAD_4 for each marker, and sections of triangles and quads for each of the two planes, which are boundary
// conditions like markers, or are connected to each other where they are periodic.
#include <cgnslib.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"
#include "core/marker_names.hpp"
#include "core/parallel.hpp"
#include "io/cgns_elements.hpp"
#include "io/cgns_lock.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"
#include "mesh/periodic.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t parallel_grain = 1 << 16;

/// Exponents of mass, length, time, temperature and angle. The unit of length is that of the input, which is not known.
constexpr std::array<float, 5> length_dimension{0, 1, 0, 0, 0}, angle_dimension{0, 0, 0, 0, 1};

BCType_t condition_of(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::wall:
            return BCWallViscous;
        case MarkerKind::far_field:
            return BCFarfield;
        case MarkerKind::symmetry:
            return BCSymmetryPlane;
        case MarkerKind::periodic:
        case MarkerKind::internal:
        case MarkerKind::other:
            break;
    }
    return BCGeneral;
}

std::string section_name(const CellBlock& block, bool in_space) {
    const bool triangles = block.corners == 3;
    return fmt::format("{}_{}", block.region,
                       in_space ? (triangles ? "prisms" : "hexahedra") : (triangles ? "triangles" : "quads"));
}

/// A part of the boundary with a name: a marker, or a plane at the end of a span.
struct BoundaryPart {
    std::string name;
    MarkerKind kind;
    cgsize_t first = 0, last = -1;  ///< numbers of its elements
};

class CgnsWriter {
public:
    CgnsWriter(const MeshView& mesh, const CurvedNodes& curved, CgnsVariant variant, const fs::path& target)
        : mesh_(mesh), curved_(curved), variant_(variant), extrusion_(variant.extrusion), target_(target) {
        for (const Marker& marker : mesh.markers) boundary_.push_back({marker.name, marker.kind});
        if (extrusion_ != nullptr)
            for (const char* plane : {first_plane, last_plane})
                boundary_.push_back({plane, extrusion_->periodic ? MarkerKind::other : MarkerKind::symmetry});
    }

    void write(const fs::path& file) {
        require(cg_set_file_type(variant_.adf ? CG_FILE_ADF : CG_FILE_HDF5));
        require(cg_open(file.c_str(), CG_MODE_WRITE, &file_));
        try {
            write_base();
            write_coordinates();
            write_sections();
            write_boundary_conditions();
            if (extrusion_ != nullptr && extrusion_->periodic) write_periodic_planes();
            write_periodic_borders();
        } catch (...) {
            cg_close(file_);
            throw;
        }
        require(cg_close(file_));
    }

private:
    void require(int status) const {
        if (status != CG_OK) throw IoError(target_.string(), std::string("cannot write: ") + cg_get_error());
    }

    /// Returns the number of cells across the span, or 1 in the plane.
    std::size_t layers() const { return extrusion_ != nullptr ? extrusion_->cells : 1; }
    std::size_t nodes() const {
        return mesh_.points.size() * (extrusion_ != nullptr ? extrusion_->planes() : 1) + curved_.points.size();
    }
    /// Returns a point of the plane: that of a vertex or, of plane meshes, that of a node of curved cells.
    Point point(std::size_t node) const {
        const std::size_t n = mesh_.points.size();
        return extrusion_ == nullptr && node >= n ? curved_.points[node - n] : mesh_.points[node % n];
    }

    void write_base() {
        const bool in_space = extrusion_ != nullptr;
        require(cg_base_write(file_, "Base", in_space ? 3 : 2, in_space || variant_.three_coordinates ? 3 : 2, &base_));
        const bool has_axis = std::any_of(boundary_.begin(), boundary_.end(), is_axis<BoundaryPart>);
        // CGNS knows an axis in two dimensions alone.
        if (has_axis && !in_space && !variant_.three_coordinates) {
            constexpr std::array<float, 2> origin{0, 0}, along{1, 0};
            require(cg_axisym_write(file_, base_, origin.data(), along.data()));
        }
        const std::size_t cells = layers() * (mesh_.triangles.size() + mesh_.quads.size());
        cgsize_t sizes[3] = {static_cast<cgsize_t>(nodes()), static_cast<cgsize_t>(cells), 0};
        for (const BoundaryPart& part : boundary_) {
            int family = 0, condition = 0;
            require(cg_family_write(file_, base_, part.name.c_str(), &family));
            require(cg_fambc_write(file_, base_, family, "FamBC", condition_of(part.kind), &condition));
        }
        require(cg_zone_write(file_, base_, "Zone", sizes, Unstructured, &zone_));
    }

    void write_coordinates() {
        write_axis("CoordinateX", [&](std::size_t i) { return point(i).x; });
        write_axis("CoordinateY", [&](std::size_t i) { return point(i).y; });
        if (extrusion_ != nullptr)
            write_axis("CoordinateZ", [&](std::size_t i) { return extrusion_->height(i / mesh_.points.size()); });
        else if (variant_.three_coordinates)
            write_axis("CoordinateZ", [](std::size_t) { return 0.0; });
    }
    template <class Coordinate>
    void write_axis(const char* name, Coordinate&& coordinate) {
        std::vector<double> values(nodes());
        core::parallel_for(values.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) values[i] = coordinate(i);
        });
        int number = 0;
        require(cg_coord_write(file_, base_, zone_, RealDouble, name, values.data(), &number));
        require(cg_goto(file_, base_, "Zone_t", zone_, "GridCoordinates_t", 1, name, 0, "end"));
        require(cg_dataclass_write(NormalizedByUnknownDimensional));
        require(cg_exponents_write(RealSingle, length_dimension.data()));
    }

    /// Writes a section of elements, numbered from the end of the last section on. node(i, k) returns node k of element
    /// i, counted from 0.
    template <class F>
    void write_section(const std::string& name, ElementType_t type, std::size_t size, std::size_t count, F&& node) {
        std::vector<cgsize_t> nodes(size * count);
        core::parallel_for(count, parallel_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t k = 0; k < size; ++k) nodes[size * i + k] = static_cast<cgsize_t>(node(i, k) + 1);
        });
        const auto first = next_element_;
        next_element_ += static_cast<cgsize_t>(count);
        int number = 0;
        require(cg_section_write(file_, base_, zone_, name.c_str(), type, first, next_element_ - 1, 0, nodes.data(),
                                 &number));
    }
    void write_sections() {
        extrusion_ != nullptr ? write_volumes() : write_cells();
        std::size_t first_edge = 0;
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
            const std::vector<Segment>& edges = mesh_.markers[m].edges;
            boundary_[m].first = next_element_;
            if (edges.empty()) continue;
            if (extrusion_ != nullptr)
                write_sides(boundary_[m].name, edges);
            else
                write_bars(boundary_[m].name, edges, first_edge);
            first_edge += edges.size();
            boundary_[m].last = next_element_ - 1;
        }
        if (extrusion_ == nullptr) return;
        write_plane(boundary_[mesh_.markers.size()], false);
        write_plane(boundary_[mesh_.markers.size() + 1], true);
    }
    void write_cells() {
        for (const CellBlock& block : cell_blocks(mesh_)) {
            const CgnsElement& element = cgns_element(static_cast<unsigned>(block.corners), curved_.order);
            const std::vector<VertexId>& beside = block.corners == 3 ? curved_.triangle_nodes : curved_.quad_nodes;
            const std::size_t between = element.nodes() - block.corners;
            write_section(section_name(block, false), element.type, element.nodes(), block.cells.size(),
                          [&](std::size_t i, std::size_t k) {
                              if (k < block.corners) return block.vertices(mesh_, i)[k].index();
                              const std::size_t place = place_of_cgns_node(element, k) - block.corners;
                              return beside[block.cells[i] * between + place].index();
                          });
        }
    }
    /// Writes the edges of a marker. `first`: the number of the edges of the markers before.
    void write_bars(const std::string& name, const std::vector<Segment>& edges, std::size_t first) {
        const CgnsElement& element = cgns_element(2, curved_.order);
        write_section(name, element.type, element.nodes(), edges.size(), [&](std::size_t i, std::size_t k) {
            if (k < 2) return (k == 0 ? edges[i].a : edges[i].b).index();
            return curved_.marker_nodes[(first + i) * (element.nodes() - 2) + k - 2].index();
        });
    }
    void write_volumes() {
        const std::size_t n = mesh_.points.size();
        for (const CellBlock& block : cell_blocks(mesh_)) {
            const std::size_t count = block.cells.size(), corners = block.corners;
            write_section(section_name(block, true), corners == 3 ? PENTA_6 : HEXA_8, 2 * corners, layers() * count,
                          [&](std::size_t i, std::size_t k) {
                              return (i / count + k / corners) * n +
                                     block.vertices(mesh_, i % count)[k % corners].index();
                          });
        }
    }
    /// Writes the faces on the edges of a marker. Normals of faces point out of the volume.
    void write_sides(const std::string& name, const std::vector<Segment>& edges) {
        write_section(name, QUAD_4, 4, layers() * edges.size(), [&](std::size_t i, std::size_t k) {
            const Segment& edge = edges[i % edges.size()];
            const std::size_t plane = i / edges.size() + (k < 2 ? 0 : 1);
            return plane * mesh_.points.size() + (k == 0 || k == 3 ? edge.a : edge.b).index();
        });
    }
    void write_plane(BoundaryPart& plane, bool is_last) {
        plane.first = next_element_;
        const std::size_t shift = is_last ? layers() * mesh_.points.size() : 0;
        const auto write = [&](const char* shape, ElementType_t type, std::size_t corners, const auto& cells) {
            if (cells.empty()) return;
            write_section(plane.name + shape, type, corners, cells.size(), [&](std::size_t i, std::size_t k) {
                return shift + cells[i].v[is_last ? k : corners - 1 - k].index();
            });
        };
        write("_triangles", TRI_3, 3, mesh_.triangles);
        write("_quads", QUAD_4, 4, mesh_.quads);
        plane.last = next_element_ - 1;
    }

    void write_boundary_conditions() {
        const std::size_t conditions =
            extrusion_ != nullptr && extrusion_->periodic ? mesh_.markers.size() : boundary_.size();
        for (std::size_t m = 0; m < conditions; ++m) {
            const BoundaryPart& part = boundary_[m];
            if (part.last < part.first || part.kind == MarkerKind::internal) continue;
            const cgsize_t range[2] = {part.first, part.last};
            int condition = 0;
            require(cg_boco_write(file_, base_, zone_, part.name.c_str(), FamilySpecified, PointRange, 2, range,
                                  &condition));
            require(cg_boco_gridlocation_write(file_, base_, zone_, condition,
                                               extrusion_ != nullptr ? FaceCenter : EdgeCenter));
            require(cg_goto(file_, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", condition, "end"));
            require(cg_famname_write(part.name.c_str()));
        }
    }
    /// Connects the nodes of each of the two planes to those of the other.
    void write_periodic_planes() {
        const std::size_t n = mesh_.points.size();
        std::vector<cgsize_t> first(n), last(n);
        for (std::size_t i = 0; i < n; ++i) {
            first[i] = static_cast<cgsize_t>(i + 1);
            last[i] = static_cast<cgsize_t>(layers() * n + i + 1);
        }
        connect(first_plane, first, last, {0, 0, extrusion_->length});
        connect(last_plane, last, first, {0, 0, -extrusion_->length});
    }
    /// Connects the nodes of each of two periodic borders to those of the other, in all planes.
    void write_periodic_borders() {
        const auto pair = mesh::find_periodic_pair(mesh_.points, mesh_.markers).pair;
        if (!pair) return;
        std::vector<cgsize_t> first, second;
        for (std::size_t plane = 0; plane < (extrusion_ != nullptr ? extrusion_->planes() : 1); ++plane)
            for (const auto& [a, b] : pair->vertices) {
                first.push_back(static_cast<cgsize_t>(plane * mesh_.points.size() + a.index() + 1));
                second.push_back(static_cast<cgsize_t>(plane * mesh_.points.size() + b.index() + 1));
            }
        const Point t = pair->translation;
        connect(mesh_.markers[pair->first].name.c_str(), first, second, {t.x, t.y, 0});
        connect(mesh_.markers[pair->second].name.c_str(), second, first, {-t.x, -t.y, 0});
    }
    /// Connects nodes to others, which are theirs moved by `shift`.
    void connect(const char* name, const std::vector<cgsize_t>& own, const std::vector<cgsize_t>& donor,
                 const std::array<double, 3>& shift) {
        const auto count = static_cast<cgsize_t>(own.size());
        const float no_turn[3] = {0, 0, 0};
        const float translation[3] = {static_cast<float>(shift[0]), static_cast<float>(shift[1]),
                                      static_cast<float>(shift[2])};
        int number = 0;
        require(cg_conn_write(file_, base_, zone_, name, Vertex, Abutting1to1, PointList, count, own.data(), "Zone",
                              Unstructured, PointListDonor, DataTypeNull, count, donor.data(), &number));
        require(cg_conn_periodic_write(file_, base_, zone_, number, no_turn, no_turn, translation));
        write_units(number, "RotationCenter", length_dimension);
        write_units(number, "RotationAngle", angle_dimension);
        write_units(number, "Translation", length_dimension);
    }
    /// Says what the array of a periodic connection counts.
    void write_units(int connection, const char* array, const std::array<float, 5>& dimension) {
        require(cg_goto(file_, base_, "Zone_t", zone_, "ZoneGridConnectivity_t", 1, "GridConnectivity_t", connection,
                        "GridConnectivityProperty_t", 1, "Periodic_t", 1, array, 0, "end"));
        require(cg_dataclass_write(NormalizedByUnknownDimensional));
        require(cg_exponents_write(RealSingle, dimension.data()));
    }

    MeshView mesh_;
    const CurvedNodes& curved_;  ///< of order 1 where cells are straight
    CgnsVariant variant_;
    const Extrusion* extrusion_;  ///< null: the mesh is plane
    const fs::path& target_;
    int file_ = 0, base_ = 0, zone_ = 0;
    cgsize_t next_element_ = 1;
    std::vector<BoundaryPart> boundary_;  ///< the markers, then the planes
};

/// Returns a generous estimate of the size of the file. HDF5 crashes the program at its end after a failed write, so a
/// full disk must be noticed before anything is written.
std::size_t bytes_needed(const MeshView& mesh, const CurvedNodes& curved, CgnsVariant variant) {
    const auto nodes = [&](unsigned corners) { return cgns_element(corners, curved.order).nodes(); };
    const std::size_t plane = 24 * (mesh.points.size() + curved.points.size()) +
                              sizeof(cgsize_t) * (nodes(3) * mesh.triangles.size() + nodes(4) * mesh.quads.size() +
                                                  nodes(2) * count_marker_edges(mesh));
    return (variant.extrusion != nullptr ? 2 * variant.extrusion->planes() : 1) * plane +
           50'000 * (8 + mesh.markers.size());
}

/// Throws UsageError for meshes that a CGNS file cannot hold.
void require_fit(const MeshView& mesh, const fs::path& file, const Extrusion* extrusion) {
    require_marker_names(mesh.markers, file, "CGNS", "/", core::max_marker_name);
    constexpr std::array<std::string_view, 4> other_nodes{"Zone", "ZoneType", "ZoneBC", "GridCoordinates"};
    for (const Marker& marker : mesh.markers)
        if (std::find(other_nodes.begin(), other_nodes.end(), marker.name) != other_nodes.end())
            throw UsageError(
                fmt::format("{}: '{}' is the name of another node, and of a marker", file.string(), marker.name));
    for (const CellBlock& block : cell_blocks(mesh))
        for (const Marker& marker : mesh.markers)
            if (marker.name == section_name(block, extrusion != nullptr))
                throw UsageError(fmt::format("{}: '{}' is the name of a section of cells, and of a marker",
                                             file.string(), marker.name));
    const std::size_t elements = (extrusion != nullptr ? 2 * extrusion->planes() : 1) *
                                 (mesh.triangles.size() + mesh.quads.size() + count_marker_edges(mesh));
    if (4 * elements > static_cast<std::size_t>(std::numeric_limits<cgsize_t>::max()))
        throw UsageError(fmt::format("{}: more cells than this CGNS library numbers", file.string()));
}

}  // namespace

void write_cgns(const MeshView& mesh, const CurvedNodes& nodes, const fs::path& file, CgnsVariant variant) {
    require_fit(mesh, file, variant.extrusion);
    core::write_atomically(file, [&](const fs::path& temporary) {
        core::reserve_room(temporary, file, bytes_needed(mesh, nodes, variant));
        const std::lock_guard lock(cgns_lock());
        CgnsWriter(mesh, nodes, variant, file).write(temporary);
    });
}

}  // namespace lamina::io
