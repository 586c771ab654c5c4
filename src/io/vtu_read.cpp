// Reads VTK XML unstructured grids of triangles (5), quads (9) and lines (3), or of these with the nodes of one order
// up to 4: Lagrange cells (69, 70, 68), and quadratic ones (22, 28, 21), whose nodes have the same places. Ignores z,
// vertices and polylines (1, 2, 4), arrays that lamina does not write, and lines that are in no marker. vtu_write.cpp
// describes the arrays. Where there are wedges (13) or hexahedra (12), the grid is a plane mesh extruded in z, and that
// plane mesh is read. Source: VTK User's Guide, "VTK File Formats", XML.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <lamina/error.hpp>
#include <lamina/files.hpp>

#include "core/marker_names.hpp"
#include "io/curved_lists.hpp"
#include "io/formats.hpp"
#include "io/mesh_arrays.hpp"
#include "io/plane_of_extrusion.hpp"
#include "io/sizes.hpp"
#include "io/vtk_cell_types.hpp"
#include "io/vtk_xml.hpp"
#include "mesh/cell_lattice.hpp"

namespace lamina::io {

namespace {

/// Returns the number of corners of a type of cell; 0 for types that cannot be read or are ignored.
unsigned corners_of(std::uint8_t type) {
    switch (type) {
        case vtk_line:
        case vtk_quadratic_edge:
        case vtk_lagrange_curve:
            return 2;
        case vtk_triangle:
        case vtk_quadratic_triangle:
        case vtk_lagrange_triangle:
            return 3;
        case vtk_quad:
        case vtk_biquadratic_quad:
        case vtk_lagrange_quad:
            return 4;
        default:
            return 0;
    }
}

/// Returns the order of a cell of this type with so many vertices; 0 where the type does not have them.
unsigned order_of(std::uint8_t type, std::int64_t vertices) {
    const unsigned order =
        order_of_cell(corners_of(type), static_cast<std::size_t>(std::max<std::int64_t>(vertices, 0)));
    if (type >= vtk_lagrange_curve) return order;
    return order == (type >= vtk_quadratic_edge ? 2 : 1) ? order : 0;
}

bool is_ignored(std::uint8_t type) { return type == vtk_vertex || type == vtk_poly_vertex || type == vtk_poly_line; }

bool is_volume(std::uint8_t type) { return type == vtk_wedge || type == vtk_hexahedron; }

/// The values of an array one after the other. Of an array that is stored raw only some are in memory at a time.
template <class T>
class ValuesInOrder {
public:
    /// The file must outlive this object.
    ValuesInOrder(const VtkXmlFile& file, std::string name) : file_(&file), name_(std::move(name)) {
        if (!file.is_raw(name_)) window_ = file.values<T>(name_);
        size_ = file.is_raw(name_) ? file.size(name_) : window_.size();
    }
    /// Fails unless the array has this number of values.
    ValuesInOrder(const VtkXmlFile& file, std::string name, std::size_t expected)
        : file_(&file), name_(std::move(name)) {
        if (!file.is_raw(name_)) window_ = file.values<T>(name_, expected);
        size_ = file.is_raw(name_) ? file.size(name_) : expected;
        if (size_ != expected)
            file.fail(fmt::format("array '{}' has {} values where {} are announced", name_, size_, expected));
    }
    std::size_t size() const { return size_; }
    T operator[](std::size_t i) {
        constexpr std::size_t window = std::size_t{1} << 16;
        if (i < first_ || i - first_ >= window_.size()) {
            first_ = i;
            window_ = file_->part<T>(name_, i, std::min(window, size_ - i));
        }
        return window_[i - first_];
    }

private:
    const VtkXmlFile* file_;
    std::string name_;
    std::size_t first_ = 0, size_ = 0;
    std::vector<T> window_;
};

/// Fills a target, a Mesh or MeshArrays.
template <class Target>
class VtuReader {
public:
    /// The program that wrote the file. Only points and cells are read from the files of others, since their arrays may
    /// have the names of ours and other meanings.
    enum class Writer { lamina, anyone };

    VtuReader(std::string_view bytes, const std::filesystem::path& file,
              Writer writer) requires std::is_default_constructible_v<Target>
        : VtuReader(bytes, file, writer, Target{}) {}
    VtuReader(std::string_view bytes, const std::filesystem::path& file, Writer writer, Target target)
        : xml_(bytes, file.string()), file_(file), bytes_(bytes.size()), writer_(writer), mesh_(std::move(target)) {}

