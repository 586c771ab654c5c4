// The dual graph of a simple polygon's triangulation is a tree: every interior edge divides it into two subtrees, whose
// triangles are summed up once. A straight line across the polygon meets a chain of triangles and leaves whole subtrees
// on its left. All sides are decided exactly. Source of the walk: O. Devillers, S. Pion, M. Teillaud, Walking in a
// triangulation, Int. J. Found. Comput. Sci. 13 (2002).
//
//      left
//    A ------- x         A walk goes along a line from triangle to triangle. It comes into a triangle across A-B. The
//     \  ->   /          third vertex x lies on the left of the line, as here, or on the right. The walk goes out
//      \     /           across B-x in the first case and across x-A in the second.
//       \   /
//         B  right
#include "decoupling/border_triangulation.hpp"

#include <cassert>
#include <numeric>

#include "core/predicates.hpp"
#include "core/segments.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::decoupling {

using delaunay::Index;
using delaunay::Link;
using delaunay::Tri;

namespace {

/// Returns the link across which a walk leaves a triangle that it came into across `in`.
Link next_link(Link in, bool vertex_on_left) {
    return Link(in.triangle(), vertex_on_left ? delaunay::next(in.edge()) : delaunay::previous(in.edge()));
}

/// Triangulates the points, and keeps what lies on the left of the segments.
delaunay::Tris triangulate_inside(std::span<const Point> points, std::span<const Segment> segments) {
    delaunay::Tris tris = delaunay::triangulate_points(points);
    delaunay::insert_segments(points, segments, tris);
    return delaunay::keep_left_of_segments(segments, tris, points.size());
}

Box box_of_border(std::span<const Point> points) {
    Box box;
    for (const Point p : points) box.include(p);
    return box;
}

}  // namespace

double estimate_undivided(const LocalBorder& local, const SizeField& size) {
    return delaunay::estimate_undivided(local.points, triangulate_inside(local.points, local.segments), size);
}

BorderTriangulation::BorderTriangulation(LocalBorder local, const SizeField& size)
    : size_(size.restricted_to(box_of_border(local.points))) {
    points_ = std::move(local.points);
    auto edge = local.segments.begin();
    for (const std::size_t n : local.loops) {
        std::vector<Index>& vertices = loops_.emplace_back();
        vertices.reserve(n);
        for (std::size_t i = 0; i < n; ++i, ++edge) vertices.push_back(edge->a.value);
    }
    tris_ = triangulate_inside(points_, local.segments);
    collect_loop_edges();
    if (loops_.size() > 1) return;
    estimate_loads();
    sum_up_subtrees();
}

void BorderTriangulation::estimate_loads() {
    if (loads_.loads.empty()) loads_ = delaunay::estimate_loads(points_, tris_, size_);
}

bool BorderTriangulation::has_more_than(double triangles) {
    if (loads_.loads.empty() && delaunay::has_clearly_more_than(points_, tris_, size_, triangles)) return true;
    return estimate().triangles > triangles;
}

WorkEstimate BorderTriangulation::estimate() {
    estimate_loads();
    return {loads_.total, loads_.lattice};
}

void BorderTriangulation::collect_loop_edges() {
    // Most vertices have one edge that begins there.
    first_edge_.assign(points_.size() + 1, 0);
    for (const auto& loop : loops_)
        for (const Index v : loop) ++first_edge_[v + 1];
    std::partial_sum(first_edge_.begin(), first_edge_.end(), first_edge_.begin());
    loop_edges_.resize(first_edge_.back());
    std::vector<Index> free(first_edge_.begin(), first_edge_.end() - 1);
    for (std::size_t l = 0; l < loops_.size(); ++l)
        for (std::size_t i = 0; i < loops_[l].size(); ++i) {
            const LoopVertex from{l, i};
            loop_edges_[free[local_index(from)]++] = {local_index(from), local_index(next(from)), {}, from};
        }
    for (Index t = 0; t < tris_.size(); ++t)
        for (unsigned e = 0; e < 3; ++e) {
            if (!tris_[t].n[e].is_constrained()) continue;
            LoopEdge* found = find_loop_edge(tris_[t].v[delaunay::next(e)], tris_[t].v[delaunay::previous(e)]);
            if (found != nullptr) found->inside = Link(t, e);
        }
}

/// Returns the edge of a loop from a to b; null where there is none.
BorderTriangulation::LoopEdge* BorderTriangulation::find_loop_edge(Index a, Index b) {
    for (Index i = first_edge_[a]; i < first_edge_[a + 1]; ++i)
        if (loop_edges_[i].b == b) return &loop_edges_[i];
    return nullptr;
}

double BorderTriangulation::triangles_in(Index t) const {
    double sum = 0;
    for (std::size_t i = loads_.begin[t]; i < loads_.begin[t + 1]; ++i) sum += loads_.loads[i].triangles;
    return sum;
}

