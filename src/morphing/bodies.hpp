// The walls of a mesh as edges and as closed bodies, by their places among the vertices that wall_vertices() returns.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/mesh.hpp>
#include <lamina/morph.hpp>

namespace lamina::morphing {

/// Returns the edges of the markers of kind wall, between places in `walls.vertex`, counter-clockwise round the bodies.
std::vector<Segment> edges_of_walls(const Mesh& mesh, const WallVertices& walls);

/// A closed body of a mesh: places in MorphMap::walls(), counter-clockwise.
struct Body {
    std::size_t first, count;
    std::string name;  ///< of the marker of its first edge
};

std::vector<Body> closed_bodies(const MorphMap& map);

/// Returns the bodies as elements, with their vertices at these places of all wall vertices.
Geometry as_geometry(std::span<const Body> bodies, std::span<const Point> wall);

}  // namespace lamina::morphing
