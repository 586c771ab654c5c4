// Counts the edges of the isotropic region that violate the Delaunay property.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/mesh.hpp>
#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/defects.hpp"

namespace lamina::mesh {

struct DelaunayCount {
    std::size_t edges = 0;       ///< edges between two isotropic triangles
    std::size_t violations = 0;  ///< those with a vertex strictly inside the circle of the opposite triangle
};

/// Returns whether d lies strictly inside the circle of the counter-clockwise triangle a, b, c. Exact.
inline bool is_strictly_in_circle(Point a, Point b, Point c, Point d) {
    const core::RoundedIncircle rounded = core::rounded_incircle(a, b, c, d);
    return (rounded.certain() ? rounded.det : incircle(a, b, c, d)) > 0;
}

/// Returns whether the vertex opposite to `twin` lies strictly inside the circle of the triangle that has `edge`.
/// Precondition: both are edges of triangles.
inline bool violates_delaunay(const MeshView& mesh, std::size_t edge, std::size_t twin) {
    const VertexId* v = mesh.triangles[edge / 3].v;
    const VertexId opposite = mesh.triangles[twin / 3].v[(twin + 2) % 3];
    return is_strictly_in_circle(mesh.points[v[0].index()], mesh.points[v[1].index()], mesh.points[v[2].index()],
                                 mesh.points[opposite.index()]);
}

/// Returns the constraints of the mesh and the edges of its internal markers, each once and with its smaller vertex
/// first, sorted.
std::vector<Segment> sorted_constraints(const MeshView& mesh);

/// Takes the constraints between isotropic triangles out of a count of all interior edges: they are few, so this is
/// cheaper than to look up each edge. Reports constraints that are no edges of the mesh.
void subtract_constraints(const MeshView& mesh, const std::vector<Segment>& constraints, DelaunayCount& count,
                          DefectList& defects);

}  // namespace lamina::mesh
