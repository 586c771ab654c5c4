// Distances to the walls.
#pragma once

#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

namespace lamina::mesh {

/// Returns the distance of each point to the nearest edge of a marker of kind wall; infinite where there is none.
LAMINA_EXPORT std::vector<double> wall_distances(const Mesh& mesh);

}  // namespace lamina::mesh
