// Reads VTK XML unstructured grids of triangles (5), quads (9) and lines (3). Ignores z, vertices and polylines (1, 2,
// 4), arrays that lamina does not write, and lines that are in no marker. vtu_write.cpp describes the arrays. Source:
// VTK User's Guide, "VTK File Formats", XML.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <lamina/error.hpp>

#include "io/formats.hpp"
#include "io/sizes.hpp"
#include "io/vtk_cell_types.hpp"
#include "io/vtk_xml.hpp"

namespace lamina::io {

namespace {

/// Returns the number of corners of a type of cell; 0 for types that cannot be read or are ignored.
std::int64_t corners_of(std::uint8_t type) {
    if (type == vtk_triangle) return 3;
    if (type == vtk_quad) return 4;
    return type == vtk_line ? 2 : 0;
}

bool is_ignored(std::uint8_t type) { return type == vtk_vertex || type == vtk_poly_vertex || type == vtk_poly_line; }

class VtuReader {
public:
    /// The program that wrote the file. Only points and cells are read from the files of others, since their arrays may
    /// have the names of ours and other meanings.
    enum class Writer { lamina, anyone };

    VtuReader(const std::string& bytes, const std::filesystem::path& file, Writer writer)
        : xml_(bytes, file.string()), file_(file), bytes_(bytes.size()), writer_(writer) {}

    Mesh read() {
        read_points();
        if (writer_ == Writer::lamina) read_markers_and_constraints();
        read_cells();
        return std::move(mesh_);
    }
    /// Returns the sizes that the file holds as point data.
    std::vector<double> sizes() const {
        const std::string section = "PointData";
        return xml_.values<double>(section + "/" + size_array(xml_.scalars(section), file_), xml_.points());
    }

    /// Returns the growth of sizes that the file holds, if any.
    std::optional<double> gradation() const {
        if (!xml_.has(gradation_array)) return {};
        const double gradation = xml_.values<double>(gradation_array, 1).front();
        if (!(gradation > 0 && std::isfinite(gradation))) xml_.fail("the gradation of sizes is not positive");
        return gradation;
    }
    /// Returns a field of the points or, where they have none of this name, of the cells. Precondition: read().
    SolutionField field(const FieldRequest& request) const {
        const std::string at_points = "PointData/" + request.array, at_cells = "CellData/" + request.array;
        if (xml_.has(at_points)) return {request.name, false, part(request, at_points, xml_.points())};
        if (!xml_.has(at_cells)) throw UsageError(fmt::format("{}: no array '{}'", file_.string(), request.array));
        const std::vector<double> all = part(request, at_cells, xml_.cells());
        SolutionField field{request.name, true, {}};
        for (const std::size_t cell : cells_) field.values.push_back(all[cell]);
        return field;
    }

private:
    std::vector<double> part(const FieldRequest& request, const std::string& array, std::size_t tuples) const {
        const std::size_t components = xml_.components(array);
        return part_of(request, xml_.values<double>(array, components * tuples), components);
    }

