// The sources of the size field that stand for a background mesh.
#pragma once

#include <vector>

#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// Returns points with the sizes of the mesh: its vertices, and as many points between them as it takes. Inside every
/// triangle, as far as it lies in the domain, size + gradation x distance of some point is within a tenth of the linear
/// interpolation. There are about as many points as vertices and requested triangles together, or fewer. Throws
/// OptionError where they are more than 32-bit numbers can count, or where the mesh is not well formed.
std::vector<SizeSource> background_sources(const SizedMesh& mesh, double gradation, const Box& domain);

}  // namespace lamina::sizing
