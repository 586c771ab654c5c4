// Checks of the markers of a mesh.
#pragma once

#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/adjacency.hpp"
#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Returns the edges of the boundary, directed with the mesh on their left, sorted.
std::vector<Segment> boundary_edges(const Mesh& mesh, const Adjacency& adjacency);

/// Reports boundary edges that are in no marker or in several, marker edges that are not on the boundary or directed
/// the wrong way, and markers of the same name. `boundary` are the edges of boundary_edges().
void check_markers(const Mesh& mesh, const std::vector<Segment>& boundary, DefectList& defects);

}  // namespace lamina::mesh
