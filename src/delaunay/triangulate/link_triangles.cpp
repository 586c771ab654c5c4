// Neighbours meet in a list of edges that is sorted by the vertices of the edges.
#include "delaunay/triangulate/link_triangles.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace lamina::delaunay {

Tris link_triangles(std::span<const Triangle> triangles, std::span<const Segment> segments) {
    Tris tris(triangles.size());
    std::vector<std::pair<std::uint64_t, Link>> edges;
    edges.reserve(3 * triangles.size());
    for (Index t = 0; t < tris.size(); ++t) {
        for (unsigned e = 0; e < 3; ++e) tris[t].v[e] = triangles[t].v[e].value;
        for (unsigned e = 0; e < 3; ++e)
            edges.emplace_back(undirected_key(tris[t].v[next(e)], tris[t].v[previous(e)]), Link(t, e));
    }
    const auto by_key = [](const auto& l, const auto& r) { return l.first < r.first; };
    std::sort(edges.begin(), edges.end(), by_key);
    for (std::size_t i = 0; i + 1 < edges.size(); ++i)
        if (edges[i].first == edges[i + 1].first)
            connect(tris, edges[i].second.triangle(), edges[i].second.edge(), edges[i + 1].second);
    for (const Segment& s : segments) {
        const std::pair key{undirected_key(s.a.value, s.b.value), Link()};
        const auto edge = std::lower_bound(edges.begin(), edges.end(), key, by_key);
        if (edge == edges.end() || edge->first != key.first) continue;
        const Link link = edge->second;
        if (!tris[link.triangle()].n[link.edge()].is_border()) constrain_edge(tris, link.triangle(), link.edge());
    }
    assert(are_linked(tris));
    return tris;
}

}  // namespace lamina::delaunay
