// Insertion by cavities and segments. A cavity stops at constrained edges; that it is star-shaped all the same follows
// from the triangulation being constrained Delaunay: beyond the end e of a segment no triangle on the ray from the new
// point through e holds the point in its circle, so the cavity does not reach behind the segment.
#include "delaunay/dynamic/dynamic_tris.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "core/random.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/walk.hpp"

namespace lamina::delaunay::dynamic {

namespace {

constexpr Index infinity = growing_ghost_vertex;

}  // namespace

DynamicTris::DynamicTris() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    vertices_.push_back({nan, nan});
    alive_.push_back(0);
    at_vertex_.push_back(no_index);
}

Index DynamicTris::append(std::span<const Point> points) {
    const auto first = static_cast<Index>(vertices_.size());
    vertices_.insert(vertices_.end(), points.begin(), points.end());
    alive_.resize(vertices_.size(), 0);
    at_vertex_.resize(vertices_.size(), no_index);
    return first;
}

void DynamicTris::drop_last() {
    assert(!alive_.back() && at_vertex_.back() == no_index);
    vertices_.pop_back();
    alive_.pop_back();
    at_vertex_.pop_back();
}

/// Returns a triangle at a vertex that is no ghost.
Index DynamicTris::triangle_at(Index v) const {
    Index t = at_vertex_[v];
    // Two ghosts at most are neighbours round a vertex.
    while (is_growing_ghost(tris_[t])) t = tris_[t].n[next(corner_of(tris_[t], v))].triangle();
    return t;
}

Index DynamicTris::walk_from(Index near, Point p) const {
    return walk(vertices_.data(), tris_.data(), triangle_at(near), p);
}

Index DynamicTris::sample_near(Point p, Index hint) const {
    Index best = is_alive(hint) ? hint : 0;
    const auto tries = static_cast<std::size_t>(std::cbrt(static_cast<double>(vertices_.size())));
    for (std::size_t i = 0; i < tries; ++i) {
        const auto v = static_cast<Index>(1 + core::splitmix64(i) % (vertices_.size() - 1));
        if (!alive_[v]) continue;
        if (best == 0 || squared_length(vertices_[v] - p) < squared_length(vertices_[best] - p)) best = v;
    }
    // Where most vertices were removed the sample may hold none.
    return best != 0 ? best : static_cast<Index>(std::find(alive_.begin(), alive_.end(), 1) - alive_.begin());
}

std::optional<Index> DynamicTris::find(Point p, Index near) const {
    const Tri& t = tris_[walk_from(near, p)];
    for (const Index v : t.v)
        if (v != infinity && vertices_[v] == p) return v;
    return std::nullopt;
}

Index DynamicTris::insert(Index v, Index near) {
    assert(v < vertices_.size() && at_vertex_[v] == no_index && at_vertex_[near] != no_index);
    const Point p = vertices_[v];
    const Index t = walk_from(near, p);
    for (const Index w : tris_[t].v)
        if (w != infinity && vertices_[w] == p) return w;
    // A constrained edge that p lies on is cut: it is released until p is in, and then both its parts are constrained.
    Index a = no_index, b = no_index;
    for (unsigned e = 0; e < 3 && !is_growing_ghost(tris_[t]); ++e) {
        const Index from = tris_[t].v[next(e)], to = tris_[t].v[previous(e)];
        if (!tris_[t].n[e].is_constrained() || core::inline_orient2d(vertices_[from], vertices_[to], p) != 0) continue;
        a = from;
        b = to;
        release_edge(tris_, t, e);
    }
    const RelativeTriangle relative = relative_to(vertices_.data(), tris_[t], p);
    find_cavity<true>(vertices_.data(), tris_.data(), t, relative, p, cavity_);
    assert(is_star(vertices_, cavity_, p, infinity));
    fill_cavity(tris_, cavity_, v, [&](Index made, const CavityEdge& from, const CavityEdge&) {
        at_vertex_[from.a] = made;
        at_vertex_[v] = made;
    });
    if (a != no_index) {
        for (const Index end : {a, b}) {
            const Link edge = find_edge(tris_, at_vertex_, v, end);
            assert(!edge.is_border());
            constrain_edge(tris_, edge.triangle(), edge.edge());
        }
    }
    alive_[v] = 1;
    ++alive_count_;
    assert(has_corner(tris_[at_vertex_[v]], v));
    return v;
}

/// Makes a triangle of three vertices, which do not lie on one line, and its ghosts.
void DynamicTris::make_first_triangle(Index a, Index b, Index c) {
    assert(tris_.empty() && orient2d(vertices_[a], vertices_[b], vertices_[c]) != 0);
    if (orient2d(vertices_[a], vertices_[b], vertices_[c]) < 0) std::swap(b, c);
    tris_.resize(4);
    set_triangle(0, a, b, c);
    const Index v[3] = {a, b, c};
    for (unsigned e = 0; e < 3; ++e) {
        set_triangle(1 + e, v[previous(e)], v[next(e)], infinity);
        connect(tris_, 0, e, Link(1 + e, 2));
    }
    // Edge 0 of a ghost runs from v[e+1] to infinity; its neighbour is the ghost across edge e + 2.
    for (unsigned e = 0; e < 3; ++e) connect(tris_, 1 + e, 0, Link(1 + previous(e), 1));
    assert(are_linked(tris_) && is_counter_clockwise(vertices_, tris_[0]));
}

