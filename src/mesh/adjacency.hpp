// Which cells meet at which edge.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::detail {

/// Numbers the directed edges of the cells: triangle t owns 3t, 3t+1, 3t+2, then quad q owns 3T+4q ... 3T+4q+3.
/// Edge i of a cell goes from its vertex i to the next one, the cell on its left. Cells: triangles, then quads.
class CellEdges {
public:
    explicit CellEdges(const Mesh& mesh) : mesh_(mesh), triangle_edges_(3 * mesh.triangles.size()) {}

    std::size_t size() const { return triangle_edges_ + 4 * mesh_.quads.size(); }
    std::size_t cells() const { return mesh_.triangles.size() + mesh_.quads.size(); }
    std::size_t corners(std::size_t cell) const { return cell < mesh_.triangles.size() ? 3 : 4; }
    std::size_t first(std::size_t cell) const {
        return cell < mesh_.triangles.size() ? 3 * cell : 4 * cell - mesh_.triangles.size();
    }
    std::size_t cell_of(std::size_t edge) const {
        return edge < triangle_edges_ ? edge / 3 : mesh_.triangles.size() + (edge - triangle_edges_) / 4;
    }
    /// Vertex i of a cell.
    VertexId corner(std::size_t cell, std::size_t i) const {
        return cell < mesh_.triangles.size() ? mesh_.triangles[cell].v[i]
                                             : mesh_.quads[cell - mesh_.triangles.size()].v[i];
    }
    VertexId origin(std::size_t edge) const {
        const std::size_t cell = cell_of(edge);
        return corner(cell, edge - first(cell));
    }
    VertexId target(std::size_t edge) const {
        const std::size_t cell = cell_of(edge);
        const std::size_t i = edge - first(cell) + 1;
        return corner(cell, i == corners(cell) ? 0 : i);
    }

private:
    const Mesh& mesh_;
    std::size_t triangle_edges_;
};

inline constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();

struct Adjacency {
    std::vector<std::uint32_t> twin;      ///< for each directed edge the opposite one, or no_edge
    std::vector<std::uint32_t> boundary;  ///< directed edges on one cell alone, ascending
    std::vector<std::uint32_t> overused;  ///< directed edges that meet others than their one twin, ascending
    std::vector<VertexId> orphans;        ///< vertices of no cell, ascending
    std::size_t edges = 0;                ///< undirected

    /// One of the directed edges between a and b (a < b), or no_edge.
    std::uint32_t find(VertexId a, VertexId b) const;

    // Directed edges by their smaller vertex: entries [start[v], start[v+1]), each greater vertex << 32 | edge << 1 |
    // (1 where the edge goes from the greater to the smaller), ascending.
    std::vector<std::uint32_t> start;
    std::vector<std::uint64_t> entries;
};

/// Linear time but for the sorting of each vertex's own few edges; 20 bytes a directed edge.
/// Precondition: all indices in range. Throws MeshError above 2^31 directed edges.
Adjacency find_adjacency(const Mesh& mesh);

}  // namespace lamina::detail
