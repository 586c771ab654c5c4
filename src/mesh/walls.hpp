// How evenly the walls of a mesh are divided, and how high the cells on them are.
#pragma once

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::mesh {

/// Measures the walls of a mesh: MeshCheck::walls. `first_height` is the height that first cells should have; empty:
/// their median. Precondition: all indices are in range.
WallSummary measure_walls(const Mesh& mesh, const Adjacency& adjacency, std::optional<double> first_height);

}  // namespace lamina::mesh
