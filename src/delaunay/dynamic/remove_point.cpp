// Removal of a vertex. The triangles round it leave a polygon that is star-shaped from it. Ears are cut off this polygon,
// in the order in which they would appear if the vertex rose from the paraboloid of the Delaunay property: then hardly
// any edge has to be flipped afterwards. Ears are those of convex corners that leave the vertex in what remains, so what
// remains stays star-shaped, and there is always one.
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
#include <queue>

#include "core/predicates.hpp"
#include "delaunay/dynamic/dynamic_tris.hpp"
#include "delaunay/walk.hpp"

namespace lamina::delaunay::dynamic {

/// An ear that may be cut off. Those with the smallest height come first.
struct DynamicTris::Ear {
    double height;
    Index corner, before, after;
    friend bool operator<(const Ear& l, const Ear& r) {
        return l.height != r.height ? l.height > r.height : l.corner > r.corner;
    }
};

/// Lists the polygon round a vertex, counter-clockwise; infinity, if it is a corner, comes last. Returns the triangles.
std::vector<Index> DynamicTris::collect_star(Index v, std::vector<StarCorner>& star) const {
    std::vector<Index> places;
    const Index first = at_vertex_[v];
    Index t = first;
    do {
        const unsigned i = corner_of(tris_[t], v);
        star.push_back({tris_[t].v[next(i)], tris_[t].n[i]});
        places.push_back(t);
        t = tris_[t].n[next(i)].triangle();
    } while (t != first);
    const auto at_infinity =
        std::find_if(star.begin(), star.end(), [](const StarCorner& c) { return c.vertex == growing_ghost_vertex; });
    if (at_infinity != star.end()) std::rotate(star.begin(), at_infinity + 1, star.end());
    const auto count = static_cast<Index>(star.size());
    for (Index i = 0; i < count; ++i) {
        star[i].before = (i + count - 1) % count;
        star[i].after = (i + 1) % count;
    }
    return places;
}

/// Returns the ear of a corner, if it may be cut off.
std::optional<DynamicTris::Ear> DynamicTris::make_ear(const std::vector<StarCorner>& star, Index corner,
                                                      Point removed) const {
    const StarCorner& c = star[corner];
    const Index va = star[c.before].vertex, vb = c.vertex, vc = star[c.after].vertex;
    if (va == growing_ghost_vertex || vb == growing_ghost_vertex || vc == growing_ghost_vertex) return std::nullopt;
    const Point a = vertices_[va], b = vertices_[vb], p = vertices_[vc];
    if (core::inline_orient2d(a, b, p) <= 0 || core::inline_orient2d(a, p, removed) < 0) return std::nullopt;
    const double height = core::rounded_incircle(a, b, p, removed).det / cross(b - a, p - a);
    return Ear{std::isnan(height) ? HUGE_VAL : height, corner, c.before, c.after};
}

/// Cuts ears off until `least_corners` are left or no corner is convex. New triangles take their places from the end of
/// `places`. Returns a corner that is left.
Index DynamicTris::cut_ears(std::vector<StarCorner>& star, Point removed, std::size_t least_corners,
                            std::vector<Index>& places) {
    std::vector<Ear> ears;
    for (Index i = 0; i < star.size(); ++i)
        if (const auto ear = make_ear(star, i, removed)) ears.push_back(*ear);
    std::priority_queue<Ear> queue({}, std::move(ears));
    std::size_t left = star.size();
    Index corner = static_cast<Index>(star.size() - 1);
    while (left > least_corners && !queue.empty()) {
        const Ear ear = queue.top();
        queue.pop();
        StarCorner& cut = star[ear.corner];
        if (cut.is_cut || cut.before != ear.before || cut.after != ear.after) continue;
        StarCorner &before = star[ear.before], &after = star[ear.after];
        const Index t = places.back();
        places.pop_back();
        set_triangle(t, before.vertex, cut.vertex, after.vertex);
        connect(tris_, t, 2, before.outer);
        connect(tris_, t, 0, cut.outer);
        before.outer = Link(t, 1);
        to_check_.push_back(before.outer);
        cut.is_cut = true;
        before.after = ear.after;
        after.before = ear.before;
        corner = ear.before;
        --left;
        for (const Index changed : {ear.before, ear.after})
            if (const auto next_ear = make_ear(star, changed, removed)) queue.push(*next_ear);
    }
    return corner;
}

/// Makes the last triangle of a polygon that has three corners left, of which `first` is one.
void DynamicTris::close_inner(const std::vector<StarCorner>& star, Index first, std::vector<Index>& places) {
    const StarCorner &a = star[first], &b = star[a.after], &c = star[b.after];
    assert(c.after == first);
    const Index t = places.back();
    places.pop_back();
    set_triangle(t, a.vertex, b.vertex, c.vertex);
    connect(tris_, t, 2, a.outer);
    connect(tris_, t, 0, b.outer);
    connect(tris_, t, 1, c.outer);
}

/// Makes ghosts on the chain that is left of a polygon whose last corner is at infinity.
///
///      x0 --- x1 --- x2     The polygon's edge from the last x to infinity belongs to the ghost beyond it, and so does
///      |      |      |      that from infinity to x0.
void DynamicTris::close_hull(const std::vector<StarCorner>& star, std::vector<Index>& places) {
    const StarCorner& at_infinity = star.back();
    Link before = at_infinity.outer;  // across infinity -> x0
    for (Index i = at_infinity.after; star[i].after + 1 != star.size(); i = star[i].after) {
        const Index t = places.back();
        places.pop_back();
        set_triangle(t, star[i].vertex, star[star[i].after].vertex, growing_ghost_vertex);
        connect(tris_, t, 2, star[i].outer);
        connect(tris_, t, 1, before);
        before = Link(t, 0);
    }
    const Link last = star[at_infinity.before].outer;  // across the last x -> infinity
    connect(tris_, before.triangle(), before.edge(), last);
}

/// Moves the last triangle to a place that is free.
void DynamicTris::free_place(Index t) {
    const auto last = static_cast<Index>(tris_.size() - 1);
    if (t != last) {
        tris_[t] = tris_[last];
        for (unsigned e = 0; e < 3; ++e) connect(tris_, t, e, tris_[t].n[e]);
        for (const Index v : tris_[t].v)
            if (at_vertex_[v] == last) at_vertex_[v] = t;
    }
    tris_.pop_back();
}

void DynamicTris::remove(Index v) {
    alive_[v] = 0;
    --alive_count_;
    if (tris_.empty()) return;
    std::vector<StarCorner> star;
    std::vector<Index> places = collect_star(v, star);
    at_vertex_[v] = no_index;
    const Point removed = vertices_[v];
    if (star.back().vertex != growing_ghost_vertex) {
        close_inner(star, cut_ears(star, removed, 3, places), places);
    } else {
        const std::size_t all = places.size();
        cut_ears(star, removed, 2, places);
        // Ghosts on both sides of the chain: nothing but a line is left.
        const bool only_line = places.size() == all && is_growing_ghost(tris_[star.front().outer.triangle()]);
        if (only_line) {
            tris_.clear();
            to_check_.clear();
            std::fill(at_vertex_.begin(), at_vertex_.end(), no_index);
            return;
        }
        close_hull(star, places);
    }
    flip_until_delaunay();
    assert(places.size() == 2);
    std::sort(places.begin(), places.end());
    while (!places.empty()) {
        free_place(places.back());
        places.pop_back();
    }
}

}  // namespace lamina::delaunay::dynamic
