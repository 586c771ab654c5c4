// Removal of a vertex. The triangles round it leave a polygon that is star-shaped from it. Ears are cut off this
// polygon, in the order in which they would appear if the vertex rose from the paraboloid of the Delaunay property:
// then hardly any edge has to be flipped afterwards. Ears are those of convex corners that leave the vertex in what
// remains, so what remains stays star-shaped, and there is always one.
//
//        w2 ----- w1                w2 ----- w1
//       /  \     / \               /  \ ear   \.           On the hull the polygon is open towards infinity. Ears are
//     w3 --- v ---- w0            w3   '----- w0           cut until the chain has no convex corner; then the chain is
//       \  /    \  /               \         /             the new hull, and gets ghosts.
//        w4 ---- w5                 w4 ---- w5
//
// Source: O. Devillers, On deletion in Delaunay triangulations, Int. J. Comput. Geom. Appl. 12 (2002).
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/predicates.hpp"
#include "delaunay/dynamic/dynamic_tris.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::dynamic {

/// Lists the triangles round a vertex and the corners of their polygon; infinity, if it is one, comes last.
void DynamicTris::collect_star(Index v) {
    star_.clear();
    places_.clear();
    assert(has_corner(tris_[at_vertex_[v]], v));
    const Index first = at_vertex_[v];
    Index t = first;
    do {
        const unsigned i = corner_of(tris_[t], v);
        assert(is_linked(tris_, t) && !tris_[t].n[next(i)].is_constrained());
        star_.push_back({tris_[t].v[next(i)], tris_[t].n[i]});
        places_.push_back(t);
        t = tris_[t].n[next(i)].triangle();
    } while (t != first);
    const auto at_infinity =
        std::find_if(star_.begin(), star_.end(), [](const StarCorner& c) { return c.vertex == growing_ghost_vertex; });
    if (at_infinity != star_.end()) std::rotate(star_.begin(), at_infinity + 1, star_.end());
    const auto last = static_cast<Index>(star_.size() - 1);
    for (Index i = 0; i <= last; ++i) {
        star_[i].before = i == 0 ? last : i - 1;
        star_[i].after = i == last ? 0 : i + 1;
    }
}

/// Adds the ear of a corner to the heap, if it may be cut off.
void DynamicTris::add_ear(Index corner, Point removed) {
    const StarCorner& c = star_[corner];
    const Index va = star_[c.before].vertex, vb = c.vertex, vc = star_[c.after].vertex;
    if (va == growing_ghost_vertex || vb == growing_ghost_vertex || vc == growing_ghost_vertex) return;
    const Point a = vertices_[va], b = vertices_[vb], p = vertices_[vc];
    if (core::inline_orient2d(a, b, p) <= 0 || core::inline_orient2d(a, p, removed) < 0) return;
    const double height = core::rounded_incircle(a, b, p, removed).det / cross(b - a, p - a);
    ears_.push_back({std::isnan(height) ? HUGE_VAL : height, corner, c.before, c.after});
    std::push_heap(ears_.begin(), ears_.end());
}

/// Cuts ears off until `least_corners` are left or no corner is convex. New triangles take their places from the end of
/// places_. Returns a corner that is left.
Index DynamicTris::cut_ears(Point removed, std::size_t least_corners) {
    std::size_t left = star_.size();
    auto corner = static_cast<Index>(left - 1);
    if (left <= least_corners) return corner;
    ears_.clear();
    for (Index i = 0; i < star_.size(); ++i) add_ear(i, removed);
    while (left > least_corners && !ears_.empty()) {
        const Ear ear = ears_.front();
        std::pop_heap(ears_.begin(), ears_.end());
        ears_.pop_back();
        StarCorner& cut = star_[ear.corner];
        if (cut.is_cut || cut.before != ear.before || cut.after != ear.after) continue;
        StarCorner &before = star_[ear.before], &after = star_[ear.after];
        assert(!places_.empty() && ear.corner != ear.before && ear.before != ear.after);
        const Index t = places_.back();
        places_.pop_back();
        set_triangle(t, before.vertex, cut.vertex, after.vertex);
        connect(tris_, t, 2, before.outer);
        connect(tris_, t, 0, cut.outer);
        assert(is_counter_clockwise(vertices_, tris_[t]) && is_linked(tris_, t, 2) && is_linked(tris_, t, 0));
        before.outer = Link(t, 1);
        to_check_.push_back(before.outer);
        cut.is_cut = true;
        before.after = ear.after;
        after.before = ear.before;
        corner = ear.before;
        if (--left == least_corners) break;
        add_ear(ear.before, removed);
        add_ear(ear.after, removed);
    }
    return corner;
}

