// An order of triangles that does not depend on the numbers of vertices.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

namespace {

/// Returns the place of each point in the lexicographic order of all.
std::vector<Index> ranks_of(std::span<const Point> points) {
    struct NumberedPoint {
        Point at;
        Index number;
    };
    std::vector<NumberedPoint> sorted;
    sorted.reserve(points.size());
    for (const Point p : points) sorted.push_back({p, static_cast<Index>(sorted.size())});
    std::sort(sorted.begin(), sorted.end(), [](const NumberedPoint& a, const NumberedPoint& b) {
        return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
    });
    std::vector<Index> ranks(points.size());
    for (Index i = 0; i < sorted.size(); ++i) ranks[sorted[i].number] = i;
    return ranks;
}

}  // namespace

// Points are distinct, and a directed edge has one triangle on its left: the first two vertices of a triangle, the first
// being the lowest of the three, decide its place.
Tris in_order_of_place(std::span<const Point> points, const Tris& tris) {
    const std::vector<Index> rank = ranks_of(points);
    std::vector<std::uint8_t> first(tris.size(), 0);  // the corner of each triangle that becomes its first
    std::vector<Index> start(points.size() + 1, 0);   // for each rank, where the triangles begin whose lowest it is
    for (Index t = 0; t < tris.size(); ++t) {
        for (std::uint8_t i = 1; i < 3; ++i)
            if (rank[tris[t].v[i]] < rank[tris[t].v[first[t]]]) first[t] = i;
        ++start[rank[tris[t].v[first[t]]] + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> order(tris.size()), next(start.begin(), start.end() - 1);
    for (Index t = 0; t < tris.size(); ++t) order[next[rank[tris[t].v[first[t]]]]++] = t;
    const auto second = [&](Index t) { return rank[tris[t].v[(first[t] + 1) % 3]]; };
    for (std::size_t r = 0; r < points.size(); ++r)
        std::sort(order.begin() + start[r], order.begin() + start[r + 1],
                  [&](Index s, Index t) { return second(s) < second(t); });
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
