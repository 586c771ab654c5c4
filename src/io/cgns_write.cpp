// Writes CGNS files: one base with one unstructured zone; sections TRI_3 and QUAD_4 for each region, and one section
// BAR_2 for each marker. Source: CGNS Standard Interface Data Structures 3.4; the CGNS mid-level library.
//
// Programs look for a marker in different places, so it stands in all of them under one name:
//  - a section of bars, where SU2 looks;
//  - a boundary condition in ZoneBC over the range of these bars, located at edge centres;
//  - the family that the boundary condition points to, which holds the kind of boundary.
// Sections of cells are named REGION_triangles and REGION_quads. The numbers of elements run from the cells on to the
// bars.
#include <cgnslib.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"
#include "core/marker_names.hpp"
#include "core/parallel.hpp"
#include "io/cgns_lock.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t parallel_grain = 1 << 16;

BCType_t condition_of(MarkerKind kind) {
    switch (kind) {
        case MarkerKind::wall:
            return BCWallViscous;
        case MarkerKind::far_field:
            return BCFarfield;
        case MarkerKind::symmetry:
            return BCSymmetryPlane;
        case MarkerKind::other:
            break;
    }
    return BCGeneral;
}

std::string section_name(const CellBlock& block) {
    return fmt::format("{}_{}", block.region, block.corners == 3 ? "triangles" : "quads");
}

class CgnsWriter {
public:
    CgnsWriter(const MeshView& mesh, CgnsVariant variant, const fs::path& target)
        : mesh_(mesh), variant_(variant), target_(target) {}

    void write(const fs::path& file) {
        require(cg_set_file_type(variant_.adf ? CG_FILE_ADF : CG_FILE_HDF5));
        require(cg_open(file.c_str(), CG_MODE_WRITE, &file_));
        try {
            write_base();
            write_coordinates();
            write_sections();
            write_boundary_conditions();
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

    void write_base() {
        require(cg_base_write(file_, "Base", 2, variant_.three_coordinates ? 3 : 2, &base_));
        const auto cells = mesh_.triangles.size() + mesh_.quads.size();
        cgsize_t sizes[3] = {static_cast<cgsize_t>(mesh_.points.size()), static_cast<cgsize_t>(cells), 0};
        for (const Marker& marker : mesh_.markers) {
            int family = 0, condition = 0;
            require(cg_family_write(file_, base_, marker.name.c_str(), &family));
            require(cg_fambc_write(file_, base_, family, "FamBC", condition_of(marker.kind), &condition));
        }
        require(cg_zone_write(file_, base_, "Zone", sizes, Unstructured, &zone_));
    }

    void write_coordinates() {
        write_axis("CoordinateX", [](Point p) { return p.x; });
        write_axis("CoordinateY", [](Point p) { return p.y; });
        if (variant_.three_coordinates) write_axis("CoordinateZ", [](Point) { return 0.0; });
    }
    template <class Coordinate>
    void write_axis(const char* name, Coordinate&& coordinate) {
        // Exponents of mass, length, time, temperature and angle. The unit of length is that of the input, which is
        // not known.
        constexpr float length_dimension[5] = {0, 1, 0, 0, 0};
        std::vector<double> values(mesh_.points.size());
        core::parallel_for(values.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) values[i] = coordinate(mesh_.points[i]);
        });
        int number = 0;
        require(cg_coord_write(file_, base_, zone_, RealDouble, name, values.data(), &number));
        require(cg_goto(file_, base_, "Zone_t", zone_, "GridCoordinates_t", 1, name, 0, "end"));
        require(cg_dataclass_write(NormalizedByUnknownDimensional));
        require(cg_exponents_write(RealSingle, length_dimension));
    }

