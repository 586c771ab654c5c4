// The cells whose angles no refinement could mend, and the others.
#pragma once

#include <cstdint>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/check_cells.hpp"

namespace lamina::mesh {

/// Returns those of the narrow cells that were found, which are isotropic, that are not exempt: that neither have a
/// corner between two frozen edges that enclose less than 60 degrees, nor are triangles whose shortest edge leads
/// across such a corner of the isotropic region's outline, from one side to the other. Frozen edges are those that the
/// mesh shows: on the boundary, beside the layer or another piece, and constraints. Precondition: `constraints` are
/// those of sorted_constraints().
std::vector<std::uint32_t> find_unexcused(const MeshView& mesh, CheckedCells checked,
                                          const std::vector<Segment>& constraints);

}  // namespace lamina::mesh
