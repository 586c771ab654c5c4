// A segment that is no edge yet removes the triangles that it crosses, and the polygons on its two sides are
// triangulated anew (crossed_polygons.hpp). Where a segment runs through a vertex it is split there. Source: M. V.
// Anglada, An improved incremental algorithm for constructing restricted Delaunay triangulations, Computers & Graphics
// 21 (1997).
#include "delaunay/constrain/insert_segments.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <string>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/crossed_polygons.hpp"
#include "delaunay/constrain/crossing_point.hpp"

namespace lamina::delaunay {

namespace {

/// The points and the segments that are inserted, as messages name them.
struct SegmentInput {
    std::span<const Point> points;
    std::span<const Segment> segments;
    Index ghost = ghost_vertex;  ///< the number of the vertex at infinity
};

std::string segment_name(const SegmentInput& input, std::size_t i) { return core::segment_name(input.segments, i); }

/// Returns the index of the first segment that the constrained edge c-d is a part of.
std::size_t segment_of_edge(const SegmentInput& input, Index c, Index d) {
    const Point from = input.points[c], to = input.points[d];
    for (std::size_t i = 0; i < input.segments.size(); ++i) {
        const Point a = input.points[input.segments[i].a.index()], b = input.points[input.segments[i].b.index()];
        if (orient2d(a, b, from) == 0 && orient2d(a, b, to) == 0 && dot(from - a, from - b) <= 0 &&
            dot(to - a, to - b) <= 0)
            return i;
    }
    assert(false);
    return 0;
}

[[noreturn]] void fail_through_vertex(const SegmentInput& input, std::size_t segment, Index v) {
    throw InputError({.at = input.points[v], .points = {v}, .segments = {segment}},
                     core::concat(segment_name(input, segment), " passes through point ", v));
}

/// Throws the error for a segment that crosses the constrained edge c-d.
[[noreturn]] void fail_crossing(const SegmentInput& input, std::size_t segment, Index c, Index d) {
    const Point p = input.points[input.segments[segment].a.index()],
                q = input.points[input.segments[segment].b.index()];
    const Point r = input.points[c], s = input.points[d];
    const double t = cross(r - p, s - r) / cross(q - p, s - r);
    const std::size_t other = segment_of_edge(input, c, d);
    throw InputError({.at = p + t * (q - p), .segments = {segment, other}},
                     core::concat(segment_name(input, segment), " crosses ", segment_name(input, other)));
}

/// How a segment leaves one of its ends: along an edge or through a triangle.
struct Departure {
    Index at;                ///< the end
    Index along = no_index;  ///< the other vertex of the edge; no_index if the segment leaves through a triangle
    Link exit;               ///< the edge; or the edge opposite `at` of the triangle, which the segment crosses
};

/// Turns round a vertex, from triangle to triangle, to find how the segment to `target` leaves it.
class DepartureSearch {
public:
    DepartureSearch(const SegmentInput& input, const Tris& tris, Index first, Index at, Index target)
        : points_(input.points), tris_(tris), ghost_(input.ghost), at_(at), target_(target), t_(first) {}

    /// Looks at the next triangle. Returns whether the departure is known.
    bool step(Departure& departure) {
        const Tri& tri = tris_[t_];
        const unsigned i = tri.v[0] == at_ ? 0 : tri.v[1] == at_ ? 1 : 2;
        const Index u = tri.v[next(i)], w = tri.v[previous(i)];
        if (u != ghost_) {
            const double at_u = core::inline_orient2d(points_[at_], points_[u], points_[target_]);
            if (at_u == 0 && dot(points_[u] - points_[at_], points_[target_] - points_[at_]) > 0) {
                departure = {at_, u, Link(t_, previous(i))};
                return true;
            }
            if (w != ghost_ && at_u > 0 && core::inline_orient2d(points_[at_], points_[w], points_[target_]) < 0) {
                departure = {at_, no_index, Link(t_, i)};
                return true;
            }
        }
        t_ = tri.n[next(i)].triangle();  // counter-clockwise, across at-w
        return false;
    }

private:
    std::span<const Point> points_;
    const Tris& tris_;
    Index ghost_;
    Index at_, target_;
    Index t_;  ///< the triangle to look at
};

/// What became of a segment.
enum class Insertion {
    complete,
    crossed,  ///< it crosses a constrained edge
    beyond    ///< it leaves the reach
};

/// Inserts one segment after another into the part of a triangulation that is within reach.
class SegmentInserter {
public:
    SegmentInserter(const SegmentInput& input, Tris& tris, std::vector<Index>& at_vertex, const Reach& reach = {})
        : input_(input),
          reach_(reach),
          tris_(tris),
          at_vertex_(at_vertex),
          polygons_(input.points, reach_, tris, at_vertex) {}

