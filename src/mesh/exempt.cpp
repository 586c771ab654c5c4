#include "mesh/exempt.hpp"

#include <algorithm>
#include <utility>

#include "core/parallel.hpp"
#include "core/segments.hpp"
#include "mesh/adjacency.hpp"
#include "mesh/isotropic_cells.hpp"

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
            if (is_sharp(edges_.first(cell) + i)) return true;
        return false;
    }

private:
    const Mesh& mesh_;
    CellEdges edges_;
    const Adjacency& adjacency_;
    const std::vector<Segment>& constraints_;

    std::size_t next(std::size_t edge) const { return advanced(edge, 1); }
    std::size_t previous(std::size_t edge) const { return advanced(edge, edges_.corners(edges_.cell_of(edge)) - 1); }
    /// Returns the edge of the same cell that is this many steps ahead, counter-clockwise.
    std::size_t advanced(std::size_t edge, std::size_t steps) const {
        const std::size_t cell = edges_.cell_of(edge), first = edges_.first(cell);
        return first + (edge - first + steps) % edges_.corners(cell);
    }

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

    /// Returns whether the corner at the origin v of `edge` lies between two frozen edges that enclose less than 60
    /// degrees. Walks over the cells round v in both directions up to the next frozen edge:
    ///
    ///      b   .            v-a  frozen edge found clockwise from `edge`
    ///       \ .  cell       v-b  frozen edge found counter-clockwise from it
    ///        v-----> edge
    ///         \  .
    ///          a
    bool is_sharp(std::size_t edge) const {
        std::size_t right = edge;  // leaves v
        while (!is_frozen(right)) {
            right = next(adjacency_.twin[right]);
            if (right == edge) return false;  // no edge at v is frozen
        }
        std::size_t left = previous(edge);  // arrives at v
        while (!is_frozen(left)) left = previous(adjacency_.twin[left]);
        const Point v = mesh_.points[edges_.origin(edge).index()];
        const Point a = mesh_.points[edges_.target(right).index()] - v;
        const Point b = mesh_.points[edges_.origin(left).index()] - v;
        return core::encloses_sharp_angle(a, b);
    }
};

/// The outline of the isotropic region: the edges of its cells on the boundary of the mesh and on the layer. The region
/// lies on the left.
class Outline {
public:
    Outline(const Mesh& mesh, const Adjacency& adjacency) : mesh_(mesh) {
        const CellEdges edges(mesh);
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const std::uint32_t twin = adjacency.twin[e];
            if (!is_isotropic(mesh, edges.cell_of(e))) continue;
            if (twin == no_edge || !is_isotropic(mesh, edges.cell_of(twin)))
                next_.emplace_back(edges.origin(e), edges.target(e));
        }
        std::sort(next_.begin(), next_.end());
    }

    /// Returns whether the edge opposite the smallest angle of a triangle spans a sharp corner of the outline: whether
    /// both its ends lie on the outline, few edges from one corner that encloses less than 60 degrees.
    ///
    ///                     p2 ___---
    ///            p1 ___---  |
    ///      v ___---   |     |       triangles with the edges p1 q1 and p2 q2
    ///        ---______|_____|__
    ///                 q1    q2
    bool is_spanned(const Triangle& triangle) const {
        std::size_t shortest = 0;
        for (std::size_t i = 1; i < 3; ++i)
            if (length(triangle, i) < length(triangle, shortest)) shortest = i;
        const VertexId p = triangle.v[shortest], q = triangle.v[(shortest + 1) % 3];
        if (after(p) == q || after(q) == p) return false;  // it is an edge of the outline itself
        return leads_round_sharp_corner(p, q) || leads_round_sharp_corner(q, p);
    }

private:
    const Mesh& mesh_;
    std::vector<std::pair<VertexId, VertexId>> next_;  ///< both ends of each edge, sorted

    Point at(VertexId v) const { return mesh_.points[v.index()]; }
    double length(const Triangle& triangle, std::size_t i) const {
        return distance(at(triangle.v[i]), at(triangle.v[(i + 1) % 3]));
    }

    /// Returns the next vertex of the outline; the same one where the outline does not pass it, or passes it twice.
    VertexId after(VertexId v) const {
        const auto edge = std::lower_bound(next_.begin(), next_.end(), std::pair{v, VertexId{0}});
        if (edge == next_.end() || edge->first != v) return v;
        const auto other = edge + 1;
        return other != next_.end() && other->first == v ? v : edge->second;
    }

    /// Returns whether the outline leads from one vertex to another in few edges, round a sharp corner.
    bool leads_round_sharp_corner(VertexId from, VertexId to) const {
        constexpr int max_edges = 32;
        bool sharp = false;
        VertexId v = from, next = after(v);
        for (int edges = 0; edges < max_edges && next != v; ++edges) {
            if (next == to) return sharp;
            const VertexId beyond = after(next);
            sharp |= core::encloses_sharp_angle(at(beyond) - at(next), at(v) - at(next));
            v = next;
            next = beyond;
        }
        return false;
    }
};

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
    const Outline outline(mesh, adjacency);
    std::erase_if(others, [&](std::uint32_t cell) {
        return cell < mesh.triangles.size() && outline.is_spanned(mesh.triangles[cell]);
    });
    return others;
}

}  // namespace lamina::mesh
