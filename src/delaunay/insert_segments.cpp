// Constraint insertion: the triangles that a segment crosses are removed and the polygons on its two sides triangulated
// anew; where it runs through a vertex it is split there. Source: M. V. Anglada, An improved incremental algorithm for
// constructing restricted Delaunay triangulations, Computers & Graphics 21 (1997). The opposite vertex of each base is
// chosen with the perturbed incircle test, so the result obeys the one tie rule.
#include <algorithm>
#include <cassert>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/predicates.hpp"
#include "core/text.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

namespace {

/// An edge of the polygon beside a segment. Where both sides of an edge belong to the polygon (it dangles), `partner`
/// is the other side's place in the list of all chain edges.
struct ChainEdge {
    Index a, b;
    Link inside;  ///< triangle (to be removed) and edge from which it was seen
    Link outer;   ///< what lies across
    Index partner = no_index;
    Link filled;  ///< the new triangle on the inside, once made
};

/// Scratch space of one call of insert_segments().
struct Workspace {
    std::vector<Index> crossed;      ///< triangles to be removed
    std::vector<ChainEdge> edges;    ///< of both chains
    std::vector<Index> left, right;  ///< indices into edges, in the order from a to b
    std::vector<Index> chain;        ///< the chain being filled, as indices into edges
    std::vector<Index> vertices;     ///< and its vertices, one more
    struct Range {
        std::size_t low, high;  ///< vertices of the chain; the polygon lies left of low -> high
        Link base;              ///< the new triangle across the base
    };
    std::vector<Range> ranges;
};

/// The segments being inserted, for messages.
struct Input {
    std::span<const Point> points;
    std::span<const Segment> segments;
};

std::string segment_name(const Input& input, std::size_t i) {
    return core::concat("segment ", i, " (", input.segments[i].a.value, "-", input.segments[i].b.value, ")");
}

/// Where c-d is a part of a segment: that segment.
std::size_t segment_of_edge(const Input& input, Index c, Index d) {
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

[[noreturn]] void fail_through_vertex(const Input& input, std::size_t segment, Index v) {
    throw InputError({.at = input.points[v], .points = {v}, .segments = {segment}},
                     core::concat(segment_name(input, segment), " passes through point ", v));
}

[[noreturn]] void fail_crossing(const Input& input, std::size_t segment, Index c, Index d) {
    const Point p = input.points[input.segments[segment].a.index()],
                q = input.points[input.segments[segment].b.index()];
    const Point r = input.points[c], s = input.points[d];
    const double t = cross(r - p, s - r) / cross(q - p, s - r);
    const std::size_t other = segment_of_edge(input, c, d);
    throw InputError({.at = p + t * (q - p), .segments = {segment, other}},
                     core::concat(segment_name(input, segment), " crosses ", segment_name(input, other)));
}

void constrain_edge(Tris& tris, Index triangle, unsigned edge) {
    const Link outer = tris[triangle].n[edge];
    tris[triangle].n[edge] = outer.fixed();
    if (!outer.is_border()) tris[outer.triangle()].n[outer.edge()] = Link(triangle, edge, true);
}

/// How a segment leaves its first vertex.
struct Departure {
    Index along = no_index;  ///< the next vertex, where the segment leaves along an edge; the edge is fixed
    Link exit;               ///< otherwise the edge, opposite a, through which it leaves: (triangle, edge)
};

Departure depart(std::span<const Point> points, Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b) {
    // Most segments are edges already, which takes no arithmetic to see.
    if (const Link edge = find_edge(tris, at_vertex, a, b); !edge.is_border()) {
        constrain_edge(tris, edge.triangle(), edge.edge());
        return {b, Link::border()};
    }
    const Index at_a = at_vertex[a];
    Index t = at_a;
    Link exit = Link::border();
    do {
        const Tri& tri = tris[t];
        const unsigned i = tri.v[0] == a ? 0 : tri.v[1] == a ? 1 : 2;
        const Index u = tri.v[next(i)], w = tri.v[previous(i)];
        if (u != ghost_vertex) {
            const double at_u = core::inline_orient2d(points[a], points[u], points[b]);
            if (at_u == 0 && dot(points[u] - points[a], points[b] - points[a]) > 0) {
                constrain_edge(tris, t, previous(i));
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

/// Walks along a -> b and collects the crossed triangles and the two chains:
///
///        w0 ---- w1 ------- w2
///       /  \    /  \      /    \        left chain   a w0 w1 w2 b
///      a ---\--/----\----/----- b       right chain  a u0 u1 b
///       \    \/      \  /      /
///        u0 ---------- u1 ----
///
/// Stops at the first vertex on the segment, at the latest b, and returns it. Nothing is changed.
Index collect_crossed(const Input& input, std::size_t segment, const Tris& tris, Link exit, Index a, Index b,
                      Workspace& work) {
    const std::span<const Point> points = input.points;
    work.crossed.clear();
    work.edges.clear();
    work.left.clear();
    work.right.clear();
    const auto chain_edge = [&](std::vector<Index>& side, Index triangle, unsigned edge) {
        const Tri& t = tris[triangle];
        side.push_back(static_cast<Index>(work.edges.size()));
        work.edges.push_back({t.v[next(edge)], t.v[previous(edge)], Link(triangle, edge), t.n[edge], no_index, {}});
    };
    Index t = exit.triangle();
    unsigned e = exit.edge();
    work.crossed.push_back(t);
    chain_edge(work.left, t, next(e));
    chain_edge(work.right, t, previous(e));
    for (;;) {
        const Link across = tris[t].n[e];
        if (across.is_constrained()) fail_crossing(input, segment, tris[t].v[next(e)], tris[t].v[previous(e)]);
        t = across.triangle();
        const unsigned k = across.edge();
        work.crossed.push_back(t);
        const Index x = tris[t].v[k];
        const double side = x == b ? 0 : core::inline_orient2d(points[a], points[b], points[x]);
        if (side == 0) {
            chain_edge(work.left, t, previous(k));
            chain_edge(work.right, t, next(k));
            return x;
        }
        if (side > 0) {
            chain_edge(work.left, t, previous(k));
            e = next(k);
        } else {
            chain_edge(work.right, t, next(k));
            e = previous(k);
        }
    }
}

/// Finds the chain edges whose other side is removed, too (see ChainEdge). The removed triangles serve as the table:
/// their links are overwritten by places in the list.
void pair_dangling_edges(Tris& tris, Workspace& work) {
    // A ghost has one vertex of this number, never two.
    for (Index t : work.crossed) tris[t].v[0] = tris[t].v[1] = no_index;
    for (Index i = 0; i < work.edges.size(); ++i) {
        const ChainEdge& edge = work.edges[i];
        tris[edge.inside.triangle()].n[edge.inside.edge()] = Link(i, 0);
    }
    for (ChainEdge& edge : work.edges) {
        if (edge.outer.is_border()) continue;
        const Tri& t = tris[edge.outer.triangle()];
        if (t.v[0] == no_index && t.v[1] == no_index) edge.partner = t.n[edge.outer.edge()].triangle();
    }
}

/// Connects a new triangle to a chain edge, or two new ones where the edge dangles.
void attach(Tris& tris, Workspace& work, Index chain_edge, Index triangle, unsigned edge) {
    ChainEdge& c = work.edges[chain_edge];
    c.filled = Link(triangle, edge);
    if (c.partner == no_index)
        connect(tris, triangle, edge, c.outer);
    else if (const Link other = work.edges[c.partner].filled; !other.is_border())
        connect(tris, triangle, edge, Link(other.triangle(), other.edge(), c.outer.is_constrained()));
}

/// Does the direction from u to x lie in the closed sector that opens counter-clockwise from `from` to `to`?
bool in_sector(Point u, Point from, Point to, Point x) {
    if (from == to) return true;
    const double opening = core::inline_orient2d(u, from, to);
    if (opening >= 0) return core::inline_orient2d(u, from, x) >= 0 && core::inline_orient2d(u, x, to) >= 0;
    return !(core::inline_orient2d(u, to, x) > 0 && core::inline_orient2d(u, x, from) > 0);
}

/// The place in the chain, strictly between low and high, of the vertex that forms a triangle with low -> high: left of
/// it, and no other such vertex in its circle. A vertex from which edges dangle stands in the chain several times: the
/// place whose interior angle faces the base is the one.
std::size_t opposite_vertex(std::span<const Point> points, const std::vector<Index>& vertices, std::size_t low,
                            std::size_t high) {
    const Index a = vertices[low], b = vertices[high];
    std::size_t k = low;
    for (std::size_t i = low + 1; i < high; ++i) {
        const Index v = vertices[i];
        if (core::inline_orient2d(points[a], points[b], points[v]) <= 0) continue;
        if (k == low ||
            (v == vertices[k]
                 ? in_sector(points[v], points[vertices[i - 1]], points[vertices[i + 1]], points[a])
                 : core::inline_incircle_perturbed(points[a], points[b], points[vertices[k]], points[v]) > 0))
            k = i;
    }
    assert(k != low);
    return k;
}

/// Triangulates the polygon between the chain and its base, the straight line from its first to its last vertex, which
/// has the polygon on its left. The triangles come from the end of `crossed`. Returns the triangle at the base, as
/// (triangle, edge 2).
///
///             k                 the vertex k whose circle with the base holds no other vertex of the chain
///           /   \               makes the triangle; what remains on both sides is the same problem
///       ../       \..
///      low ------- high
Link fill_polygon(std::span<const Point> points, Tris& tris, Workspace& work, std::vector<Index>& at_vertex) {
    // Seen from the crossed triangles the edges run against the chain, which has its polygon on the right.
    work.vertices.assign(1, work.edges[work.chain.front()].b);
    for (Index e : work.chain) work.vertices.push_back(work.edges[e].a);
    Link top = Link::border();
    work.ranges.assign(1, {0, work.chain.size(), Link::border()});
    while (!work.ranges.empty()) {
        const Workspace::Range r = work.ranges.back();
        work.ranges.pop_back();
        const std::size_t k = opposite_vertex(points, work.vertices, r.low, r.high);
        const Index t = work.crossed.back();
        work.crossed.pop_back();
        const Index v[3] = {work.vertices[r.low], work.vertices[r.high], work.vertices[k]};
        for (unsigned i = 0; i < 3; ++i) {
            tris[t].v[i] = v[i];
            tris[t].n[i] = Link::border();
            at_vertex[v[i]] = t;
        }
        if (r.base.is_border())
            top = Link(t, 2);
        else
            connect(tris, t, 2, r.base);
        if (r.high == k + 1)
            attach(tris, work, work.chain[k], t, 0);
        else
            work.ranges.push_back({k, r.high, Link(t, 0)});
        if (k == r.low + 1)
            attach(tris, work, work.chain[r.low], t, 1);
        else
            work.ranges.push_back({r.low, k, Link(t, 1)});
    }
    return top;
}

/// fill_polygon() for long chains, where looking at every vertex for every triangle would cost O(k^2): the polygon's
/// constrained triangulation is a part of that of its vertices. Chain edges were Delaunay edges of more points, or
/// segments: nearly all stand in the plain triangulation, and inserting the others is a smaller problem of this kind.
Link fill_long_polygon(std::span<const Point> points, Tris& tris, Workspace& work, std::vector<Index>& at_vertex) {
    std::vector<Index> chain(1, work.edges[work.chain.front()].b);
    for (Index e : work.chain) chain.push_back(work.edges[e].a);
    std::vector<Index> global = chain;
    std::sort(global.begin(), global.end());
    global.erase(std::unique(global.begin(), global.end()), global.end());
    const auto local = [&](Index v) {
        return VertexId(static_cast<std::size_t>(std::lower_bound(global.begin(), global.end(), v) - global.begin()));
    };
    std::vector<Point> vertices;
    for (Index v : global) vertices.push_back(points[v]);
    // Directed with the polygon on the left; the base is the last.
    std::vector<Segment> rim;
    for (std::size_t i = 0; i < work.chain.size(); ++i) rim.push_back({local(chain[i + 1]), local(chain[i])});
    rim.push_back({local(chain.front()), local(chain.back())});
    Tris inside = triangulate_points(vertices);
    insert_segments(vertices, rim, inside);
    inside = keep_left_of_segments({&rim.back(), 1}, inside, vertices.size());
    assert(inside.size() + 1 == work.chain.size());

    std::vector<std::pair<Segment, Index>> rim_places;
    for (std::size_t i = 0; i < rim.size(); ++i) rim_places.push_back({rim[i], static_cast<Index>(i)});
    std::sort(rim_places.begin(), rim_places.end());
    const std::vector<Index> made(work.crossed.end() - static_cast<std::ptrdiff_t>(inside.size()), work.crossed.end());
    work.crossed.resize(work.crossed.size() - inside.size());
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (unsigned e = 0; e < 3; ++e) {
            const Link n = inside[i].n[e];
            const Index v = global[inside[i].v[e]];
            tris[made[i]].v[e] = v;
            tris[made[i]].n[e] = n.is_constrained() ? Link::border() : Link(made[n.triangle()], n.edge());
            at_vertex[v] = made[i];
        }
    Link top = Link::border();
    for (std::size_t i = 0; i < inside.size(); ++i)
        for (unsigned e = 0; e < 3; ++e) {
            if (!inside[i].n[e].is_constrained()) continue;
            const Segment edge{VertexId{inside[i].v[next(e)]}, VertexId{inside[i].v[previous(e)]}};
            const Index place =
                std::lower_bound(rim_places.begin(), rim_places.end(), std::pair{edge, Index{0}})->second;
            if (place + 1 == rim.size())
                top = Link(made[i], e);
            else
                attach(tris, work, work.chain[place], made[i], e);
        }
    return top;
}

/// Triangulates the polygon of work.chain. Returns the new triangle at the base and its edge there.
Link fill(std::span<const Point> points, Tris& tris, Workspace& work, std::vector<Index>& at_vertex) {
    constexpr std::size_t long_chain = 100;
    return work.chain.size() < long_chain ? fill_polygon(points, tris, work, at_vertex)
                                          : fill_long_polygon(points, tris, work, at_vertex);
}

/// Inserts the segment's part from vertex a to the first vertex on it, at the latest b. Returns that vertex.
Index insert_piece(const Input& input, std::size_t segment, Tris& tris, std::vector<Index>& at_vertex, Index a, Index b,
                   Workspace& work) {
    const Departure departure = depart(input.points, tris, at_vertex, a, b);
    if (departure.along != no_index) return departure.along;
    const Index end = collect_crossed(input, segment, tris, departure.exit, a, b, work);
    pair_dangling_edges(tris, work);
    work.chain = work.left;
    const Link left = fill(input.points, tris, work, at_vertex);
    // The right chain, walked from end to a, has its polygon on the left as well.
    work.chain.assign(work.right.rbegin(), work.right.rend());
    const Link right = fill(input.points, tris, work, at_vertex);
    connect(tris, left.triangle(), left.edge(), right.fixed());
    return end;
}

}  // namespace

std::vector<Index> triangle_at_vertex(const Tris& tris, std::size_t point_count) {
    std::vector<Index> at(point_count, no_index);
    for (Index t = 0; t < tris.size(); ++t)
        for (Index v : tris[t].v)
            if (v != ghost_vertex) at[v] = t;
    return at;
}

Link find_edge(const Tris& tris, const std::vector<Index>& at_vertex, Index a, Index b) {
    const Index start = at_vertex[a];
    Index t = start;
    do {
        const Tri& tri = tris[t];
        const unsigned i = tri.v[0] == a ? 0 : tri.v[1] == a ? 1 : 2;
        if (tri.v[next(i)] == b) return Link(t, previous(i));
        t = tri.n[next(i)].triangle();
    } while (t != start);
    return Link::border();
}

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
    const Input input{points, segments};
    check_segments(points, segments, tris);
    std::vector<SegmentPiece> pieces;
    pieces.reserve(segments.size());
    Workspace work;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        Index from = segments[i].a.value;
        while (from != segments[i].b.value) {
            const Index to = insert_piece(input, i, tris, at_vertex, from, segments[i].b.value, work);
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
