// The steps by which a plain Delaunay triangulation grows.
#include "delaunay/triangulate/growing.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/interruption_point.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/triangulate/conditions.hpp"

namespace lamina::delaunay {

namespace {

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
    std::vector<Point> vertices(order.size() + 1);
    vertices[0] = {nan, nan};
    core::parallel_for(order.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) vertices[i + 1] = points[order[i]];
    });
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
    assert(tris.empty() && orient2d(points[1], points[2], points[3]) != 0);
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
    assert(are_linked(tris));
}

}  // namespace

void fail_duplicate(std::span<const Point> points, Index a, Index b) {
    throw InputError({.at = points[a], .points = {std::min(a, b), std::max(a, b)}},
                     core::concat("points ", std::min(a, b), " and ", std::max(a, b), " are the same"));
}

GrowingTriangulation begin_to_grow(std::span<const Point> points, std::vector<Index>& order) {
    GrowingTriangulation grown;
    if (order.size() < 3 || !bring_triangle_to_front(points, order)) {
        refuse_duplicates_on_line(points, order);
        return grown;
    }
    grown.vertices = vertices_in_order(points, order);
    grown.tris.reserve(2 * order.size());
    add_first_triangle(grown.vertices.data(), grown.tris);
    return grown;
}

void insert_vertices(std::span<const Point> points, std::span<const Index> order, std::size_t first, std::size_t last,
                     GrowingTriangulation& grown) {
    const Point* const vertices = grown.vertices.data();
    Tris& tris = grown.tris;
    assert(last < grown.vertices.size() && last <= order.size() && is_sphere(tris, first - 1));
    Cavity cavity;
    Index recent = beside_ghost(tris, 0);
    Point from = vertices[tris[recent].v[0]];
    constexpr Index vertices_between_looks = 1u << 14;
    for (auto vertex = static_cast<Index>(first); vertex <= last; ++vertex) {
        if (vertex % vertices_between_looks == 0) core::check_interruption();
        const Point p = vertices[vertex];
        const Index start = find_place<false>(vertices, tris.data(), recent, from, p);
        const RelativeTriangle relative = relative_to(vertices, tris[start], p);
        if (const Index equal = vertex_at_point(tris[start], relative); equal != no_index)
            fail_duplicate(points, order[equal - 1], order[vertex - 1]);
        find_cavity<true>(vertices, tris.data(), start, relative, p, cavity);
        assert(is_star(grown.vertices, cavity, p, growing_ghost_vertex));
        fill_cavity(tris, cavity, vertex);
        recent = start_of_next_walk(tris, cavity);
        from = p;
    }
    assert(is_sphere(tris, last));
}

}  // namespace lamina::delaunay
