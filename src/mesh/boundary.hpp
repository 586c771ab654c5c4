// The boundary of a mesh as loops of edges.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/check_markers.hpp"
#include "mesh/defects.hpp"

namespace lamina::mesh {

struct BoundarySummary {
    std::size_t loops = 0;
    std::size_t outer_loops = 0;  ///< the counter-clockwise ones
    double area = 0;              ///< signed area, summed over all loops
    double area_magnitude = 0;    ///< sum of the magnitudes of the terms of `area`: the scale of its rounding error
    DefectList defects;
};

/// Traces the loops and proves that they bound a domain that is covered once: no vertex is on two loops or twice on
/// one, no two edges touch but at a common end, and the winding number is 0 or 1 everywhere. Counter-clockwise,
/// conforming cells then cover the domain exactly once, because the number of cells over a point is the winding number
/// of the boundary round it. Edges of a wall without thickness, sorted in `slits`, may lie at the same place as their
/// twins. Precondition: `edges` are the edges that one cell alone has, in a conforming mesh, directed with the mesh on
/// their left.
BoundarySummary check_boundary(std::span<const Point> points, std::vector<Segment> edges,
                               std::span<const SlitEdge> slits = {});

}  // namespace lamina::mesh
