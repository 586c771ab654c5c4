// Writes VTK XML unstructured grids with one piece. All arrays are appended, with offsets counted from behind the
// underscore. A raw array is stored as [length, UInt64][bytes]. A compressed array is stored as [blocks][bytes of a
// block][bytes of the last block if it is shorter, else 0][compressed bytes of each block], all UInt64, followed by
// the blocks, each a zlib stream. Source: VTK User's Guide, "VTK File Formats", XML.
//
// The files hold more than points and cells, so that a mesh is read back as it was:
//   cells        triangles, quads, then the edges of each marker as lines
//   cell data    region (0 layer, 1 isotropic, 2 lines), piece and layer (0 on lines) where the mesh has them;
//                marker (0 on triangles and quads, 1 on the lines of the first marker, ...); quality (1 for the
//                equilateral triangle and the square, 0 for flat cells and lines)
//   field data   marker_names (UTF-8, with a zero byte behind each name, since not every reader knows strings),
//                marker_kinds (in the order of MarkerKind), constraints (pairs of points)
//   point data   wall_distance where it is asked for
// Files of sizes have the point data size and, where it is known, the field data lamina_size_gradation.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "io/binary_output.hpp"
#include "io/formats.hpp"
#include "io/vtk_cell_types.hpp"
#include "mesh/quality.hpp"

namespace lamina::io {

namespace {

template <class T>
constexpr const char* type_name() {
    if constexpr (std::is_same_v<T, double>) return "Float64";
    if constexpr (std::is_same_v<T, float>) return "Float32";
    if constexpr (std::is_same_v<T, std::int64_t>) return "Int64";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "UInt32";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "UInt16";
    if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
}

/// Collects the XML header and the arrays that it announces, and writes both. Raw arrays are computed only when they
/// are written.
class VtuWriter {
public:
    explicit VtuWriter(bool compress) : compress_(compress) {}

    std::string xml;

    /// Announces an array of tuples x components values; value(i) returns value i.
    template <class T, class F>
    void add_array(const char* name, std::size_t tuples, std::size_t components, F value, bool in_field_data = false) {
        xml += fmt::format("        <DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" ", type_name<T>(),
                           name, components);
        if (in_field_data) xml += fmt::format("NumberOfTuples=\"{}\" ", tuples);
        xml += fmt::format("format=\"appended\" offset=\"{}\"/>\n", offset_);
        const std::size_t count = tuples * components;
        const auto fill = [value = std::move(value)](char* p, std::size_t i) { store(p, static_cast<T>(value(i))); };
        if (compress_) {
            appended_.push_back([bytes = compressed(count, sizeof(T), fill)](std::ostream& out) { out << bytes; });
        } else {
            appended_.push_back([count, fill](std::ostream& out) {
                write_value(out, std::uint64_t{count * sizeof(T)});
                write_records(out, count, sizeof(T), fill);
            });
            offset_ += sizeof(std::uint64_t) + count * sizeof(T);
        }
    }
    void write(std::ostream& out) const {
        out << xml << "  <AppendedData encoding=\"raw\">\n_";
        for (const auto& write_array : appended_) write_array(out);
        out << "\n  </AppendedData>\n</VTKFile>\n";
    }

private:
    /// Returns an array as it is stored in the file, and moves the offset of the next one behind it.
    template <class F>
    std::string compressed(std::size_t count, std::size_t size, F&& fill) {
        constexpr std::size_t block_bytes = 1 << 18;
        constexpr int level = 4;
        const std::size_t block = block_bytes / size, blocks = (count + block - 1) / block;
        const std::vector<std::string> parts =
            core::parallel_blocks(count, block, [&](std::size_t begin, std::size_t end) {
                std::string plain((end - begin) * size, '\0');
                for (std::size_t i = begin; i < end; ++i) fill(plain.data() + (i - begin) * size, i);
                uLongf length = compressBound(plain.size());
                std::string part(length, '\0');
                if (compress2(reinterpret_cast<Bytef*>(part.data()), &length,
                              reinterpret_cast<const Bytef*>(plain.data()), plain.size(), level) != Z_OK)
                    throw std::bad_alloc();
                part.resize(length);
                return part;
            });
        std::string bytes(8 * (3 + blocks), '\0');
        char* p = bytes.data();
        for (const std::size_t value : {blocks, block_bytes, count % block * size}) p = store(p, std::uint64_t{value});
        for (const std::string& part : parts) p = store(p, std::uint64_t{part.size()});
        for (const std::string& part : parts) bytes += part;
        offset_ += bytes.size();
        return bytes;
    }

