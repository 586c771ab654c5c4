// A vertex within rounding of a constrained edge is seen from it, or another such vertex is. So the triangles beside
// the edge are enough, but for needles: the vertex may then be that of a triangle behind.
//
//                    ..--c      v stands nearer to a-b than c, but nearer to a, too, so that the triangle at a-b has the
//            v..---''   /       corner c. The line a-c is as near to a-b there as v.
//         a------------b
#include "delaunay/constrain/beside_edges.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "delaunay/constrain/planarize.hpp"

namespace lamina::delaunay {

namespace {

/// A place relative to an edge, which has the triangle that it is looked at from on its left.
struct PlaceBesideEdge {
    double along;  ///< the distance from its first end
    double left;   ///< the distance from its line
};

/// Walks from constrained edges through the triangles that come near to them. No vertex lies in the narrow strip that
/// is near, or the walk ends, so edges cut the strip in two and no triangle is met twice.
class BesideSearch {
public:
    BesideSearch(std::span<const Point> points, const Tris& tris) : points_(points), tris_(tris) {}

    /// Returns whether a vertex is near to a constrained edge of a triangle, on this side. Precondition: each of them
    /// is a whole segment.
    bool finds_at(Index t) {
        const Tri& tri = tris_[t];
        if (tri.is_ghost()) return false;
        for (unsigned e = 0; e < 3; ++e) {
            if (!tri.n[e].is_constrained()) continue;
            if (finds(Link(t, e), near_to(points_[tri.v[next(e)]], points_[tri.v[previous(e)]]))) return true;
        }
        return false;
    }

    /// Returns whether a vertex on either side is near to a piece.
    bool finds_at(const SegmentPiece& piece, std::span<const Segment> segments, const std::vector<Index>& at_vertex) {
        const Segment parent = segments[piece.parent];
        const PassingDistances near = near_to(points_[parent.a.index()], points_[parent.b.index()]);
        const Link left = find_edge(tris_, at_vertex, piece.segment.a.value, piece.segment.b.value);
        return finds(left, near) || finds(tris_[left.triangle()].n[left.edge()], near);
    }

private:
    /// Returns how near vertices to a segment must be to be looked at. Rounding must not hide one that planarize()
    /// finds.
    static PassingDistances near_to(Point a, Point b) {
        const PassingDistances exact = passing_distances(a, b);
        return {1.5 * exact.from_edge, 0.9 * exact.from_ends};
    }

    /// Returns whether a vertex on the side of the edge's triangle is near to the edge.
    ///
    /// The sides of most triangles are constrained or so steep that they are not near at near.from_ends from the end.
    /// No other triangle has to be looked at then, which is seen without a division.
    bool finds(Link edge, PassingDistances near) {
        const Tri& tri = tris_[edge.triangle()];
        if (tri.is_ghost()) return false;
        const unsigned e = edge.edge();
        const Point a = points_[tri.v[next(e)]], b = points_[tri.v[previous(e)]], w = points_[tri.v[e]];
        const double along = dot(b - a, w - a), squared = squared_length(b - a), left = cross(b - a, w - a);
        const double rise = left * near.from_ends;
        const auto stays_away = [&](Link side, double along_side) {
            return side.is_constrained() || rise > near.from_edge * along_side;
        };
        if (left * left > near.from_edge * near.from_edge * squared && stays_away(tri.n[previous(e)], along) &&
            stays_away(tri.n[next(e)], squared - along))
            return false;
        near_ = near;
        length_ = std::sqrt(squared);
        if (!(length_ > 2 * near_.from_ends)) return false;
        origin_ = a;
        direction_ = (1 / length_) * (b - a);
        ways_.assign(1, edge);
        for (std::size_t steps = 0; !ways_.empty(); ++steps) {
            if (steps > tris_.size()) return true;  // rounding has led the walk in a circle
            const Link way = ways_.back();
            ways_.pop_back();
            if (enter(way)) return true;
        }
        return false;
    }

    PlaceBesideEdge place(Index v) const {
        const Point p = points_[v] - origin_;
        return {dot(direction_, p), cross(direction_, p)};
    }
    bool is_between_ends(double along) const { return along > near_.from_ends && along < length_ - near_.from_ends; }

    /// Looks at the corner of a triangle that lies opposite the edge by which it is entered. Returns whether it is
    /// near.
    bool enter(Link way) {
        const Tri& tri = tris_[way.triangle()];
        if (tri.is_ghost()) return false;
        const unsigned e = way.edge();
        const PlaceBesideEdge w = place(tri.v[e]);
        if (w.left <= near_.from_edge && is_between_ends(w.along)) return true;
        for (const unsigned side : {next(e), previous(e)}) {
            const Link across = tri.n[side];
            if (across.is_constrained()) continue;
            const Index other = side == next(e) ? tri.v[previous(e)] : tri.v[next(e)];
            if (comes_near(w, place(other))) ways_.push_back(across);
        }
        return false;
    }

    /// Returns whether the straight way between two places comes near, between the ends of the edge.
    bool comes_near(PlaceBesideEdge p, PlaceBesideEdge q) const {
        if (p.along > q.along) std::swap(p, q);
        const double from = std::max(p.along, near_.from_ends), to = std::min(q.along, length_ - near_.from_ends);
        if (!(from <= to)) return false;
        const double slope = q.along > p.along ? (q.left - p.left) / (q.along - p.along) : 0;
        return std::min(p.left + slope * (from - p.along), p.left + slope * (to - p.along)) <= near_.from_edge;
    }

    std::span<const Point> points_;
    const Tris& tris_;
    PassingDistances near_{};
    double length_ = 0;
    Point origin_, direction_;
    std::vector<Link> ways_;
};

}  // namespace

bool may_pass_beside_vertex(std::span<const Point> points, std::span<const Segment> segments,
                            const TriangulatedPieces& triangulated) {
    const Tris& tris = triangulated.tris;
    const std::vector<SegmentPiece>& pieces = triangulated.pieces;
    constexpr std::size_t grain = 10'000;
    // Where each segment is one edge, its ends say how near it may pass, and a search of the triangles in their order
    // is many times as quick as one that looks up the edges.
    const bool are_whole = pieces.size() == segments.size();
    const auto found =
        core::parallel_blocks(are_whole ? tris.size() : pieces.size(), grain, [&](std::size_t begin, std::size_t end) {
            BesideSearch search(points, tris);
            for (std::size_t i = begin; i < end; ++i)
                if (are_whole ? search.finds_at(static_cast<Index>(i))
                              : search.finds_at(pieces[i], segments, triangulated.at_vertex))
                    return 1;
            return 0;
        });
    return std::find(found.begin(), found.end(), 1) != found.end();
}

}  // namespace lamina::delaunay
