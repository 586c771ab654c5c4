// The steps by which a plain Delaunay triangulation grows: find the place of a vertex, and insert it there.
// Sources: A. Bowyer, D. F. Watson, The Computer Journal 24 (1981) (cavities); O. Devillers, S. Pion, M. Teillaud,
// Walking in a triangulation, Int. J. Found. Comput. Sci. 13 (2002).
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/predicates.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// A triangulation that grows. Its vertices are numbered in the order of their insertion, so points that are close in
/// the plane are close in memory.
struct GrowingTriangulation {
    std::vector<Point> vertices;  ///< all that are to be inserted, from 1 on; number 0 is the vertex at infinity
    Tris tris;                    ///< closed by ghosts at growing_ghost_vertex; empty where all points lie on one line
};

/// Makes the first triangle, of the first three points of the order. If these lie on one line, the third one and a
/// later one swap places. Throws InputError for duplicates where all points lie on one line.
GrowingTriangulation begin_to_grow(std::span<const Point> points, std::vector<Index>& order);

/// Inserts the vertices from number `first` to `last`, where those before are in the triangulation. Throws InputError
/// for duplicates; vertex v is points[order[v - 1]].
void insert_vertices(std::span<const Point> points, std::span<const Index> order, std::size_t first, std::size_t last,
                     GrowingTriangulation& grown);

/// Returns a triangle that is no ghost, t or the one behind its hull edge; no_index where there is a border.
inline Index beside_ghost(const Tris& tris, Index t) {
    for (unsigned i = 0; i < 3; ++i) {
        if (tris[t].v[i] != growing_ghost_vertex) continue;
        return tris[t].n[i].is_border() ? no_index : tris[t].n[i].triangle();
    }
    return t;
}

/// Throws the InputError that names two equal points.
[[noreturn]] void fail_duplicate(std::span<const Point> points, Index a, Index b);

/// Returns whether p lies strictly on the right of edge e of t, whose ends relative to p are a and b. Exact.
inline bool right_of(const Point* points, const Tri& t, unsigned e, Point a, Point b, Point p) {
    const double left = a.x * b.y, right = a.y * b.x;
    const double area2 = left - right;
    if (std::abs(area2) >= core::orient2d_bound * (std::abs(left) + std::abs(right))) return area2 < 0;
    return core::orient2d_after_filter(points[t.v[next(e)]], points[t.v[previous(e)]], p) < 0;
}

/// Returns a triangle whose circle holds p, or a triangle that has p as a vertex. Walks from `start`, which is no
/// ghost and has a vertex at `from`, towards p. The walk ends because the triangulation is Delaunay. With `Borders` the
/// triangles may be a part of a triangulation, with borders round it; then returns no_index where the walk leaves it.
template <bool Borders>
Index find_place(const Point* points, const Tri* tris, Index start, Point from, Point p) {
    unsigned e = 0;
    Point a, b;
    for (;; ++e) {
        if (e == 3) return start;
        a = points[tris[start].v[next(e)]] - p;
        b = points[tris[start].v[previous(e)]] - p;
        if (right_of(points, tris[start], e, a, b, p)) break;
    }
    Link across = tris[start].n[e];
    unsigned steps = 0;
    for (;;) {
        if constexpr (Borders) {
            if (across.is_border()) return no_index;
        }
        // The walk has entered the triangle (b, a, w) through its edge k, so p lies on the same side of a -> b as w.
        //        a
        //      / | \      If p is on the right of a -> w, the walk goes on across a-w; if p is on the right of
        //     o  |  w     w -> b, it goes on across w-b; else the triangle holds p.
        //      \ | /
        //        b
        const Tri& t = tris[across.triangle()];
        const unsigned k = across.edge();
        if (t.v[k] == growing_ghost_vertex) return across.triangle();
        const Point w = points[t.v[k]] - p;
        const bool across_aw = right_of(points, t, next(k), a, w, p);
        // Where p is on the right of both, either way is good, but in the needles between points that lie almost on a
        // line it may be long. So long walks take the one that the straight way from `from` to p takes.
        constexpr unsigned many_steps = 64;
        if (across_aw &&
            (++steps < many_steps || cross(p - from, w) > 0 || !right_of(points, t, previous(k), w, b, p))) {
            across = t.n[next(k)];
            b = w;
        } else if (across_aw || right_of(points, t, previous(k), w, b, p)) {
            across = t.n[previous(k)];
            a = w;
        } else {
            return across.triangle();
        }
    }
}

/// Returns the vertex of t at which p lies, or no_index. `relative` is t relative to p.
inline Index vertex_at_point(const Tri& t, const RelativeTriangle& relative) {
    for (unsigned i = 0; i < 3; ++i)
        if (relative.r[i] == Point{}) return t.v[i];
    return no_index;
}

/// Returns the new triangle that the next walk starts at, which is no ghost. From a needle the way would lead through
/// others, so where there may be needles the largest is taken. Areas of ghosts are NaN.
inline Index start_of_next_walk(const Tris& tris, const Cavity& cavity) {
    if (cavity.is_open_star) {
        // New ghosts hold the vertex at infinity at 1 or 2.
        for (std::size_t i = 0;; ++i) {
            const Tri& t = tris[cavity.triangles[i]];
            if (t.v[1] != growing_ghost_vertex && t.v[2] != growing_ghost_vertex) return cavity.triangles[i];
        }
    }
    Index largest = no_index;
    double largest_area2 = -HUGE_VAL;
    for (std::size_t i = 0; i < cavity.boundary.size(); ++i) {
        if (!(cavity.boundary[i].area2 > largest_area2)) continue;
        largest_area2 = cavity.boundary[i].area2;
        largest = cavity.triangles[i];
    }
    return largest;
}

}  // namespace lamina::delaunay
