// Searches in an array of linked triangles.
#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count) {
    std::vector<Index> at(point_count, no_index);
    for (Index t = 0; t < tris.size(); ++t)
        for (Index v : tris[t].v)
            if (v != ghost_vertex) at[v] = t;
    return at;
}

Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b) {
    const Index start = at_vertex[a];
    Index t = start;
    do {
        const Tri& tri = tris[t];
        const unsigned i = tri.v[0] == a ? 0 : tri.v[1] == a ? 1 : 2;
        if (tri.v[next(i)] == b) return Link(t, previous(i));
        t = tri.n[next(i)].triangle();
    } while (t != start);
    return Link::border();
}

}  // namespace lamina::delaunay
