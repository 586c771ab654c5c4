// Sharp corners between frozen edges, whose narrow triangles no refinement could mend.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

#include "core/segments.hpp"

namespace lamina::mesh {

/// Returns the number i of the shortest edge of a triangle, from corner i to the next; the first of several.
inline std::size_t shortest_edge(Point a, Point b, Point c) {
    const double lengths[3] = {distance(a, b), distance(b, c), distance(c, a)};
    return static_cast<std::size_t>(std::min_element(lengths, lengths + 3) - lengths);
}

/// Returns whether the corner at the origin v of a directed edge lies between two frozen edges that enclose less than
/// 60 degrees. Walks over the cells round v in both directions up to the next frozen edge:
///
///      b   .            v-a  frozen edge found clockwise from `edge`
///       \ .  cell       v-b  frozen edge found counter-clockwise from it
///        v-----> edge
///         \  .
///          a
///
/// `edges` knows origin(e) and target(e) as points, is_frozen(e), the twin(e) of an edge that is not frozen, and the
/// edges next(e) and previous(e) of the same cell.
template <class Edges, class Edge>
bool is_sharp_corner(const Edges& edges, Edge edge) {
    Edge right = edge;  // leaves v
    while (!edges.is_frozen(right)) {
        right = edges.next(edges.twin(right));
        if (right == edge) return false;  // no edge at v is frozen
    }
    Edge left = edges.previous(edge);  // arrives at v
    while (!edges.is_frozen(left)) left = edges.previous(edges.twin(left));
    const Point v = edges.origin(edge);
    return core::encloses_sharp_angle(edges.target(right) - v, edges.origin(left) - v);
}

/// The outline of the isotropic region: the edges of its cells on the boundary of the mesh and on the layer. The region
/// lies on the left.
class Outline {
public:
    /// `points` holds the vertices of the edges and must outlive this object.
    Outline(std::span<const Point> points, std::vector<Segment> edges) : points_(points), edges_(std::move(edges)) {
        std::sort(edges_.begin(), edges_.end());
    }

    /// Returns whether the shortest edge p-q of a triangle, opposite its smallest angle, spans a sharp corner of the
    /// outline: whether both its ends lie on the outline, few edges from one corner that encloses less than 60 degrees.
    ///
    ///                     p2 ___---
    ///            p1 ___---  |
    ///      v ___---   |     |       triangles with the edges p1 q1 and p2 q2
    ///        ---______|_____|__
    ///                 q1    q2
    bool is_spanned(VertexId p, VertexId q) const {
        if (after(p) == q || after(q) == p) return false;  // it is an edge of the outline itself
        return leads_round_sharp_corner(p, q) || leads_round_sharp_corner(q, p);
    }

private:
    std::span<const Point> points_;
    std::vector<Segment> edges_;  ///< sorted

    Point at(VertexId v) const { return points_[v.index()]; }

    /// Returns the next vertex of the outline; the same one where the outline does not pass it, or passes it twice.
    VertexId after(VertexId v) const {
        const auto edge = std::lower_bound(edges_.begin(), edges_.end(), Segment{v, VertexId{0}});
        if (edge == edges_.end() || edge->a != v) return v;
        const auto other = edge + 1;
        return other != edges_.end() && other->a == v ? v : edge->b;
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

}  // namespace lamina::mesh
