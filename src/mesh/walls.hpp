// How evenly the walls of a mesh are divided, and how high the cells on them are.
#pragma once

#include <span>
#include <vector>

#include <lamina/export.hpp>
#include <lamina/mesh.hpp>

#include "mesh/boundary_edges.hpp"

namespace lamina::mesh {

/// Neighbouring wall edges are even where the ratio of their lengths is at most this.
inline constexpr double even_wall_ratio = 1.25;

/// Returns the edges of all markers that may be walls (may_be_wall()), directed with the mesh on their left, sorted.
LAMINA_EXPORT std::vector<Segment> sorted_wall_edges(std::span<const Marker> markers);

/// Measures the walls of a mesh: MeshCheck::walls. `points` holds the vertices of its boundary. The options say how
/// high first cells should be. Precondition: all indices are in range.
WallSummary measure_walls(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, const MeshCheckOptions& options);

}  // namespace lamina::mesh
