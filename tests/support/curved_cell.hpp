// One cell with the nodes of a higher order.
#pragma once

#include <lamina/curved_mesh.hpp>

#include "mesh/cell_lattice.hpp"

namespace lamina::test {

/// Returns one straight cell with the nodes of this order, and a marker of its first edge.
inline CurvedMesh one_cell(unsigned corners, unsigned order) {
    CurvedMesh cell;
    cell.mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    if (corners == 3) cell.mesh.points = {{0, 0}, {1, 0}, {0, 1}};
    if (corners == 3)
        cell.mesh.triangles = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}}}};
    else
        cell.mesh.quads = {{{VertexId{0u}, VertexId{1u}, VertexId{2u}, VertexId{3u}}}};
    cell.mesh.markers = {{"wall", MarkerKind::wall, {{VertexId{0u}, VertexId{1u}}}}};
    cell.nodes.order = order;
    const auto lattice = mesh::lattice_of_cell(corners, order);
    for (std::size_t n = corners; n < lattice.size(); ++n) {
        cell.nodes.points.push_back({double(lattice[n].i) / order, double(lattice[n].j) / order});
        (corners == 3 ? cell.nodes.triangle_nodes : cell.nodes.quad_nodes).push_back(VertexId(n));
        if (n < corners + order - 1) cell.nodes.marker_nodes.push_back(VertexId(n));
    }
    return cell;
}

}  // namespace lamina::test
