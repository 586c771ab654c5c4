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
//   point data   wall_distance where it is asked for; vertex in parts of a mesh (pvtu_write.cpp)
// Files of sizes have the point data size and, where they are known, the field data lamina_size_gradation and those of
// walls.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <lamina/error.hpp>

#include "io/curved_lists.hpp"
#include "io/formats.hpp"
#include "io/sizes.hpp"
#include "io/vtk_cell_types.hpp"
#include "io/vtu_writer.hpp"
#include "mesh/cell_lattice.hpp"
#include "mesh/quality.hpp"

namespace lamina::io {

namespace {

/// The cells of the file: triangles, quads, then the lines of all markers.
struct VtuCells {
    explicit VtuCells(const MeshView& m) : mesh(m), triangles(m.triangles.size()), quads(m.quads.size()) {
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
    std::size_t offset(std::size_t i) const { return vtu_offset(i, triangles, inner()); }
    VtkCellType type(std::size_t i) const { return vtu_type(i, triangles, inner()); }
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
    MeshView mesh;
    std::size_t triangles, quads;
    std::vector<MarkerLine> lines;
};

/// Adds the point data.
using AddData = std::function<void(VtuWriter&)>;

/// Returns what adds numbers at the points; nothing where there are none.
AddData point_data(const char* name, const std::vector<double>& values) {
    return [name, &values](VtuWriter& vtu) {
        if (values.empty()) return;
        vtu.xml += "      <PointData>\n";
        vtu.add_array<double>(name, values.size(), 1, [&values](std::size_t i) { return values[i]; });
        vtu.xml += "      </PointData>\n";
    };
}

void add_cell_data(const MeshView& mesh, const VtuCells& cells, const AddData& add_more, VtuWriter& vtu) {
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
    if (add_more) add_more(vtu);
    vtu.xml += "      </CellData>\n";
}

/// Returns how many fields from f on are the components of one vector; 1 where f stands for itself.
std::size_t vector_components(std::span<const SolutionField> fields, std::size_t f) {
    const auto stem = [&](std::size_t i) { return fields[i].name.substr(0, fields[i].name.find_last_of(':')); };
    std::size_t n = 0;
    for (const char* const axis : {":x", ":y", ":z"}) {
        const std::size_t i = f + n;
        if (i >= fields.size() || fields[i].at_cells != fields[f].at_cells || fields[i].name != stem(f) + axis) break;
        ++n;
    }
    return std::max<std::size_t>(n, 1);
}

/// Adds the fields at points, or those at cells, of so many tuples; on lines they are 0.
void add_fields(std::span<const SolutionField> fields, bool at_cells, std::size_t tuples, VtuWriter& vtu) {
    for (std::size_t f = 0; f < fields.size();) {
        const std::size_t n = vector_components(fields, f);
        const std::string& first = fields[f].name;
        const std::string name = n == 1 ? first : first.substr(0, first.size() - 2);
        if (fields[f].at_cells == at_cells)
            vtu.add_array<double>(name.c_str(), tuples, n, [fields, f, n](std::size_t i) {
                const std::vector<double>& values = fields[f + i % n].values;
                return i / n < values.size() ? values[i / n] : 0;
            });
        f += n;
    }
}

void add_points(const MeshView& mesh, std::span<const Point> curved, VtuWriter& vtu) {
    vtu.xml += "      <Points>\n";
    const std::size_t vertices = mesh.points.size();
    vtu.add_array<double>("Points", vertices + curved.size(), 3, [&mesh, curved, vertices](std::size_t i) {
        const Point p = i / 3 < vertices ? mesh.points[i / 3] : curved[i / 3 - vertices];
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

/// The cells of the file as Lagrange cells. Source: VTK, vtkHigherOrderQuadrilateral and vtkHigherOrderTriangle.
struct LagrangeCells {
    std::vector<std::int64_t> connectivity, offsets;

    LagrangeCells() = default;
    LagrangeCells(const VtuCells& cells, const CurvedNodes& nodes) {
        const MeshView& mesh = cells.mesh;
        const unsigned p = nodes.order;
        const std::vector<std::size_t> order_of_quad = vtk_order_of_quad(p);
        std::array<VertexId, mesh::nodes_of_cell(4, max_cell_order)> all{};
        const auto gather = [&](std::span<const VertexId> corners, const std::vector<VertexId>& beside,
                                std::size_t first, std::size_t count) {
            const auto end = std::copy(corners.begin(), corners.end(), all.begin());
            std::copy_n(beside.begin() + static_cast<std::ptrdiff_t>(first * count), count, end);
            return corners.size() + count;
        };
        const auto add = [&](VertexId v) { connectivity.push_back(v.value); };
        const auto end_cell = [&] { offsets.push_back(static_cast<std::int64_t>(connectivity.size())); };
        for (std::size_t t = 0; t < cells.triangles; ++t) {
            const std::size_t n = gather(mesh.triangles[t].v, nodes.triangle_nodes, t, mesh::nodes_of_cell(3, p) - 3);
            for (std::size_t k = 0; k < n; ++k) add(all[k]);
            end_cell();
        }
        for (std::size_t q = 0; q < cells.quads; ++q) {
            gather(mesh.quads[q].v, nodes.quad_nodes, q, mesh::nodes_of_cell(4, p) - 4);
            for (const std::size_t k : order_of_quad) add(all[k]);
            end_cell();
        }
        for (std::size_t i = 0; i < cells.lines.size(); ++i) {
            const Segment& edge = cells.lines[i].edge;
            const std::size_t n = gather(std::array{edge.a, edge.b}, nodes.marker_nodes, i, p - 1);
            for (std::size_t k = 0; k < n; ++k) add(all[k]);
            end_cell();
        }
    }
};

void add_lagrange_cells(const VtuCells& cells, const LagrangeCells& lagrange, VtuWriter& vtu) {
    vtu.xml += "      <Cells>\n";
    vtu.add_array<std::int64_t>("connectivity", lagrange.connectivity.size(), 1,
                                [&lagrange](std::size_t i) { return lagrange.connectivity[i]; });
    vtu.add_array<std::int64_t>("offsets", cells.count(), 1,
                                [&lagrange](std::size_t i) { return lagrange.offsets[i]; });
    vtu.add_array<std::uint8_t>("types", cells.count(), 1, [&cells](std::size_t i) {
        return i < cells.triangles ? vtk_lagrange_triangle : i < cells.inner() ? vtk_lagrange_quad : vtk_lagrange_curve;
    });
    vtu.xml += "      </Cells>\n";
}

/// What a file holds beside the mesh.
struct GridData {
    AddData at_points{}, at_cells{};
    const SizedMesh* sizes = nullptr;
};

void write_grid(const MeshView& mesh, const GridData& data, bool compressed, std::ostream& out,
                const CurvedNodes& curved = {}) {
    const VtuCells cells(mesh);
    const LagrangeCells lagrange = curved.order > 1 ? LagrangeCells(cells, curved) : LagrangeCells{};
    VtuWriter vtu(compressed);
    vtu.xml = vtu_head(compressed);
    add_vtu_field_data(mesh.markers, mesh.constraints, data.sizes, vtu);
    vtu.xml += fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
                           mesh.points.size() + curved.points.size(), cells.count());
    if (data.at_points) data.at_points(vtu);
    add_cell_data(mesh, cells, data.at_cells, vtu);
    add_points(mesh, curved.points, vtu);
    if (curved.order > 1)
        add_lagrange_cells(cells, lagrange, vtu);
    else
        add_cells(cells, vtu);
    vtu.xml += "    </Piece>\n  </UnstructuredGrid>\n";
    vtu.write(out);
}

/// Adds the number of points of each wall, and a row of numbers for each point.
void add_walls(const std::vector<SizedWall>& walls, VtuWriter& vtu) {
    constexpr bool in_field_data = true;
    std::vector<double> rows;
    for (const SizedWall& wall : walls)
        for (std::size_t i = 0; i < wall.points.size(); ++i)
            rows.insert(rows.end(),
                        {wall.points[i].x, wall.points[i].y, wall.spacings[i], wall.units[i], wall.thicknesses[i]});
    vtu.add_array<std::int64_t>(
        wall_sizes_array, walls.size(), 1,
        [walls](std::size_t i) { return static_cast<std::int64_t>(walls[i].points.size()); }, in_field_data);
    vtu.add_array<double>(
        wall_rows_array, rows.size() / numbers_of_wall_row, numbers_of_wall_row,
        [rows](std::size_t i) { return rows[i]; }, in_field_data);
}

}  // namespace

std::string vtu_head(bool compressed) {
    return fmt::format(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"{}>\n"
        "  <UnstructuredGrid>\n",
        compressed ? " compressor=\"vtkZLibDataCompressor\"" : "");
}

void add_vtu_field_data(std::span<const Marker> markers, std::span<const Segment> constraints, const SizedMesh* sizes,
                        VtuWriter& vtu) {
    std::string names;
    for (const Marker& marker : markers) names += marker.name + '\0';
    vtu.xml += "    <FieldData>\n";
    constexpr bool in_field_data = true;
    vtu.add_array<std::uint8_t>(
        "marker_names", names.size(), 1, [names](std::size_t i) { return names[i]; }, in_field_data);
    vtu.add_array<std::uint32_t>(
        "constraints", constraints.size(), 2,
        [constraints](std::size_t i) {
            const Segment& edge = constraints[i / 2];
            return i % 2 == 0 ? edge.a.value : edge.b.value;
        },
        in_field_data);
    vtu.add_array<std::uint8_t>(
        "marker_kinds", markers.size(), 1, [markers](std::size_t i) { return markers[i].kind; }, in_field_data);
    if (sizes != nullptr && sizes->gradation)
        vtu.add_array<double>(
            "lamina_size_gradation", 1, 1, [sizes](std::size_t) { return *sizes->gradation; }, in_field_data);
    if (sizes != nullptr && !sizes->walls.empty()) add_walls(sizes->walls, vtu);
    vtu.xml += "    </FieldData>\n";
}

void write_vtu(const MeshView& mesh, VtuVariant variant, std::ostream& out) {
    const std::vector<double> distances = variant.wall_distance ? wall_distances(mesh) : std::vector<double>{};
    write_grid(mesh, {point_data("wall_distance", distances)}, variant.compressed, out);
}

void write_curved_vtu(const MeshView& mesh, const CurvedNodes& nodes, bool compressed, std::ostream& out) {
    write_grid(mesh, {}, compressed, out, nodes);
}

void write_vtu_part(const MeshView& part, std::span<const VertexId> vertices, std::ostream& out) {
    const auto add_ids = [&](VtuWriter& vtu) {
        vtu.xml += "      <PointData GlobalIds=\"vertex\">\n";
        vtu.add_array<std::int64_t>("vertex", vertices.size(), 1,
                                    [&](std::size_t i) { return std::int64_t{vertices[i].value}; });
        vtu.xml += "      </PointData>\n";
    };
    write_grid(part, {add_ids}, false, out);
}

void write_vtu_solution(const Solution& solution, std::ostream& out) {
    const auto at_points = [&](VtuWriter& vtu) {
        vtu.xml += "      <PointData>\n";
        add_fields(solution.fields, false, solution.mesh.points.size(), vtu);
        vtu.xml += "      </PointData>\n";
    };
    const std::size_t cells = VtuCells(solution.mesh).count();
    const auto at_cells = [&](VtuWriter& vtu) { add_fields(solution.fields, true, cells, vtu); };
    write_grid(solution.mesh, {at_points, at_cells}, true, out);
}

void write_vtu_sizes(const SizedMesh& sizes, std::ostream& out) {
    Mesh mesh;
    mesh.points = sizes.points;
    mesh.triangles = sizes.triangles;
    write_grid(mesh, {point_data("size", sizes.sizes), {}, &sizes}, true, out);
}

}  // namespace lamina::io
