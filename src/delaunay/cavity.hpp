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

#include <span>
#include <vector>

#include "core/predicates.hpp"
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

/// Rim edge a -> b (b is the next entry's a) with coordinates relative to the new point.
struct RimEdge {
    Index a;
    Link outer;         ///< what lies across; fixed where the cavity was stopped by a constraint
    double ax, ay, aa;  ///< a - p and its squared length
    double area2;       ///< (a - p) x (b - p): twice the area of the triangle that will stand on this edge
};

/// An array that is written through data() up to its room; only the first size() entries mean something.
template <class T>
class Scratch {
public:
    const T& operator[](std::size_t i) const { return room_[i]; }
    std::size_t size() const { return size_; }
    std::size_t room() const { return room_.size(); }
    T* data() { return room_.data(); }
    void make_room(std::size_t room) { room_.resize(room); }
    void set_size(std::size_t size) { size_ = size; }

private:
    std::vector<T> room_;
    std::size_t size_ = 0;
};

/// Scratch space of one kernel, reused from point to point.
struct Cavity {
    /// An edge a -> b still to be looked across, relative to the new point.
    struct Frame {
        Link outer;
        Index a;
        double ax, ay, aa, bx, by, bb, area2;
    };
    Scratch<Index> triangles;
    Scratch<RimEdge> rim;
    Scratch<Frame> stack;

    Cavity() { grow(); }
    void grow() {
        const std::size_t room = 2 * triangles.room() + 64;
        triangles.make_room(room);
        rim.make_room(room);
        stack.make_room(room);
    }
    /// The i-th of the triangles that fill_cavity() makes, `appended` being the number of triangles before it.
    Index created(std::size_t i, std::size_t appended) const {
        return i < triangles.size() ? triangles[i] : static_cast<Index>(appended + (i - triangles.size()));
    }
};

/// A triangle as a new point sees it: its vertices relative to the point, and twice the (signed) areas of the triangles
/// that the point makes with its edges.
struct SeenTriangle {
    Point r[3];
    double area2[3];
};

inline SeenTriangle see(const Point* points, const Tri& t, Point p) {
    SeenTriangle s;
    for (unsigned i = 0; i < 3; ++i) s.r[i] = points[t.v[i]] - p;
    for (unsigned e = 0; e < 3; ++e) s.area2[e] = cross(s.r[next(e)], s.r[previous(e)]);
    return s;
}

/// Plain triangulation closes its hull by ghost triangles, whose vertex at infinity is number 0 with NaN for
/// coordinates: then no filter is ever certain about them, and only what comes behind the filters knows ghosts.
inline constexpr Index ghost = 0;

/// Does p lie in the (perturbed) circle of the ghost triangle t with the ghost at g: strictly outside its hull edge, or
/// on the edge itself?
inline bool in_ghost_circle(const Point* points, const Tri& t, unsigned g, Point p) {
    const Point a = points[t.v[next(g)]];
    const Point b = points[t.v[previous(g)]];
    const double side = core::inline_orient2d(a, b, p);
    if (side != 0) return side > 0;
    return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
}

/// Whether p lies in the circle of t, where the filter of find_cavity() could not tell.
template <bool Ghosts>
[[gnu::noinline]] bool in_circle_after_filter(const Point* points, const Tri& t, Point p) {
    if constexpr (Ghosts) {
        for (unsigned g = 0; g < 3; ++g)
            if (t.v[g] == ghost) return in_ghost_circle(points, t, g, p);
    }
    return core::incircle_after_filter(points[t.v[0]], points[t.v[1]], points[t.v[2]], p) > 0;
}