    Target read() {
        read_all();
        if (order_ > 1) xml_.fail(curved_cells_refused(order_));
        return std::move(mesh_);
    }
    CurvedMesh read_curved() requires std::is_same_v<Target, Mesh> {
        read_all();
        CurvedMesh curved{std::move(mesh_), std::move(curved_)};
        if (order_ <= 1) return curved;
        curved.nodes.order = order_;
        for (const std::vector<VertexId>& nodes : edge_nodes_)
            curved.nodes.marker_nodes.insert(curved.nodes.marker_nodes.end(), nodes.begin(), nodes.end());
        if (!separate_nodes(curved)) xml_.fail("a point is the corner of one cell and no corner of another one");
        return curved;
    }
    /// Returns the sizes that the file holds as point data.
    std::vector<double> sizes() const {
        const std::string section = "PointData";
        return at_vertices(
            xml_.values<double>(section + "/" + size_array(xml_.scalars(section), file_), xml_.points()));
    }

    /// Returns the growth of sizes that the file holds, if any.
    std::optional<double> gradation() const {
        if (!xml_.has(gradation_array)) return {};
        const double gradation = xml_.values<double>(gradation_array, 1).front();
        if (!(gradation > 0 && std::isfinite(gradation))) xml_.fail("the gradation of sizes is not positive");
        return gradation;
    }
    /// Returns the walls that the file holds.
    std::vector<SizedWall> walls() const {
        std::vector<SizedWall> walls;
        const std::string folder = "FieldData/";
        if (!xml_.has(folder + wall_sizes_array)) return walls;
        const auto counts = xml_.values<std::int64_t>(folder + wall_sizes_array);
        std::size_t points = 0;
        for (const std::int64_t count : counts) {
            if (count < 3 || count > static_cast<std::int64_t>(xml_.size(folder + wall_rows_array)))
                xml_.fail("the numbers of points of its walls do not fit");
            points += static_cast<std::size_t>(count);
        }
        const auto rows = xml_.values<double>(folder + wall_rows_array, numbers_of_wall_row * points);
        std::size_t at = 0;
        for (const std::int64_t count : counts) {
            SizedWall& wall = walls.emplace_back();
            for (std::int64_t i = 0; i < count; ++i, at += numbers_of_wall_row) {
                const double* row = rows.data() + at;
                wall.points.push_back({row[0], row[1]});
                wall.spacings.push_back(row[2]);
                wall.units.push_back(row[3]);
                wall.thicknesses.push_back(row[4]);
                const bool positive = row[2] > 0 && row[3] > 0 && row[4] >= 0;
                if (!positive ||
                    !std::all_of(row, row + numbers_of_wall_row, [](double x) { return std::isfinite(x); }))
                    xml_.fail("a number of its walls is not finite and positive");
            }
        }
        return walls;
    }
    /// Returns a field of the points or, where they have none of this name, of the cells. Precondition: read().
    SolutionField field(const FieldRequest& request) const {
        const std::string at_points = "PointData/" + request.array, at_cells = "CellData/" + request.array;
        if (xml_.has(at_points)) return {request.name, false, at_vertices(part(request, at_points, xml_.points()))};
        if (!xml_.has(at_cells)) throw UsageError(fmt::format("{}: no array '{}'", file_.string(), request.array));
        const std::vector<double> all = part(request, at_cells, xml_.cells());
        SolutionField field{request.name, true, {}};
        for_each_cell([&](std::size_t cell) { field.values.push_back(all[cell]); });
        return field;
    }

private:
    void read_all() {
        if (xml_.points() > bytes_) xml_.fail("NumberOfPoints exceeds the file");
        if (xml_.cells() > bytes_) xml_.fail("NumberOfCells exceeds the file");
        is_in_space_ = holds_volumes();
        if (!is_in_space_) read_points();
        if (writer_ == Writer::lamina) read_markers_and_constraints();
        is_in_space_ ? read_extrusion() : read_cells();
        read_cell_array("CellData/region", static_cast<std::size_t>(Region::isotropic), mesh_.region);
        read_cell_array("CellData/piece", std::numeric_limits<std::uint32_t>::max(), mesh_.piece);
        read_cell_array("CellData/layer", std::numeric_limits<std::uint16_t>::max(), mesh_.layer);
    }
    bool holds_volumes() const {
        ValuesInOrder<std::uint8_t> types(xml_, "Cells/types", xml_.cells());
        for (std::size_t i = 0; i < xml_.cells(); ++i)
            if (is_volume(types[i])) return true;
        return false;
    }
    /// Returns the values of the mesh's vertices out of those of all points.
    std::vector<double> at_vertices(const std::vector<double>& values) const {
        return is_in_space_ && values.size() == xml_.points() ? values_at(values, plane_.nodes) : values;
    }