    /// Writes a section of elements, numbered from the end of the last section on. vertex(i, k) returns vertex k of
    /// element i.
    template <class F>
    void write_section(const std::string& name, ElementType_t type, std::size_t corners, std::size_t count,
                       F&& vertex) {
        std::vector<cgsize_t> nodes(corners * count);
        core::parallel_for(count, parallel_grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                for (std::size_t k = 0; k < corners; ++k)
                    nodes[corners * i + k] = static_cast<cgsize_t>(vertex(i, k).index() + 1);
        });
        const auto first = next_element_;
        next_element_ += static_cast<cgsize_t>(count);
        int number = 0;
        require(cg_section_write(file_, base_, zone_, name.c_str(), type, first, next_element_ - 1, 0, nodes.data(),
                                 &number));
    }
    void write_sections() {
        for (const CellBlock& block : cell_blocks(mesh_))
            write_section(section_name(block), block.corners == 3 ? TRI_3 : QUAD_4, block.corners, block.cells.size(),
                          [&](std::size_t i, std::size_t k) { return block.vertices(mesh_, i)[k]; });
        for (const Marker& marker : mesh_.markers) {
            first_bar_.push_back(next_element_);
            if (marker.edges.empty()) continue;
            write_section(marker.name, BAR_2, 2, marker.edges.size(),
                          [&](std::size_t i, std::size_t k) { return k == 0 ? marker.edges[i].a : marker.edges[i].b; });
        }
    }

    void write_boundary_conditions() {
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) {
            const Marker& marker = mesh_.markers[m];
            if (marker.edges.empty()) continue;
            const cgsize_t range[2] = {first_bar_[m], first_bar_[m] + static_cast<cgsize_t>(marker.edges.size()) - 1};
            int condition = 0;
            require(cg_boco_write(file_, base_, zone_, marker.name.c_str(), FamilySpecified, PointRange, 2, range,
                                  &condition));
            require(cg_boco_gridlocation_write(file_, base_, zone_, condition, EdgeCenter));
            require(cg_goto(file_, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", condition, "end"));
            require(cg_famname_write(marker.name.c_str()));
        }
    }

    MeshView mesh_;
    CgnsVariant variant_;
    const fs::path& target_;
    int file_ = 0, base_ = 0, zone_ = 0;
    cgsize_t next_element_ = 1;
    std::vector<cgsize_t> first_bar_;  ///< per marker: the number of its first bar
};

/// Returns a generous estimate of the size of the file. HDF5 crashes the program at its end after a failed write, so a
/// full disk must be noticed before anything is written.
std::size_t bytes_needed(const MeshView& mesh, CgnsVariant variant) {
    return (variant.three_coordinates ? 24 : 16) * mesh.points.size() +
           sizeof(cgsize_t) * (3 * mesh.triangles.size() + 4 * mesh.quads.size() + 2 * count_marker_edges(mesh)) +
           50'000 * (3 + mesh.markers.size());
}

/// Throws UsageError for meshes that a CGNS file cannot hold.
void require_fit(const MeshView& mesh, const fs::path& file) {
    require_marker_names(mesh.markers, file, "CGNS", "/", core::max_marker_name);
    constexpr std::array<std::string_view, 4> other_nodes{"Zone", "ZoneType", "ZoneBC", "GridCoordinates"};
    for (const Marker& marker : mesh.markers)
        if (std::find(other_nodes.begin(), other_nodes.end(), marker.name) != other_nodes.end())
            throw UsageError(
                fmt::format("{}: '{}' is the name of another node, and of a marker", file.string(), marker.name));
    for (const CellBlock& block : cell_blocks(mesh))
        for (const Marker& marker : mesh.markers)
            if (marker.name == section_name(block))
                throw UsageError(fmt::format("{}: '{}' is the name of a section of cells, and of a marker",
                                             file.string(), marker.name));
    const std::size_t elements = mesh.triangles.size() + mesh.quads.size() + count_marker_edges(mesh);
    if (4 * elements > static_cast<std::size_t>(std::numeric_limits<cgsize_t>::max()))
        throw UsageError(fmt::format("{}: more cells than this CGNS library numbers", file.string()));
}

}  // namespace

void write_cgns(const MeshView& mesh, const fs::path& file, CgnsVariant variant) {
    require_fit(mesh, file);
    core::write_atomically(file, [&](const fs::path& temporary) {
        core::reserve_room(temporary, file, bytes_needed(mesh, variant));
        const std::lock_guard lock(cgns_lock());
        CgnsWriter(mesh, variant, file).write(temporary);
    });
}

}  // namespace lamina::io
