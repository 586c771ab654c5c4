// All checks and measurements of a mesh that its boundary decides.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/boundary.hpp"
#include "mesh/boundary_edges.hpp"
#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Checks the markers and, where the mesh is `conforming`, the loops of the boundary and the sums that follow from
/// them. `points` holds the vertices of the boundary and of the markers. `check` holds the area and the Euler
/// characteristic.
void check_whole_boundary(std::span<const Point> points, std::span<const Marker> markers,
                          std::span<const BoundaryEdge> boundary, bool conforming, MeshCheck& check,
                          DefectList& defects);

/// Measures the walls, of which `boundary` holds all edges.
void measure_boundary(std::span<const Point> points, std::span<const Marker> markers,
                      std::span<const BoundaryEdge> boundary, const MeshCheckOptions& options, MeshCheck& check);

/// Does the rest for a conforming mesh whose boundary and markers were checked before, without defects.
void take_checked_boundary(const BoundarySummary& boundary, MeshCheck& check, DefectList& defects);

}  // namespace lamina::mesh
