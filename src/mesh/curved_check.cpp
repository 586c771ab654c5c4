// check_curved(): whether the lists of nodes fit the mesh, and whether each cell is proved valid.
#include <algorithm>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include <lamina/curved_mesh.hpp>
#include <lamina/predicates.hpp>

#include "mesh/cell_text.hpp"
#include "mesh/curved_nodes.hpp"
#include "mesh/defects.hpp"
#include "mesh/prove_cells.hpp"

namespace lamina::mesh {

namespace {

/// Returns whether all lists have the lengths that the mesh asks for, and no number is out of range.
bool check_lists(const MeshView& mesh, const CurvedNodes& nodes, DefectList& defects) {
    const auto fail = [&](const std::string& what) {
        defects.add([&] { return MeshDefect{what, {}}; });
        return false;
    };
    if (nodes.order < 1 || nodes.order > max_cell_order) return fail(fmt::format("order {}", nodes.order));
    std::size_t edges = 0;
    for (const Marker& marker : mesh.markers) edges += marker.edges.size();
    if (nodes.triangle_nodes.size() != mesh.triangles.size() * (nodes_of_cell(3, nodes.order) - 3) ||
        nodes.quad_nodes.size() != mesh.quads.size() * (nodes_of_cell(4, nodes.order) - 4) ||
        nodes.marker_nodes.size() != edges * (nodes.order - 1))
        return fail("a list of nodes does not have the length that the order of the cells asks for");
    for (const auto* list : {&nodes.triangle_nodes, &nodes.quad_nodes, &nodes.marker_nodes})
        for (const VertexId v : *list)
            if (v.index() < mesh.points.size() || v.index() >= mesh.points.size() + nodes.points.size())
                return fail(fmt::format("node {} is out of range", v.value));
    for (const Point p : nodes.points)
        if (!in_exact_range(p)) return fail("a node with coordinates outside the exact range");
    return true;
}

/// Returns whether the nodes within an edge of a cell are those of `other`, from its end to its begin.
bool are_reversed(std::span<const VertexId> nodes, std::span<const VertexId> other) {
    return std::equal(nodes.begin(), nodes.end(), other.rbegin(), other.rend());
}

/// Reports edges whose two cells, or whose cell and marker, do not have the same nodes.
void check_common_nodes(const MeshView& mesh, const CurvedNodes& nodes, DefectList& defects) {
    const CellEdges cells(mesh);
    const std::size_t within = nodes.order - 1;
    const auto nodes_of_edge = [&](std::uint32_t edge) {
        const std::size_t cell = cells.cell_of(edge);
        return inner_nodes(mesh, nodes, cell).subspan((edge - cells.first(cell)) * within, within);
    };
    const auto report = [&](std::size_t edge) {
        defects.add([&] {
            const Segment ends{cells.origin(edge), cells.target(edge)};
            return MeshDefect{"edge " + edge_text(ends) + " has other nodes on its other side",
                              mesh.points[ends.a.index()]};
        });
    };
    const Adjacency adjacency = find_adjacency(mesh);
    for (std::uint32_t edge = 0; edge < cells.size(); ++edge) {
        const std::uint32_t twin = adjacency.twin[edge];
        if (twin != no_edge && edge < twin && !are_reversed(nodes_of_edge(edge), nodes_of_edge(twin))) report(edge);
    }
    std::vector<Segment> of_markers;
    for (const Marker& marker : mesh.markers)
        of_markers.insert(of_markers.end(), marker.edges.begin(), marker.edges.end());
    const std::vector<std::uint32_t> found = find_edges(mesh, of_markers);
    for (std::size_t i = 0; i < of_markers.size(); ++i) {
        const std::uint32_t edge = found[i];
        if (edge == no_edge) continue;  // check_mesh() reports it
        const auto own = std::span<const VertexId>(nodes.marker_nodes).subspan(i * within, within);
        const auto of_cell = nodes_of_edge(edge);
        const bool is_same = cells.origin(edge) == of_markers[i].a
                                 ? std::equal(own.begin(), own.end(), of_cell.begin(), of_cell.end())
                                 : are_reversed(own, of_cell);
        if (!is_same) report(edge);
    }
}

}  // namespace

}  // namespace lamina::mesh

namespace lamina {

using namespace mesh;

CurvedCheck check_curved(const MeshView& mesh, const CurvedNodes& nodes) {
    DefectList of_lists;
    if (!check_lists(mesh, nodes, of_lists)) {
        CurvedCheck check;
        check.defects = std::move(of_lists.kept);
        check.defect_count = of_lists.count;
        return check;
    }
    check_common_nodes(mesh, nodes, of_lists);
    CurvedCheck check = check_of(mesh, prove_cells(mesh, nodes));
    check.defect_count += of_lists.count;
    check.defects.insert(check.defects.begin(), of_lists.kept.begin(), of_lists.kept.end());
    check.defects.resize(std::min(check.defects.size(), DefectList::max_kept));
    return check;
}

}  // namespace lamina