/// Finds the cavity of p. Precondition: `start` is in conflict with p (p in its perturbed circle), p is no vertex, and
/// `seen` is `start` as seen from p. With `Ghosts` the triangulation is closed by ghosts, without it by borders.
template <bool Ghosts>
void find_cavity(const Point* points, const Tri* tris, Index start, const SeenTriangle& seen, Point p, Cavity& cavity) {
    Index* triangles = cavity.triangles.data();
    RimEdge* rim = cavity.rim.data();
    Cavity::Frame* stack = cavity.stack.data();
    std::size_t triangle_count = 0, rim_count = 0, stacked = 0;

    const Tri& first = tris[start];
    double rr[3];
    for (unsigned i = 0; i < 3; ++i) rr[i] = squared_length(seen.r[i]);
    const auto frame = [&](unsigned e) -> Cavity::Frame {
        const unsigned a = next(e), b = previous(e);
        const Point ra = seen.r[a], rb = seen.r[b];
        return {first.n[e], first.v[a], ra.x, ra.y, rr[a], rb.x, rb.y, rr[b], seen.area2[e]};
    };
    triangles[triangle_count++] = start;
    stack[stacked++] = frame(2);
    stack[stacked++] = frame(1);
    for (Cavity::Frame f = frame(0);;) {
        if (!f.outer.is_constrained()) {
            // The neighbour is (b, a, w), entered through its edge k:
            //        a
            //      / | \      inside lies on the left of a -> b
            //     o  |  w
            //      \ | /
            //        b
            const Index n = f.outer.triangle();
            const Tri& t = tris[n];
            const unsigned k = f.outer.edge();
            const Index w = t.v[k];
            const double wx = points[w].x - p.x;
            const double wy = points[w].y - p.y;
            const double ww = wx * wx + wy * wy;
            const double aw = f.ax * wy - f.ay * wx;
            const double wb = wx * f.by - wy * f.bx;
            const double det = f.bb * aw + f.aa * wb - ww * f.area2;
            // |det| is right to (10 + 96 eps) eps times the permanent, which is at most s^2 / 3.
            const double s = f.aa + f.bb + ww;
            const double error = 4e-16 * (s * s);
            if (det > error || (!(det < -error) && in_circle_after_filter<Ghosts>(points, t, p))) {
                triangles[triangle_count++] = n;
                // The rim and the stack of a cavity of t triangles hold t + 2 edges together.
                if (triangle_count + 2 == cavity.triangles.room()) [[unlikely]] {
                    cavity.grow();
                    triangles = cavity.triangles.data();
                    rim = cavity.rim.data();
                    stack = cavity.stack.data();
                }
                // First across a -> w, later across w -> b.
                stack[stacked++] = {t.n[previous(k)], w, wx, wy, ww, f.bx, f.by, f.bb, wb};
                f.outer = t.n[next(k)];
                f.bx = wx;
                f.by = wy;
                f.bb = ww;
                f.area2 = aw;
                continue;
            }
        }
        rim[rim_count++] = {f.a, f.outer, f.ax, f.ay, f.aa, f.area2};
        if (stacked == 0) break;
        f = stack[--stacked];
    }
    cavity.triangles.set_size(triangle_count);
    cavity.rim.set_size(rim_count);
}

template <bool Ghosts>
void find_cavity(const Point* points, const Tris& tris, Index start, Point p, Cavity& cavity) {
    find_cavity<Ghosts>(points, tris.data(), start, see(points, tris[start], p), p, cavity);
}

/// Replaces the cavity by the fan of triangles (p, a, b) over its rim: edge 0 of each is its rim edge.
inline void fill_cavity(Tris& tris, Cavity& cavity, Index p) {
    const std::size_t before = tris.size();
    const std::size_t k = cavity.rim.size();
    tris.resize(before + 2);
    Tri* const triangles = tris.data();
    const RimEdge* const rim = cavity.rim.data();
    Index* const created = cavity.triangles.data();
    created[k - 2] = static_cast<Index>(before);
    created[k - 1] = static_cast<Index>(before + 1);
    Index last = created[k - 1];
    Index current = created[0];
    for (std::size_t i = 0; i < k; ++i) {
        const std::size_t after = i + 1 < k ? i + 1 : 0;
        const Link outer = rim[i].outer;
        Tri& t = triangles[current];
        t.v[0] = p;
        t.v[1] = rim[i].a;
        t.v[2] = rim[after].a;
        t.n[0] = outer;
        t.n[1] = Link(created[after], 2);
        t.n[2] = Link(last, 1);
        if (!outer.is_border()) triangles[outer.triangle()].n[outer.edge()] = Link(current, 0, outer.is_constrained());
        last = current;
        current = created[after];
    }
}

}  // namespace lamina::delaunay
