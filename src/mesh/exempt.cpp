#include "mesh/exempt.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/isotropic_cells.hpp"
#include "mesh/sharp_corners.hpp"

namespace lamina::mesh {

namespace {

/// Finds the two frozen edges between which a corner of an isotropic cell lies.
class FrozenCorners {
public:
    FrozenCorners(const Mesh& mesh, const Adjacency& adjacency, const std::vector<Segment>& constraints)
        : mesh_(mesh), edges_(mesh), adjacency_(adjacency), constraints_(constraints) {}

    /// Returns whether a corner of the cell lies between two frozen edges that enclose less than 60 degrees.
    bool has_sharp_corner(std::size_t cell) const {
        for (std::size_t i = 0; i < edges_.corners(cell); ++i)
            if (is_sharp_corner(*this, edges_.first(cell) + i)) return true;
        return false;
    }

    // What is_sharp_corner() needs to know.
    Point origin(std::size_t edge) const { return mesh_.points[edges_.origin(edge).index()]; }
    Point target(std::size_t edge) const { return mesh_.points[edges_.target(edge).index()]; }
    std::size_t twin(std::size_t edge) const { return adjacency_.twin[edge]; }
    std::size_t next(std::size_t edge) const { return advanced(edge, 1); }
    std::size_t previous(std::size_t edge) const { return advanced(edge, edges_.corners(edges_.cell_of(edge)) - 1); }

    /// Precondition: the edge belongs to an isotropic cell.
    bool is_frozen(std::size_t edge) const {
        const std::uint32_t twin = adjacency_.twin[edge];
        if (twin == no_edge) return true;
        const std::size_t cell = edges_.cell_of(edge), other = edges_.cell_of(twin);
        if (!is_isotropic(mesh_, other)) return true;
        if (!mesh_.piece.empty() && mesh_.piece[cell] != mesh_.piece[other]) return true;
        const VertexId a = edges_.origin(edge), b = edges_.target(edge);
        return std::binary_search(constraints_.begin(), constraints_.end(), Segment{std::min(a, b), std::max(a, b)});
    }

private:
    const Mesh& mesh_;
    CellEdges edges_;
    const Adjacency& adjacency_;
    const std::vector<Segment>& constraints_;

    /// Returns the edge of the same cell that is this many steps ahead, counter-clockwise.
    std::size_t advanced(std::size_t edge, std::size_t steps) const {
        const std::size_t cell = edges_.cell_of(edge), first = edges_.first(cell);
        return first + (edge - first + steps) % edges_.corners(cell);
    }
};

/// Returns the edges of isotropic cells on the boundary of the mesh and on the layer.
std::vector<Segment> outline_edges(const Mesh& mesh, const Adjacency& adjacency) {
    const CellEdges edges(mesh);
    std::vector<Segment> outline;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::uint32_t twin = adjacency.twin[e];
        if (!is_isotropic(mesh, edges.cell_of(e))) continue;
        if (twin == no_edge || !is_isotropic(mesh, edges.cell_of(twin)))
            outline.push_back({edges.origin(e), edges.target(e)});
    }
    return outline;
}

}  // namespace

std::vector<std::uint32_t> find_unexcused(const Mesh& mesh, const Adjacency& adjacency,
                                          const std::vector<Segment>& constraints,
                                          const std::vector<std::uint32_t>& cells) {
    const FrozenCorners corners(mesh, adjacency, constraints);
    const auto find_others = [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> others;
        for (std::size_t i = begin; i < end; ++i)
            if (!corners.has_sharp_corner(cells[i])) others.push_back(cells[i]);
        return others;
    };
    std::vector<std::uint32_t> others;
    for (const std::vector<std::uint32_t>& part : core::parallel_blocks(cells.size(), cells_per_block, find_others))
        others.insert(others.end(), part.begin(), part.end());
    if (others.empty()) return others;
    const Outline outline(mesh.points, outline_edges(mesh, adjacency));
    std::erase_if(others, [&](std::uint32_t cell) {
        if (cell >= mesh.triangles.size()) return false;
        const VertexId* v = mesh.triangles[cell].v;
        const std::size_t shortest =
            shortest_edge(mesh.points[v[0].index()], mesh.points[v[1].index()], mesh.points[v[2].index()]);
        return outline.is_spanned(v[shortest], v[(shortest + 1) % 3]);
    });
    return others;
}

}  // namespace lamina::mesh
