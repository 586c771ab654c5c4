// Checks of the markers of a mesh.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/defects.hpp"

namespace lamina::mesh {

/// Reports boundary edges that are in no marker or in several, marker edges that are not on the boundary or directed
/// the wrong way, markers of the same name, and periodic markers that are no exact copies of each other. `boundary` are the edges of the boundary, directed with the mesh on
/// their left, sorted; `points` holds their vertices and those of the markers.
void check_markers(std::span<const Point> points, std::span<const Marker> markers, const std::vector<Segment>& boundary,
                   DefectList& defects);

}  // namespace lamina::mesh
