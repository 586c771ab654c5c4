// CGNS: one base, one unstructured zone; sections TRI_3 and QUAD_4 for each region, one section BAR_2 for each marker.
// Source: CGNS Standard Interface Data Structures 3.4; the CGNS mid-level library.
//
// Who reads the file wants the marker in different places, so it stands in all of them under one name: the section of
// bars (SU2 looks there), a boundary condition in ZoneBC over the range of these bars, located at edge centres, and the
// family that it points to, which holds the kind of boundary. Names of sections of cells are REGION_triangles and
// REGION_quads. Numbers of elements continue from the cells to the bars.
// Read back: one unstructured zone with sections of these types, any names. An edge goes to the boundary condition that
// lists it, else to the marker that its section makes.
#include <cgnslib.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include <lamina/error.hpp>

#include "core/atomic_file.hpp"
#include "core/parallel.hpp"
#include "io/formats.hpp"
#include "io/mesh_parts.hpp"

namespace lamina::io {

namespace fs = std::filesystem;

namespace {

/// The library keeps its open files, and the kind of the next one, in global variables.
std::mutex& library_in_use() {
    static std::mutex mutex;
    return mutex;
}

constexpr std::size_t parallel_grain = 1 << 16;

// --- Writing

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
    CgnsWriter(const Mesh& mesh, CgnsVariant variant, const fs::path& target)
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
        // In the units of the input, which nobody told; exponents of mass, length, time, temperature, angle.
        constexpr float length_dimension[5] = {0, 1, 0, 0, 0};
        std::vector<double> values(mesh_.points.size());
        const auto write_axis = [&](const char* name, auto&& coordinate) {
            core::parallel_for(values.size(), parallel_grain, [&](std::size_t begin, std::size_t end) {
                for (std::size_t i = begin; i < end; ++i) values[i] = coordinate(mesh_.points[i]);
            });
            int number = 0;
            require(cg_coord_write(file_, base_, zone_, RealDouble, name, values.data(), &number));
            require(cg_goto(file_, base_, "Zone_t", zone_, "GridCoordinates_t", 1, name, 0, "end"));
            require(cg_dataclass_write(NormalizedByUnknownDimensional));
            require(cg_exponents_write(RealSingle, length_dimension));
        };
        write_axis("CoordinateX", [](Point p) { return p.x; });
        write_axis("CoordinateY", [](Point p) { return p.y; });
        if (variant_.three_coordinates) write_axis("CoordinateZ", [](Point) { return 0.0; });
    }

    /// Numbered from where the last section ended; vertex(i, k) of element i.
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

    const Mesh& mesh_;
    CgnsVariant variant_;
    const fs::path& target_;
    int file_ = 0, base_ = 0, zone_ = 0;
    cgsize_t next_element_ = 1;
    std::vector<cgsize_t> first_bar_;  ///< of each marker
};

/// HDF5 brings down the program that ends after a write has failed, so a full disk must be seen before.
std::size_t bytes_needed(const Mesh& mesh, CgnsVariant variant) {
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    return (variant.three_coordinates ? 24 : 16) * mesh.points.size() +
           sizeof(cgsize_t) * (3 * mesh.triangles.size() + 4 * mesh.quads.size() + 2 * edges) +
           50'000 * (3 + mesh.markers.size());
}

void require_fit(const Mesh& mesh, const fs::path& file) {
    require_marker_names(mesh, file, "CGNS", "/", 32);
    for (const CellBlock& block : cell_blocks(mesh))
        for (const Marker& marker : mesh.markers)
            if (marker.name == section_name(block))
                throw UsageError(fmt::format("{}: '{}' is the name of a section of cells, and of a marker",
                                             file.string(), marker.name));
    std::size_t elements = mesh.triangles.size() + mesh.quads.size();
    for (const Marker& marker : mesh.markers) elements += marker.edges.size();
    if (4 * elements > static_cast<std::size_t>(std::numeric_limits<cgsize_t>::max()))
        throw UsageError(fmt::format("{}: more cells than this CGNS library numbers", file.string()));
}

// --- Reading

MarkerKind kind_of(BCType_t condition) {
    switch (condition) {
        case BCWall:
        case BCWallInviscid:
        case BCWallViscous:
        case BCWallViscousHeatFlux:
        case BCWallViscousIsothermal:
            return MarkerKind::wall;
        case BCFarfield:
            return MarkerKind::far_field;
        case BCSymmetryPlane:
            return MarkerKind::symmetry;
        default:
            return MarkerKind::other;
    }
}

class CgnsReader {
public:
    explicit CgnsReader(const fs::path& file) : name_(file.string()) {
        // Where this fails within the file, the library keeps it open: it cannot close what it has read in half.
        require(cg_open(file.c_str(), CG_MODE_READ, &file_));
    }
    ~CgnsReader() { cg_close(file_); }
    CgnsReader(const CgnsReader&) = delete;
    CgnsReader& operator=(const CgnsReader&) = delete;

    Mesh read() {
        read_zone();
        read_coordinates();
        read_sections();
        read_boundary_conditions();
        make_markers();
        make_regions();
        orient_markers(mesh_);
        return std::move(mesh_);
    }

private:
    using Name = char[33];