std::vector<Index> DynamicTris::insert_without_triangles(Index first) {
    std::vector<Index> order;
    for (Index v = 1; v < vertices_.size(); ++v)
        if (alive_[v] || v >= first) order.push_back(v);
    const std::vector<Index> sequence = order;
    std::sort(order.begin(), order.end(), [&](Index v, Index w) {
        return vertices_[v] == vertices_[w] ? v < w : lexicographically_less(vertices_[v], vertices_[w]);
    });
    std::vector<Index> found(vertices_.size() - first);
    Index at = no_index;
    for (const Index v : order) {
        if (at == no_index || vertices_[at] != vertices_[v]) at = v;
        if (v >= first) found[v - first] = at;
        alive_count_ += at == v && !alive_[v];
        alive_[v] = at == v;
    }
    insert_all(sequence);
    assert(is_sphere(tris_, alive_count_));
    return found;
}

/// Triangulates those of the vertices that are alive, unless they lie on one line.
void DynamicTris::insert_all(std::span<const Index> sequence) {
    std::vector<Index> line;
    std::size_t k = 0;
    for (; k < sequence.size(); ++k) {
        if (!alive_[sequence[k]]) continue;
        line.push_back(sequence[k]);
        if (line.size() > 2 && orient2d(vertices_[line[0]], vertices_[line[1]], vertices_[line.back()]) != 0) break;
    }
    if (k == sequence.size()) return;
    tris_.reserve(2 * sequence.size());
    make_first_triangle(line[0], line[1], line.back());
    Index near = line.back();
    line.pop_back();
    const auto insert_alive = [&](Index v) {
        --alive_count_;
        near = insert(v, near);
    };
    for (std::size_t i = 2; i < line.size(); ++i) insert_alive(line[i]);
    for (++k; k < sequence.size(); ++k)
        if (alive_[sequence[k]]) insert_alive(sequence[k]);
}

bool DynamicTris::has_constrained_edge(Index v) const {
    if (tris_.empty() || !had_segments_) return false;
    const Index first = at_vertex_[v];
    Index t = first;
    do {
        const unsigned i = corner_of(tris_[t], v);
        if (tris_[t].n[next(i)].is_constrained()) return true;
        t = tris_[t].n[next(i)].triangle();
    } while (t != first);
    return false;
}

std::optional<CrossedEdge> DynamicTris::insert_segment(Segment segment, std::vector<SegmentPiece>& pieces) {
    had_segments_ = true;
    const std::size_t before = pieces.size();
    const auto crossed = delaunay::insert_segment(vertices_, segment, tris_, at_vertex_, infinity, pieces);
    if (!crossed) return std::nullopt;
    std::vector<Link> inserted;
    for (std::size_t i = before; i < pieces.size(); ++i)
        if (!pieces[i].repeats)
            inserted.push_back(find_edge(tris_, at_vertex_, pieces[i].segment.a.value, pieces[i].segment.b.value));
    release(inserted);
    pieces.resize(before);
    return crossed;
}

std::optional<std::vector<Link>> DynamicTris::find_constrained_way(Index a, Index b) const {
    std::vector<Link> way;
    Index at = a;
    while (at != b) {
        const Index first = at_vertex_[at];
        Index t = first, reached = no_index;
        do {
            const unsigned i = corner_of(tris_[t], at);
            const Index w = tris_[t].v[next(i)];
            const Link across = tris_[t].n[previous(i)];
            if (w != infinity && across.is_constrained() &&
                core::inline_orient2d(vertices_[at], vertices_[w], vertices_[b]) == 0 &&
                dot(vertices_[w] - vertices_[at], vertices_[b] - vertices_[at]) > 0) {
                way.emplace_back(t, previous(i));
                reached = w;
                break;
            }
            t = tris_[t].n[next(i)].triangle();
        } while (t != first);
        // The last edge may not end beyond b.
        if (reached == no_index ||
            (reached != b && dot(vertices_[b] - vertices_[reached], vertices_[b] - vertices_[a]) < 0))
            return std::nullopt;
        at = reached;
    }
    return way;
}

void DynamicTris::release(std::span<const Link> edges) {
    for (const Link edge : edges) {
        assert(tris_[edge.triangle()].n[edge.edge()].is_constrained());
        release_edge(tris_, edge.triangle(), edge.edge());
        to_check_.push_back(edge);
    }
    flip_until_delaunay();
}

/// Flips the edges of to_check_, and those round them, until all are locally Delaunay.
void DynamicTris::flip_until_delaunay() {
    while (!to_check_.empty()) {
        const Link edge = to_check_.back();
        to_check_.pop_back();
        const Index t = edge.triangle();
        const Tri& tri = tris_[t];
        const Link across = tri.n[edge.edge()];
        const Index n = across.triangle();
        if (across.is_constrained() || is_growing_ghost(tri) || is_growing_ghost(tris_[n])) continue;
        const Index opposite = tris_[n].v[across.edge()];
        if (core::inline_incircle_perturbed(vertices_[tri.v[0]], vertices_[tri.v[1]], vertices_[tri.v[2]],
                                            vertices_[opposite]) <= 0)
            continue;
        flip_edge(tris_, t, edge.edge());
        assert(is_counter_clockwise(vertices_, tris_[t]) && is_counter_clockwise(vertices_, tris_[n]));
        for (const Index v : tris_[t].v) at_vertex_[v] = t;
        for (const Index v : tris_[n].v) at_vertex_[v] = n;
        for (const Link around : {Link(t, 0), Link(t, 2), Link(n, 0), Link(n, 1)}) to_check_.push_back(around);
    }
}

void DynamicTris::set_triangle(Index t, Index a, Index b, Index c) {
    tris_[t].v[0] = a;
    tris_[t].v[1] = b;
    tris_[t].v[2] = c;
    for (const Index v : tris_[t].v) at_vertex_[v] = t;
}

}  // namespace lamina::delaunay::dynamic
