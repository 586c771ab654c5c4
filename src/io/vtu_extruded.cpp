// Writes VTK XML unstructured grids in space (extrusion.hpp), for ParaView and programs that read VTK's files.
//
//   cells        wedges, hexahedra, the quads of the markers, then the triangles and quads in the first plane and
//                those in the last one
//   cell data    marker (0 in the volume, 1 on the first marker ...; the planes follow the markers), and region where
//                the mesh has it (0 layer, 1 isotropic, 2 on markers and planes)
//   field data   marker_names and marker_kinds, as in plane files
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "io/formats.hpp"
#include "io/vtk_cell_types.hpp"
#include "io/vtu_writer.hpp"

namespace lamina::io {

namespace {

/// Cells of one type and one marker, which stand in a row in the file.
struct CellRow {
    VtkCellType type;
    std::size_t corners, count;
    std::uint32_t marker = 0;
};

class ExtrudedCells {
public:
    ExtrudedCells(const MeshView& mesh, const Extrusion& extrusion) : mesh_(mesh), extrusion_(extrusion) {
        const std::size_t triangles = mesh.triangles.size(), quads = mesh.quads.size();
        add({vtk_wedge, 6, extrusion.cells * triangles});
        add({vtk_hexahedron, 8, extrusion.cells * quads});
        std::uint32_t number = 0;
        for (const Marker& marker : mesh.markers) add({vtk_quad, 4, extrusion.cells * marker.edges.size(), ++number});
        for (int plane = 0; plane < 2; ++plane) {
            add({vtk_triangle, 3, triangles, ++number});
            add({vtk_quad, 4, quads, number});
        }
    }

    std::size_t count() const { return first_cell_.back(); }
    std::size_t corners() const { return first_corner_.back(); }
    VtkCellType type(std::size_t cell) const { return rows_[row_of(first_cell_, cell)].type; }
    std::uint32_t marker(std::size_t cell) const { return rows_[row_of(first_cell_, cell)].marker; }
    /// Returns the number of corners of the cell and of all cells before it.
    std::size_t offset(std::size_t cell) const {
        const std::size_t row = row_of(first_cell_, cell);
        return first_corner_[row] + (cell + 1 - first_cell_[row]) * rows_[row].corners;
    }
    /// Returns the node at a place in the list of the corners of all cells.
    std::size_t node(std::size_t place) const {
        const std::size_t row = row_of(first_corner_, place), corners = rows_[row].corners;
        const std::size_t cell = (place - first_corner_[row]) / corners, k = (place - first_corner_[row]) % corners;
        const std::size_t markers = mesh_.markers.size(), n = mesh_.points.size();
        if (row < 2) {
            const std::size_t cells = row == 0 ? mesh_.triangles.size() : mesh_.quads.size();
            const bool upper = k >= corners / 2;
            return (cell / cells + (upper ? 1 : 0)) * n + vertex(row == 0, cell % cells, k % (corners / 2));
        }
        if (row < 2 + markers) {
            const std::vector<Segment>& edges = mesh_.markers[row - 2].edges;
            const Segment& edge = edges[cell % edges.size()];
            const VertexId v = k == 0 || k == 3 ? edge.a : edge.b;
            return (cell / edges.size() + (k < 2 ? 0 : 1)) * n + v.index();
        }
        // The normals of faces point out of the volume.
        const bool last = row - 2 - markers >= 2;
        const bool triangle = corners == 3;
        return last ? extrusion_.cells * n + vertex(triangle, cell, k) : vertex(triangle, cell, corners - 1 - k);
    }
    /// Returns the region of a cell, where the mesh has regions.
    std::uint8_t region(std::size_t cell) const {
        constexpr std::uint8_t none = 2;
        const std::size_t row = row_of(first_cell_, cell), triangles = mesh_.triangles.size();
        if (row >= 2) return none;
        const std::size_t i = cell - first_cell_[row];
        return static_cast<std::uint8_t>(mesh_.region[row == 0 ? i % triangles : triangles + i % mesh_.quads.size()]);
    }

private:
    void add(const CellRow& row) {
        rows_.push_back(row);
        first_cell_.push_back(first_cell_.back() + row.count);
        first_corner_.push_back(first_corner_.back() + row.count * row.corners);
    }
    static std::size_t row_of(const std::vector<std::size_t>& firsts, std::size_t i) {
        return static_cast<std::size_t>(std::upper_bound(firsts.begin(), firsts.end(), i) - firsts.begin()) - 1;
    }
    std::size_t vertex(bool triangle, std::size_t cell, std::size_t k) const {
        return triangle ? mesh_.triangles[cell].v[k].index() : mesh_.quads[cell].v[k].index();
    }

    MeshView mesh_;
    const Extrusion& extrusion_;
    std::vector<CellRow> rows_;
    std::vector<std::size_t> first_cell_{0}, first_corner_{0};  ///< per row, and behind the last
};

}  // namespace

void write_vtu_extruded(const MeshView& mesh, const Extrusion& extrusion, bool compressed, std::ostream& out) {
    const ExtrudedCells cells(mesh, extrusion);
    std::vector<Marker> named;
    for (const Marker& marker : mesh.markers) named.push_back({marker.name, marker.kind, {}});
    const MarkerKind kind = extrusion.periodic ? MarkerKind::other : MarkerKind::symmetry;
    for (const char* plane : {first_plane, last_plane}) named.push_back({plane, kind, {}});
    const std::size_t n = mesh.points.size(), nodes = extrusion.planes() * n;

    VtuWriter vtu(compressed);
    vtu.xml = vtu_head(compressed);
    add_vtu_field_data(named, {}, nullptr, vtu);
    vtu.xml +=
        fmt::format("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <CellData>\n", nodes, cells.count());
    if (!mesh.region.empty())
        vtu.add_array<std::uint8_t>("region", cells.count(), 1, [&](std::size_t i) { return cells.region(i); });
    vtu.add_array<std::uint32_t>("marker", cells.count(), 1, [&](std::size_t i) { return cells.marker(i); });
    vtu.xml += "      </CellData>\n      <Points>\n";
    vtu.add_array<double>("Points", nodes, 3, [&](std::size_t i) {
        const Point p = mesh.points[i / 3 % n];
        return i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : extrusion.height(i / 3 / n);
    });
    vtu.xml += "      </Points>\n      <Cells>\n";
    vtu.add_array<std::int64_t>("connectivity", cells.corners(), 1, [&](std::size_t i) { return cells.node(i); });
    vtu.add_array<std::int64_t>("offsets", cells.count(), 1, [&](std::size_t i) { return cells.offset(i); });
    vtu.add_array<std::uint8_t>("types", cells.count(), 1, [&](std::size_t i) { return cells.type(i); });
    vtu.xml += "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n";
    vtu.write(out);
}

}  // namespace lamina::io