    bool compress_;
    std::vector<std::function<void(std::ostream&)>> appended_;  ///< writers of the arrays
    std::size_t offset_ = 0;                                    ///< offset of the next array
};

/// The cells of the file: triangles, quads, then the lines of all markers.
struct VtuCells {
    explicit VtuCells(const Mesh& m) : mesh(m), triangles(m.triangles.size()), quads(m.quads.size()) {
        for (std::size_t i = 0; i < m.markers.size(); ++i)
            for (const Segment& edge : m.markers[i].edges) lines.push_back({edge, static_cast<std::uint32_t>(i + 1)});
    }
    /// Returns the number of triangles and quads.
    std::size_t inner() const { return triangles + quads; }
    std::size_t count() const { return inner() + lines.size(); }
    /// Returns vertex i in the list of the vertices of all cells.
    VertexId vertex(std::size_t i) const {
        if (i < 3 * triangles) return mesh.triangles[i / 3].v[i % 3];
        i -= 3 * triangles;
        if (i < 4 * quads) return mesh.quads[i / 4].v[i % 4];
        i -= 4 * quads;
        return i % 2 == 0 ? lines[i / 2].edge.a : lines[i / 2].edge.b;
    }
    /// Returns the number of vertices of cell i and of all cells before it.
    std::size_t offset(std::size_t i) const {
        const std::size_t n = i + 1;
        return 3 * std::min(n, triangles) + 4 * (std::clamp(n, triangles, inner()) - triangles) +
               2 * (std::max(n, inner()) - inner());
    }
    VtkCellType type(std::size_t i) const { return i < triangles ? vtk_triangle : i < inner() ? vtk_quad : vtk_line; }
    float quality(std::size_t i) const {
        const auto at = [&](VertexId v) { return mesh.points[v.index()]; };
        if (i < triangles) {
            const VertexId* v = mesh.triangles[i].v;
            return static_cast<float>(mesh::shape_of_triangle(at(v[0]), at(v[1]), at(v[2])));
        }
        if (i >= inner()) return 0;
        const VertexId* v = mesh.quads[i - triangles].v;
        return static_cast<float>(mesh::shape_of_quad(at(v[0]), at(v[1]), at(v[2]), at(v[3])));
    }

