// Counts the cells whose angles no refinement could mend.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"

namespace lamina::mesh {

/// Returns how many of `cells`, which are isotropic, have a corner between two frozen edges that enclose less than 60
/// degrees. Frozen edges are those that the mesh shows: on the boundary, beside the layer or another piece, and
/// constraints. Precondition: `constraints` are those of sorted_constraints().
std::size_t count_exempt(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints,
                         const std::vector<std::uint32_t>& cells);

}  // namespace lamina::mesh