    [[noreturn]] void fail(const std::string& reason) const { throw InputError({name_, 0, {}}, reason); }
    void require(int status) const {
        if (status != CG_OK) fail(cg_get_error());
    }

    void read_zone() {
        int bases = 0, zones = 0, cell_dimension = 0;
        Name name;
        ZoneType_t type;
        require(cg_nbases(file_, &bases));
        if (bases != 1) fail(fmt::format("{} bases: only files with one can be read", bases));
        require(cg_base_read(file_, 1, name, &cell_dimension, &dimension_));
        if (cell_dimension != 2 || dimension_ < 2 || dimension_ > 3)
            fail(fmt::format("cells of dimension {} in {} dimensions: only plane meshes can be read", cell_dimension,
                             dimension_));
        require(cg_nzones(file_, 1, &zones));
        if (zones != 1) fail(fmt::format("{} zones: only files with one can be read", zones));
        require(cg_zone_type(file_, 1, 1, &type));
        if (type != Unstructured) fail("the zone is structured: only unstructured ones can be read");
        cgsize_t sizes[9] = {};
        require(cg_zone_read(file_, 1, 1, name, sizes));
        // Whatever a damaged file says, no coordinates take fewer bytes than this.
        std::error_code ignored;
        const auto bytes = fs::file_size(name_, ignored);
        if (sizes[0] < 0 || sizes[1] < 0 || static_cast<std::uintmax_t>(sizes[0]) > bytes)
            fail("absurd size of the zone");
        points_ = static_cast<std::size_t>(sizes[0]);
        bytes_ = bytes;
    }

    std::vector<double> axis(const char* name) {
        std::vector<double> values(points_);
        const cgsize_t first = 1, last = static_cast<cgsize_t>(points_);
        if (points_ > 0) require(cg_coord_read(file_, 1, 1, name, RealDouble, &first, &last, values.data()));
        return values;
    }
    void read_coordinates() {
        const std::vector<double> x = axis("CoordinateX"), y = axis("CoordinateY");
        mesh_.points.resize(points_);
        for (std::size_t i = 0; i < points_; ++i) {
            if (!std::isfinite(x[i]) || !std::isfinite(y[i])) fail(fmt::format("point {} is not finite", i + 1));
            mesh_.points[i] = {x[i], y[i]};
        }
        if (dimension_ == 2) return;
        for (const double z : axis("CoordinateZ"))
            if (z != axis_z_.value_or(z))
                fail(fmt::format("points in the planes z = {} and z = {}: the mesh is not plane", *axis_z_, z));
            else
                axis_z_ = z;
    }

    void read_sections() {
        int sections = 0;
        require(cg_nsections(file_, 1, 1, &sections));
        for (int s = 1; s <= sections; ++s) {
            Name name;
            ElementType_t type;
            cgsize_t first = 0, last = 0, size = 0;
            int rim = 0, has_parents = 0;
            require(cg_section_read(file_, 1, 1, s, name, &type, &first, &last, &rim, &has_parents));
            if (type == NODE) continue;
            if (type != TRI_3 && type != QUAD_4 && type != BAR_2)
                fail(fmt::format("section '{}' has elements {}: only TRI_3, QUAD_4 and BAR_2 can be read", name,
                                 cg_ElementTypeName(type)));
            require(cg_ElementDataSize(file_, 1, 1, s, &size));
            const cgsize_t corners = type == TRI_3 ? 3 : type == QUAD_4 ? 4 : 2;
            if (first < 1 || last < first || size < 0 || static_cast<std::uintmax_t>(size) > bytes_ ||
                size / corners != last - first + 1 || size % corners != 0)
                fail(fmt::format("section '{}' has not the elements {} to {}", name, first, last));
            std::vector<cgsize_t> nodes(static_cast<std::size_t>(size));
            require(cg_elements_read(file_, 1, 1, s, nodes.data(), nullptr));
            add_section(name, type, first, nodes);
        }
    }
    void add_section(const std::string& name, ElementType_t type, cgsize_t first, const std::vector<cgsize_t>& nodes) {
        const auto vertex = [&](std::size_t i) {
            if (nodes[i] < 1 || static_cast<std::size_t>(nodes[i]) > points_)
                fail(fmt::format("section '{}': vertex {} where there are {}", name, nodes[i], points_));
            return VertexId(static_cast<std::size_t>(nodes[i] - 1));
        };
        if (type == TRI_3) {
            for (std::size_t i = 0; i < nodes.size(); i += 3)
                mesh_.triangles.push_back({{vertex(i), vertex(i + 1), vertex(i + 2)}});
            triangle_sections_.emplace_back(name, nodes.size() / 3);
        } else if (type == QUAD_4) {
            for (std::size_t i = 0; i < nodes.size(); i += 4)
                mesh_.quads.push_back({{vertex(i), vertex(i + 1), vertex(i + 2), vertex(i + 3)}});
            quad_sections_.emplace_back(name, nodes.size() / 4);
        } else {
            BarSection section{name, first, {}, {}};
            for (std::size_t i = 0; i < nodes.size(); i += 2) section.bars.push_back({vertex(i), vertex(i + 1)});
            section.condition.resize(section.bars.size(), 0);
            bars_.push_back(std::move(section));
        }
    }