    void read_points() {
        if (xml_.points() > bytes_) xml_.fail("NumberOfPoints exceeds the file");
        const std::vector<double> coordinates = xml_.values<double>("Points/", 3 * xml_.points());
        mesh_.points.resize(xml_.points());
        for (std::size_t i = 0; i < mesh_.points.size(); ++i) {
            mesh_.points[i] = {coordinates[3 * i], coordinates[3 * i + 1]};
            if (!std::isfinite(mesh_.points[i].x) || !std::isfinite(mesh_.points[i].y))
                xml_.fail(fmt::format("point {} is not finite", i));
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
                if (kinds[m] > static_cast<std::uint8_t>(MarkerKind::other)) xml_.fail("unknown kind of marker");
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
        if (xml_.cells() > bytes_) xml_.fail("NumberOfCells exceeds the file");
        types_ = xml_.values<std::uint8_t>("Cells/types", xml_.cells());
        offsets_ = xml_.values<std::int64_t>("Cells/offsets", xml_.cells());
        connectivity_ = xml_.values<std::int64_t>("Cells/connectivity");
        const bool has_markers = writer_ == Writer::lamina && xml_.has("CellData/marker");
        markers_ = has_markers ? xml_.values<std::uint32_t>("CellData/marker", xml_.cells())
                               : std::vector<std::uint32_t>(xml_.cells(), 0);
        for (std::size_t i = 0; i < xml_.cells(); ++i) read_cell(i);

        cells_ = std::move(triangles_);
        cells_.insert(cells_.end(), quads_.begin(), quads_.end());
        read_cell_array("CellData/region", static_cast<std::size_t>(Region::isotropic), mesh_.region);
        read_cell_array("CellData/piece", std::numeric_limits<std::uint32_t>::max(), mesh_.piece);
        read_cell_array("CellData/layer", std::numeric_limits<std::uint16_t>::max(), mesh_.layer);
    }
    void read_cell(std::size_t i) {
        const std::int64_t first = i == 0 ? 0 : offsets_[i - 1], end = offsets_[i];
        const std::int64_t corners = corners_of(types_[i]);
        if (is_ignored(types_[i])) {
            if (end < 0 || static_cast<std::size_t>(end) > connectivity_.size())
                xml_.fail(fmt::format("cell {} ends behind the last vertex", i));
            return;
        }
        if (corners == 0) xml_.fail(fmt::format("cell {} has the unknown type {}", i, types_[i]));
        if (end != first + corners || static_cast<std::size_t>(end) > connectivity_.size())
            xml_.fail(fmt::format("cell {} has not the {} vertices of its type", i, corners));
        const auto corner = [&](std::int64_t k) { return vertex(connectivity_[static_cast<std::size_t>(first + k)]); };
        if (corners == 3) {
            triangles_.push_back(i);
            mesh_.triangles.push_back({{corner(0), corner(1), corner(2)}});
        } else if (corners == 4) {
            quads_.push_back(i);
            mesh_.quads.push_back({{corner(0), corner(1), corner(2), corner(3)}});
        } else if (markers_[i] != 0) {
            if (markers_[i] > mesh_.markers.size()) xml_.fail(fmt::format("cell {} has a marker without a name", i));
            mesh_.markers[markers_[i] - 1].edges.push_back({corner(0), corner(1)});
        }
    }
    /// Reads an array of cell data, where the file has it, for the triangles and quads. Fails for values above the
    /// limit.
    template <class T>
    void read_cell_array(const char* name, std::size_t limit, std::vector<T>& target) const {
        if (writer_ != Writer::lamina || !xml_.has(name)) return;
        const auto all = xml_.values<std::uint32_t>(name, xml_.cells());
        for (const std::size_t i : cells_) {
            if (all[i] > limit) xml_.fail(fmt::format("array '{}' holds a value that is out of range", name));
            target.push_back(static_cast<T>(all[i]));
        }
    }

    VtkXmlFile xml_;
    std::filesystem::path file_;
    std::size_t bytes_;  ///< size of the file
    Writer writer_;
    std::vector<std::uint8_t> types_;             ///< per cell of the file
    std::vector<std::int64_t> offsets_;           ///< per cell of the file: the end of its vertices in connectivity_
    std::vector<std::int64_t> connectivity_;      ///< the vertices of all cells
    std::vector<std::uint32_t> markers_;          ///< per cell of the file: its marker, from 1, or 0
    std::vector<std::size_t> triangles_, quads_;  ///< positions of the mesh's cells in the file
    std::vector<std::size_t> cells_;              ///< the same for triangles and quads, once all are read
    Mesh mesh_;
};

}  // namespace

Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader(bytes, file, VtuReader::Writer::lamina).read();
}

PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file) {
    VtuReader reader(bytes, file, VtuReader::Writer::anyone);
    const std::optional<double> gradation = reader.gradation();
    PointValues result = read_point_values(std::move(reader));
    result.gradation = gradation;
    return result;
}

Solution read_vtu_solution(const std::string& bytes, const std::filesystem::path& file,
                           std::span<const FieldRequest> fields) {
    VtuReader reader(bytes, file, VtuReader::Writer::lamina);
    Solution solution{reader.read(), {}};
    for (const FieldRequest& field : fields) solution.fields.push_back(reader.field(field));
    return solution;
}

}  // namespace lamina::io
