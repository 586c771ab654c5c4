#include "mesh/boundary_edges.hpp"

#include <algorithm>

#include "mesh/check_cells.hpp"

namespace lamina::mesh {

std::vector<BoundaryEdge> find_boundary_edges(const MeshView& mesh, std::span<const std::uint32_t> edges_of_one_cell) {
    const CellEdges edges(mesh);
    std::vector<BoundaryEdge> boundary;
    boundary.reserve(edges_of_one_cell.size());
    for (const std::uint32_t e : edges_of_one_cell) {
        const std::size_t cell = edges.cell_of(e);
        BoundaryEdge& edge = boundary.emplace_back(BoundaryEdge{{edges.origin(e), edges.target(e)}});
        edge.in_first_layer =
            mesh.layer.empty() ? !mesh.region.empty() && mesh.region[cell] == Region::layer : mesh.layer[cell] == 1;
        edge.beyond_first_layer = !mesh.layer.empty() && mesh.layer[cell] > 1;
        if (edge.in_first_layer) edge.height = height_over(mesh, edges, e);
    }
    return boundary;
}

std::vector<Segment> sorted_ends(std::span<const BoundaryEdge> edges) {
    std::vector<Segment> ends;
    ends.reserve(edges.size());
    for (const BoundaryEdge& edge : edges) ends.push_back(edge.ends);
    std::sort(ends.begin(), ends.end());
    return ends;
}

bool is_closed(std::span<const Segment> edges) {
    std::vector<VertexId> begins, ends;
    for (const Segment& edge : edges) {
        begins.push_back(edge.a);
        ends.push_back(edge.b);
    }
    std::sort(begins.begin(), begins.end());
    std::sort(ends.begin(), ends.end());
    return begins == ends;
}

}  // namespace lamina::mesh