    /// Notes for each bar the boundary condition it is in, from 1 on.
    void read_boundary_conditions() {
        int count = 0;
        require(cg_nbocos(file_, 1, 1, &count));
        for (int c = 1; c <= count; ++c) {
            Name name;
            BCType_t type;
            PointSetType_t set;
            cgsize_t points = 0, normals = 0;
            int normal_index[3] = {}, data_sets = 0;
            DataType_t normal_type;
            require(cg_boco_info(file_, 1, 1, c, name, &type, &set, &points, normal_index, &normals, &normal_type,
                                 &data_sets));
            conditions_.push_back({name, kind_of(type == FamilySpecified ? condition_of_family(c) : type), {}});
            GridLocation_t location;
            require(cg_boco_gridlocation_read(file_, 1, 1, c, &location));
            const bool of_elements =
                set == ElementRange || set == ElementList || location == EdgeCenter || location == FaceCenter;
            if (!of_elements) continue;
            if (points < 0 || static_cast<std::uintmax_t>(points) > bytes_) fail("absurd size of a boundary condition");
            std::vector<cgsize_t> elements(static_cast<std::size_t>(points));
            require(cg_boco_read(file_, 1, 1, c, elements.data(), nullptr));
            if (set == PointRange || set == ElementRange) {
                if (elements.size() == 2) mark(elements[0], elements[1], c);
            } else {
                for (const cgsize_t element : elements) mark(element, element, c);
            }
        }
    }
    BCType_t condition_of_family(int c) {
        Name wanted, name;
        require(cg_goto(file_, 1, "Zone_t", 1, "ZoneBC_t", 1, "BC_t", c, "end"));
        int families = 0;
        if (cg_famname_read(wanted) != CG_OK || cg_nfamilies(file_, 1, &families) != CG_OK) return BCGeneral;
        for (int f = 1; f <= families; ++f) {
            int conditions = 0, geometries = 0;
            BCType_t type;
            require(cg_family_read(file_, 1, f, name, &conditions, &geometries));
            if (std::string(name) != wanted || conditions == 0) continue;
            require(cg_fambc_read(file_, 1, f, 1, name, &type));
            return type;
        }
        return BCGeneral;
    }
    void mark(cgsize_t first, cgsize_t last, int condition) {
        for (BarSection& section : bars_) {
            const auto size = static_cast<cgsize_t>(section.bars.size());
            const cgsize_t begin = std::max<cgsize_t>(first - section.first, 0);
            const cgsize_t end = std::min<cgsize_t>(last - section.first + 1, size);
            for (cgsize_t i = begin; i < end; ++i) section.condition[static_cast<std::size_t>(i)] = condition;
        }
    }

    void make_markers() {
        for (BarSection& section : bars_) {
            Marker rest{section.name, kind_of_name(section.name), {}};
            for (std::size_t i = 0; i < section.bars.size(); ++i) {
                const int c = section.condition[i];
                (c == 0 ? rest : conditions_[static_cast<std::size_t>(c - 1)]).edges.push_back(section.bars[i]);
            }
            if (!rest.edges.empty()) conditions_.push_back(std::move(rest));
        }
        for (Marker& marker : conditions_)
            if (!marker.edges.empty()) mesh_.markers.push_back(std::move(marker));
    }
    void make_regions() {
        triangle_sections_.insert(triangle_sections_.end(), quad_sections_.begin(), quad_sections_.end());
        for (const auto& [name, count] : triangle_sections_) {
            Region region;
            if (!region_of_name(name.substr(0, name.rfind('_')), region)) {
                mesh_.region.clear();
                return;
            }
            mesh_.region.insert(mesh_.region.end(), count, region);
        }
    }

    struct BarSection {
        std::string name;
        cgsize_t first;
        std::vector<Segment> bars;
        std::vector<int> condition;  ///< of each bar, 0 = none
    };

    std::string name_;
    int file_ = 0, dimension_ = 2;
    std::size_t points_ = 0;
    std::uintmax_t bytes_ = 0;
    std::optional<double> axis_z_;
    std::vector<std::pair<std::string, std::size_t>> triangle_sections_, quad_sections_;
    std::vector<BarSection> bars_;
    std::vector<Marker> conditions_;
    Mesh mesh_;
};

}  // namespace

void write_cgns(const Mesh& mesh, const fs::path& file, CgnsVariant variant) {
    require_fit(mesh, file);
    core::require_room(file, bytes_needed(mesh, variant));
    core::write_atomically(file, [&](const fs::path& temporary) {
        const std::lock_guard lock(library_in_use());
        CgnsWriter(mesh, variant, file).write(temporary);
    });
}

Mesh read_cgns(const fs::path& file) {
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) throw IoError(file.string(), "cannot read: no such file");
    const std::lock_guard lock(library_in_use());
    return CgnsReader(file).read();
}

}  // namespace lamina::io