    std::vector<double> part(const FieldRequest& request, const std::string& array, std::size_t tuples) const {
        const std::size_t components = xml_.components(array);
        return part_of(request, xml_.values<double>(array, components * tuples), components);
    }

    void read_points() {
        ValuesInOrder<double> coordinates(xml_, "Points/", 3 * xml_.points());
        mesh_.points.reserve(xml_.points());
        for (std::size_t i = 0; i < xml_.points(); ++i) {
            const Point p{coordinates[3 * i], coordinates[3 * i + 1]};
            if (!std::isfinite(p.x) || !std::isfinite(p.y)) xml_.fail(fmt::format("point {} is not finite", i));
            mesh_.points.push_back(p);
        }
    }

    VertexId vertex(std::int64_t index) const {
        if (index < 0 || static_cast<std::size_t>(index) >= xml_.points())
            xml_.fail(fmt::format("vertex index {} where there are {} points", index, xml_.points()));
        return VertexId(static_cast<std::size_t>(index));
    }

    void read_markers_and_constraints() {
        if (xml_.has("FieldData/marker_names")) {
            const auto stored = xml_.values<std::uint8_t>("FieldData/marker_names");
            std::string_view names(reinterpret_cast<const char*>(stored.data()), stored.size());
            for (std::size_t end; (end = names.find('\0')) != std::string_view::npos; names.remove_prefix(end + 1))
                mesh_.markers.push_back({std::string(names.substr(0, end)), MarkerKind::other, {}});
            if (!names.empty()) xml_.fail("the last marker's name does not end");
        }
        if (xml_.has("FieldData/marker_kinds")) {
            const auto kinds = xml_.values<std::uint8_t>("FieldData/marker_kinds", mesh_.markers.size());
            for (std::size_t m = 0; m < kinds.size(); ++m) {
                if (kinds[m] >= core::marker_kind_count) xml_.fail("unknown kind of marker");
                mesh_.markers[m].kind = static_cast<MarkerKind>(kinds[m]);
            }
        }
        if (xml_.has("FieldData/constraints")) {
            const auto ends = xml_.values<std::int64_t>("FieldData/constraints");
            if (ends.size() % 2 != 0) xml_.fail("constraints do not come in pairs of points");
            for (std::size_t i = 0; i < ends.size(); i += 2)
                mesh_.constraints.push_back({vertex(ends[i]), vertex(ends[i + 1])});
        }
    }

    void read_cells() {
        CellArrays arrays = cell_arrays();
        reserve_cells(mesh_, xml_.cells());
        std::int64_t first = 0;
        for (std::size_t i = 0; i < xml_.cells(); ++i) first = read_cell(i, first, arrays);
        triangles_ = mesh_.triangles.size();
        quads_ = mesh_.quads.size();
    }
    struct CellArrays {
        ValuesInOrder<std::uint8_t> types;
        ValuesInOrder<std::int64_t> offsets;       ///< per cell of the file: the end of its vertices in `connectivity`
        ValuesInOrder<std::int64_t> connectivity;  ///< the vertices of all cells
        std::optional<ValuesInOrder<std::uint32_t>> markers;  ///< per cell of the file: its marker, from 1, or 0
    };
    CellArrays cell_arrays() const {
        CellArrays arrays{{xml_, "Cells/types", xml_.cells()},
                          {xml_, "Cells/offsets", xml_.cells()},
                          {xml_, "Cells/connectivity"},
                          {}};
        if (writer_ == Writer::lamina && xml_.has("CellData/marker"))
            arrays.markers.emplace(xml_, "CellData/marker", xml_.cells());
        return arrays;
    }