void BorderTriangulation::sum_up_subtrees() {
    constexpr unsigned char none = 3;
    std::vector<Index> order{0};  // parents before children
    to_root_.assign(tris_.size(), none);
    order.reserve(tris_.size());
    for (std::size_t k = 0; k < order.size(); ++k)
        for (unsigned e = 0; e < 3; ++e) {
            const Link link = tris_[order[k]].n[e];
            if (link.is_constrained() || e == to_root_[order[k]]) continue;
            to_root_[link.triangle()] = static_cast<unsigned char>(link.edge());
            order.push_back(link.triangle());
        }
    assert(order.size() == tris_.size());
    subtree_.resize(tris_.size());
    for (Index t = 0; t < tris_.size(); ++t) subtree_[t] = triangles_in(t);
    for (std::size_t k = order.size(); k-- > 1;)
        subtree_[tris_[order[k]].n[to_root_[order[k]]].triangle()] += subtree_[order[k]];
}

/// Returns the estimated triangles on the other side of an edge of a triangle; 0 for border edges and without a tree.
double BorderTriangulation::triangles_beyond(Index t, unsigned edge) const {
    const Link link = tris_[t].n[edge];
    if (link.is_constrained() || subtree_.empty()) return 0;
    return to_root_[t] == edge ? loads_.total - subtree_[t] : subtree_[link.triangle()];
}

const BorderTriangulation::LoopEdge& BorderTriangulation::loop_edge(Index a, Index b) const {
    Index i = first_edge_[a];
    while (loop_edges_[i].b != b) ++i;
    assert(i < first_edge_[a + 1]);
    return loop_edges_[i];
}

/// Returns the triangle at a border vertex u that a line from u towards a point enters first, or no_index where the
/// line does not leave u into the subdomain. The line may run along the triangle's first edge, u-w, but not along u-x.
///
///           x
///          / \.  -> toward        The search turns counter-clockwise round u, from the edge to the next border vertex.
///         / t \.
///        u --- w
Index BorderTriangulation::first_triangle(LoopVertex from, Point toward) const {
    const Point u = point(from);
    if (!core::inside_wedge(u, point(next(from)), point(previous(from)), toward)) return delaunay::no_index;
    Link uw = loop_edge(local_index(from), local_index(next(from))).inside;
    for (;;) {
        const Tri& t = tris_[uw.triangle()];
        const Point w = points_[t.v[delaunay::previous(uw.edge())]], x = points_[t.v[uw.edge()]];
        if (core::inline_orient2d(u, w, toward) >= 0 && core::inline_orient2d(u, toward, x) > 0) return uw.triangle();
        const Link ux = t.n[delaunay::previous(uw.edge())];
        if (ux.is_constrained()) return delaunay::no_index;
        uw = ux;
    }
}

/// Returns the link across which a walk from a border vertex leaves its first triangle: that of the opposite edge.
Link BorderTriangulation::link_out_of(Index first, LoopVertex from) const {
    return Link(first, corner_of(tris_[first], local_index(from)));
}

std::optional<BorderTriangulation::RayHit> BorderTriangulation::shoot(LoopVertex from, Point direction) const {
    const Point p = point(from), toward = p + direction;
    const Index first = first_triangle(from, toward);
    if (first == delaunay::no_index) return std::nullopt;
    double left = 0;
    const auto add_left_part_of = [&](Index crossed) {
        if (subtree_.empty()) return;
        for (std::size_t i = loads_.begin[crossed]; i < loads_.begin[crossed + 1]; ++i)
            if (cross(direction, loads_.loads[i].at - p) > 0) left += loads_.loads[i].triangles;
    };
    Link out = link_out_of(first, from);
    if (core::inline_orient2d(p, toward, points_[tris_[first].v[delaunay::next(out.edge())]]) == 0) return std::nullopt;
    add_left_part_of(first);
    left += triangles_beyond(first, delaunay::next(out.edge()));
    for (;;) {
        const Tri& t = tris_[out.triangle()];
        const Link in = t.n[out.edge()];
        if (in.is_constrained())
            return RayHit{loop_edge(t.v[delaunay::next(out.edge())], t.v[delaunay::previous(out.edge())]).from, left};
        const double side = core::inline_orient2d(p, toward, points_[tris_[in.triangle()].v[in.edge()]]);
        if (side == 0) return std::nullopt;
        add_left_part_of(in.triangle());
        if (side > 0) left += triangles_beyond(in.triangle(), delaunay::previous(in.edge()));
        out = next_link(in, side > 0);
    }
}

bool BorderTriangulation::sees(LoopVertex from, LoopVertex to) const {
    const Point p = point(from), q = point(to);
    const Index target = local_index(to);
    if (!core::inside_wedge(q, point(next(to)), point(previous(to)), p)) return false;
    const Index first = first_triangle(from, q);
    if (first == delaunay::no_index) return false;
    Link out = link_out_of(first, from);
    const Index w = tris_[first].v[delaunay::next(out.edge())];
    if (w == target) return true;
    if (core::inline_orient2d(p, q, points_[w]) == 0) return false;
    for (;;) {
        const Link in = tris_[out.triangle()].n[out.edge()];
        if (in.is_constrained()) return false;
        const Index x = tris_[in.triangle()].v[in.edge()];
        if (x == target) return true;
        const double side = core::inline_orient2d(p, q, points_[x]);
        if (side == 0) return false;
        out = next_link(in, side > 0);
    }
}

}  // namespace lamina::decoupling
