// Plain Delaunay triangulation by cavity insertion in biased randomised order.
// Sources: N. Amenta, S. Choi, G. Rote, SoCG 2003 (order); A. Bowyer, D. F. Watson, The Computer Journal 24 (1981)
// (cavities); the tie rule makes every intermediate triangulation the unique one of its points (docs/decisions/0001).
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "kernel/cavity.hpp"
#include "kernel/insertion_order.hpp"
#include "kernel/triangulator.hpp"

namespace lamina::kernel {

namespace {

[[noreturn]] void fail_duplicate(Index a, Index b, Point p) {
    throw InputError({.file = {}, .line = 0, .at = p},
                     fmt::format("points {} and {} are the same", std::min(a, b), std::max(a, b)));
}

/// Three points of the order that are not on one line, moved to its front. False if there are none.
bool bring_triangle_to_front(std::span<const Point> points, std::vector<Index>& order) {
    for (std::size_t i = 2; i < order.size(); ++i) {
        if (orient2d(points[order[0]], points[order[1]], points[order[i]]) != 0) {
            std::swap(order[2], order[i]);
            return true;
        }
    }
    return false;
}

/// One triangle and its three ghosts:
///
///      ghost 2 \    / ghost 1       real edge of the ghost across edge e: v[e+2] -> v[e+1],
///               v[0]                outside on its left
///              /    \.
///         v[1] ------ v[2]
///             ghost 0
Tris first_triangle(std::span<const Point> points, Index a, Index b, Index c) {
    if (orient2d(points[a], points[b], points[c]) < 0) std::swap(b, c);
    Tris tris(4);
    const Index v[3] = {a, b, c};
    for (unsigned e = 0; e < 3; ++e) {
        tris[0].v[e] = v[e];
        Tri& ghost = tris[1 + e];
        ghost.v[0] = v[previous(e)];
        ghost.v[1] = v[next(e)];
        ghost.v[2] = ghost_vertex;
        connect(tris, 0, e, Link(1 + e, 2));
    }
    for (unsigned e = 0; e < 3; ++e) {
        // Ghost edge 0 runs v[e+1] -> infinity; its neighbour is the ghost across edge e + 2, which starts there.
        connect(tris, 1 + e, 0, Link(1 + previous(e), 1));
    }
    return tris;
}

/// A triangle in conflict with p, found by walking from `start` (no ghost) towards p; or the triangle of which p is a
/// vertex. The walk ends because the triangulation is Delaunay.
Index locate(const Point* points, const Tris& tris, Index start, Point p) {
    Index t = start;
    unsigned entered = 3;
    for (;;) {
        const Tri& tri = tris[t];
        unsigned e = 0;
        for (; e < 3; ++e) {
            if (e == entered) continue;
            if (detail::inline_orient2d(points[tri.v[next(e)]], points[tri.v[previous(e)]], p) < 0) break;
        }
        if (e == 3) return t;
        const Link across = tri.n[e];
        t = across.triangle();
        entered = across.edge();
        if (tris[t].is_ghost()) return t;
    }
}

}  // namespace

Tris triangulate_points(std::span<const Point> points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!in_exact_range(points[i]))
            throw InputError({.file = {}, .line = 0, .at = points[i]},
                             fmt::format("point {} is outside the range of exact arithmetic", i));
    }
    std::vector<Index> order = insertion_order(points);
    if (order.size() < 3 || !bring_triangle_to_front(points, order)) {
        for (std::size_t i = 1; i < order.size(); ++i) {
            // On a line the order along the curve brings equal points together only per round: compare all.
            for (std::size_t j = 0; j < i; ++j)
                if (points[order[i]] == points[order[j]]) fail_duplicate(order[i], order[j], points[order[i]]);
        }
        return {};
    }

    Tris tris = first_triangle(points, order[0], order[1], order[2]);
    tris.reserve(2 * points.size() + 8);
    Cavity cavity;
    Index recent = 0;
    for (std::size_t i = 3; i < order.size(); ++i) {
        const Index vertex = order[i];
        const Point p = points[vertex];
        const Index start = locate(points.data(), tris, recent, p);
        for (Index v : tris[start].v)
            if (v != ghost_vertex && points[v] == p) fail_duplicate(v, vertex, p);
        find_cavity<true>(points.data(), tris, start, p, cavity);
        const std::size_t before = tris.size();
        fill_cavity(tris, cavity, vertex);
        for (std::size_t k = 0; k < cavity.rim.size(); ++k) {
            recent = cavity.created(k, before);
            if (!tris[recent].is_ghost()) break;
        }
    }
    return tris;
}

Triangulation without_ghosts(const Tris& tris) {
    Triangulation result;
    result.triangles.reserve(tris.size());
    for (const Tri& t : tris)
        if (!t.is_ghost()) result.triangles.push_back({VertexId{t.v[0]}, VertexId{t.v[1]}, VertexId{t.v[2]}});
    return result;
}

}  // namespace lamina::kernel

namespace lamina {

Triangulation delaunay(std::span<const Point> points) {
    return kernel::without_ghosts(kernel::triangulate_points(points));
}

}  // namespace lamina
