// Plain Delaunay triangulation inserts points one by one in BRIO, each by its cavity. The tie rule makes every
// intermediate triangulation the unique one of its points (docs/decisions/0001).
// Source: N. Amenta, S. Choi, G. Rote, SoCG 2003 (order). growing.hpp has the cavities.
#include "delaunay/triangulate/triangulate_points.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/brio.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/growing.hpp"

namespace lamina::delaunay {

namespace {

GrowingTriangulation grow(std::span<const Point> points, std::vector<Index>& order) {
    GrowingTriangulation grown = begin_to_grow(points, order);
    if (!grown.tris.empty()) insert_vertices(points, order, 4, order.size(), grown);
    return grown;
}

/// Changes growing_ghost_vertex to ghost_vertex in all triangles round the vertex at infinity; `first` is one of them.
void renumber_ghost_vertex(Tris& tris, Index first) {
    Index t = first;
    do {
        Tri& tri = tris[t];
        assert(has_corner(tri, growing_ghost_vertex));
        const unsigned i = tri.v[0] == growing_ghost_vertex ? 0 : tri.v[1] == growing_ghost_vertex ? 1 : 2;
        tri.v[i] = ghost_vertex;
        t = tri.n[next(i)].triangle();
    } while (t != first);
}

}  // namespace

Tris triangulate_points(std::span<const Point> points, std::span<const std::uint32_t> stand_in) {
    check_points(points);
    assert(stand_in.empty() || stand_in.size() == points.size());
    Box box;
    for (const Point p : points) box.include(p);
    std::vector<Index> order = brio_order(points, box);
    if (!stand_in.empty()) std::erase_if(order, [&](Index i) { return stand_in[i] != i; });
    Tris tris = grow(points, order).tris;
    assert(is_sphere(tris, order.size()) && are_linked(tris));
    order.insert(order.begin(), ghost_vertex);  // now vertex v is the point order[v]
    for (Tri& t : tris)
        for (Index& v : t.v) v = order[v];
    return tris;
}

OrderedTriangulation triangulate_in_order(std::span<const Point> points, std::vector<Index>& order) {
    GrowingTriangulation grown = grow(points, order);
    OrderedTriangulation result{std::move(grown.vertices), std::move(grown.tris), {}};
    if (result.tris.empty()) return result;
    result.at_vertex.resize(result.vertices.size());
    for (Index t = 0; t < result.tris.size(); ++t)
        for (const Index v : result.tris[t].v) result.at_vertex[v] = t;
    renumber_ghost_vertex(result.tris, result.at_vertex[growing_ghost_vertex]);
    assert(is_sphere(result.tris, order.size()));
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