/// Makes the last triangle of a polygon that has three corners left, of which `first` is one.
void DynamicTris::close_inner(Index first) {
    const StarCorner &a = star_[first], &b = star_[a.after], &c = star_[b.after];
    assert(c.after == first);
    const Index t = places_.back();
    places_.pop_back();
    set_triangle(t, a.vertex, b.vertex, c.vertex);
    connect(tris_, t, 2, a.outer);
    connect(tris_, t, 0, b.outer);
    connect(tris_, t, 1, c.outer);
    assert(is_counter_clockwise(vertices_, tris_[t]) && is_linked(tris_, t));
}

/// Makes ghosts on the chain that is left of a polygon whose last corner is at infinity.
///
///      x0 --- x1 --- x2     The polygon's edge from the last x to infinity belongs to the ghost beyond it, and so does
///      |      |      |      that from infinity to x0.
void DynamicTris::close_hull() {
    const StarCorner& at_infinity = star_.back();
    assert(at_infinity.vertex == growing_ghost_vertex && !at_infinity.is_cut);
    Link before = at_infinity.outer;  // across infinity -> x0
    for (Index i = at_infinity.after; star_[i].after + 1 != star_.size(); i = star_[i].after) {
        assert(!places_.empty());
        const Index t = places_.back();
        places_.pop_back();
        set_triangle(t, star_[i].vertex, star_[star_[i].after].vertex, growing_ghost_vertex);
        connect(tris_, t, 2, star_[i].outer);
        connect(tris_, t, 1, before);
        assert(is_linked(tris_, t, 2) && is_linked(tris_, t, 1));
        before = Link(t, 0);
    }
    const Link last = star_[at_infinity.before].outer;  // across the last x -> infinity
    connect(tris_, before.triangle(), before.edge(), last);
    assert(is_linked(tris_, before.triangle(), before.edge()));
}

/// Moves the last triangle to a place that is free.
void DynamicTris::free_place(Index t) {
    const auto last = static_cast<Index>(tris_.size() - 1);
    // It is that of a triangle that was removed: none knows it as a neighbour, nor any vertex as one of its triangles.
    assert(t <= last && !is_linked(tris_, t));
    assert(std::none_of(tris_[t].v, tris_[t].v + 3, [&](Index v) { return at_vertex_[v] == t; }));
    if (t != last) {
        tris_[t] = tris_[last];
        for (unsigned e = 0; e < 3; ++e) connect(tris_, t, e, tris_[t].n[e]);
        for (const Index v : tris_[t].v)
            if (at_vertex_[v] == last) at_vertex_[v] = t;
        assert(is_linked(tris_, t));
    }
    tris_.pop_back();
}

void DynamicTris::remove(Index v) {
    assert(is_alive(v) && !has_constrained_edge(v));
    alive_[v] = 0;
    --alive_count_;
    if (tris_.empty()) return;
    collect_star(v);
    at_vertex_[v] = no_index;
    const Point removed = vertices_[v];
    if (star_.back().vertex != growing_ghost_vertex) {
        close_inner(cut_ears(removed, 3));
    } else {
        const std::size_t all = places_.size();
        cut_ears(removed, 2);
        // Ghosts on both sides of the chain: nothing but a line is left.
        if (places_.size() == all && is_growing_ghost(tris_[star_.front().outer.triangle()])) {
            tris_.clear();
            std::fill(at_vertex_.begin(), at_vertex_.end(), no_index);
            return;
        }
        close_hull();
    }
    flip_until_delaunay();
    assert(places_.size() == 2);
    if (places_[0] < places_[1]) std::swap(places_[0], places_[1]);
    for (const Index place : places_) free_place(place);
    assert(is_sphere(tris_, alive_count_));
}

}  // namespace lamina::delaunay::dynamic
