// Neighbours in a mesh: which cells meet at which edge.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "core/uninitialized.hpp"

namespace lamina::mesh {

/// Numbers the cells of a mesh and their directed edges. Cells are the triangles, then the quads. Triangle t of T has
/// the edges 3t, 3t+1, 3t+2; quad q has the edges 3T+4q ... 3T+4q+3. Edge i of a cell goes from the cell's vertex i to
/// the next one and has the cell on its left.
class CellEdges {
public:
    /// The arrays of the mesh must outlive this object.
    explicit CellEdges(const MeshView& mesh) : mesh_(mesh), triangle_edges_(3 * mesh.triangles.size()) {}

    /// Returns the number of directed edges.
    std::size_t size() const { return triangle_edges_ + 4 * mesh_.quads.size(); }
    std::size_t cells() const { return mesh_.triangles.size() + mesh_.quads.size(); }
    /// Returns the number of corners of a cell: 3 or 4.
    std::size_t corners(std::size_t cell) const { return cell < mesh_.triangles.size() ? 3 : 4; }
    /// Returns the first edge of a cell; for cell = cells(), the number of edges.
    std::size_t first(std::size_t cell) const {
        return cell < mesh_.triangles.size() ? 3 * cell : 4 * cell - mesh_.triangles.size();
    }
    std::size_t cell_of(std::size_t edge) const {
        return edge < triangle_edges_ ? edge / 3 : mesh_.triangles.size() + (edge - triangle_edges_) / 4;
    }
    /// Returns vertex i of a cell.
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
    MeshView mesh_;
    std::size_t triangle_edges_;
};

inline constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();

/// Number of cells that a thread takes at a time. Their data stays in the second-level cache.
inline constexpr std::size_t cells_per_block = 1 << 13;

/// The neighbours of all cells. Edges are numbered by CellEdges.
struct Adjacency {
    /// Per directed edge: the opposite edge of the neighbour, or no_edge.
    core::UninitializedArray<std::uint32_t> twin;
    std::vector<std::uint32_t> boundary;  ///< directed edges that one cell alone has, ascending
    std::vector<std::uint32_t> overused;  ///< directed edges that share their ends with more than one other edge, or
                                          ///< with one of the same direction; ascending
    std::vector<VertexId> orphans;        ///< vertices of no cell, ascending
    std::size_t edges = 0;                ///< number of undirected edges
};

/// Finds the neighbours of all cells in linear time. Blocks of successive cells match their own edges in parallel,
/// through a small hash table each. Edges whose ends are both shared with other blocks, which are few where successive
/// cells are neighbours, are distributed by hash and matched in the same way. Takes 12 to 14 bytes a triangle.
/// Precondition: all indices are in range. Throws MeshError from 2^32 directed edges on.
LAMINA_EXPORT Adjacency find_adjacency(const MeshView& mesh);

/// The pairs of opposite edges in a list of directed edges, which are numbered by their places in it.
struct EdgePairs {
    core::UninitializedArray<std::uint32_t> twin;   ///< per edge: the opposite edge, or no_edge
    std::vector<std::uint32_t> boundary, overused;  ///< as in Adjacency
    std::size_t edges = 0;                          ///< number of undirected edges
};

/// Finds the pairs in linear time. Throws MeshError from 2^32 - 1 edges on.
LAMINA_EXPORT EdgePairs pair_edges(std::span<const Segment> edges);

/// Two opposite directed edges, numbered by CellEdges; the first has the lower number.
struct EdgePair {
    std::uint32_t edge = no_edge, twin = no_edge;
};

/// Returns for each segment the lowest directed edge between its ends, in either direction, or no_edge, and the twin
/// that find_adjacency() finds for it; takes linear time. Precondition: all indices are in range.
LAMINA_EXPORT std::vector<EdgePair> find_pairs(const MeshView& mesh, std::span<const Segment> segments);

/// Returns the edges alone.
LAMINA_EXPORT std::vector<std::uint32_t> find_edges(const MeshView& mesh, std::span<const Segment> segments);

}  // namespace lamina::mesh
