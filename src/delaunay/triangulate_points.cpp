// Plain Delaunay triangulation by cavity insertion in biased randomised order.
// Sources: N. Amenta, S. Choi, G. Rote, SoCG 2003 (order); A. Bowyer, D. F. Watson, The Computer Journal 24 (1981)
// (cavities); the tie rule makes every intermediate triangulation the unique one of its points (docs/decisions/0001).
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/text.hpp"
#include "delaunay/brio.hpp"
#include "delaunay/cavity.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

namespace {

[[noreturn]] void fail_duplicate(std::span<const Point> points, Index a, Index b) {
    throw InputError({.at = points[a], .points = {std::min(a, b), std::max(a, b)}},
                     core::concat("points ", std::min(a, b), " and ", std::max(a, b), " are the same"));
}

void check_points(std::span<const Point> points) {
    if (points.size() > max_triangles / 2)
        throw InputError(
            {}, core::concat(points.size(), " points are more than the ", max_triangles / 2, " of one triangulation"));
    bool in_range = true;
    for (const Point p : points) in_range &= in_exact_range(p);
    if (in_range) return;
    const auto bad = std::find_if_not(points.begin(), points.end(), [](Point p) { return in_exact_range(p); });
    const auto index = static_cast<std::size_t>(bad - points.begin());
    throw InputError({.at = *bad, .points = {index}},
                     core::concat("point ", index, " is outside the range of exact arithmetic"));
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

void refuse_duplicates_on_line(std::span<const Point> points, std::vector<Index> order) {
    std::sort(order.begin(), order.end(), [&](Index a, Index b) {
        return points[a] == points[b] ? a < b : lexicographically_less(points[a], points[b]);
    });
    for (std::size_t i = 1; i < order.size(); ++i)
        if (points[order[i - 1]] == points[order[i]]) fail_duplicate(points, order[i - 1], order[i]);
}

/// Vertices are numbered from 1 in the order of insertion while the triangulation grows, so that what is near in the
/// plane is near in memory; number 0 is the ghost.
std::vector<Point> vertices_in_order(std::span<const Point> points, const std::vector<Index>& order) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Point> vertices;
    vertices.reserve(order.size() + 1);
    vertices.push_back({nan, nan});
    for (const Index i : order) vertices.push_back(points[i]);
    return vertices;
}

/// One triangle and its three ghosts:
///
///      ghost 2 \    / ghost 1       real edge of the ghost across edge e: v[e+2] -> v[e+1],
///               v[0]                outside on its left
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
        outside.v[2] = ghost;
        connect(tris, 0, e, Link(1 + e, 2));
    }
    for (unsigned e = 0; e < 3; ++e) {
        // Ghost edge 0 runs v[e+1] -> infinity; its neighbour is the ghost across edge e + 2, which starts there.
        connect(tris, 1 + e, 0, Link(1 + previous(e), 1));
    }
}

/// Is p strictly on the right of edge e of t? a and b are its ends relative to p.
inline bool right_of(const Point* points, const Tri& t, unsigned e, Point a, Point b, Point p) {
    const double left = a.x * b.y, right = a.y * b.x;
    const double area2 = left - right;
    if (std::abs(area2) > core::orient2d_bound * (std::abs(left) + std::abs(right))) return area2 < 0;
    return core::orient2d_after_filter(points[t.v[next(e)]], points[t.v[previous(e)]], p) < 0;
}

/// A triangle in conflict with p, found by walking from `start` (no ghost) towards p; or the triangle of which p is a
/// vertex. The walk ends because the triangulation is Delaunay.
Index locate(const Point* points, const Tri* tris, Index start, Point p) {
    unsigned e = 0;
    Point a, b;
    for (;; ++e) {
        if (e == 3) return start;
        a = points[tris[start].v[next(e)]] - p;
        b = points[tris[start].v[previous(e)]] - p;
        if (right_of(points, tris[start], e, a, b, p)) break;
    }
    Link across = tris[start].n[e];
    for (;;) {
        // Entered (b, a, w) through its edge k, p being on its side of a -> b:
        //        a
        //      / | \      p is on the right of a -> w: go on there; of w -> b: there; of neither: found
        //     o  |  w
        //      \ | /
        //        b
        const Tri& t = tris[across.triangle()];
        const unsigned k = across.edge();
        if (t.v[k] == ghost) return across.triangle();
        const Point w = points[t.v[k]] - p;
        if (right_of(points, t, next(k), a, w, p)) {
            across = t.n[next(k)];
            b = w;
        } else if (right_of(points, t, previous(k), w, b, p)) {
            across = t.n[previous(k)];
            a = w;
        } else {
            return across.triangle();
        }
    }
}

/// Inserts the vertices from number 4 on.
void insert_vertices(std::span<const Point> vertices, std::span<const Point> points, const std::vector<Index>& order,
                     Tris& tris) {
    Cavity cavity;
    Index recent = 0;
    for (Index vertex = 4; vertex < vertices.size(); ++vertex) {
        const Point p = vertices[vertex];
        const Index start = locate(vertices.data(), tris.data(), recent, p);
        const SeenTriangle seen = see(vertices.data(), tris[start], p);
        for (unsigned i = 0; i < 3; ++i)
            if (seen.r[i] == Point{}) fail_duplicate(points, order[tris[start].v[i] - 1], order[vertex - 1]);
        find_cavity<true>(vertices.data(), tris.data(), start, seen, p, cavity);
        fill_cavity(tris, cavity, vertex);
        // A real triangle of the fan: ghosts hold the ghost at 1 or 2.
        for (std::size_t i = 0;; ++i) {
            recent = cavity.triangles.data()[i];
            if (tris[recent].v[1] != ghost && tris[recent].v[2] != ghost) break;
        }
    }
}

/// A triangulation as it grows: vertices as vertices_in_order() numbers them.
struct Grown {
    std::vector<Point> vertices;
    Tris tris;
};

/// No triangles where all points are on one line. The order may change in its first three places.
Grown grow(std::span<const Point> points, std::vector<Index>& order) {
    Grown grown;
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

/// Gives the vertex at infinity its usual number in all triangles round it.
void name_ghosts(Tris& tris, Index first) {
    Index t = first;
    do {
        Tri& tri = tris[t];
        const unsigned i = tri.v[0] == ghost ? 0 : tri.v[1] == ghost ? 1 : 2;
        tri.v[i] = ghost_vertex;
        t = tri.n[next(i)].triangle();
    } while (t != first);
}

}  // namespace

Tris triangulate_points(std::span<const Point> points) {
    check_points(points);
    Box box;
    for (const Point p : points) box.include(p);
    std::vector<Index> order = insertion_order(points, box);
    Tris tris = grow(points, order).tris;
    order.insert(order.begin(), ghost_vertex);
    for (Tri& t : tris)
        for (Index& v : t.v) v = order[v];
    return tris;
}

OrderedTriangulation triangulate_in_order(std::span<const Point> points, std::vector<Index>& order) {
    Grown grown = grow(points, order);
    OrderedTriangulation result{std::move(grown.vertices), std::move(grown.tris), {}};
    if (result.tris.empty()) return result;
    result.at_vertex.resize(result.vertices.size());
    for (Index t = 0; t < result.tris.size(); ++t)
        for (const Index v : result.tris[t].v) result.at_vertex[v] = t;
    name_ghosts(result.tris, result.at_vertex[ghost]);
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
