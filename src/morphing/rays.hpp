// The rays of the layer: which wall vertex each vertex of the layer stands above, and in which direction.
#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <lamina/mesh.hpp>

namespace lamina::morphing {

inline constexpr std::uint32_t no_ray = std::numeric_limits<std::uint32_t>::max();

/// A straight row of vertices above a wall vertex.
struct Ray {
    std::uint32_t wall;  ///< place of the wall vertex in WallVertices
    /// Where it stands between the normals of the two edges at the wall vertex, from 0 at that of the edge before to 1 at
    /// that of the edge after. The rays of a fan at a corner differ in it.
    double share = 0.5;
};

/// The rays of a mesh.
struct Rays {
    std::vector<Ray> rays;                 ///< first one per wall vertex, which holds that vertex alone
    std::vector<std::uint32_t> of_vertex;  ///< per vertex of the mesh: its ray, or no_ray
};

/// Finds the rays. `edges` are those of edges_of_walls(). A mesh without regions has those that estimate_regions() finds.
Rays find_rays(const Mesh& mesh, const WallVertices& walls, std::span<const Segment> edges);

}  // namespace lamina::morphing
