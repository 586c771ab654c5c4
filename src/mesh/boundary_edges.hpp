// The edges on the boundary of a mesh, with what is known of the cells behind them.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::mesh {

/// A directed edge that one cell alone has, with the mesh on its left.
struct BoundaryEdge {
    Segment ends;
    bool in_first_layer = false;      ///< whether the cell belongs to the first layer
    bool beyond_first_layer = false;  ///< whether it reaches beyond it
    double height = 0;                ///< of the cell over the edge; of cells in the first layer alone
};

/// Returns the edges that one cell alone has, in the order in which they are given: Adjacency::boundary.
std::vector<BoundaryEdge> find_boundary_edges(const MeshView& mesh, std::span<const std::uint32_t> edges_of_one_cell);

/// Returns their ends, sorted.
std::vector<Segment> sorted_ends(std::span<const BoundaryEdge> edges);

/// Returns whether as many of these edges begin at each vertex as end there.
bool is_closed(std::span<const Segment> edges);

}  // namespace lamina::mesh
