// The number of turns is 0 outside the hull and changes across segments alone, by 1 for each that crosses the way.
#include "delaunay/constrain/winding.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include <lamina/error.hpp>

#include "core/arguments.hpp"
#include "core/text.hpp"

namespace lamina::delaunay {

void check_closed_loops(std::span<const Segment> segments, std::size_t point_count, WindingRule rule) {
    const bool directed = rule == WindingRule::non_zero;
    std::vector<std::int64_t> balance(point_count, 0);
    for (const Segment& s : segments) {
        ++balance[s.a.index()];
        balance[s.b.index()] += directed ? -1 : 1;
    }
    const auto is_open = [&](std::int64_t b) { return directed ? b != 0 : b % 2 != 0; };
    for (std::size_t i = 0; i < segments.size(); ++i)
        for (const VertexId v : {segments[i].a, segments[i].b})
            if (is_open(balance[v.index()]))
                throw InputError(
                    {.points = {v.index()}, .segments = {i}},
                    core::concat("the segments form no closed loops: ", core::segment_name(segments, i),
                                 " ends at point ", v.value,
                                 directed ? ", where as many should start as end" : ", where an odd number meets"));
}

TriangleSelection select_by_winding(const std::vector<SegmentPiece>& pieces, const Tris& tris, std::size_t point_count,
                                    WindingRule rule) {
    const std::vector<Index> at_vertex = triangle_at_vertex(tris, point_count);
    // What the number of turns grows by on the way into a triangle across each of its edges.
    std::vector<std::int32_t> growth(3 * tris.size(), 0);
    const auto growth_across = [&](Link edge) -> std::int32_t& { return growth[3 * edge.triangle() + edge.edge()]; };
    for (const SegmentPiece& piece : pieces) {
        const Link left = find_edge(tris, at_vertex, piece.segment.a.value, piece.segment.b.value);
        ++growth_across(left);
        --growth_across(tris[left.triangle()].n[left.edge()]);
    }
    constexpr std::int32_t unknown = std::numeric_limits<std::int32_t>::min();
    std::vector<std::int32_t> turns(tris.size(), unknown);
    std::vector<Index> front;
    for (Index t = 0; t < tris.size(); ++t) {
        if (!tris[t].is_ghost()) continue;
        turns[t] = 0;
        front.push_back(t);
    }
    while (!front.empty()) {
        const Index t = front.back();
        front.pop_back();
        for (const Link n : tris[t].n) {
            if (turns[n.triangle()] != unknown) continue;
            turns[n.triangle()] = turns[t] + growth_across(n);
            front.push_back(n.triangle());
        }
    }
    TriangleSelection selection(tris.size(), 0);
    for (Index t = 0; t < tris.size(); ++t)
        selection[t] = !tris[t].is_ghost() && (rule == WindingRule::non_zero ? turns[t] != 0 : turns[t] % 2 != 0);
    return selection;
}

}  // namespace lamina::delaunay
