#include "io/curved_lists.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "io/mesh_parts.hpp"
#include "mesh/cell_lattice.hpp"

namespace lamina::io {

namespace {

template <class F>
void for_each_list_of_nodes(CurvedNodes& nodes, F&& f) {
    for (auto* list : {&nodes.triangle_nodes, &nodes.quad_nodes, &nodes.marker_nodes}) f(*list);
}

template <class F>
void for_each_corner(Mesh& mesh, F&& f) {
    for (Triangle& triangle : mesh.triangles) std::for_each(triangle.v, triangle.v + 3, f);
    for (Quad& quad : mesh.quads) std::for_each(quad.v, quad.v + 4, f);
    const auto of_edge = [&](Segment& edge) {
        f(edge.a);
        f(edge.b);
    };
    for (Marker& marker : mesh.markers) std::for_each(marker.edges.begin(), marker.edges.end(), of_edge);
    std::for_each(mesh.constraints.begin(), mesh.constraints.end(), of_edge);
}

/// Does what orient_markers() does, and turns the nodes of an edge with it.
void orient_curved_markers(CurvedMesh& curved) {
    const std::vector<Marker> before = curved.mesh.markers;
    orient_markers(curved.mesh);
    const std::ptrdiff_t of_edge = static_cast<std::ptrdiff_t>(curved.nodes.order) - 1;
    auto nodes = curved.nodes.marker_nodes.begin();
    for (std::size_t m = 0; m < before.size(); ++m)
        for (std::size_t i = 0; i < before[m].edges.size(); ++i, nodes += of_edge)
            if (curved.mesh.markers[m].edges[i] != before[m].edges[i]) std::reverse(nodes, nodes + of_edge);
}

}  // namespace

unsigned order_of_cell(unsigned corners, std::size_t nodes) {
    for (unsigned order = 1; order <= max_cell_order; ++order)
        if (mesh::nodes_of_cell(corners, order) == nodes) return order;
    return 0;
}

std::string curved_cells_refused(unsigned order) {
    return fmt::format("cells of order {}: curved ones are for 'lamina check', 'convert', 'plot' and 'view'", order);
}

bool orient_and_separate(CurvedMesh& curved) {
    if (curved.nodes.order <= 1) {
        orient_markers(curved.mesh);
        return true;
    }
    orient_curved_markers(curved);
    return separate_nodes(curved);
}

bool separate_nodes(CurvedMesh& curved) {
    const std::vector<Point> points = std::exchange(curved.mesh.points, {});
    std::vector<bool> is_node(points.size());
    for_each_list_of_nodes(curved.nodes, [&](const std::vector<VertexId>& list) {
        for (const VertexId v : list) is_node[v.index()] = true;
    });
    std::vector<VertexId> number(points.size());
    const auto vertex_count = static_cast<std::size_t>(std::count(is_node.begin(), is_node.end(), false));
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<Point>& target = is_node[i] ? curved.nodes.points : curved.mesh.points;
        number[i] = VertexId((is_node[i] ? vertex_count : 0) + target.size());
        target.push_back(points[i]);
    }
    bool is_apart = true;
    for_each_corner(curved.mesh, [&](VertexId& v) {
        is_apart = is_apart && !is_node[v.index()];
        v = number[v.index()];
    });
    for_each_list_of_nodes(curved.nodes, [&](std::vector<VertexId>& list) {
        for (VertexId& v : list) v = number[v.index()];
    });
    return is_apart;
}

std::vector<std::uint32_t> edges_as_first_met(const MeshView& mesh, const mesh::Adjacency& adjacency) {
    std::vector<std::uint32_t> edges;
    edges.reserve(adjacency.edges);
    for (std::uint32_t e = 0; e < mesh::CellEdges(mesh).size(); ++e)
        if (adjacency.twin[e] == mesh::no_edge || e < adjacency.twin[e]) edges.push_back(e);
    return edges;
}

std::vector<std::size_t> rows_of_nodes(unsigned corners, unsigned order, std::size_t first) {
    const std::span<const mesh::LatticePlace> lattice = mesh::lattice_of_cell(corners, order);
    std::vector<std::size_t> places(lattice.size());
    std::iota(places.begin(), places.end(), std::size_t{0});
    std::sort(places.begin() + static_cast<std::ptrdiff_t>(first), places.end(), [&](std::size_t a, std::size_t b) {
        return std::pair(lattice[a].j, lattice[a].i) < std::pair(lattice[b].j, lattice[b].i);
    });
    return places;
}

std::vector<std::size_t> vtk_order_of_quad(unsigned order) {
    std::vector<std::size_t> places = rows_of_nodes(4, order, std::size_t{4} * order);
    const std::ptrdiff_t between = static_cast<std::ptrdiff_t>(order) - 1;  // nodes of an edge beside its ends
    const auto begin = places.begin() + 4 + 2 * between;
    std::reverse(begin, begin + between);
    std::reverse(begin + between, begin + 2 * between);
    return places;
}

}  // namespace lamina::io
