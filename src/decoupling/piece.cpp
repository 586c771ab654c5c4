// Tracing by turning as far left as possible at every vertex; M. de Berg et al., Computational Geometry (2008),
// chapter 2 (doubly-connected edge lists). Angular comparisons are exact.
#include "decoupling/piece.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>

#include "core/parallel.hpp"
#include "core/predicates.hpp"

namespace lamina::decoupling {

namespace {

/// Upper half plane first (angle in [0, pi)), counter-clockwise inside a half.
bool angle_less(Point origin, Point a, Point b) {
    const auto lower = [&](Point p) { return p.y < origin.y || (p.y == origin.y && p.x < origin.x); };
    if (lower(a) != lower(b)) return lower(b);
    return core::inline_orient2d(origin, a, b) > 0;
}

/// Is p inside the closed loop? Exact crossing count along the ray to +x.
bool inside(std::span<const Point> points, std::span<const VertexId> loop, Point p) {
    bool in = false;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Point a = points[loop[i].index()], b = points[loop[i + 1 < loop.size() ? i + 1 : 0].index()];
        if ((a.y <= p.y) == (b.y <= p.y)) continue;
        const double side = core::inline_orient2d(a, b, p);
        if (b.y > a.y ? side > 0 : side < 0) in = !in;
    }
    return in;
}

double doubled_area(std::span<const Point> points, std::span<const VertexId> loop) {
    // Relative to a vertex of the loop: far from the origin the products would cancel.
    const Point o = points[loop.front().index()];
    double area = 0;
    for (std::size_t i = 0; i + 1 < loop.size(); ++i)
        area += cross(points[loop[i].index()] - o, points[loop[i + 1].index()] - o);
    return area;
}

/// Edges leaving each vertex, counter-clockwise, as places in `edges`.
struct Star {
    std::vector<std::size_t> start;  ///< per vertex, one more
    std::vector<std::uint32_t> edge;
};

Star leaving_edges(std::span<const Point> points, std::span<const Segment> edges) {
    Star star;
    star.start.assign(points.size() + 1, 0);
    for (const Segment& e : edges) ++star.start[e.a.index() + 1];
    for (std::size_t v = 0; v < points.size(); ++v) star.start[v + 1] += star.start[v];
    star.edge.resize(edges.size());
    std::vector<std::size_t> fill(star.start.begin(), star.start.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e) star.edge[fill[edges[e].a.index()]++] = e;
    core::parallel_for(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t v = begin; v < end; ++v)
            std::sort(star.edge.begin() + static_cast<std::ptrdiff_t>(star.start[v]),
                      star.edge.begin() + static_cast<std::ptrdiff_t>(star.start[v + 1]),
                      [&](std::uint32_t l, std::uint32_t r) {
                          return angle_less(points[v], points[edges[l].b.index()], points[edges[r].b.index()]);
                      });
    });
    return star;
}

/// The edge that follows e round the piece on its left: of those leaving its end, the first one clockwise from the way
/// back.
///
///        following
///            ^   .
///            |  /          the way back is the edge drawn dotted;
///    e.a --> v ..          turning clockwise from it, `following` comes first
std::uint32_t following(std::span<const Point> points, std::span<const Segment> edges, const Star& star,
                        std::uint32_t e) {
    const auto [u, v] = edges[e];
    const std::size_t begin = star.start[v.index()], end = star.start[v.index() + 1];
    assert(begin < end);
    // The last edge with a smaller angle than the way back, cyclically.
    std::size_t k = begin;
    while (k < end && angle_less(points[v.index()], points[edges[star.edge[k]].b.index()], points[u.index()])) ++k;
    return star.edge[k == begin ? end - 1 : k - 1];
}

}  // namespace

std::vector<Piece> trace_pieces(std::span<const Point> points, std::span<const Segment> edges) {
    const Star star = leaving_edges(points, edges);
    std::vector<Piece> pieces;
    std::vector<std::vector<VertexId>> holes;
    std::vector<char> done(edges.size(), 0);
    for (std::uint32_t first = 0; first < edges.size(); ++first) {
        if (done[first]) continue;
        std::vector<VertexId> loop;
        for (std::uint32_t e = first; !done[e]; e = following(points, edges, star, e)) {
            done[e] = 1;
            loop.push_back(edges[e].a);
        }
        if (doubled_area(points, loop) > 0)
            pieces.push_back({{std::move(loop)}});
        else
            holes.push_back(std::move(loop));
    }
    // Pieces do not overlap, so the outer loops that hold a hole are nested; the innermost has the smallest area.
    std::vector<double> area;
    for (const Piece& p : pieces) area.push_back(doubled_area(points, p.loops.front()));
    for (std::vector<VertexId>& hole : holes) {
        std::size_t owner = pieces.size();
        for (std::size_t p = 0; p < pieces.size(); ++p) {
            // Pieces inside the hole have its vertices on their borders.
            const std::vector<VertexId>& outer = pieces[p].loops.front();
            if (std::find(outer.begin(), outer.end(), hole.front()) == outer.end() &&
                inside(points, outer, points[hole.front().index()]) &&
                (owner == pieces.size() || area[p] < area[owner]))
                owner = p;
        }
        if (owner < pieces.size()) pieces[owner].loops.push_back(std::move(hole));
    }
    return pieces;
}

Halves split(const Piece& piece, std::size_t from, std::size_t to, std::span<const VertexId> line) {
    const std::vector<VertexId>& loop = piece.loops.front();
    const auto along = [&](std::size_t first, std::size_t last, std::vector<VertexId>& part) {
        for (std::size_t i = first; i != last; i = i + 1 < loop.size() ? i + 1 : 0) part.push_back(loop[i]);
    };
    std::vector<VertexId> first{loop[from]}, second{loop[to]};
    first.insert(first.end(), line.begin(), line.end());
    along(to, from, first);
    second.insert(second.end(), line.rbegin(), line.rend());
    along(from, to, second);
    return {{{std::move(first)}}, {{std::move(second)}}};
}

Piece join(const Piece& piece, Corner from, Corner to, std::span<const VertexId> line) {
    const auto round = [&](Corner corner, std::vector<VertexId>& part) {
        const std::vector<VertexId>& loop = piece.loops[corner.loop];
        for (std::size_t k = 0; k <= loop.size(); ++k) part.push_back(loop[(corner.place + k) % loop.size()]);
    };
    std::vector<VertexId> joined;
    round(from, joined);
    joined.insert(joined.end(), line.begin(), line.end());
    round(to, joined);
    joined.insert(joined.end(), line.rbegin(), line.rend());
    Piece result;
    for (std::size_t l = 0; l < piece.loops.size(); ++l) {
        if (l == std::min(from.loop, to.loop))
            result.loops.push_back(std::move(joined));
        else if (l != std::max(from.loop, to.loop))
            result.loops.push_back(piece.loops[l]);
    }
    return result;
}

}  // namespace lamina::decoupling
