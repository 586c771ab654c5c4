// An order of triangles that does not depend on the numbers of vertices.
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "core/bounding_box.hpp"
#include "core/rounding.hpp"
#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

namespace {

struct NumberedPoint {
    Point at;
    Index number;
};

bool is_before(const NumberedPoint& a, const NumberedPoint& b) {
    return a.at.x != b.at.x ? a.at.x < b.at.x : a.at.y < b.at.y;
}

/// Returns the points with coordinates rounded to whole multiples of a length that is small beside the region and its
/// distance from the origin: of points one above the other, rounding must not decide which is on the left.
std::vector<NumberedPoint> rounded(std::span<const Point> points) {
    std::vector<NumberedPoint> result;
    if (points.empty()) return result;
    Box box = core::bounding_box(points);
    box.include({});
    const double per_length = 0x1p38 / core::longer_side(box);
    result.reserve(points.size());
    for (const Point p : points)
        result.push_back({core::rounded_to_multiples(per_length * p, 1), static_cast<Index>(result.size())});
    return result;
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

/// Returns the place of each point in the lexicographic order of all. Successive points of a border lie on few straight
/// lines, so they are long runs, which are merged. Source: D. E. Knuth, The Art of Computer Programming 3 (1998),
/// 5.2.4, natural merging.
std::vector<Index> ranks_of(std::span<const Point> points) {
    std::vector<NumberedPoint> sorted = rounded(points), merged(points.size());
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

// Points are distinct, and a directed edge has one triangle on its left: the first two vertices of a triangle decide
// its place. They are those of an edge of the border where it has one: of four points on a circle, and two edges of the
// border between them, rounding decides which diagonal the triangles share, but not which edges they stand on.
Tris in_order_of_place(std::span<const Point> points, const Tris& tris) {
    assert(are_linked(tris));
    const std::vector<Index> rank = ranks_of(points);
    const auto starts_border = [&](Index t, unsigned corner) { return tris[t].n[previous(corner)].is_constrained(); };
    std::vector<std::uint8_t> first(tris.size());  // the corner of each triangle that becomes its first
    std::vector<Index> key(tris.size());           // triangles at the border before others, by the rank of this corner
    std::vector<Index> start(2 * points.size() + 1, 0);  // for each key, where its triangles begin
    for (Index t = 0; t < tris.size(); ++t) {
        key[t] = no_index;
        for (std::uint8_t i = 0; i < 3; ++i) {
            const Index place = rank[tris[t].v[i]] + (starts_border(t, i) ? 0 : static_cast<Index>(points.size()));
            if (place >= key[t]) continue;
            key[t] = place;
            first[t] = i;
        }
        ++start[key[t] + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Index> order(tris.size()), next_place(start.begin(), start.end() - 1);
    for (Index t = 0; t < tris.size(); ++t) order[next_place[key[t]]++] = t;
    const auto second = [&](Index t) { return rank[tris[t].v[next(first[t])]]; };
    for (std::size_t k = 0; k + 1 < start.size(); ++k)
        std::sort(order.begin() + start[k], order.begin() + start[k + 1],
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
    assert(are_linked(result));
    return result;
}

}  // namespace lamina::delaunay
