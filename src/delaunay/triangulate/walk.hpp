// A walk through a triangulation that need not be Delaunay, from triangle to triangle towards a point.
// Source: O. Devillers, S. Pion, M. Teillaud, Walking in a triangulation, Int. J. Found. Comput. Sci. 13 (2002).
#pragma once

#include <cstdint>
#include <utility>

#include "core/predicates.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns whether one of the vertices is growing_ghost_vertex.
inline bool is_growing_ghost(const Tri& t) {
    return t.v[0] == growing_ghost_vertex || t.v[1] == growing_ghost_vertex || t.v[2] == growing_ghost_vertex;
}

/// Returns whether p lies strictly on the right of edge e of t.
inline bool is_beyond(const Point* vertices, const Tri& t, unsigned e, Point p) {
    return core::inline_orient2d(vertices[t.v[next(e)]], vertices[t.v[previous(e)]], p) < 0;
}

/// Returns a triangle that holds p, or a ghost whose hull edge p lies strictly beyond. A point on an edge or vertex may
/// be found in any of the triangles there. Precondition: `start` is no ghost, and ghosts close the hull.
inline Index walk(const Point* vertices, const Tri* tris, Index start, Point p) {
    unsigned e = 0;
    while (!is_beyond(vertices, tris[start], e, p))
        if (++e == 3) return start;
    Link across = tris[start].n[e];
    // A walk that always tries the same edge first may run in circles where the triangulation is not Delaunay. So does
    // none that chooses at random for ever; in most triangulations no choice is needed, and choosing costs time.
    constexpr unsigned many_steps = 50;
    std::uint32_t random = 1;
    for (unsigned steps = 0;; ++steps) {
        const Tri& t = tris[across.triangle()];
        const unsigned k = across.edge();
        if (is_growing_ghost(t)) return across.triangle();
        unsigned first = next(k), second = previous(k);
        if (steps > many_steps) {
            random = random * 1664525u + 1013904223u;
            if (random >> 31) std::swap(first, second);
        }
        if (is_beyond(vertices, t, first, p))
            across = t.n[first];
        else if (is_beyond(vertices, t, second, p))
            across = t.n[second];
        else
            return across.triangle();
    }
}

}  // namespace lamina::delaunay