    /// Reads a plane mesh from the copies that the grid holds of it.
    void read_extrusion() {
        SpaceMesh space;
        ValuesInOrder<double> coordinates(xml_, "Points/", 3 * xml_.points());
        for (std::size_t i = 0; i < xml_.points(); ++i) {
            space.points.push_back({coordinates[3 * i], coordinates[3 * i + 1]});
            space.heights.push_back(coordinates[3 * i + 2]);
            const Point p = space.points.back();
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(space.heights.back()))
                xml_.fail(fmt::format("point {} is not finite", i));
        }
        CellArrays arrays = cell_arrays();
        std::int64_t first = 0;
        for (std::size_t i = 0; i < xml_.cells(); ++i) first = read_cell_in_space(i, first, arrays, space);
        plane_ = plane_of_extrusion(space, mesh_.markers.size(), file_);
        for (const Point p : plane_.points) mesh_.points.push_back(p);
        for (const Triangle& triangle : plane_.triangles) mesh_.triangles.push_back(triangle);
        for (const Quad& quad : plane_.quads) mesh_.quads.push_back(quad);
        for (std::size_t m = 0; m < mesh_.markers.size(); ++m) mesh_.markers[m].edges = std::move(plane_.edges[m]);
        std::erase_if(mesh_.markers,
                      [](const Marker& marker) { return marker.edges.empty(); });  // the ends of the span
        triangles_ = mesh_.triangles.size();
        quads_ = mesh_.quads.size();
    }
    /// Adds a volume, or a face that is in a marker, whose nodes begin at `first`. Returns where they end.
    std::int64_t read_cell_in_space(std::size_t i, std::int64_t first, CellArrays& arrays, SpaceMesh& space) {
        const std::int64_t end = arrays.offsets[i];
        const std::uint8_t type = arrays.types[i];
        const std::size_t corners = type == vtk_wedge || type == vtk_triangle ? 3 : 4;
        const auto expected = static_cast<std::int64_t>(is_volume(type) ? 2 * corners : corners);
        if (!is_volume(type) && type != vtk_triangle && type != vtk_quad)
            xml_.fail(fmt::format("cell {} has type {} beside wedges and hexahedra", i, type));
        if (end < 0 || end - first != expected || static_cast<std::size_t>(end) > arrays.connectivity.size())
            xml_.fail(fmt::format("cell {} has not the vertices of its type", i));
        const auto node = [&](std::size_t k) {
            return static_cast<std::uint32_t>(vertex(arrays.connectivity[static_cast<std::size_t>(first) + k]).index());
        };
        if (is_volume(type)) {
            SpaceMesh::Volume& volume = space.volumes.emplace_back(SpaceMesh::Volume{corners, {}});
            for (std::size_t k = 0; k < 2 * corners; ++k) volume.nodes[k] = node(k);
            volume_cells_.push_back(i);
            return end;
        }
        const std::uint32_t marker = arrays.markers ? (*arrays.markers)[i] : 0;
        if (marker == 0) return end;
        if (marker > mesh_.markers.size()) xml_.fail(fmt::format("cell {} has a marker without a name", i));
        SpaceMesh::Face& face = space.faces.emplace_back(SpaceMesh::Face{corners, {}, marker - 1});
        for (std::size_t k = 0; k < corners; ++k) face.nodes[k] = node(k);
        return end;
    }

    /// Reads a cell whose vertices begin at `first`, and returns where they end.
    std::int64_t read_cell(std::size_t i, std::int64_t first, CellArrays& arrays) {
        const std::int64_t end = arrays.offsets[i];
        const std::uint8_t type = arrays.types[i];
        const unsigned corners = corners_of(type);
        if (is_ignored(type)) {
            if (end < 0 || static_cast<std::size_t>(end) > arrays.connectivity.size())
                xml_.fail(fmt::format("cell {} ends behind the last vertex", i));
            return end;
        }
        if (corners == 0) xml_.fail(fmt::format("cell {} has the unknown type {}", i, type));
        const unsigned order = order_of(type, end - first);
        if (order == 0 || static_cast<std::size_t>(end) > arrays.connectivity.size())
            xml_.fail(fmt::format("cell {} has not the vertices of its type", i));
        const std::uint32_t marker = arrays.markers ? (*arrays.markers)[i] : 0;
        if (corners == 2 && marker == 0) return end;
        if (order_ != 0 && order != order_) xml_.fail("cells of several orders");
        order_ = order;
        if (corners == 4 && order_of_quad_.empty()) order_of_quad_ = vtk_order_of_quad(order);
        std::array<VertexId, mesh::nodes_of_cell(4, max_cell_order)> v;
        const auto nodes = static_cast<std::size_t>(end - first);
        for (std::size_t k = 0; k < nodes; ++k)
            v[corners == 4 ? order_of_quad_[k] : k] = vertex(arrays.connectivity[static_cast<std::size_t>(first) + k]);
        const std::span<const VertexId> beside = std::span(v).subspan(corners, nodes - corners);
        const auto keep = [&](std::vector<VertexId>& list) { list.insert(list.end(), beside.begin(), beside.end()); };
        if (corners == 3) {
            mesh_.triangles.push_back({{v[0], v[1], v[2]}});
            keep(curved_.triangle_nodes);
        } else if (corners == 4) {
            mesh_.quads.push_back({{v[0], v[1], v[2], v[3]}});
            keep(curved_.quad_nodes);
        } else {
            if (marker > mesh_.markers.size()) xml_.fail(fmt::format("cell {} has a marker without a name", i));
            mesh_.markers[marker - 1].edges.push_back({v[0], v[1]});
            edge_nodes_.resize(mesh_.markers.size());
            keep(edge_nodes_[marker - 1]);
        }
        return end;
    }
    /// Calls f(i) for the positions of the mesh's cells in the file: the triangles, then the quads.
    template <class F>
    void for_each_cell(F&& f) const {
        for (const std::uint32_t volume : plane_.volumes) f(volume_cells_[volume]);
        if (is_in_space_) return;
        for (const auto& [corners, count] : {std::pair{3u, triangles_}, std::pair{4u, quads_}}) {
            if (count == 0) continue;
            ValuesInOrder<std::uint8_t> types(xml_, "Cells/types", xml_.cells());
            for (std::size_t i = 0; i < xml_.cells(); ++i)
                if (corners_of(types[i]) == corners) f(i);
        }
    }
    /// Reads an array of cell data, where the file has it, for the triangles and quads. Fails for values above the
    /// limit.
    template <class Values>
    void read_cell_array(const char* name, std::size_t limit, Values& target) const {
        if (writer_ != Writer::lamina || !xml_.has(name)) return;
        ValuesInOrder<std::uint32_t> all(xml_, name, xml_.cells());
        target.reserve(triangles_ + quads_);
        for_each_cell([&](std::size_t i) {
            const std::uint32_t value = all[i];
            if (value > limit) xml_.fail(fmt::format("array '{}' holds a value that is out of range", name));
            target.push_back(static_cast<typename Values::value_type>(value));
        });
    }