    struct MarkerLine {
        Segment edge;
        std::uint32_t marker;  ///< from 1
    };
    const Mesh& mesh;
    std::size_t triangles, quads;
    std::vector<MarkerLine> lines;
};

void add_field_data(const Mesh& mesh, std::optional<double> size_gradation, VtuWriter& vtu) {
    std::string names;
    for (const Marker& marker : mesh.markers) names += marker.name + '\0';
    vtu.xml += "    <FieldData>\n";
    constexpr bool in_field_data = true;
    vtu.add_array<std::uint8_t>(
        "marker_names", names.size(), 1, [names](std::size_t i) { return names[i]; }, in_field_data);
    vtu.add_array<std::uint32_t>(
        "constraints", mesh.constraints.size(), 2,
        [&mesh](std::size_t i) {
            const Segment& edge = mesh.constraints[i / 2];
            return i % 2 == 0 ? edge.a.value : edge.b.value;
        },
        in_field_data);
    vtu.add_array<std::uint8_t>(
        "marker_kinds", mesh.markers.size(), 1, [&mesh](std::size_t i) { return mesh.markers[i].kind; }, in_field_data);
    if (size_gradation)
        vtu.add_array<double>(
            "lamina_size_gradation", 1, 1, [size_gradation](std::size_t) { return *size_gradation; }, in_field_data);
    vtu.xml += "    </FieldData>\n";
}

/// Numbers at the points, and their name.
struct PointArray {
    const char* name;
    const std::vector<double>& values;
};

void add_point_data(const PointArray& array, VtuWriter& vtu) {
    if (array.values.empty()) return;
    vtu.xml += "      <PointData>\n";
    vtu.add_array<double>(array.name, array.values.size(), 1,
                          [&values = array.values](std::size_t i) { return values[i]; });
    vtu.xml += "      </PointData>\n";
}

void add_cell_data(const Mesh& mesh, const VtuCells& cells, VtuWriter& vtu) {
    const auto put = [&]<class T>(const char* name, const auto& values, T value_on_lines) {
        if (values.empty()) return;
        vtu.add_array<T>(name, cells.count(), 1, [&values, value_on_lines](std::size_t i) {
            return i < values.size() ? static_cast<T>(values[i]) : value_on_lines;
        });
    };
    vtu.xml += "      <CellData>\n";
    put("region", mesh.region, std::uint8_t{2});
    put("piece", mesh.piece, std::uint32_t{0});
    put("layer", mesh.layer, std::uint16_t{0});
    vtu.add_array<std::uint32_t>("marker", cells.count(), 1, [&cells](std::size_t i) {
        return i < cells.inner() ? 0 : cells.lines[i - cells.inner()].marker;
    });
    vtu.add_array<float>("quality", cells.count(), 1, [&cells](std::size_t i) { return cells.quality(i); });
    vtu.xml += "      </CellData>\n";
}

void add_points(const Mesh& mesh, VtuWriter& vtu) {
    vtu.xml += "      <Points>\n";
    vtu.add_array<double>("Points", mesh.points.size(), 3, [&mesh](std::size_t i) {
        const Point p = mesh.points[i / 3];
        return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : 0.0;
    });
    vtu.xml += "      </Points>\n";
}

void add_cells(const VtuCells& cells, VtuWriter& vtu) {
    const std::size_t vertices = cells.count() == 0 ? 0 : cells.offset(cells.count() - 1);
    vtu.xml += "      <Cells>\n";
    vtu.add_array<std::int64_t>("connectivity", vertices, 1, [&cells](std::size_t i) { return cells.vertex(i).value; });
    vtu.add_array<std::int64_t>("offsets", cells.count(), 1, [&cells](std::size_t i) { return cells.offset(i); });
    vtu.add_array<std::uint8_t>("types", cells.count(), 1, [&cells](std::size_t i) { return cells.type(i); });
    vtu.xml += "      </Cells>\n";
}

void write_grid(const Mesh& mesh, const PointArray& array, bool compressed, std::optional<double> size_gradation,
                std::ostream& out) {
    const VtuCells cells(mesh);
    VtuWriter vtu(compressed);
    vtu.xml = fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n"
        "  <UnstructuredGrid>\n",
        compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
    add_field_data(mesh, size_gradation, vtu);
    vtu.xml +=
        fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", mesh.points.size(), cells.count());
    add_point_data(array, vtu);
    add_cell_data(mesh, cells, vtu);
    add_points(mesh, vtu);
    add_cells(cells, vtu);
    vtu.xml += "    </Piece>\n  </UnstructuredGrid>\n";
    vtu.write(out);
}

}  // namespace

void write_vtu(const Mesh& mesh, VtuVariant variant, std::ostream& out) {
    const std::vector<double> distances = variant.wall_distance ? wall_distances(mesh) : std::vector<double>{};
    write_grid(mesh, {"wall_distance", distances}, variant.compressed, {}, out);
}

void write_vtu_sizes(const SizedMesh& sizes, std::ostream& out) {
    Mesh mesh;
    mesh.points = sizes.points;
    mesh.triangles = sizes.triangles;
    write_grid(mesh, {"size", sizes.sizes}, true, sizes.gradation, out);
}

}  // namespace lamina::io
