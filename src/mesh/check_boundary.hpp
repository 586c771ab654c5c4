// All checks and measurements of a mesh that its boundary decides.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/boundary.hpp"
#include "mesh/boundary_edges.hpp"
#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Checks the markers and, where the mesh is `conforming`, the loops of the boundary and the sums that follow from them;
/// measures the walls. `points` holds the vertices of the boundary and of the markers. `check` holds the area and the
/// Euler characteristic.
void check_whole_boundary(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, bool conforming, const MeshCheckOptions& options,
                          MeshCheck& check, DefectList& defects);

/// Does so for a conforming mesh whose boundary and markers were checked before, without defects. `boundary` holds the
/// edges of its walls and perhaps others.
void check_known_boundary(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, const BoundarySummary& known,
                          const MeshCheckOptions& options, MeshCheck& check, DefectList& defects);

}  // namespace lamina::mesh
