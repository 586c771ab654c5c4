#include "remeshing/metric_mesh.hpp"

#include <cassert>

#include <lamina/error.hpp>

namespace lamina::remeshing {

void refuse_more_triangles() { throw MeshError("the metric asks for more than 2^29 triangles"); }

std::uint32_t MetricMesh::new_triangle() {
    if (unused_.empty()) {
        if (triangles.size() >= most_triangles) refuse_more_triangles();
        triangles.emplace_back();
        return static_cast<std::uint32_t>(triangles.size() - 1);
    }
    const std::uint32_t t = unused_.back();
    unused_.pop_back();
    return t;
}

void MetricMesh::renumber() {
    std::vector<std::uint32_t> order, number(triangles.size(), no_index), vertex_number(vertices.size(), no_index);
    order.reserve(triangles.size());
    const auto visit = [&](std::uint32_t t) {
        if (!triangles[t].is_used() || number[t] != no_index) return;
        number[t] = static_cast<std::uint32_t>(order.size());
        order.push_back(t);
    };
    std::vector<MeshVertex> new_vertices;
    new_vertices.reserve(vertices.size());
    std::size_t at = 0;
    for (std::uint32_t start = 0; start < triangles.size(); ++start) {
        visit(start);
        for (; at < order.size(); ++at)
            for (const EdgeHandle behind : triangles[order[at]].n)
                if (!is_border(behind)) visit(triangle_of(behind));
    }
    std::vector<MeshTriangle> new_triangles;
    new_triangles.reserve(order.size());
    for (const std::uint32_t t : order) {
        MeshTriangle triangle = triangles[t];
        for (unsigned i = 0; i < 3; ++i) {
            const std::uint32_t v = triangle.v[i];
            if (vertex_number[v] == no_index) {
                vertex_number[v] = static_cast<std::uint32_t>(new_vertices.size());
                new_vertices.push_back(vertices[v]);
                new_vertices.back().triangle = number[t];
            }
            triangle.v[i] = vertex_number[v];
            if (!is_border(triangle.n[i]))
                triangle.n[i] = edge_link(number[triangle_of(triangle.n[i])], edge_of(triangle.n[i]));
        }
        new_triangles.push_back(triangle);
    }
    vertices = std::move(new_vertices);
    triangles = std::move(new_triangles);
    unused_.clear();
}

void MetricMesh::renew(std::uint32_t t) {
    MeshTriangle& triangle = triangles[t];
    MeshVertex &a = vertices[triangle.v[0]], &b = vertices[triangle.v[1]], &c = vertices[triangle.v[2]];
    assert(turns_left(a.at, b.at, c.at));
    triangle.distortion = static_cast<float>(distortion(a, b, c));
    triangle.is_settled = a.is_settled = b.is_settled = c.is_settled = false;
}

void MetricMesh::collect_ring(std::uint32_t v, Ring& ring) const {
    ring.clear();
    std::uint32_t t = vertices[v].triangle;
    const auto corner_in = [&](std::uint32_t triangle) {
        const auto& corners = triangles[triangle].v;
        return corners[0] == v ? 0u : corners[1] == v ? 1u : 2u;
    };
    unsigned i = corner_in(t);
    if (vertices[v].freedom != Freedom::free) {
        // Clockwise to the border: across the edge from the vertex to corner i + 1, which is opposite corner i + 2.
        for (EdgeHandle behind = triangles[t].n[before(i)]; !is_border(behind); behind = triangles[t].n[before(i)]) {
            t = triangle_of(behind);
            i = corner_in(t);
        }
    }
    const std::uint32_t first = t;
    do {
        ring.push_back(edge_link(t, i));
        const EdgeHandle behind = triangles[t].n[after(i)];
        if (is_border(behind)) break;
        t = triangle_of(behind);
        i = after(edge_of(behind));
    } while (t != first);
}

MetricMesh::TwoTriangles MetricMesh::triangles_at(EdgeHandle h) const {
    const EdgeHandle behind = triangles[triangle_of(h)].n[edge_of(h)];
    const MeshTriangle &t = triangles[triangle_of(h)], &u = triangles[triangle_of(behind)];
    const unsigned e = edge_of(h), f = edge_of(behind);
    return {triangle_of(h), triangle_of(behind), t.v[e],         t.v[after(e)], t.v[before(e)],
            u.v[f],         t.n[after(e)],       t.n[before(e)], u.n[after(f)], u.n[before(f)]};
}

std::uint32_t MetricMesh::divide(EdgeHandle h, const MeshVertex& vertex) {
    if (is_border(triangles[triangle_of(h)].n[edge_of(h)])) return divide_border(h, vertex);
    //        a                  a
    //      / t \              / | \          The handles of a-b and of d-c stay; edges of t and u that lead to c and b
    //    b ----- c    ->    b - p - c        pass to the new triangles.
    //      \ u /              \ | /
    //        d                  d
    const auto [t, u, a, b, c, d, to_ca, to_ab, to_bd, to_dc] = triangles_at(h);
    const Point p = vertex.at;
    if (!turns_left(point(a), point(b), p) || !turns_left(point(a), p, point(c))) return no_index;
    if (!turns_left(point(d), point(c), p) || !turns_left(point(d), p, point(b))) return no_index;
    const auto v = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    const std::uint32_t t2 = new_triangle(), u2 = new_triangle();
    set_corners(t2, a, v, c);
    set_corners(u2, d, v, b);
    set_corners(t, a, b, v);
    set_corners(u, d, c, v);
    link(t, 0, edge_link(u2, 0));
    link(t, 1, edge_link(t2, 2));
    link(t, 2, to_ab);
    link(t2, 0, edge_link(u, 0));
    link(t2, 1, to_ca);
    link(u, 1, edge_link(u2, 2));
    link(u, 2, to_dc);
    link(u2, 1, to_bd);
    for (const std::uint32_t changed : {t, t2, u, u2}) renew(changed);
    return v;
}

std::uint32_t MetricMesh::divide_border(EdgeHandle h, const MeshVertex& vertex) {
    //        a                  a
    //      / t \              / | \          The handle of a-b stays.
    //    b ----- c    ->    b - p - c
    const std::uint32_t t = triangle_of(h);
    const unsigned e = edge_of(h);
    const std::uint32_t a = triangles[t].v[e], b = triangles[t].v[after(e)], c = triangles[t].v[before(e)];
    const EdgeHandle border = triangles[t].n[e], to_ca = triangles[t].n[after(e)], to_ab = triangles[t].n[before(e)];
    if (!turns_left(point(a), point(b), vertex.at) || !turns_left(point(a), vertex.at, point(c))) return no_index;
    const auto v = static_cast<std::uint32_t>(vertices.size());
    vertices.push_back(vertex);
    const std::uint32_t t2 = new_triangle();
    set_corners(t, a, b, v);
    set_corners(t2, a, v, c);
    link(t, 0, border);
    link(t, 1, edge_link(t2, 2));
    link(t, 2, to_ab);
    link(t2, 0, border);
    link(t2, 1, to_ca);
    renew(t);
    renew(t2);
    return v;
}

void MetricMesh::swap(EdgeHandle h, float first, float second) {
    //        a                 a
    //      / t \             / | \           The handles of the edge are those of a-d afterwards.
    //    b ----- c   ->    b t | u c
    //      \ u /             \ | /
    //        d                 d
    const auto [t, u, a, b, c, d, to_ca, to_ab, to_bd, to_dc] = triangles_at(h);
    assert(turns_left(point(a), point(b), point(d)) && turns_left(point(a), point(d), point(c)));
    set_corners(t, a, b, d);
    set_corners(u, a, d, c);
    link(t, 0, to_bd);
    link(t, 1, edge_link(u, 2));
    link(t, 2, to_ab);
    link(u, 0, to_dc);
    link(u, 1, to_ca);
    triangles[t].distortion = first;
    triangles[u].distortion = second;
    triangles[t].is_settled = triangles[u].is_settled = false;
    for (const std::uint32_t v : {a, b, c, d}) vertices[v].is_settled = false;
}

void MetricMesh::contract(std::uint32_t v, const Ring& ring, std::uint32_t onto) {
    //    y ------ x            y ------ x
    //    | \    / |            |      / |       The triangles at the edge v-w vanish, and their other neighbours meet.
    //    |   v    |     ->     |   /    |       On a line there is one of them, and the border behind v-w passes on.
    //    | /    \ |            | /      |
    //    w ------ z            w ------ z
    for (const EdgeHandle h : ring) {
        const std::uint32_t t = triangle_of(h);
        const unsigned i = edge_of(h);
        MeshTriangle& triangle = triangles[t];
        if (triangle.v[after(i)] != onto && triangle.v[before(i)] != onto) {
            triangle.v[i] = onto;
            continue;
        }
        // The edge that leads to `onto` and the one that leads from the third corner to v become one.
        const unsigned w = triangle.v[after(i)] == onto ? after(i) : before(i);
        const unsigned x = 3 - i - w;
        const EdgeHandle beyond = triangle.n[i], inside = triangle.n[w];
        link(triangle_of(inside), edge_of(inside), beyond);
        vertices[triangle.v[x]].triangle = vertices[onto].triangle = triangle_of(inside);
        triangle.v[0] = no_index;
        unused_.push_back(t);
    }
    vertices[v].triangle = no_index;
    for (const EdgeHandle h : ring)
        if (triangles[triangle_of(h)].is_used()) renew(triangle_of(h));
}

void MetricMesh::move(std::uint32_t v, const Ring& ring, const MeshVertex& moved, std::span<const float> distortions) {
    vertices[v] = moved;
    vertices[v].is_settled = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        MeshTriangle& triangle = triangles[triangle_of(ring[i])];
        triangle.distortion = distortions[i];
        triangle.is_settled = false;
        vertices[triangle.v[after(edge_of(ring[i]))]].is_settled = false;
        assert(turns_left(point(triangle.v[0]), point(triangle.v[1]), point(triangle.v[2])));
    }
}

}  // namespace lamina::remeshing
