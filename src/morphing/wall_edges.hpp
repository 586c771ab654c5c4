// The edges of the walls between the vertices that wall_vertices() returns.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::morphing {

/// Returns the edges of the markers of kind wall, between places in `walls.vertex`, counter-clockwise round the bodies.
std::vector<Segment> edges_of_walls(const Mesh& mesh, const WallVertices& walls);

}  // namespace lamina::morphing
