#include "mesh/exempt.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/isotropic_cells.hpp"
#include "mesh/sharp_corners.hpp"

namespace lamina::mesh {

namespace {

/// Calls f(i, found) for all i below n, on several threads, and returns what all calls add to `found`, in the order of
/// i.
template <class F>
std::vector<std::uint32_t> collect(std::size_t n, F&& f) {
    const auto collect_block = [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> found;
        for (std::size_t i = begin; i < end; ++i) f(i, found);
        return found;
    };
    std::vector<std::uint32_t> all;
    for (const std::vector<std::uint32_t>& part : core::parallel_blocks(n, cells_per_block, collect_block))
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// All cells round some vertices, with their neighbours round these vertices. Edges are numbered cell by cell. It finds
/// the two frozen edges between which a corner of an isotropic cell at one of these vertices lies.
class Stars {
public:
    Stars(const MeshView& mesh, const VertexMarks& centers, const std::vector<Segment>& constraints)
        : mesh_(mesh), centers_(centers), constraints_(constraints) {
        const CellEdges edges(mesh);
        cells_ = collect(edges.cells(), [&](std::size_t cell, std::vector<std::uint32_t>& found) {
            for (std::size_t i = 0; i < edges.corners(cell); ++i)
                if (centers.has(edges.corner(cell, i))) return found.push_back(static_cast<std::uint32_t>(cell));
        });
        for (std::size_t k = 0; k < cells_.size(); ++k) {
            first_.push_back(static_cast<std::uint32_t>(ends_.size()));
            for (std::size_t i = 0, n = edges.corners(cells_[k]); i < n; ++i) {
                ends_.push_back({edges.corner(cells_[k], i), edges.corner(cells_[k], (i + 1) % n)});
                owner_.push_back(static_cast<std::uint32_t>(k));
            }
        }
        first_.push_back(static_cast<std::uint32_t>(ends_.size()));
        twin_ = pair_edges(ends_).twin;
    }

    /// Returns whether a corner of the cell at one of the vertices lies between two frozen edges that enclose less than
    /// 60 degrees.
    bool has_sharp_corner(std::uint32_t cell) const {
        const auto found = std::lower_bound(cells_.begin(), cells_.end(), cell);
        if (found == cells_.end() || *found != cell) return false;
        const auto k = static_cast<std::size_t>(found - cells_.begin());
        for (std::size_t e = first_[k]; e < first_[k + 1]; ++e)
            if (centers_.has(ends_[e].a) && is_sharp_corner(*this, e)) return true;
        return false;
    }

    // What is_sharp_corner() needs to know.
    Point origin(std::size_t edge) const { return mesh_.points[ends_[edge].a.index()]; }
    Point target(std::size_t edge) const { return mesh_.points[ends_[edge].b.index()]; }
    std::size_t twin(std::size_t edge) const { return twin_[edge]; }
    std::size_t next(std::size_t edge) const {
        return edge + 1 == first_[owner_[edge] + 1] ? first_[owner_[edge]] : edge + 1;
    }
    std::size_t previous(std::size_t edge) const {
        return edge == first_[owner_[edge]] ? first_[owner_[edge] + 1] - 1 : edge - 1;
    }

    /// Precondition: the edge belongs to an isotropic cell and has one of the vertices as an end, so that all its cells
    /// are there.
    bool is_frozen(std::size_t edge) const {
        const std::uint32_t twin = twin_[edge];
        if (twin == no_edge) return true;
        const std::size_t cell = cells_[owner_[edge]], other = cells_[owner_[twin]];
        if (!is_isotropic(mesh_, other)) return true;
        if (!mesh_.piece.empty() && mesh_.piece[cell] != mesh_.piece[other]) return true;
        const auto [a, b] = ends_[edge];
        return std::binary_search(constraints_.begin(), constraints_.end(), Segment{std::min(a, b), std::max(a, b)});
    }

private:
    MeshView mesh_;
    const VertexMarks& centers_;
    const std::vector<Segment>& constraints_;
    std::vector<std::uint32_t> cells_;  ///< ascending
    std::vector<std::uint32_t> first_;  ///< per cell: its first edge; then the number of edges
    std::vector<Segment> ends_;         ///< per edge
    std::vector<std::uint32_t> owner_;  ///< per edge: the place of its cell in cells_
    core::UninitializedArray<std::uint32_t> twin_;
};

/// Returns the cells without a sharp corner between frozen edges. `frozen` are the ends of all frozen edges: a corner
/// anywhere else is none, so few cells need their neighbours.
std::vector<std::uint32_t> without_sharp_corners(const MeshView& mesh, const std::vector<std::uint32_t>& cells,
                                                 const VertexMarks& frozen, const std::vector<Segment>& constraints) {
    const CellEdges edges(mesh);
    VertexMarks centers(mesh.points.size());
    for (const std::uint32_t cell : cells)
        for (std::size_t i = 0; i < edges.corners(cell); ++i)
            if (const VertexId v = edges.corner(cell, i); frozen.has(v)) centers.add(v);
    const Stars stars(mesh, centers, constraints);
    return collect(cells.size(), [&](std::size_t i, std::vector<std::uint32_t>& found) {
        if (!stars.has_sharp_corner(cells[i])) found.push_back(cells[i]);
    });
}

}  // namespace

std::vector<std::uint32_t> find_unexcused(const MeshView& mesh, CheckedCells checked,
                                          const std::vector<Segment>& constraints) {
    if (checked.summary.narrow.empty()) return {};
    const CellEdges edges(mesh);
    std::vector<Segment> outline_edges = std::move(checked.summary.outline);
    for (const std::uint32_t e : checked.edges.boundary) {
        if (!is_isotropic(mesh, edges.cell_of(e))) continue;
        outline_edges.push_back({edges.origin(e), edges.target(e)});
    }
    // Edges that too many cells share count as frozen, too, since no neighbour is known.
    for (const std::vector<std::uint32_t>* some : {&checked.edges.boundary, &checked.edges.overused})
        for (const std::uint32_t e : *some)
            for (const VertexId v : {edges.origin(e), edges.target(e)}) checked.frozen.add(v);
    for (const std::uint32_t e : checked.edges.overused)
        if (is_isotropic(mesh, edges.cell_of(e))) outline_edges.push_back({edges.origin(e), edges.target(e)});
    for (const Segment& edge : constraints)
        for (const VertexId v : {edge.a, edge.b}) checked.frozen.add(v);

    std::vector<std::uint32_t> others =
        without_sharp_corners(mesh, checked.summary.narrow, checked.frozen, constraints);
    if (others.empty()) return others;
    const Outline outline(mesh.points, std::move(outline_edges));
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
