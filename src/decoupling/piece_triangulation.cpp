// A simple polygon's triangulation has a tree for its dual, so every interior edge knows what lies on either side; a
// straight line across the polygon meets a chain of triangles and leaves whole subtrees on its left.
// Source for the walk: O. Devillers, S. Pion, M. Teillaud, Walking in a triangulation, Int. J. Found. Comput. Sci. 13
// (2002). All sides are decided exactly.
#include "decoupling/piece_triangulation.hpp"

#include <algorithm>
#include <cassert>

#include "core/predicates.hpp"
#include "core/segments.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::decoupling {

using delaunay::Index;
using delaunay::Link;
using delaunay::Tri;

namespace {

unsigned place_in(const Tri& t, Index v) { return t.v[0] == v ? 0 : t.v[1] == v ? 1 : 2; }

}  // namespace

PieceTriangulation::PieceTriangulation(std::span<const Point> points, const Piece& piece, const SizeField& size) {
    std::vector<VertexId> ids;
    for (const auto& loop : piece.loops) ids.insert(ids.end(), loop.begin(), loop.end());
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    for (VertexId v : ids) points_.push_back(points[v.index()]);

    std::vector<Segment> segments;
    for (const auto& loop : piece.loops) {
        auto& local = loops_.emplace_back();
        for (VertexId v : loop)
            local.push_back(static_cast<Index>(std::lower_bound(ids.begin(), ids.end(), v) - ids.begin()));
        for (std::size_t i = 0; i < local.size(); ++i)
            segments.push_back({VertexId{local[i]}, VertexId{local[i + 1 < local.size() ? i + 1 : 0]}});
    }
    tris_ = delaunay::triangulate_points(points_);
    delaunay::insert_segments(points_, segments, tris_);
    tris_ = delaunay::keep_left_of_segments(segments, tris_, points_.size());
    loads_ = delaunay::estimate_loads(points_, tris_, size);

    for (std::size_t l = 0; l < loops_.size(); ++l)
        for (std::size_t i = 0; i < loops_[l].size(); ++i)
            border_.push_back({loops_[l][i], loops_[l][i + 1 < loops_[l].size() ? i + 1 : 0], {}, {l, i}});
    std::sort(border_.begin(), border_.end());
    for (Index t = 0; t < tris_.size(); ++t)
        for (unsigned e = 0; e < 3; ++e) {
            if (!tris_[t].n[e].is_constrained()) continue;
            const BorderEdge wanted{tris_[t].v[delaunay::next(e)], tris_[t].v[delaunay::previous(e)], {}, {}};
            const auto found = std::lower_bound(border_.begin(), border_.end(), wanted);
            if (found != border_.end() && found->a == wanted.a && found->b == wanted.b) found->inside = Link(t, e);
        }
    if (loops_.size() == 1) sum_up();
}

double PieceTriangulation::held_by(Index t) const {
    double sum = 0;
    for (std::size_t i = loads_.begin[t]; i < loads_.begin[t + 1]; ++i) sum += loads_.loads[i].triangles;
    return sum;
}

void PieceTriangulation::sum_up() {
    constexpr unsigned char none = 3;
    std::vector<Index> order{0};
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
    below_.resize(tris_.size());
    for (Index t = 0; t < tris_.size(); ++t) below_[t] = held_by(t);
    for (std::size_t k = order.size(); k-- > 1;)
        below_[tris_[order[k]].n[to_root_[order[k]]].triangle()] += below_[order[k]];
}

double PieceTriangulation::beyond(Index t, unsigned edge) const {
    const Link link = tris_[t].n[edge];
    if (link.is_constrained() || below_.empty()) return 0;
    return to_root_[t] == edge ? triangles() - below_[t] : below_[link.triangle()];
}

const PieceTriangulation::BorderEdge& PieceTriangulation::border_edge(Index a, Index b) const {
    const auto found = std::lower_bound(border_.begin(), border_.end(), BorderEdge{a, b, {}, {}});
    assert(found != border_.end() && found->a == a && found->b == b);
    return *found;
}

/// The triangle at a corner that a line towards a point enters first, no_index where the line leaves outside the
/// corner. It may run along the triangle's first edge, u-w, never along x-u.
///
///           x
///          / \.  -> toward        turning counter-clockwise from the edge to the next corner
///         / t \.
///        u --- w
Index PieceTriangulation::first_triangle(Corner from, Point toward) const {
    const Point p = point(from);
    if (!core::inside_wedge(p, point(next(from)), point(previous(from)), toward)) return delaunay::no_index;
    Link uw = border_edge(vertex(from), vertex(next(from))).inside;
    for (;;) {
        const Tri& t = tris_[uw.triangle()];
        const Point w = points_[t.v[delaunay::previous(uw.edge())]], x = points_[t.v[uw.edge()]];
        if (core::inline_orient2d(p, w, toward) >= 0 && core::inline_orient2d(p, toward, x) > 0) return uw.triangle();
        const Link ux = t.n[delaunay::previous(uw.edge())];
        if (ux.is_constrained()) return delaunay::no_index;
        uw = ux;
    }
}

//        left
//    A -------- x          The line comes in through A-B. The new vertex x may lie on its left, as here, or on its
//    right:
//     \  ->   /           it goes out through B-x or x-A.
//      \     /
//       \   /
//         B   right

std::optional<PieceTriangulation::Hit> PieceTriangulation::shoot(Corner from, Point direction) const {
    const Point p = point(from), toward = p + direction;
    const Index first = first_triangle(from, toward);
    if (first == delaunay::no_index) return std::nullopt;
    double left = 0;
    const auto add_part = [&](Index crossed) {
        for (std::size_t i = loads_.begin[crossed]; i < loads_.begin[crossed + 1]; ++i)
            if (cross(direction, loads_.loads[i].at - p) > 0) left += loads_.loads[i].triangles;
    };
    Link out(first, place_in(tris_[first], vertex(from)));
    if (core::inline_orient2d(p, toward, points_[tris_[first].v[delaunay::next(out.edge())]]) == 0) return std::nullopt;
    add_part(first);
    left += beyond(first, delaunay::next(out.edge()));
    for (;;) {
        const Tri& t = tris_[out.triangle()];
        const Link in = t.n[out.edge()];
        if (in.is_constrained())
            return Hit{border_edge(t.v[delaunay::next(out.edge())], t.v[delaunay::previous(out.edge())]).corner, left};
        const double side = core::inline_orient2d(p, toward, points_[tris_[in.triangle()].v[in.edge()]]);
        if (side == 0) return std::nullopt;
        add_part(in.triangle());
        if (side > 0) left += beyond(in.triangle(), delaunay::previous(in.edge()));
        out = Link(in.triangle(), side > 0 ? delaunay::next(in.edge()) : delaunay::previous(in.edge()));
    }
}

bool PieceTriangulation::sees(Corner from, Corner to) const {
    const Point p = point(from), q = point(to);
    const Index target = vertex(to);
    if (!core::inside_wedge(q, point(next(to)), point(previous(to)), p)) return false;
    const Index first = first_triangle(from, q);
    if (first == delaunay::no_index) return false;
    Link out(first, place_in(tris_[first], vertex(from)));
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
        out = Link(in.triangle(), side > 0 ? delaunay::next(in.edge()) : delaunay::previous(in.edge()));
    }
}

}  // namespace lamina::decoupling
