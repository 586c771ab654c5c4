// A segment that is no edge yet removes the triangles that it crosses, and the polygons on its two sides are
// triangulated anew (crossed_polygons.hpp). Where a segment runs through a vertex it is split there. Source: M. V.
// Anglada, An improved incremental algorithm for constructing restricted Delaunay triangulations, Computers & Graphics
// 21 (1997).
#include "delaunay/insert_segments.hpp"

#include <cassert>
#include <string>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/crossed_polygons.hpp"

namespace lamina::delaunay {

namespace {

/// The points and the segments that are inserted, as messages name them.
struct SegmentInput {
    std::span<const Point> points;
    std::span<const Segment> segments;
};

std::string segment_name(const SegmentInput& input, std::size_t i) {
    return core::concat("segment ", i, " (", input.segments[i].a.value, "-", input.segments[i].b.value, ")");
}

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

/// How a segment leaves its first vertex a: along an edge or through a triangle.
struct Departure {
    Index along = no_index;  ///< the other end of the edge; no_index if the segment leaves through a triangle
    Link exit;               ///< that triangle and its edge opposite a, which the segment crosses
};

/// Inserts one segment after another into a triangulation.
class SegmentInserter {
public:
    SegmentInserter(const SegmentInput& input, Tris& tris, std::vector<Index>& at_vertex)
        : input_(input), tris_(tris), at_vertex_(at_vertex), polygons_(input.points, tris, at_vertex) {}

    /// Inserts the part of a segment from its vertex a to the first vertex on it, at the latest its end b. Returns that
    /// vertex.
    Index insert_piece(std::size_t segment, Index a, Index b) {
        const Departure departure = depart(a, b);
        if (departure.along != no_index) return departure.along;
        const Index end = collect_crossed(segment, departure.exit, a, b);
        polygons_.fill();
        return end;
    }

private:
    /// Returns how the segment a-b leaves a. An edge that it leaves along becomes constrained.
    Departure depart(Index a, Index b) {
        const std::span<const Point> points = input_.points;
        // Most segments are edges already, and no arithmetic is needed to see that.
        if (const Link edge = find_edge(tris_, at_vertex_, a, b); !edge.is_border()) {
            constrain_edge(tris_, edge.triangle(), edge.edge());
            return {b, Link::border()};
        }
        const Index at_a = at_vertex_[a];
        Index t = at_a;
        Link exit = Link::border();
        do {
            const Tri& tri = tris_[t];
            const unsigned i = tri.v[0] == a ? 0 : tri.v[1] == a ? 1 : 2;
            const Index u = tri.v[next(i)], w = tri.v[previous(i)];
            if (u != ghost_vertex) {
                const double at_u = core::inline_orient2d(points[a], points[u], points[b]);
                if (at_u == 0 && dot(points[u] - points[a], points[b] - points[a]) > 0) {
                    constrain_edge(tris_, t, previous(i));
                    return {u, Link::border()};
                }
                if (w != ghost_vertex && at_u > 0 && core::inline_orient2d(points[a], points[w], points[b]) < 0)
                    exit = Link(t, i);
            }
            t = tri.n[next(i)].triangle();  // counter-clockwise, across a-w
        } while (t != at_a);
        assert(!exit.is_border());
        return {no_index, exit};
    }

    /// Walks along a -> b and collects the crossed triangles and the chains on both sides. Stops at the first vertex on
    /// the segment, at the latest b, and returns it. Does not change the triangulation. Throws InputError at a
    /// constrained edge.
    Index collect_crossed(std::size_t segment, Link exit, Index a, Index b) {
        const std::span<const Point> points = input_.points;
        polygons_.clear();
        Index t = exit.triangle();
        unsigned e = exit.edge();
        polygons_.add_crossed(t);
        polygons_.add_left(t, next(e));
        polygons_.add_right(t, previous(e));
        for (;;) {
            const Link across = tris_[t].n[e];
            if (across.is_constrained()) fail_crossing(input_, segment, tris_[t].v[next(e)], tris_[t].v[previous(e)]);
            t = across.triangle();
            const unsigned k = across.edge();
            polygons_.add_crossed(t);
            const Index x = tris_[t].v[k];
            const double side = x == b ? 0 : core::inline_orient2d(points[a], points[b], points[x]);
            if (side == 0) {
                polygons_.add_left(t, previous(k));
                polygons_.add_right(t, next(k));
                return x;
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
    Tris& tris_;
    std::vector<Index>& at_vertex_;
    CrossedPolygons polygons_;
};

}  // namespace

void check_segments(std::span<const Point> points, std::span<const Segment> segments, const Tris& tris) {
    for (std::size_t i = 0; i < segments.size(); ++i) {
        const auto [a, b] = segments[i];
        if (a.index() >= points.size() || b.index() >= points.size() || a == b)
            throw InputError({.segments = {i}}, core::concat(segment_name({points, segments}, i),
                                                             " does not join two of the ", points.size(), " points"));
    }
    if (tris.empty() && !segments.empty())
        throw InputError({}, "all points lie on one line: segments cannot be inserted");
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
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Index from = segments[i].a.value;
        while (from != segments[i].b.value) {
            const Index to = inserter.insert_piece(i, from, segments[i].b.value);
            pieces.push_back({{VertexId{from}, VertexId{to}}, static_cast<Index>(i)});
            from = to;
        }
    }
    return pieces;
}

void insert_segments(std::span<const Point> points, std::span<const Segment> segments, Tris& tris) {
    const std::vector<SegmentPiece> pieces = insert_and_split_segments(points, segments, tris);
    for (const SegmentPiece& piece : pieces)
        if (piece.segment.b != segments[piece.parent].b)
            fail_through_vertex({points, segments}, piece.parent, piece.segment.b.value);
}

}  // namespace lamina::delaunay
