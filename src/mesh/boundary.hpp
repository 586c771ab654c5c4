// The boundary of a mesh as loops of edges.
#pragma once

#include <span>
#include <vector>

#include <lamina/mesh.hpp>

#include "mesh/defects.hpp"

namespace lamina::mesh {

struct BoundarySummary {
    std::size_t loops = 0;
    std::size_t outer_loops = 0;  ///< counter-clockwise ones
    double area = 0;              ///< signed, of all loops
    double area_magnitude = 0;    ///< sum of the magnitudes that were added: scales the rounding of `area`
    DefectList defects;
};

/// Traces the loops and proves that they bound a domain covered once: no vertex on two loops or twice on one, no two
/// edges that touch but at a common end, and winding number 0 or 1 everywhere. Cells that are counter-clockwise and
/// conforming then cover the domain exactly once: the number of cells over a point is the winding number of the
/// boundary round it.
/// Precondition: the edges are those of conforming cells that have one cell, directed with the mesh on their left.
BoundarySummary check_boundary(std::span<const Point> points, std::vector<Segment> edges);

}  // namespace lamina::mesh
