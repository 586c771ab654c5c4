// Reads VTK XML unstructured grids: triangles (5), quads (9) and lines (3). z, vertices and polylines (1, 2, 4) and
// arrays that lamina does not write are ignored, and lines with marker 0 or without the array, too. What the arrays
// mean: vtu_write.cpp. Source: VTK User's Guide, "VTK File Formats", XML.
#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "io/formats.hpp"
#include "io/vtk_xml.hpp"

namespace lamina::io {

namespace {

enum CellType : std::uint8_t {
    vertex_type = 1,
    vertices_type = 2,
    line_type = 3,
    polyline_type = 4,
    triangle_type = 5,
    quad_type = 9
};

class VtuReader {
public:
    /// Of a mesh that others may have written only points and cells count: arrays of theirs may have the names of ours.
    enum class Writer { lamina, anyone };

    VtuReader(const std::string& bytes, const std::filesystem::path& file, Writer writer)
        : xml_(bytes, file.string()), file_(file), bytes_(bytes.size()), writer_(writer) {}

    Mesh read() {
        read_points();
        if (writer_ == Writer::lamina) read_markers_and_constraints();
        read_cells();
        return std::move(mesh_);
    }
    std::vector<double> sizes() const {
        const std::string section = "PointData";
        return xml_.values<double>(section + "/" + size_array(xml_.scalars(section), file_), xml_.points());
    }

private:
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
        const auto types = xml_.values<std::uint8_t>("Cells/types", xml_.cells());
        const auto offsets = xml_.values<std::int64_t>("Cells/offsets", xml_.cells());
        const auto connectivity = xml_.values<std::int64_t>("Cells/connectivity");
        const bool has_markers = writer_ == Writer::lamina && xml_.has("CellData/marker");
        const auto marker = has_markers ? xml_.values<std::uint32_t>("CellData/marker", xml_.cells())
                                        : std::vector<std::uint32_t>(xml_.cells(), 0);

        std::vector<std::size_t> triangles, quads;  // where they stand in the file
        std::int64_t first = 0;
        for (std::size_t i = 0; i < xml_.cells(); ++i) {
            if (types[i] == vertex_type || types[i] == vertices_type || types[i] == polyline_type) {
                first = offsets[i];
                if (first < 0 || static_cast<std::size_t>(first) > connectivity.size())
                    xml_.fail(fmt::format("cell {} ends behind the last vertex", i));
                continue;
            }
            const std::int64_t corners = types[i] == triangle_type ? 3 : types[i] == quad_type ? 4 : 2;
            if (corners == 2 && types[i] != line_type)
                xml_.fail(fmt::format("cell {} has the unknown type {}", i, types[i]));
            if (offsets[i] != first + corners || static_cast<std::size_t>(offsets[i]) > connectivity.size())
                xml_.fail(fmt::format("cell {} has not the {} vertices of its type", i, corners));
            const auto corner = [&](std::int64_t k) {
                return vertex(connectivity[static_cast<std::size_t>(first + k)]);
            };
            if (corners == 3) {
                triangles.push_back(i);
                mesh_.triangles.push_back({{corner(0), corner(1), corner(2)}});
            } else if (corners == 4) {
                quads.push_back(i);
                mesh_.quads.push_back({{corner(0), corner(1), corner(2), corner(3)}});
            } else if (marker[i] != 0) {
                if (marker[i] > mesh_.markers.size()) xml_.fail(fmt::format("cell {} has a marker without a name", i));
                mesh_.markers[marker[i] - 1].edges.push_back({corner(0), corner(1)});
            }
            first = offsets[i];
        }
        triangles.insert(triangles.end(), quads.begin(), quads.end());
        const auto read_cell_array = [&](const char* name, auto& target, std::size_t limit) {
            if (writer_ != Writer::lamina || !xml_.has(name)) return;
            const auto all = xml_.values<std::uint32_t>(name, xml_.cells());
            for (const std::size_t i : triangles) {
                if (all[i] > limit) xml_.fail(fmt::format("array '{}' holds a value that is out of range", name));
                target.push_back(static_cast<typename std::decay_t<decltype(target)>::value_type>(all[i]));
            }
        };
        read_cell_array("CellData/region", mesh_.region, static_cast<std::size_t>(Region::isotropic));
        read_cell_array("CellData/piece", mesh_.piece, std::numeric_limits<std::uint32_t>::max());
        read_cell_array("CellData/layer", mesh_.layer, std::numeric_limits<std::uint16_t>::max());
    }

    VtkXmlFile xml_;
    std::filesystem::path file_;
    std::size_t bytes_;  ///< of the whole file
    Writer writer_;
    Mesh mesh_;
};

}  // namespace

Mesh read_vtu(const std::string& bytes, const std::filesystem::path& file) {
    return VtuReader(bytes, file, VtuReader::Writer::lamina).read();
}

PointValues read_vtu_sizes(const std::string& bytes, const std::filesystem::path& file) {
    return read_point_values(VtuReader(bytes, file, VtuReader::Writer::anyone));
}

}  // namespace lamina::io
