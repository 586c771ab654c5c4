// Selections are floods that stop at constrained edges.
#include "delaunay/constrain/regions.hpp"

#include <cassert>

#include <lamina/error.hpp>

#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/insert_segments.hpp"

namespace lamina::delaunay {

namespace {

/// Whether a flood passes through ghost triangles, or leaves them as they are.
enum class Ghosts { enter, avoid };

/// Sets the values of all triangles that can be reached from `start` without crossing a constrained edge. The flood
/// does not enter triangles that have the value already. `front` is scratch space.
template <Ghosts ghosts, class Value>
void flood(const Tris& tris, Index start, Value value, std::vector<Value>& selection, std::vector<Index>& front) {
    const auto reach = [&](Index t) {
        if (selection[t] == value || (ghosts == Ghosts::avoid && tris[t].is_ghost())) return;
        selection[t] = value;
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

/// Returns the triangle that holds p, or a ghost if p lies outside the hull. A walk that always tries the same edge
/// first may run in circles where the triangulation is not Delaunay, so the first edge to try is random.
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

/// Throws InputError if the seed lies on a vertex or on a constrained edge of the triangle that holds it.
void check_seed(std::span<const Point> points, const Tri& tri, Point seed, std::size_t index) {
    unsigned touched = 0;
    bool on_segment = false;
    for (unsigned e = 0; e < 3; ++e) {
        if (core::inline_orient2d(points[tri.v[next(e)]], points[tri.v[previous(e)]], seed) != 0) continue;
        ++touched;
        on_segment = on_segment || tri.n[e].is_constrained();
    }
    if (touched == 2 || on_segment)
        throw InputError({.at = seed, .seeds = {index}},
                         core::concat("hole ", index, " lies on a ", touched == 2 ? "vertex" : "segment"));
}

}  // namespace

TriangleSelection select_all(const Tris& tris) {
    TriangleSelection selection(tris.size());
    for (Index t = 0; t < tris.size(); ++t) selection[t] = !tris[t].is_ghost();
    return selection;
}

TriangleSelection select_inside_segments(const Tris& tris) {
    TriangleSelection selection = select_all(tris);
    std::vector<Index> front;
    for (const Tri& t : tris) {
        if (!t.is_ghost()) continue;
        for (unsigned e = 0; e < 3; ++e)
            if (t.v[e] == ghost_vertex && !t.n[e].is_constrained())
                flood<Ghosts::avoid>(tris, t.n[e].triangle(), char{0}, selection, front);
    }
    return selection;
}

TriangleSelection select_left_of_segments(std::span<const Segment> segments, const Tris& tris,
                                          std::size_t point_count) {
    const std::vector<Index> at_vertex = triangle_at_vertex(tris, point_count);
    TriangleSelection selection(tris.size(), 0);
    std::vector<Index> front;
    for (const Segment& s : segments) {
        const Link left = find_edge(tris, at_vertex, s.a.value, s.b.value);
        if (!left.is_border()) flood<Ghosts::avoid>(tris, left.triangle(), char{1}, selection, front);
    }
    return selection;
}

TriangleSelection select_region(OrderedTriangulation& triangulation, std::span<const Segment> border) {
    auto& [vertices, tris, at_vertex] = triangulation;
    const std::vector<SegmentPiece> pieces = insert_and_split_segments(vertices, border, tris, at_vertex);
    // Few triangles lie outside: it is quicker to flood these, through the ghosts, than the region.
    TriangleSelection selection(tris.size(), 1);
    std::vector<Index> front;
    for (const SegmentPiece& piece : pieces) {
        const Link right = find_edge(tris, at_vertex, piece.segment.b.value, piece.segment.a.value);
        flood<Ghosts::enter>(tris, right.triangle(), char{0}, selection, front);
    }
    return selection;
}

std::vector<std::size_t> deselect_holes(std::span<const Point> points, std::span<const Point> seeds, const Tris& tris,
                                        TriangleSelection& selection) {
    std::vector<std::size_t> idle;
    Index t = 0;
    while (t < tris.size() && tris[t].is_ghost()) ++t;
    std::vector<Index> front;
    for (std::size_t i = 0; i < seeds.size(); ++i) {
        const Index found = t == tris.size() ? no_index : locate(points, tris, t, seeds[i]);
        if (found == no_index || tris[found].is_ghost()) {
            idle.push_back(i);
            continue;
        }
        t = found;
        check_seed(points, tris[t], seeds[i], i);
        if (!selection[t]) idle.push_back(i);
        flood<Ghosts::avoid>(tris, t, char{0}, selection, front);
    }
    return idle;
}

std::vector<std::uint32_t> spread_values(const Tris& tris, std::span<const ValueSeed> seeds) {
    std::vector<std::uint32_t> values(tris.size(), no_index);
    std::vector<Index> front;
    // All triangles that a flood reaches have a value, or none has.
    for (const ValueSeed& seed : seeds)
        if (values[seed.triangle] == no_index) flood<Ghosts::avoid>(tris, seed.triangle, seed.value, values, front);
    return values;
}

Tris keep_selected(const Tris& tris, const TriangleSelection& selection) {
    assert(selection.size() == tris.size());
    std::vector<Index> renumbered(tris.size(), no_index);
    Index count = 0;
    for (Index t = 0; t < tris.size(); ++t)
        if (selection[t]) renumbered[t] = count++;
    Tris kept(count);
    for (Index t = 0; t < tris.size(); ++t) {
        if (!selection[t]) continue;
        Tri& copy = kept[renumbered[t]] = tris[t];
        for (Link& n : copy.n) {
            if (n.is_border()) continue;
            const Index other = renumbered[n.triangle()];
            n = other == no_index ? Link::border() : Link(other, n.edge(), n.is_constrained());
        }
    }
    assert(are_linked(kept));
    return kept;
}

Tris keep_left_of_segments(std::span<const Segment> segments, const Tris& tris, std::size_t point_count) {
    return keep_selected(tris, select_left_of_segments(segments, tris, point_count));
}

}  // namespace lamina::delaunay
