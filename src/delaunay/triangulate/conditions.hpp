// Conditions that hold before and after a change of triangles, for assertions alone. The links between triangles have
// theirs in triangles.hpp.
#pragma once

#include <cstddef>
#include <span>

#include <lamina/point.hpp>

#include "core/predicates.hpp"
#include "delaunay/triangulate/cavity.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// Returns whether a triangle is counter-clockwise. Exact.
inline bool is_counter_clockwise(std::span<const Point> points, const Tri& t) {
    return core::inline_orient2d(points[t.v[0]], points[t.v[1]], points[t.v[2]]) > 0;
}

/// Returns whether a cavity was found, and p lies strictly on the inner side of each edge of its boundary, so that the
/// triangles between p and these edges are counter-clockwise (exact). Edges at the vertex at infinity, if there is one,
/// have no sides.
inline bool is_star(std::span<const Point> vertices, const Cavity& cavity, Point p, Index at_infinity = no_index) {
    if (cavity.is_open_star) return true;
    for (std::size_t i = 0; i < cavity.boundary.size(); ++i) {
        const CavityEdge &a = cavity.boundary[i], &b = cavity.boundary[i + 1];
        if (a.a == at_infinity || b.a == at_infinity) continue;
        if (!(core::inline_orient2d(vertices[a.a], vertices[b.a], p) > 0)) return false;
    }
    return cavity.boundary.size() >= 3;
}

/// Returns whether triangles that are closed by ghosts are as many as so many vertices have by the formula of Euler:
/// with the vertex at infinity they are a sphere. There may be none, as where all vertices lie on one line.
inline bool is_sphere(const Tris& tris, std::size_t vertices) {
    return tris.empty() || tris.size() + 2 == 2 * vertices;
}

}  // namespace lamina::delaunay
