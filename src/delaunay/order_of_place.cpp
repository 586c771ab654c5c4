// An order of triangles that does not depend on the numbers of vertices.
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "delaunay/triangles.hpp"

namespace lamina::delaunay {

namespace {

struct NumberedPoint {
    Point at;
    Index number;
};

bool is_before(const NumberedPoint& a, const NumberedPoint& b) {
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
}

/// Makes runs that ascend of those that do already and of those that descend, and returns where they end.
std::vector<std::size_t> make_runs(std::span<NumberedPoint> points) {
    std::vector<std::size_t> ends;
    for (std::size_t begin = 0; begin < points.size(); begin = ends.back()) {
        std::size_t end = begin + 1;
        if (end < points.size()) {
            const bool ascends = is_before(points[begin], points[end]);
            while (end < points.size() && is_before(points[end - 1], points[end]) == ascends) ++end;
            if (!ascends) std::reverse(points.begin() + begin, points.begin() + end);
        }
        ends.push_back(end);
    }
    return ends;
}

/// Returns the place of each point in the lexicographic order of all. Successive points of a border lie on few straight lines,
/// so they are long runs, which are merged. Source: D. E. Knuth, The Art of Computer Programming 3 (1998), 5.2.4, natural
/// merging.
std::vector<Index> ranks_of(std::span<const Point> points) {
    std::vector<NumberedPoint> sorted, merged(points.size());
    sorted.reserve(points.size());
    for (const Point p : points) sorted.push_back({p, static_cast<Index>(sorted.size())});
    for (std::vector<std::size_t> ends = make_runs(sorted); ends.size() > 1;) {
        std::vector<std::size_t> merged_ends;
        std::size_t begin = 0;
        for (std::size_t i = 0; i < ends.size(); i += 2) {
            const std::size_t middle = ends[i], end = i + 1 < ends.size() ? ends[i + 1] : middle;
            std::merge(sorted.begin() + begin, sorted.begin() + middle, sorted.begin() + middle, sorted.begin() + end,
                       merged.begin() + begin, is_before);
            merged_ends.push_back(begin = end);
        }
        sorted.swap(merged);
        ends = std::move(merged_ends);
    }
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