    /// Inserts a segment, and appends its pieces. Where it crosses a constrained edge, crossed() gives this edge. Where
    /// it is not completed, the pieces before and behind have been inserted.
    Insertion insert(std::size_t segment, std::vector<SegmentPiece>& pieces) {
        const auto parent = static_cast<Index>(segment);
        Index from = input_.segments[segment].a.value, to = input_.segments[segment].b.value;
        if (crosses_last_way_out(from, to)) return Insertion::beyond;
        Insertion outcome = Insertion::complete;
        at_far_end_.clear();
        while (from != to) {
            if (!reach_.has_vertex(from) && !reach_.has_vertex(to)) {
                outcome = Insertion::beyond;
                break;
            }
            const Departure departure = depart(from, to);
            const bool forward = departure.at == from;
            bool repeats = false;
            Index end = departure.along;
            if (end != no_index) {
                const Link edge = departure.exit;
                assert(tris_[edge.triangle()].v[next(edge.edge())] == departure.at);
                assert(tris_[edge.triangle()].v[previous(edge.edge())] == end);
                const Link across = tris_[edge.triangle()].n[edge.edge()];
                if (!reach_.has_triangle(edge.triangle()) || !reach_.has_triangle(across.triangle())) {
                    outcome = Insertion::beyond;
                    break;
                }
                repeats = across.is_constrained();
                constrain_edge(tris_, edge.triangle(), edge.edge());
            } else {
                outcome = collect_crossed(departure.exit, departure.at, forward ? to : from, end);
                if (outcome != Insertion::complete) break;
                polygons_.fill();
            }
            assert(end != departure.at && end < at_vertex_.size());
            if (forward)
                pieces.push_back({{VertexId{from}, VertexId{end}}, parent, repeats});
            else
                at_far_end_.push_back({{VertexId{end}, VertexId{to}}, parent, repeats});
            (forward ? from : to) = end;
        }
        pieces.insert(pieces.end(), at_far_end_.rbegin(), at_far_end_.rend());
        assert(outcome != Insertion::complete || input_.segments[segment].a == input_.segments[segment].b ||
               (pieces.back().parent == parent && pieces.back().segment.b == input_.segments[segment].b));
        return outcome;
    }

    CrossedEdge crossed() const { return crossed_; }

private:
    /// Returns whether a-b crosses the edge where the last segment left the reach, which nothing removes. Neighbours of
    /// such a segment are often as long, and need not be followed to the same edge.
    bool crosses_last_way_out(Index a, Index b) const {
        const auto [c, d] = last_way_out_;
        if (c == no_index) return false;
        const std::span<const Point> points = input_.points;
        return cross_properly(points[a], points[b], points[c], points[d]);
    }

    /// Returns whether a triangle is known that has v as a corner. Precondition: v is within reach.
    bool is_vertex(Index v) const { return at_vertex_[v] < tris_.size() && has_corner(tris_[at_vertex_[v]], v); }

    /// Returns how the segment a-b leaves a or, where many edges meet at a, one of its ends. So hubs of n segments do
    /// not take O(n^2): in a planar graph the smaller degrees of the ends of its n edges add up to O(n).
    /// Precondition: an end is within reach.
    Departure depart(Index a, Index b) const {
        if (!reach_.has_vertex(a)) return depart_from(b, a);
        if (!reach_.has_vertex(b)) return depart_from(a, b);
        assert(is_vertex(a) && is_vertex(b));
        // Most segments are edges already, and no arithmetic is needed to see that.
        if (const Link edge = find_edge(tris_, at_vertex_, a, b); !edge.is_border()) return {a, b, edge};
        constexpr unsigned many_edges = 64;
        Departure departure{};
        DepartureSearch from_a(input_, tris_, at_vertex_[a], a, b), from_b(input_, tris_, at_vertex_[b], b, a);
        for (unsigned steps = 0;; ++steps)
            if (from_a.step(departure) || (steps >= many_edges && from_b.step(departure))) return departure;
    }

    Departure depart_from(Index at, Index target) const {
        assert(is_vertex(at));
        Departure departure{};
        DepartureSearch search(input_, tris_, at_vertex_[at], at, target);
        while (!search.step(departure)) continue;
        return departure;
    }

