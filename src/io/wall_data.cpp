// Tables of the walls, for those who build data sets.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <lamina/io.hpp>

#include "core/atomic_file.hpp"
#include "mesh/adjacency.hpp"

namespace lamina::io {

namespace {

using mesh::CellEdges;
using mesh::no_edge;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

/// The walls' edges, found by their ends.
struct Walls {
    explicit Walls(const Mesh& mesh) : after(mesh.points.size(), none), before(mesh.points.size(), none) {
        for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
            if (mesh.markers[m].kind != MarkerKind::wall) continue;
            for (const Segment& edge : mesh.markers[m].edges) {
                // The mesh is on the left of an edge: in the outline's own order it runs from b to a.
                after[edge.b.index()] = before[edge.a.index()] = static_cast<std::uint32_t>(edges.size());
                edges.push_back({edge.b, edge.a});
                marker.push_back(m);
            }
        }
    }
    std::vector<Segment> edges;         ///< counter-clockwise round the bodies
    std::vector<std::size_t> marker;    ///< of each edge
    std::vector<std::uint32_t> after;   ///< edge that begins at a vertex, or none
    std::vector<std::uint32_t> before;  ///< edge that ends there, or none
};

/// Height of the lowest vertex of the cell with the directed edge e above the wall's edge that it is.
double cell_height(const Mesh& mesh, const mesh::CellEdges& cells, Segment edge, std::uint32_t e) {
    const Point a = mesh.points[edge.a.index()], b = mesh.points[edge.b.index()];
    double height = HUGE_VAL;
    if (e == mesh::no_edge) return height;
    const std::size_t cell = cells.cell_of(e);
    for (std::size_t k = 0; k < cells.corners(cell); ++k) {
        const VertexId v = cells.corner(cell, k);
        if (v == edge.a || v == edge.b) continue;
        height = std::min(height, std::abs(cross(b - a, mesh.points[v.index()] - a)) / distance(a, b));
    }
    return height;
}

}  // namespace

}  // namespace lamina::io

namespace lamina {

using namespace io;

void write_wall_data(const Mesh& mesh, const std::filesystem::path& file) {
    const Walls walls(mesh);
    const mesh::CellEdges cells(mesh);
    const std::vector<std::uint32_t> cell_edges = mesh::find_edges(mesh, walls.edges);
    std::string text = "marker,vertex,x,y,arc_length,normal_x,normal_y,first_height\n";
    std::vector<bool> done(mesh.points.size(), false);

    const auto outward = [&](std::uint32_t e) {
        const Segment edge = walls.edges[e];
        return unit(-perpendicular(mesh.points[edge.b.index()] - mesh.points[edge.a.index()]));
    };
    const auto add_row = [&](std::size_t v, double arc_length) {
        done[v] = true;
        const std::uint32_t in = walls.before[v], out = walls.after[v];
        Point normal{0, 0};
        double height = HUGE_VAL;
        for (const std::uint32_t e : {in, out}) {
            if (e == none) continue;
            normal = normal + outward(e);
            height = std::min(height, cell_height(mesh, cells, walls.edges[e], cell_edges[e]));
        }
        // At a cusp the normals cancel: straight on.
        if (squared_length(normal) < 1e-20 && in != none) normal = -perpendicular(-outward(in));
        normal = unit(normal);
        const std::string& name = mesh.markers[walls.marker[out != none ? out : in]].name;
        text += fmt::format("{},{},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e},{:.16e}\n", name, v, mesh.points[v].x,
                            mesh.points[v].y, arc_length, normal.x, normal.y, height);
    };
    const auto walk = [&](std::size_t v) {
        for (double arc_length = 0; !done[v];) {
            add_row(v, arc_length);
            if (walls.after[v] == none) return;
            const std::size_t next = walls.edges[walls.after[v]].b.index();
            arc_length += distance(mesh.points[v], mesh.points[next]);
            v = next;
        }
    };
    // Walls that end somewhere begin there, closed ones at their first vertex.
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        if (walls.after[v] != none && walls.before[v] == none) walk(v);
    for (std::size_t v = 0; v < mesh.points.size(); ++v)
        if (walls.after[v] != none && !done[v]) walk(v);
    core::write_stream_atomically(file, [&](std::ostream& out) { out << text; });
}

}  // namespace lamina
