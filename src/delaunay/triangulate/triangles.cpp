// Searches and flips in an array of linked triangles.
#include "delaunay/triangulate/triangles.hpp"

#include <cassert>

namespace lamina::delaunay {

void flip_edge(Tris& tris, Index t, unsigned e) {
    assert(t < tris.size() && e < 3 && !tris[t].n[e].is_constrained());
    const Tri above = tris[t];
    const Index n = above.n[e].triangle();
    const unsigned k = above.n[e].edge();
    const Tri below = tris[n];
    assert(is_linked(tris, t) && is_linked(tris, n));
    assert(t != n && above.v[e] != below.v[k]);
    const Index a = above.v[next(e)], b = above.v[previous(e)], c = above.v[e], d = below.v[k];
    tris[t] = {{c, a, d}, {{}, Link(n, 2), {}}};
    tris[n] = {{c, d, b}, {{}, {}, Link(t, 1)}};
    connect(tris, t, 0, below.n[next(k)]);
    connect(tris, t, 2, above.n[previous(e)]);
    connect(tris, n, 0, below.n[previous(k)]);
    connect(tris, n, 1, above.n[next(e)]);
    assert(is_linked(tris, t) && is_linked(tris, n));
}

std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count) {
    std::vector<Index> at(point_count, no_index);
    for (Index t = 0; t < tris.size(); ++t)
        for (Index v : tris[t].v)
            if (v != ghost_vertex) at[v] = t;
    return at;
}

Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b) {
    // The turns round b begin late, since few vertices have more edges than this and at_vertex[b] is far in memory.
    constexpr unsigned many_edges = 32;
    const Index start_a = at_vertex[a];
    Index at_a = start_a, at_b = no_index, start_b = no_index;
    unsigned steps = 0;
    do {
        const Tri& tri = tris[at_a];
        const unsigned i = tri.v[0] == a ? 0 : tri.v[1] == a ? 1 : 2;
        if (tri.v[next(i)] == b) return Link(at_a, previous(i));
        at_a = tri.n[next(i)].triangle();
        if (++steps < many_edges) continue;
        if (steps == many_edges) at_b = start_b = at_vertex[b];
        const Tri& other = tris[at_b];
        const unsigned k = other.v[0] == b ? 0 : other.v[1] == b ? 1 : 2;
        if (other.v[previous(k)] == a) return Link(at_b, next(k));
        at_b = other.n[next(k)].triangle();
        if (at_b == start_b) break;
    } while (at_a != start_a);
    return Link::border();
}

}  // namespace lamina::delaunay
