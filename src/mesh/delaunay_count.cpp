#include "mesh/delaunay_count.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "mesh/cell_text.hpp"
#include "mesh/check_markers.hpp"
#include "mesh/isotropic_cells.hpp"

namespace lamina::mesh {

std::vector<Segment> sorted_constraints(const MeshView& mesh) {
    std::vector<Segment> constraints = internal_edges(mesh.markers);
    constraints.insert(constraints.end(), mesh.constraints.begin(), mesh.constraints.end());
    for (Segment& edge : constraints)
        if (edge.b < edge.a) std::swap(edge.a, edge.b);
    std::sort(constraints.begin(), constraints.end());
    constraints.erase(std::unique(constraints.begin(), constraints.end()), constraints.end());
    return constraints;
}

void subtract_constraints(const MeshView& mesh, const std::vector<Segment>& constraints, DelaunayCount& count,
                          DefectList& defects) {
    const CellEdges edges(mesh);
    const std::vector<EdgePair> pairs = find_pairs(mesh, constraints);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        const Segment& constraint = constraints[i];
        const auto [edge, twin] = pairs[i];
        if (edge == no_edge) {
            defects.add([&] {
                return MeshDefect{fmt::format("constraint {} is no edge of the mesh", edge_text(constraint)),
                                  mesh.points[constraint.a.index()]};
            });
            continue;
        }
        if (twin == no_edge) continue;
        if (!is_isotropic_triangle(mesh, edges.cell_of(edge)) || !is_isotropic_triangle(mesh, edges.cell_of(twin)))
            continue;
        --count.edges;
        count.violations -= violates_delaunay(mesh, edge, twin);
    }
}

}  // namespace lamina::mesh
