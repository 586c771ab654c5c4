// What a background mesh asks for, as sources of the size field.
#pragma once

#include <span>
#include <vector>

#include <lamina/sizing.hpp>

namespace lamina::sizing {

/// Points with the sizes of the mesh: its vertices, and as many between them that inside every triangle, as far as it
/// lies in the domain, size + gradation x distance of some point is within a tenth of the linear interpolation. They
/// are at most about as many as the triangles that the sizes ask for, and the vertices. Throws UsageError where these
/// are more than 32-bit numbers can count, or the mesh is not well formed.
std::vector<SizeSource> background_sources(const SizedMesh& mesh, double gradation, const Box& domain);

/// Returns the sources that ask for edges of the loops shorter than they are, or nearly so, in the order of the edges
/// that they are nearest to. A source allows an edge the length share x size + gradation x distance.
std::vector<SizeSource> binding_sources(std::span<const SizeSource> sources, Loops loops, double gradation,
                                        double share);

}  // namespace lamina::sizing