    VtkXmlFile xml_;
    std::filesystem::path file_;
    std::size_t bytes_;  ///< size of the file
    Writer writer_;
    bool is_in_space_ = false;               ///< whether the grid is a plane mesh in copies
    PlaneOfExtrusion plane_;                 ///< if so
    std::vector<std::size_t> volume_cells_;  ///< if so: the places of wedges and hexahedra among the cells of the file
    std::size_t triangles_ = 0, quads_ = 0;  ///< numbers of the mesh's cells, also once the mesh is handed out
    Target mesh_;
    unsigned order_ = 0;                             ///< of all cells; 0 before the first one
    std::vector<std::size_t> order_of_quad_;         ///< vtk_order_of_quad()
    CurvedNodes curved_;                             ///< the nodes of cells beside their corners, as points of the mesh
    std::vector<std::vector<VertexId>> edge_nodes_;  ///< per marker
};

}  // namespace

Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader<Mesh>(bytes, file, VtuReader<Mesh>::Writer::lamina).read();
}

CurvedMesh read_curved_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader<Mesh>(bytes, file, VtuReader<Mesh>::Writer::lamina).read_curved();
}

void read_vtu_arrays(const std::filesystem::path& file, MeshArrays& arrays) {
    const core::FileBytes mapped(file);
    using Reader = VtuReader<MeshArrays>;
    arrays = Reader(mapped.bytes(), input_name(file), Reader::Writer::lamina, std::move(arrays)).read();
}

PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file) {
    VtuReader<Mesh> reader(bytes, file, VtuReader<Mesh>::Writer::anyone);
    const std::optional<double> gradation = reader.gradation();
    std::vector<SizedWall> walls = reader.walls();
    PointValues result = read_point_values(std::move(reader));
    result.gradation = gradation;
    result.walls = std::move(walls);
    return result;
}

std::vector<std::string> vtu_fields(const std::string& bytes, const std::filesystem::path& file) {
    const std::set<std::string> of_meshes{"region", "piece", "layer", "marker", "quality", "wall_distance"};
    const VtkXmlFile xml(bytes, file.string());
    std::vector<std::string> fields;
    std::set<std::string> at_points;
    for (const std::string section : {"PointData", "CellData"})
        for (const std::string& name : xml.arrays(section)) {
            // Those of the points come first, and hide those of the cells.
            if (of_meshes.contains(name) || !at_points.insert(name).second) continue;
            const std::size_t components = xml.components(fmt::format("{}/{}", section, name));
            if (components == 1) fields.push_back(name);
            if (components == 2 || components == 3)
                for (std::size_t i = 0; i < components; ++i) fields.push_back(name + ":" + "xyz"[i]);
        }
    return fields;
}

Solution read_vtu_solution(const std::string& bytes, const std::filesystem::path& file,
                           std::span<const FieldRequest> fields) {
    VtuReader<Mesh> reader(bytes, file, VtuReader<Mesh>::Writer::lamina);
    Solution solution{reader.read(), {}};
    for (const FieldRequest& field : fields) solution.fields.push_back(reader.field(field));
    return solution;
}

}  // namespace lamina::io
