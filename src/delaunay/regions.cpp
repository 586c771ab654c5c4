// Which triangles of a constrained triangulation are kept: floods that stop at fixed edges.
#include <utility>

#include <lamina/error.hpp>

#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

namespace {

/// Gives `value` to all triangles that can be reached from `start` without crossing a fixed edge. What has the value
/// already is not entered.
void flood(const Tris& tris, Index start, char value, Marks& marks, std::vector<Index>& front) {
    const auto reach = [&](Index t) {
        if (marks[t] == value || tris[t].is_ghost()) return;
        marks[t] = value;
        front.push_back(t);
    };
    reach(start);
    while (!front.empty()) {
        const Tri& t = tris[front.back()];
        front.pop_back();
        for (Link n : t.n)
            if (!n.is_constrained()) reach(n.triangle());
    }
}

/// The triangle that holds p, a ghost where p is outside the hull. A walk that always takes the same edges first may
/// run in circles where the triangulation is not Delaunay: the first edge looked at changes by chance.
Index locate(std::span<const Point> points, const Tris& tris, Index start, Point p) {
    Index t = start;
    std::uint32_t random = 1;
    for (;;) {
        if (tris[t].is_ghost()) return t;
        random = random * 1664525u + 1013904223u;
        unsigned e = (random >> 16) % 3;
        unsigned tried = 0;
        for (; tried < 3; ++tried, e = next(e)) {
            const Tri& tri = tris[t];
            if (core::inline_orient2d(points[tri.v[next(e)]], points[tri.v[previous(e)]], p) < 0) break;
        }
        if (tried == 3) return t;
        t = tris[t].n[e].triangle();
    }
}

}  // namespace

Marks mark_all(const Tris& tris) {
    Marks marks(tris.size());
    for (Index t = 0; t < tris.size(); ++t) marks[t] = !tris[t].is_ghost();
    return marks;
}

Marks mark_inside_segments(const Tris& tris) {
    Marks marks = mark_all(tris);
    std::vector<Index> front;
    for (const Tri& t : tris) {
        if (!t.is_ghost()) continue;
        for (unsigned e = 0; e < 3; ++e)
            if (t.v[e] == ghost_vertex && !t.n[e].is_constrained()) flood(tris, t.n[e].triangle(), 0, marks, front);
    }
    return marks;
}

Marks mark_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count) {
    const std::vector<Index> at_vertex = triangle_at_vertex(tris, point_count);
    Marks marks(tris.size(), 0);
    std::vector<Index> front;
    for (const Segment& s : segments) {
        const Link left = find_edge(tris, at_vertex, s.a.value, s.b.value);
        if (!left.is_border()) flood(tris, left.triangle(), 1, marks, front);
    }
    return marks;
}

void carve_holes(std::span<const Point> points, std::span<const Point> seeds, const Tris& tris, Marks& marks) {
    Index t = 0;
    while (t < tris.size() && tris[t].is_ghost()) ++t;
    if (t == tris.size()) return;
    std::vector<Index> front;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const Index at = locate(points, tris, t, seeds[i]);
        if (tris[at].is_ghost()) continue;
        t = at;
        const Tri& tri = tris[t];
        unsigned touched = 0;
        bool on_segment = false;
        for (unsigned e = 0; e < 3; ++e) {
            if (core::inline_orient2d(points[tri.v[next(e)]], points[tri.v[previous(e)]], seeds[i]) != 0) continue;
            ++touched;
            on_segment = on_segment || tri.n[e].is_constrained();
        }
        if (touched == 2 || on_segment)
            throw InputError({.at = seeds[i]},
                             core::concat("hole ", i, " lies on a ", touched == 2 ? "vertex" : "segment"));
        flood(tris, t, 0, marks, front);
    }
}

Marks mark_region(OrderedTriangulation& triangulation, std::span<const Segment> border) {
    auto& [vertices, tris, at_vertex] = triangulation;
    const std::vector<SegmentPiece> pieces = insert_and_split_segments(vertices, border, tris, at_vertex);
    // What lies outside is little: it is flooded, through the ghosts, instead of the region.
    Marks marks(tris.size(), 1);
    std::vector<Index> front;
    const auto reach = [&](Index t) {
        if (std::exchange(marks[t], 0)) front.push_back(t);
    };
    for (const SegmentPiece& piece : pieces) {
        reach(find_edge(tris, at_vertex, piece.segment.b.value, piece.segment.a.value).triangle());
        while (!front.empty()) {
            const Tri& t = tris[front.back()];
            front.pop_back();
            for (Link n : t.n)
                if (!n.is_constrained()) reach(n.triangle());
        }
    }
    return marks;
}

Tris keep_marked(const Tris& tris, const Marks& marks) {
    std::vector<Index> renumbered(tris.size(), no_index);
    Index count = 0;
    for (Index t = 0; t < tris.size(); ++t)
        if (marks[t]) renumbered[t] = count++;
    Tris kept(count);
    for (Index t = 0; t < tris.size(); ++t) {
        if (!marks[t]) continue;
        Tri& copy = kept[renumbered[t]] = tris[t];
        for (Link& n : copy.n) {
            if (n.is_border()) continue;
            const Index other = renumbered[n.triangle()];
            n = other == no_index ? Link::border() : Link(other, n.edge(), n.is_constrained());
        }
    }
    return kept;
}

Tris keep_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count) {
    return keep_marked(tris, mark_left_of_segments(segments, tris, point_count));
}

}  // namespace lamina::delaunay
