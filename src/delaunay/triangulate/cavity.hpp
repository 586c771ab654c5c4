// Insertion of a point by its cavity: the step that plain triangulation and refinement share. The cavity of a point p
// is the set of triangles whose circles hold p. They are removed, and every edge a -> b of the cavity's boundary gets
// one new triangle (p, a, b).
//
//        before                    after
//     o---------o               o---------o
//     |\       /|               |\       /|      The boundary runs counter-clockwise round the cavity. A boundary of
//     | \  .p / |               | \     / |      k edges surrounds k - 2 triangles, whose places in the array are
//     |  \   /  |               |  '-p-'  |      used again; two new triangles are appended.
//     |   \ /   |               |  / | \  |
//     o----o----o               o----o----o
//
// The triangles of a cavity form a tree in the dual graph. A depth-first search therefore needs no visited marks and
// meets the boundary edges in counter-clockwise order.
//
// Nothing is written before the whole cavity is known, so giving up costs nothing. Afterwards the indices of triangles
// of the cavity, and links into it, are invalid; all others stay valid.
//
// Source: A. Bowyer, The Computer Journal 24 (1981); D. F. Watson, ibid.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "core/predicates.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// The edge a -> b of a cavity's boundary; b is the a of the next edge. Coordinates are relative to the new point p.
struct CavityEdge {
    Index a;
    Link outer;         ///< the triangle outside; constrained where a constrained edge has stopped the cavity
    double ax, ay, aa;  ///< a - p and its squared length
    double area2;       ///< (a - p) x (b - p): twice the area of the triangle that will stand on this edge
};

/// An array that is written through data() up to its capacity. Only the first size() entries have a meaning.
template <class T>
class Scratch {
public:
    const T& operator[](std::size_t i) const { return entries_[i]; }
    std::size_t size() const { return size_; }
    std::size_t capacity() const { return entries_.size(); }
    T* data() { return entries_.data(); }
    void set_capacity(std::size_t capacity) { entries_.resize(capacity); }
    void set_size(std::size_t size) { size_ = size; }

private:
    std::vector<T> entries_;
    std::size_t size_ = 0;
};

/// A cavity, and scratch space to find it. The same object serves for one point after another.
struct Cavity {
    /// An edge a -> b that find_cavity() has yet to look across, with coordinates relative to the new point p. The edge
    /// that the search looks across before it ends at a.
    struct PendingEdge {
        Link outer;  ///< the triangle to look at
        Index b;
        double bx, by, bb;  ///< b - p and its squared length
        double area2;       ///< (a - p) x (b - p)
    };
    Scratch<Index> triangles;      ///< the triangles whose circles hold p
    Scratch<CavityEdge> boundary;  ///< the edges round them, counter-clockwise; the first is repeated behind the last
    Scratch<PendingEdge> stack;
    /// Whether no edge of the boundary is constrained, and p lies clearly on the inner side of each.
    bool is_open_star = false;
    /// No cavity has more triangles than the triangulation. Where one seems to, the search runs in circles: round an
    /// island or the ends of a segment, across which the triangles are not Delaunay.
    std::size_t max_triangles = static_cast<std::size_t>(-1);

    Cavity() { grow(); }
    void grow() {
        const std::size_t capacity = 2 * triangles.capacity() + 64;
        triangles.set_capacity(capacity);
        boundary.set_capacity(capacity);
        stack.set_capacity(capacity);
    }
    /// Returns the index of the i-th triangle that fill_cavity() makes. `old_count` is the number of triangles before.
    Index created(std::size_t i, std::size_t old_count) const {
        return i < triangles.size() ? triangles[i] : static_cast<Index>(old_count + (i - triangles.size()));
    }
};

/// A triangle relative to a point p.
struct RelativeTriangle {
    Point r[3];       ///< vertex i minus p
    double rr[3];     ///< its squared length
    double area2[3];  ///< twice the signed area of the triangle that p makes with edge e
};

inline RelativeTriangle relative_to(const Point* points, const Tri& t, Point p) {
    RelativeTriangle relative;
    for (unsigned i = 0; i < 3; ++i) {
        relative.r[i] = points[t.v[i]] - p;
        relative.rr[i] = squared_length(relative.r[i]);
    }
    for (unsigned e = 0; e < 3; ++e) relative.area2[e] = cross(relative.r[next(e)], relative.r[previous(e)]);
    return relative;
}

/// The vertex at infinity while a plain triangulation grows. Its coordinates are NaN, so no filter is ever certain
/// about a ghost triangle, and only the code behind the filters has to know ghosts.
inline constexpr Index growing_ghost_vertex = 0;

/// Returns whether p lies in the (perturbed) circle of the ghost triangle t, whose vertex at infinity is t.v[g]:
/// strictly outside its hull edge, or on that edge.
inline bool in_ghost_circle(const Point* points, const Tri& t, unsigned g, Point p) {
    const Point a = points[t.v[next(g)]];
    const Point b = points[t.v[previous(g)]];
    const double side = core::inline_orient2d(a, b, p);
    if (side != 0) return side > 0;
    return a.x != b.x ? (a.x < p.x) == (p.x < b.x) : (a.y < p.y) == (p.y < b.y);
}

