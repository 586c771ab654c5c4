// Writes the table of the wall vertices as CSV.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::io {

namespace {

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The edges of the walls, which are found by their ends.
struct WallEdges {
    explicit WallEdges(const Mesh& mesh) : after(mesh.points.size(), none), before(mesh.points.size(), none) {
        for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
            if (mesh.markers[m].kind != MarkerKind::wall) continue;
            for (const Segment& edge : mesh.markers[m].edges) {
                // A marker edge has the mesh on its left; in the order of the outline it runs from b to a.
                after[edge.b.index()] = before[edge.a.index()] = static_cast<std::uint32_t>(edges.size());
                edges.push_back({edge.b, edge.a});
                marker.push_back(m);
            }
        }
    }
    std::vector<Segment> edges;         ///< counter-clockwise round the bodies
    std::vector<std::size_t> marker;    ///< per edge: its marker
    std::vector<std::uint32_t> after;   ///< per vertex: the edge that begins there, or none
    std::vector<std::uint32_t> before;  ///< per vertex: the edge that ends there, or none
};

/// Makes the table: one row for each wall vertex, wall by wall.
class WallTable {
public:
    explicit WallTable(const Mesh& mesh)
        : mesh_(mesh),
          walls_(mesh),
          cells_(mesh),
          cell_edges_(mesh::find_edges(mesh, walls_.edges)),
          done_(mesh.points.size(), false) {
        // Walls with ends start at an end, closed ones at their first vertex.
        for (std::size_t v = 0; v < mesh.points.size(); ++v)
            if (walls_.after[v] != none && walls_.before[v] == none) add_wall(v);
        for (std::size_t v = 0; v < mesh.points.size(); ++v)
            if (walls_.after[v] != none && !done_[v]) add_wall(v);
    }

    std::string take_text() { return std::move(text_); }

private:
    /// Adds the rows of the wall that starts at this vertex.
    void add_wall(std::size_t v) {
        for (double arc_length = 0; !done_[v];) {
            add_row(v, arc_length);
            if (walls_.after[v] == none) return;
            const std::size_t next = walls_.edges[walls_.after[v]].b.index();
            arc_length += distance(mesh_.points[v], mesh_.points[next]);
            v = next;
        }
    }
    void add_row(std::size_t v, double arc_length) {
        done_[v] = true;
        const std::uint32_t edge_before = walls_.before[v], edge_after = walls_.after[v];
        Point normal{0, 0};
        double height = HUGE_VAL;
        for (const std::uint32_t e : {edge_before, edge_after}) {
            if (e == none) continue;
            normal = normal + outward_normal(e);
            height = std::min(height, cell_height(e));
        }
        // At a cusp the two normals cancel; the normal then is the direction of the edge before.
        if (squared_length(normal) < 1e-20 && edge_before != none)
            normal = -perpendicular(-outward_normal(edge_before));
        normal = unit(normal);
        const std::string& name = mesh_.markers[walls_.marker[edge_after != none ? edge_after : edge_before]].name;
        text_ += fmt::format("{},{},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e}\n", name, v, mesh_.points[v].x,
                             mesh_.points[v].y, arc_length, normal.x, normal.y, height);
    }
    Point outward_normal(std::uint32_t e) const {
        const Segment edge = walls_.edges[e];
        return unit(-perpendicular(mesh_.points[edge.b.index()] - mesh_.points[edge.a.index()]));
    }
    /// Returns the height above a wall edge of the lowest vertex of the cell on it; infinite where there is no cell.
    double cell_height(std::uint32_t e) const {
        const Segment edge = walls_.edges[e];
        const Point a = mesh_.points[edge.a.index()], b = mesh_.points[edge.b.index()];
        double height = HUGE_VAL;
        if (cell_edges_[e] == mesh::no_edge) return height;
        const std::size_t cell = cells_.cell_of(cell_edges_[e]);
        for (std::size_t k = 0; k < cells_.corners(cell); ++k) {
            const VertexId v = cells_.corner(cell, k);
            if (v == edge.a || v == edge.b) continue;
            height = std::min(height, std::abs(cross(b - a, mesh_.points[v.index()] - a)) / distance(a, b));
        }
        return height;
    }

    const Mesh& mesh_;
    WallEdges walls_;
    mesh::CellEdges cells_;
    std::vector<std::uint32_t> cell_edges_;  ///< per wall edge: the edge of the cell on it
    std::vector<bool> done_;                 ///< per vertex: whether it has a row
    std::string text_ = "marker,vertex,x,y,arc_length,normal_x,normal_y,first_height\n";
};

}  // namespace

}  // namespace lamina::io

namespace lamina {

using namespace io;

void write_wall_data(const Mesh& mesh, const std::filesystem::path& file) {
    const std::string text = WallTable(mesh).take_text();
    core::write_stream_atomically(file, [&](std::ostream& out) { out << text; });
}

}  // namespace lamina
