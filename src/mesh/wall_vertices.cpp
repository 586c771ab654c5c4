// The vertices of the walls in order, with arc lengths, normals and first heights.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::mesh {

namespace {

constexpr std::uint32_t no_wall_edge = std::numeric_limits<std::uint32_t>::max();

/// The edges of the walls, which are found by their ends.
struct WallEdgesByEnd {
    explicit WallEdgesByEnd(const Mesh& mesh)
        : after(mesh.points.size(), no_wall_edge), before(mesh.points.size(), no_wall_edge) {
        for (std::size_t m = 0; m < mesh.markers.size(); ++m) {
            if (mesh.markers[m].kind != MarkerKind::wall) continue;
            for (const Segment& edge : mesh.markers[m].edges) {
                // A marker edge has the mesh on its left; in the order of the outline it runs from b to a.
                after[edge.b.index()] = before[edge.a.index()] = static_cast<std::uint32_t>(edges.size());
                edges.push_back({edge.b, edge.a});
                marker.push_back(static_cast<std::uint32_t>(m));
            }
        }
    }
    std::vector<Segment> edges;         ///< counter-clockwise round the bodies
    std::vector<std::uint32_t> marker;  ///< per edge: its marker
    std::vector<std::uint32_t> after;   ///< per vertex: the edge that begins there, or no_wall_edge
    std::vector<std::uint32_t> before;  ///< per vertex: the edge that ends there, or no_wall_edge
};

/// Collects the vertices, wall by wall.
class WallWalk {
public:
    explicit WallWalk(const Mesh& mesh)
        : mesh_(mesh),
          walls_(mesh),
          cells_(mesh),
          cell_edges_(find_edges(mesh, walls_.edges)),
          done_(mesh.points.size(), false) {
        // Walls with ends start at an end, closed ones at their first vertex.
        for (std::size_t v = 0; v < mesh.points.size(); ++v)
            if (walls_.after[v] != no_wall_edge && walls_.before[v] == no_wall_edge) add_wall(v);
        for (std::size_t v = 0; v < mesh.points.size(); ++v)
            if (walls_.after[v] != no_wall_edge && !done_[v]) add_wall(v);
        found_.body_first.push_back(found_.vertex.size());
    }

    WallVertices take() { return std::move(found_); }

private:
    void add_wall(std::size_t v) {
        found_.body_first.push_back(found_.vertex.size());
        for (double arc_length = 0; !done_[v];) {
            add_vertex(v, arc_length);
            if (walls_.after[v] == no_wall_edge) return;
            const std::size_t next = walls_.edges[walls_.after[v]].b.index();
            arc_length += distance(mesh_.points[v], mesh_.points[next]);
            v = next;
        }
    }
    void add_vertex(std::size_t v, double arc_length) {
        done_[v] = true;
        const std::uint32_t edge_before = walls_.before[v], edge_after = walls_.after[v];
        Point normal{0, 0};
        double height = HUGE_VAL;
        for (const std::uint32_t e : {edge_before, edge_after}) {
            if (e == no_wall_edge) continue;
            normal = normal + outward_normal(e);
            height = std::min(height, cell_height(e));
        }
        // At a cusp the two normals cancel; the normal then is the direction of the edge before.
        if (squared_length(normal) < 1e-20 && edge_before != no_wall_edge)
            normal = -perpendicular(-outward_normal(edge_before));
        found_.vertex.emplace_back(v);
        found_.marker.push_back(walls_.marker[edge_after != no_wall_edge ? edge_after : edge_before]);
        found_.arc_length.push_back(arc_length);
        found_.normal.push_back(unit(normal));
        found_.first_height.push_back(height);
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
        if (cell_edges_[e] == no_edge) return height;
        const std::size_t cell = cells_.cell_of(cell_edges_[e]);
        for (std::size_t k = 0; k < cells_.corners(cell); ++k) {
            const VertexId v = cells_.corner(cell, k);
            if (v == edge.a || v == edge.b) continue;
            height = std::min(height, std::abs(cross(b - a, mesh_.points[v.index()] - a)) / distance(a, b));
        }
        return height;
    }

    const Mesh& mesh_;
    WallEdgesByEnd walls_;
    CellEdges cells_;
    std::vector<std::uint32_t> cell_edges_;  ///< per wall edge: the edge of the cell on it
    std::vector<bool> done_;                 ///< per vertex: whether it has been added
    WallVertices found_;
};

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

WallVertices wall_vertices(const Mesh& mesh) { return mesh::WallWalk(mesh).take(); }

}  // namespace lamina
