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
    /// How much of the turn of the edge after the wall vertex it takes, and of that of the edge before the rest: from 0
    /// at the first to 1 at the last ray of a fan.
    double share = 0.5;
    std::uint32_t vertices = 0;  ///< above the wall
    Point kept{};                ///< the vertex, from the wall vertex, up to which all heights are kept
    Point tip{};                 ///< its last vertex, from the wall vertex

    /// Returns by how much a vertex of the ray, as seen from the wall vertex, is beyond the kept ones.
    Point beyond_kept(Point from_wall) const {
        return dot(from_wall - kept, from_wall) > 0 ? from_wall - kept : Point{};
    }
};

/// The number of vertices of each ray that keep their heights however narrow a slot gets.
inline constexpr std::uint32_t kept_layers = 10;

/// The rays of a mesh.
struct Rays {
    std::vector<Ray> rays;                 ///< first one per wall vertex, which holds that vertex alone
    std::vector<std::uint32_t> of_vertex;  ///< per vertex of the mesh: its ray, or no_ray
};

/// Returns, per vertex, whether it is on the boundary, walls included.
std::vector<bool> boundary_vertices(const Mesh& mesh);

/// Finds the rays. `edges` are those of edges_of_walls(). A mesh without regions has those that estimate_regions()
/// finds.
Rays find_rays(const Mesh& mesh, const WallVertices& walls, std::span<const Segment> edges);

}  // namespace lamina::morphing
