// Flat triangles at the hull, which are taken from the outside inwards.
//
//     a ------------------- b      The hull edge a-b is the root of all triangles that are reached through it. v and w
//       '--v.._____..w--'          would lie on it, but for rounding: the triangles down to a-v, v-w and w-b are dropped.
#include <algorithm>
#include <vector>

#include "core/segments.hpp"
#include "delaunay/constrain/regions.hpp"

namespace lamina::delaunay {

namespace {

/// An edge of a selected triangle, behind which there is none, and the hull edge that it was reached through.
struct FlatFront {
    Link edge;
    Segment root;
};

/// Takes triangles out of a selection.
class FlatTriangles {
public:
    FlatTriangles(std::span<const Point> points, double drop_flat, const Tris& tris, TriangleSelection& selection)
        : points_(points), drop_flat_(drop_flat), tris_(tris), selection_(selection), on_border_(points.size(), 0) {
        for (const Tri& tri : tris_) {
            if (!tri.is_ghost()) continue;
            for (unsigned e = 0; e < 3; ++e) {
                if (tri.v[e] != ghost_vertex) continue;
                const Index a = tri.v[next(e)], b = tri.v[previous(e)];
                on_border_[a] = on_border_[b] = 1;
                if (!tri.n[e].is_constrained()) front_.push_back({tri.n[e], {VertexId{a}, VertexId{b}}});
            }
        }
    }

    std::size_t drop_all() {
        std::size_t dropped = 0;
        while (!front_.empty()) {
            const FlatFront at = front_.back();
            front_.pop_back();
            const Index t = at.edge.triangle();
            const Tri& tri = tris_[t];
            if (!may_drop(at)) continue;
            selection_[t] = 0;
            on_border_[tri.v[at.edge.edge()]] = 1;
            ++dropped;
            for (const unsigned e : {next(at.edge.edge()), previous(at.edge.edge())})
                if (!tri.n[e].is_constrained()) front_.push_back({tri.n[e], at.root});
        }
        return dropped;
    }

private:
    /// Returns whether a triangle is flat, and neither its vertex, a segment nor the connection there would be lost.
    bool may_drop(const FlatFront& at) const {
        if (!selection_[at.edge.triangle()]) return false;
        const Tri& tri = tris_[at.edge.triangle()];
        const unsigned front = at.edge.edge();
        if (tri.is_ghost() || on_border_[tri.v[front]]) return false;
        for (const unsigned e : {next(front), previous(front)})
            if (tri.n[e].is_border() || !selection_[tri.n[e].triangle()]) return false;
        const Point a = points_[at.root.a.index()], b = points_[at.root.b.index()];
        return core::distance_to_segment(points_[tri.v[front]], a, b) <= drop_flat_ * distance(a, b);
    }

    std::span<const Point> points_;
    double drop_flat_;
    const Tris& tris_;
    TriangleSelection& selection_;
    std::vector<char> on_border_;  ///< for each vertex
    std::vector<FlatFront> front_;
};

}  // namespace

std::size_t deselect_flat(std::span<const Point> points, double drop_flat, const Tris& tris,
                          TriangleSelection& selection) {
    return drop_flat > 0 ? FlatTriangles(points, drop_flat, tris, selection).drop_all() : 0;
}

}  // namespace lamina::delaunay