/// The error of a rounded incircle determinant is at most this times s^2, where s is the sum of the squared distances
/// of the triangle's vertices from the point: it is at most (10 + 96 eps) eps times the permanent, which in turn is at
/// most a third of s^2.
inline constexpr double incircle_error = 4e-16;

/// Twice the rounding error of the cross product of two vectors is at most this times the sum of their squared lengths.
inline constexpr double side_error = 1e-15;

/// Returns whether p lies in the circle of t, where the filter of find_cavity() could not tell.
template <bool Ghosts>
[[gnu::noinline]] bool in_circle_after_filter(const Point* points, const Tri& t, Point p) {
    if constexpr (Ghosts) {
        for (unsigned g = 0; g < 3; ++g)
            if (t.v[g] == growing_ghost_vertex) return in_ghost_circle(points, t, g, p);
    }
    // The filter with the permanent is narrower than the one of find_cavity() where the vertices are unequally far.
    return core::inline_incircle_perturbed(points[t.v[0]], points[t.v[1]], points[t.v[2]], p) > 0;
}

/// Finds the cavity of p, which is empty if the search ran in circles (Cavity::max_triangles). With `Ghosts` the
/// triangulation is closed by ghosts, without it by borders.
/// Precondition: p lies in the perturbed circle of triangle `start` and is no vertex; `relative` is `start` relative to
/// p.
template <bool Ghosts>
// NOLINTNEXTLINE(readability-function-size): the hottest loop of the program; its state has to stay in registers
void find_cavity(const Point* points, const Tri* tris, Index start, const RelativeTriangle& relative, Point p,
                 Cavity& cavity) {
    Index* triangles = cavity.triangles.data();
    CavityEdge* boundary = cavity.boundary.data();
    Cavity::PendingEdge* stack = cavity.stack.data();
    std::size_t triangle_count = 0, boundary_count = 0, stacked = 0;
    bool is_open = true;
    double least_area2 = HUGE_VAL, greatest_aa = 0;

    const Tri& first = tris[start];
    const auto pending = [&](unsigned e) -> Cavity::PendingEdge {
        const unsigned b = previous(e);
        return {first.n[e], first.v[b], relative.r[b].x, relative.r[b].y, relative.rr[b], relative.area2[e]};
    };
    triangles[triangle_count++] = start;
    stack[stacked++] = pending(2);
    stack[stacked++] = pending(1);
    Cavity::PendingEdge edge = pending(0);
    Index a = first.v[1];
    double ax = relative.r[1].x, ay = relative.r[1].y, aa = relative.rr[1];
    for (;;) {
        if (!edge.outer.is_constrained()) {
            // The neighbour is (b, a, w), entered through its edge k.
            //        a
            //      / | \      The cavity is on the left of a -> b.
            //     o  |  w
            //      \ | /
            //        b
            const Index n = edge.outer.triangle();
            const Tri& t = tris[n];
            const unsigned k = edge.outer.edge();
            const Index w = t.v[k];
            const double wx = points[w].x - p.x;
            const double wy = points[w].y - p.y;
            const double ww = wx * wx + wy * wy;
            const double aw = ax * wy - ay * wx;
            const double wb = wx * edge.by - wy * edge.bx;
            const double det = edge.bb * aw + aa * wb - ww * edge.area2;
            const double sum = aa + edge.bb + ww;
            const double error = incircle_error * (sum * sum);
            if (det > error || (!(det < -error) && in_circle_after_filter<Ghosts>(points, t, p))) {
                triangles[triangle_count++] = n;
                // The boundary and the stack of a cavity of t triangles hold t + 2 edges together, and one is repeated.
                if (triangle_count + 3 == cavity.triangles.capacity()) [[unlikely]] {
                    if (triangle_count > cavity.max_triangles) {
                        cavity.triangles.set_size(0);
                        cavity.boundary.set_size(0);
                        cavity.is_open_star = false;
                        return;
                    }
                    cavity.grow();
                    triangles = cavity.triangles.data();
                    boundary = cavity.boundary.data();
                    stack = cavity.stack.data();
                }
                // The search goes on across a -> w at once, across w -> b later.
                stack[stacked++] = {t.n[previous(k)], edge.b, edge.bx, edge.by, edge.bb, wb};
                edge = {t.n[next(k)], w, wx, wy, ww, aw};
                continue;
            }
        } else {
            is_open = false;
        }
        boundary[boundary_count++] = {a, edge.outer, ax, ay, aa, edge.area2};
        least_area2 = std::min(least_area2, edge.area2);
        greatest_aa = std::max(greatest_aa, aa);
        if (stacked == 0) break;
        a = edge.b;
        ax = edge.bx;
        ay = edge.by;
        aa = edge.bb;
        edge = stack[--stacked];
    }
    boundary[boundary_count] = boundary[0];
    cavity.is_open_star = is_open && least_area2 > 2 * side_error * greatest_aa;
    cavity.triangles.set_size(triangle_count);
    cavity.boundary.set_size(boundary_count);
}

