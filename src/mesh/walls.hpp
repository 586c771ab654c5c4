// How evenly the walls of a mesh are divided, and how high the cells on them are.
#pragma once

#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::mesh {

/// Returns the edges of all markers that may be walls (may_be_wall()), directed with the mesh on their left, sorted.
LAMINA_EXPORT std::vector<Segment> sorted_wall_edges(const Mesh& mesh);

/// Measures the walls of a mesh: MeshCheck::walls. The options say how high first cells should be. Precondition: all
/// indices are in range.
WallSummary measure_walls(const Mesh& mesh, const Adjacency& adjacency, const MeshCheckOptions& options);

}  // namespace lamina::mesh
