// Checks of the arrays of a mesh. What passes them may be indexed and computed with without further checks.
#pragma once

#include <lamina/mesh.hpp>

#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Reports meshes without cells, arrays of the wrong length, coordinates outside the exact range and indices out of
/// range.
void check_arrays(const MeshView& mesh, DefectList& defects);

}  // namespace lamina::mesh
