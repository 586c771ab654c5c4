// Plain Delaunay triangulation inserts points one by one in BRIO, each by its cavity. The tie rule makes every
// intermediate triangulation the unique one of its points (docs/decisions/0001).
// Sources: N. Amenta, S. Choi, G. Rote, SoCG 2003 (order); A. Bowyer, D. F. Watson, The Computer Journal 24 (1981)
// (cavities).
#include "delaunay/triangulate_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/interruption_point.hpp"
#include "core/text.hpp"
#include "delaunay/arguments.hpp"
#include "delaunay/brio.hpp"
#include "delaunay/cavity.hpp"

namespace lamina::delaunay {

namespace {

[[noreturn]] void fail_duplicate(std::span<const Point> points, Index a, Index b) {
    throw InputError({.at = points[a], .points = {std::min(a, b), std::max(a, b)}},
                     core::concat("points ", std::min(a, b), " and ", std::max(a, b), " are the same"));
}

/// Moves three points that do not lie on one line to the front of the order. Returns false if there are none.
bool bring_triangle_to_front(std::span<const Point> points, std::vector<Index>& order) {
    for (std::size_t i = 2; i < order.size(); ++i) {
        if (orient2d(points[order[0]], points[order[1]], points[order[i]]) != 0) {
            std::swap(order[2], order[i]);
            return true;
        }
    }
    return false;
}

/// Throws InputError for duplicates; needed where there are no triangles to find them in.
void refuse_duplicates_on_line(std::span<const Point> points, std::vector<Index> order) {
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return points[a] == points[b] ? a < b : lexicographically_less(points[a], points[b]);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (points[order[i - 1]] == points[order[i]]) fail_duplicate(points, order[i - 1], order[i]);
}

/// Returns the points in the order of their insertion, numbered from 1, behind the vertex at infinity (number 0). While
/// the triangulation grows its vertices have these numbers, so points that are close in the plane are close in memory.
std::vector<Point> vertices_in_order(std::span<const Point> points, const std::vector<Index>& order) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Point> vertices;
    vertices.reserve(order.size() + 1);
    vertices.push_back({nan, nan});
    for (const Index i : order) vertices.push_back(points[i]);
    return vertices;
}

/// Makes a triangle of vertices 1, 2 and 3, and its three ghosts:
///
///      ghost 2 \    / ghost 1       The ghost across edge e has the hull edge v[e+2] -> v[e+1],
///               v[0]                with the outside on its left.
///              /    \.
///         v[1] ------ v[2]
///             ghost 0
void add_first_triangle(const Point* points, Tris& tris) {
    Index v[3] = {1, 2, 3};
    if (orient2d(points[1], points[2], points[3]) < 0) std::swap(v[1], v[2]);
    tris.resize(4);
    for (unsigned e = 0; e < 3; ++e) {
        tris[0].v[e] = v[e];
        Tri& outside = tris[1 + e];
        outside.v[0] = v[previous(e)];
        outside.v[1] = v[next(e)];
        outside.v[2] = growing_ghost_vertex;
        connect(tris, 0, e, Link(1 + e, 2));
    }
    for (unsigned e = 0; e < 3; ++e) {
        // Edge 0 of this ghost runs from v[e+1] to infinity; its neighbour is the ghost across edge e + 2, whose hull
        // edge starts at v[e+1].
        connect(tris, 1 + e, 0, Link(1 + previous(e), 1));
    }
}

/// Returns whether p lies strictly on the right of edge e of t, whose ends relative to p are a and b. Exact.
inline bool right_of(const Point* points, const Tri& t, unsigned e, Point a, Point b, Point p) {
    const double left = a.x * b.y, right = a.y * b.x;
    const double area2 = left - right;
    if (std::abs(area2) >= core::orient2d_bound * (std::abs(left) + std::abs(right))) return area2 < 0;
    return core::orient2d_after_filter(points[t.v[next(e)]], points[t.v[previous(e)]], p) < 0;
}

/// Returns a triangle whose circle holds p, or a triangle that has p as a vertex. Walks from `start`, which is no
/// ghost and has a vertex at `from`, towards p. The walk ends because the triangulation is Delaunay.
Index locate(const Point* points, const Tri* tris, Index start, Point from, Point p) {
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

/// Returns the new triangle that the next walk starts at, which is no ghost. From a needle the way would lead through
/// others, so where there may be needles the largest is taken. Areas of ghosts are NaN.
Index start_of_next_walk(const Tris& tris, const Cavity& cavity) {
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

/// Inserts the vertices from number 4 on.
void insert_vertices(std::span<const Point> vertices, std::span<const Point> points, const std::vector<Index>& order,
                     Tris& tris) {
    Cavity cavity;
    Index recent = 0;
    constexpr Index vertices_between_looks = 1u << 14;
    for (Index vertex = 4; vertex < vertices.size(); ++vertex) {
        if (vertex % vertices_between_looks == 0) core::check_interruption();
        const Point p = vertices[vertex];
        const Index start = locate(vertices.data(), tris.data(), recent, vertices[vertex - 1], p);
        const RelativeTriangle relative = relative_to(vertices.data(), tris[start], p);
        for (unsigned i = 0; i < 3; ++i)
            if (relative.r[i] == Point{}) fail_duplicate(points, order[tris[start].v[i] - 1], order[vertex - 1]);
        find_cavity<true>(vertices.data(), tris.data(), start, relative, p, cavity);
        fill_cavity(tris, cavity, vertex);
        recent = start_of_next_walk(tris, cavity);
    }
}

/// A triangulation in the numbers of vertices_in_order().
struct GrownTriangulation {
    std::vector<Point> vertices;
    Tris tris;  ///< empty where all points lie on one line
};

/// Inserts the points in this order, of which the first three may change to make the first triangle. Throws InputError
/// for duplicates.
GrownTriangulation grow(std::span<const Point> points, std::vector<Index>& order) {
    GrownTriangulation grown;
    if (order.size() < 3 || !bring_triangle_to_front(points, order)) {
        refuse_duplicates_on_line(points, order);
        return grown;
    }
    grown.vertices = vertices_in_order(points, order);
    grown.tris.reserve(2 * order.size());
    add_first_triangle(grown.vertices.data(), grown.tris);
    insert_vertices(grown.vertices, points, order, grown.tris);
    return grown;
}

/// Changes growing_ghost_vertex to ghost_vertex in all triangles round the vertex at infinity; `first` is one of them.
void renumber_ghost_vertex(Tris& tris, Index first) {
    Index t = first;
    do {
        Tri& tri = tris[t];
        const unsigned i = tri.v[0] == growing_ghost_vertex ? 0 : tri.v[1] == growing_ghost_vertex ? 1 : 2;
        tri.v[i] = ghost_vertex;
        t = tri.n[next(i)].triangle();
    } while (t != first);
}

}  // namespace

Tris triangulate_points(std::span<const Point> points, std::span<const std::uint32_t> stand_in) {
    check_points(points);
    Box box;
    for (const Point p : points) box.include(p);
    std::vector<Index> order = brio_order(points, box);
    if (!stand_in.empty()) std::erase_if(order, [&](Index i) { return stand_in[i] != i; });
    Tris tris = grow(points, order).tris;
    order.insert(order.begin(), ghost_vertex);  // now vertex v is the point order[v]
    for (Tri& t : tris)
        for (Index& v : t.v) v = order[v];
    return tris;
}

OrderedTriangulation triangulate_in_order(std::span<const Point> points, std::vector<Index>& order) {
    GrownTriangulation grown = grow(points, order);
    OrderedTriangulation result{std::move(grown.vertices), std::move(grown.tris), {}};
    if (result.tris.empty()) return result;
    result.at_vertex.resize(result.vertices.size());
    for (Index t = 0; t < result.tris.size(); ++t)
        for (const Index v : result.tris[t].v) result.at_vertex[v] = t;
    renumber_ghost_vertex(result.tris, result.at_vertex[growing_ghost_vertex]);
    return result;
}

Triangulation without_ghosts(const Tris& tris) {
    Triangulation result;
    result.triangles.reserve(tris.size());
    for (const Tri& t : tris)
        if (!t.is_ghost()) result.triangles.push_back({VertexId{t.v[0]}, VertexId{t.v[1]}, VertexId{t.v[2]}});
    return result;
}

}  // namespace lamina::delaunay