    /// Walks along a -> b and collects the crossed triangles and the chains on both sides. Stops at the first vertex on
    /// the segment, at the latest b, which becomes the `end`; or before that, at a constrained edge or a triangle
    /// beyond the reach. Does not change the triangulation.
    Insertion collect_crossed(Link exit, Index a, Index b, Index& end) {
        const std::span<const Point> points = input_.points;
        polygons_.clear();
        Index t = exit.triangle();
        unsigned e = exit.edge();
        assert(tris_[t].v[e] == a);
        if (!reach_.has_triangle(t)) return Insertion::beyond;
        polygons_.add_crossed(t);
        polygons_.add_left(t, next(e));
        polygons_.add_right(t, previous(e));
        for (;;) {
            const Link across = tris_[t].n[e];
            if (across.is_constrained()) {
                crossed_ = {tris_[t].v[next(e)], tris_[t].v[previous(e)]};
                return Insertion::crossed;
            }
            if (!reach_.has_triangle(across.triangle())) {
                last_way_out_ = {tris_[t].v[next(e)], tris_[t].v[previous(e)]};
                return Insertion::beyond;
            }
            t = across.triangle();
            const unsigned k = across.edge();
            polygons_.add_crossed(t);
            const Index x = tris_[t].v[k];
            const double side = x == b ? 0 : core::inline_orient2d(points[a], points[b], points[x]);
            if (side == 0) {
                polygons_.add_left(t, previous(k));
                polygons_.add_right(t, next(k));
                end = x;
                return Insertion::complete;
            }
            if (side > 0) {
                polygons_.add_left(t, previous(k));
                e = next(k);
            } else {
                polygons_.add_right(t, next(k));
                e = previous(k);
            }
        }
    }

    const SegmentInput& input_;
    const Reach reach_;
    Tris& tris_;
    std::vector<Index>& at_vertex_;
    CrossedPolygons polygons_;
    CrossedEdge crossed_{};
    CrossedEdge last_way_out_{no_index, no_index};
    std::vector<SegmentPiece> at_far_end_;  ///< pieces of the present segment, from its end on
};

}  // namespace

void check_segments(std::span<const Point> points, std::span<const Segment> segments, const Tris& tris) {
    core::require_indices_below(points.size(), segments);
    if (!tris.empty()) return;
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (segments[i].a != segments[i].b)
            throw InputError({.points = {segments[i].a.index(), segments[i].b.index()}, .segments = {i}},
                             "all points lie on one line: segments cannot be inserted");
}

std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris) {
    std::vector<Index> at_vertex = triangle_at_vertex(tris, points.size());
    return insert_and_split_segments(points, segments, tris, at_vertex);
}

std::vector<SegmentPiece> insert_and_split_segments(std::span<const Point> points, std::span<const Segment> segments,
                                                    Tris& tris, std::vector<Index>& at_vertex) {
    const SegmentInput input{points, segments};
    check_segments(points, segments, tris);
    std::vector<SegmentPiece> pieces;
    pieces.reserve(segments.size());
    SegmentInserter inserter(input, tris, at_vertex);
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (inserter.insert(i, pieces) == Insertion::crossed)
            fail_crossing(input, i, inserter.crossed().c, inserter.crossed().d);
    return pieces;
}

UncrossedSegments insert_uncrossed_segments(std::span<const Point> points, std::span<const Segment> segments,
                                            std::span<const Index> which, const Reach& reach, Tris& tris,
                                            std::vector<Index>& at_vertex) {
    const SegmentInput input{points, segments};
    UncrossedSegments result;
    result.pieces.reserve(which.size());
    SegmentInserter inserter(input, tris, at_vertex, reach);
    for (const Index i : which) {
        const std::size_t first = result.pieces.size();
        const Insertion outcome = inserter.insert(i, result.pieces);
        if (outcome == Insertion::complete) continue;
        result.pieces.resize(first);
        (outcome == Insertion::crossed ? result.crossing : result.beyond).push_back(i);
    }
    return result;
}

UncrossedSegments insert_uncrossed_segments(std::span<const Point> points, std::span<const Segment> segments,
                                            Tris& tris, std::vector<Index>& at_vertex) {
    check_segments(points, segments, tris);
    std::vector<Index> all(segments.size());
    std::iota(all.begin(), all.end(), Index{0});
    return insert_uncrossed_segments(points, segments, all, Reach(), tris, at_vertex);
}

std::optional<CrossedEdge> insert_segment(std::span<const Point> points, Segment segment, Tris& tris,
                                          std::vector<Index>& at_vertex, Index ghost,
                                          std::vector<SegmentPiece>& pieces) {
    const SegmentInput input{points, {&segment, 1}, ghost};
    SegmentInserter inserter(input, tris, at_vertex);
    if (inserter.insert(0, pieces) == Insertion::complete) return std::nullopt;
    return inserter.crossed();
}

void insert_segments(std::span<const Point> points, std::span<const Segment> segments, Tris& tris) {
    const std::vector<SegmentPiece> pieces = insert_and_split_segments(points, segments, tris);
    for (const SegmentPiece& piece : pieces)
        if (piece.segment.b != segments[piece.parent].b)
            fail_through_vertex({points, segments}, piece.parent, piece.segment.b.value);
}

}  // namespace lamina::delaunay
