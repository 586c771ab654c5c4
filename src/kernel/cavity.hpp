// Insertion of a point by cavity: the step that plain triangulation and refinement share.
// Source: A. Bowyer, The Computer Journal 24 (1981); D. F. Watson, ibid.; depth-first form: docs/decisions/0002.
//
//        before                                        after
//     o---------o          triangles whose          o---------o
//     |\       /|          circle holds p           |\       /|      one new triangle (p, a, b) for
//     | \  .p / |          (the cavity) form        | \     / |      every rim edge a -> b
//     |  \   /  |          a tree in the dual:      |  '-p-'  |
//     |   \ /   |          no visited marks,        |  / | \  |      rim of k edges: k - 2 triangles are reused,
//     o----o----o          rim comes out            o----o----o      two appended
//                          counter-clockwise
//
// Nothing is written before the whole cavity is known, so giving up costs nothing. Handles of triangles in the cavity
// and of rim links into it are dead afterwards; all others survive.
#pragma once

#include <vector>

#include "core/predicates.hpp"
#include "kernel/triangles.hpp"

namespace lamina::kernel {

/// Rim edge a -> b (b is the next entry's a) with coordinates relative to the new point.
struct RimEdge {
    Index a;
    Link outer;         ///< what lies across; fixed where the cavity was stopped by a constraint
    double ax, ay, aa;  ///< a - p and its squared length
    double area2;       ///< (a - p) x (b - p): twice the area of the triangle that will stand on this edge
};

/// Scratch space of one kernel, reused from point to point.
struct Cavity {
    struct Frame {
        Index triangle;
        unsigned edge;
        double ax, ay, aa, bx, by, bb, area2;
    };
    std::vector<Index> triangles;
    std::vector<RimEdge> rim;
    std::vector<Frame> stack;

    /// The i-th of the triangles that fill() makes, `appended` being the number of triangles before it.
    Index created(std::size_t i, std::size_t appended) const {
        return i < triangles.size() ? triangles[i] : static_cast<Index>(appended + (i - triangles.size()));
    }
};

/// Does p lie in the (perturbed) circle of the ghost triangle t: strictly outside its hull edge, or on the edge itself?
inline bool in_ghost_circle(const Point* points, const Tri& t, Point p) {
    const unsigned g = t.v[0] == ghost_vertex ? 0 : t.v[1] == ghost_vertex ? 1 : 2;
    const Point a = points[t.v[next(g)]];
    const Point b = points[t.v[previous(g)]];
    const double side = detail::inline_orient2d(a, b, p);
    if (side != 0) return side > 0;
    return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
}

/// Fills cavity.triangles and cavity.rim. Precondition: `start` is in conflict with p (p in its perturbed circle), p is
/// no vertex. With `Ghosts` the triangulation is closed by ghosts, without it by borders.
template <bool Ghosts>
void find_cavity(const Point* points, const Tris& tris, Index start, Point p, Cavity& cavity) {
    cavity.triangles.clear();
    cavity.rim.clear();
    cavity.triangles.push_back(start);
    {
        const Tri& t = tris[start];
        Point r[3];
        double rr[3];
        for (unsigned i = 0; i < 3; ++i) {
            r[i] = Ghosts && t.v[i] == ghost_vertex ? Point{} : points[t.v[i]] - p;
            rr[i] = squared_length(r[i]);
        }
        for (unsigned e = 3; e-- > 0;) {
            const unsigned a = next(e), b = previous(e);
            cavity.stack.push_back({start, e, r[a].x, r[a].y, rr[a], r[b].x, r[b].y, rr[b], cross(r[a], r[b])});
        }
    }
    while (!cavity.stack.empty()) {
        const Cavity::Frame f = cavity.stack.back();
        cavity.stack.pop_back();
        const Tri& inside = tris[f.triangle];
        const Link outer = inside.n[f.edge];
        if (!outer.is_fixed()) {
            // The neighbour is (b, a, w), entered through its edge k:
            //        a
            //      / | \      inside lies on the left of a -> b
            //     o  |  w
            //      \ | /
            //        b
            const Tri& t = tris[outer.triangle()];
            const unsigned k = outer.edge();
            const Index w = t.v[k];
            bool conflict;
            double wx = 0, wy = 0, ww = 0, aw = 0, wb = 0;
            if (Ghosts && w == ghost_vertex) {
                conflict = in_ghost_circle(points, t, p);
            } else {
                wx = points[w].x - p.x;
                wy = points[w].y - p.y;
                ww = wx * wx + wy * wy;
                aw = f.ax * wy - f.ay * wx;
                wb = wx * f.by - wy * f.bx;
                if (Ghosts && (t.v[next(k)] == ghost_vertex || t.v[previous(k)] == ghost_vertex)) {
                    conflict = in_ghost_circle(points, t, p);
                } else {
                    const double det = f.bb * aw + f.aa * wb - ww * f.area2;
                    // |det| is right to (10 + 96 eps) eps times the permanent, which is at most s^2 / 3.
                    const double s = f.aa + f.bb + ww;
                    const double error = 4e-16 * (s * s);
                    if (det > error)
                        conflict = true;
                    else if (det < -error)
                        conflict = false;
                    else
                        conflict = detail::incircle_after_filter(points[t.v[0]], points[t.v[1]], points[t.v[2]], p) > 0;
                }
            }
            if (conflict) {
                const Index n = outer.triangle();
                cavity.triangles.push_back(n);
                cavity.stack.push_back({n, previous(k), wx, wy, ww, f.bx, f.by, f.bb, wb});
                cavity.stack.push_back({n, next(k), f.ax, f.ay, f.aa, wx, wy, ww, aw});
                continue;
            }
        }
        cavity.rim.push_back({inside.v[next(f.edge)], outer, f.ax, f.ay, f.aa, f.area2});
    }
}

/// Replaces the cavity by the fan of triangles (p, a, b) over its rim: edge 0 of each is its rim edge.
inline void fill_cavity(Tris& tris, const Cavity& cavity, Index p) {
    const std::size_t before = tris.size();
    const std::size_t k = cavity.rim.size();
    tris.resize(before + 2);
    Index last = cavity.created(k - 1, before);
    Index current = cavity.created(0, before);
    for (std::size_t i = 0; i < k; ++i) {
        const RimEdge& rim = cavity.rim[i];
        const Index following = cavity.created(i + 1 < k ? i + 1 : 0, before);
        Tri& t = tris[current];
        t.v[0] = p;
        t.v[1] = rim.a;
        t.v[2] = cavity.rim[i + 1 < k ? i + 1 : 0].a;
        t.n[1] = Link(following, 2);
        t.n[2] = Link(last, 1);
        connect(tris, current, 0, rim.outer);
        last = current;
        current = following;
    }
}

}  // namespace lamina::kernel