/// Returns whether an edge of the boundary of a cavity, which runs to b, is the edge of the triangle outside, the other
/// way round, and constrained or not as that triangle knows it. For assertions.
inline bool is_edge_outside(const Tris& tris, const CavityEdge& edge, Index b) {
    if (edge.outer.is_border()) return true;
    if (!is_in_range(tris, edge.outer)) return false;
    const Tri& t = tris[edge.outer.triangle()];
    const unsigned k = edge.outer.edge();
    return t.v[next(k)] == b && t.v[previous(k)] == edge.a && t.n[k].is_constrained() == edge.outer.is_constrained();
}

/// Returns whether the boundary of a cavity has as many edges as the formula of Euler says of its triangles, and each
/// of them is that of the triangle outside. For assertions.
inline bool is_bounded(const Tris& tris, const Cavity& cavity) {
    if (cavity.triangles.size() == 0 || cavity.boundary.size() != cavity.triangles.size() + 2) return false;
    for (std::size_t i = 0; i < cavity.boundary.size(); ++i)
        if (!is_edge_outside(tris, cavity.boundary[i], cavity.boundary[i + 1].a)) return false;
    return true;
}

/// Returns whether each of so many triangles has p as its first corner, and is linked. For assertions.
inline bool is_fan(const Tris& tris, const Index* created, std::size_t count, Index p) {
    return std::all_of(created, created + count, [&](Index t) { return is_linked(tris, t) && tris[t].v[0] == p; });
}

/// Replaces the triangles of the cavity by the fan of triangles (p, a, b) over its boundary. Edge 0 of each new
/// triangle is its edge of the boundary. Calls visit(t, a, b) for each new triangle t on the edge from CavityEdge a to
/// CavityEdge b.
template <class Visit>
void fill_cavity(Tris& tris, Cavity& cavity, Index p, const Visit& visit) {
    assert(is_bounded(tris, cavity));
    const std::size_t old_count = tris.size();
    const std::size_t k = cavity.boundary.size();
    tris.emplace_back();
    tris.emplace_back();
    Tri* const triangles = tris.data();
    const CavityEdge* const boundary = cavity.boundary.data();
    Index* const created = cavity.triangles.data();
    created[k - 2] = static_cast<Index>(old_count);
    created[k - 1] = static_cast<Index>(old_count + 1);
    created[k] = created[0];
    Index last = created[k - 1];
    Index current = created[0];
    for (std::size_t i = 0; i < k; ++i) {
        const Link outer = boundary[i].outer;
        Tri& t = triangles[current];
        assert(current < tris.size() && boundary[i].a != p);
        t.v[0] = p;
        t.v[1] = boundary[i].a;
        t.v[2] = boundary[i + 1].a;
        t.n[0] = outer;
        t.n[1] = Link(created[i + 1], 2);
        t.n[2] = Link(last, 1);
        if (!outer.is_border()) triangles[outer.triangle()].n[outer.edge()] = Link(current, 0, outer.is_constrained());
        visit(current, boundary[i], boundary[i + 1]);
        last = current;
        current = created[i + 1];
    }
    assert(tris.size() == old_count + 2 && is_fan(tris, created, k, p));
}

inline void fill_cavity(Tris& tris, Cavity& cavity, Index p) {
    fill_cavity(tris, cavity, p, [](Index, const CavityEdge&, const CavityEdge&) {});
}

/// Replaces the triangles of the cavity by a fan that is open at edge `gap` of its boundary: a border on which p lies,
/// so that no triangle fits between. Returns the new triangles, counter-clockwise round p. Edge 0 of each is its edge
/// of the boundary.
///
///     a ------p------ b          gap is the edge a -> b
///      \     / \     /
///       \   /   \   /
///        '-o-----o-'
inline std::vector<Index> fill_open_cavity(Tris& tris, const Cavity& cavity, Index p, std::size_t gap) {
    const std::size_t k = cavity.boundary.size();
    assert(is_bounded(tris, cavity) && gap < k && cavity.boundary[gap].outer.is_border());
    std::vector<Index> created(cavity.triangles.size() + 1);
    for (std::size_t i = 0; i + 1 < created.size(); ++i) created[i] = cavity.triangles[i];
    created.back() = static_cast<Index>(tris.size());
    tris.emplace_back();
    for (std::size_t i = 0; i < created.size(); ++i) {
        const CavityEdge& a = cavity.boundary[(gap + 1 + i) % k];
        const CavityEdge& b = cavity.boundary[(gap + 2 + i) % k];
        Tri& t = tris[created[i]];
        t.v[0] = p;
        t.v[1] = a.a;
        t.v[2] = b.a;
        t.n[1] = i + 1 < created.size() ? Link(created[i + 1], 2) : Link::border();
        t.n[2] = i > 0 ? Link(created[i - 1], 1) : Link::border();
        connect(tris, created[i], 0, a.outer);
    }
    // All edges of the boundary but for the gap have a triangle, and the outermost edges at p are borders.
    assert(created.size() + 1 == k && is_fan(tris, created.data(), created.size(), p));
    return created;
}

}  // namespace lamina::delaunay
