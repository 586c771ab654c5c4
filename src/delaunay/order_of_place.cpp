// An order of triangles that does not depend on the numbers of vertices.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

Tris in_order_of_place(std::span<const Point> points, const Tris& tris) {
    const auto is_before = [](Point a, Point b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
    std::vector<std::uint8_t> first(tris.size(), 0);  // the corner of each triangle that becomes its first
    for (Index t = 0; t < tris.size(); ++t)
        for (std::uint8_t i = 1; i < 3; ++i)
            if (is_before(points[tris[t].v[i]], points[tris[t].v[first[t]]])) first[t] = i;
    std::vector<Index> order(tris.size());
    std::iota(order.begin(), order.end(), Index{0});
    std::sort(order.begin(), order.end(), [&](Index s, Index t) {
        for (unsigned i = 0; i < 3; ++i) {
            const Point a = points[tris[s].v[(first[s] + i) % 3]], b = points[tris[t].v[(first[t] + i) % 3]];
            if (a != b) return is_before(a, b);
        }
        return false;
    });
    std::vector<Index> place(tris.size());
    for (Index i = 0; i < order.size(); ++i) place[order[i]] = i;
    Tris result(tris.size());
    for (Index i = 0; i < order.size(); ++i) {
        const Tri& old = tris[order[i]];
        for (unsigned e = 0; e < 3; ++e) {
            const unsigned from = (first[order[i]] + e) % 3;
            const Link link = old.n[from];
            result[i].v[e] = old.v[from];
            if (link.is_border()) continue;
            const Index n = link.triangle();
            result[i].n[e] = Link(place[n], (link.edge() + 3 - first[n]) % 3, link.is_constrained());
        }
    }
    return result;
}

}  // namespace lamina::delaunay
