// Crossings of segments by rounds: in each, all crossings of the present pieces are found exactly, rounded, and all
// pieces split at once, so that no order of segments matters. Vertices on segments go first: where they lie exactly on
// several pieces, no rounded crossing can differ from them. Bundles of segments some ulps apart cross again and again
// when rounded; after some rounds pieces are therefore drawn to the vertices within a growing tolerance. After
// J. D. Hobby, Practical segment intersection with finite precision output, Comput. Geom. 13 (1999), whose hot pixels
// are the tolerance here; vertices handed in never move.
#include "delaunay/planarize.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <lamina/error.hpp>

#include "core/box_tree.hpp"
#include "core/predicates.hpp"

namespace lamina::delaunay {

namespace {

/// Two or three rounds are usual. From `exact_rounds` on the tolerance doubles each round, beginning with an ulp of the
/// extent.
constexpr int exact_rounds = 6;
constexpr int most_rounds = 32;

struct Lexicographic {
    bool operator()(Point a, Point b) const { return lexicographically_less(a, b); }
};

/// A different segment may share a piece: what is found out about geometry is kept once an edge.
struct Edge {
    Index a, b;  ///< a lexicographically smaller
    friend auto operator<=>(const Edge&, const Edge&) = default;
};

struct Cut {
    std::size_t edge;
    Index vertex;
    friend auto operator<=>(const Cut&, const Cut&) = default;
};

/// Orders items[begin, end) so that neighbours in the order are neighbours in the plane: halves along the wider side.
void order_by_place(std::span<std::size_t> items, const std::vector<Point>& centers) {
    if (items.size() <= 4) return;
    Box box;
    for (std::size_t i : items) box.include(centers[i]);
    const bool by_x = box.width() > box.height();
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [&](std::size_t l, std::size_t r) {
        const double a = by_x ? centers[l].x : centers[l].y, b = by_x ? centers[r].x : centers[r].y;
        return a != b ? a < b : l < r;
    });
    order_by_place(items.first(items.size() / 2), centers);
    order_by_place(items.subspan(items.size() / 2), centers);
}

/// The edges, findable by their boxes.
class EdgeTree {
public:
    EdgeTree(const std::vector<Point>& points, const std::vector<Edge>& edges)
        : boxes_(edges.size()), order_(edges.size()), tree_(sorted_boxes(points, edges)) {}

    const Box& box(std::size_t edge) const { return boxes_[edge]; }
    template <class Visit>
    void overlaps(const Box& box, Visit&& visit) const {
        tree_.overlaps(box, [&](std::size_t i) { visit(order_[i]); });
    }

private:
    std::vector<Box> sorted_boxes(const std::vector<Point>& points, const std::vector<Edge>& edges) {
        std::vector<Point> centers;
        for (std::size_t i = 0; i < edges.size(); ++i) {
            boxes_[i].include(points[edges[i].a]);
            boxes_[i].include(points[edges[i].b]);
            centers.push_back(boxes_[i].center());
        }
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        order_by_place(order_, centers);
        std::vector<Box> sorted;
        for (std::size_t i : order_) sorted.push_back(boxes_[i]);
        return sorted;
    }

    std::vector<Box> boxes_;
    std::vector<std::size_t> order_;
    core::BoxTree tree_;
};

/// Does p, within the tolerance of a-b, divide it into shorter edges? So no edge is cut without end.
bool divides(Point a, Point b, Point p, double tolerance) {
    const double ab = squared_length(b - a);
    const double off = cross(b - a, p - a);
    return off * off <= tolerance * tolerance * ab && dot(p - a, p - b) < 0 && squared_length(p - a) < ab &&
           squared_length(p - b) < ab;
}

/// Vertices inside edges: exactly on them, or within the tolerance.
std::vector<Cut> vertices_on_edges(const std::vector<Point>& points, const std::vector<Edge>& edges,
                                   const EdgeTree& tree, double tolerance) {
    std::vector<Cut> cuts;
    for (Index v = 0; v < points.size(); ++v) {
        const Point p = points[v], reach{tolerance, tolerance};
        tree.overlaps({p - reach, p + reach}, [&](std::size_t e) {
            const auto [a, b] = edges[e];
            if (v == a || v == b) return;
            // On the line and in the box means on the edge.
            if ((core::inline_orient2d(points[a], points[b], p) == 0 && tree.box(e).contains(p)) ||
                (tolerance > 0 && divides(points[a], points[b], p, tolerance)))
                cuts.push_back({e, v});
        });
    }
    return cuts;
}

bool cross_properly(Point p, Point q, Point r, Point s) {
    const double pr = core::inline_orient2d(p, q, r), ps = core::inline_orient2d(p, q, s);
    if (!((pr > 0 && ps < 0) || (pr < 0 && ps > 0))) return false;
    const double rp = core::inline_orient2d(r, s, p), rq = core::inline_orient2d(r, s, q);
    return (rp > 0 && rq < 0) || (rp < 0 && rq > 0);
}

/// Rounded, but in the boxes of both edges. Precondition: p before q and r before s.
Point crossing_point(Point p, Point q, Point r, Point s) {
    if (lexicographically_less(r, p) || (r == p && lexicographically_less(s, q))) {
        std::swap(p, r);
        std::swap(q, s);
    }
    double t = cross(r - p, s - r) / cross(q - p, s - r);
    // Where even the directions round to parallel, the later beginning is on both.
    if (std::isnan(t)) return lexicographically_less(p, r) ? r : p;
    t = std::clamp(t, 0.0, 1.0);
    const Point x = p + t * (q - p);
    const auto between = [](double value, double a, double b, double c, double d) {
        return std::clamp(value, std::max(std::min(a, b), std::min(c, d)), std::min(std::max(a, b), std::max(c, d)));
    };
    return {between(x.x, p.x, q.x, r.x, s.x), between(x.y, p.y, q.y, r.y, s.y)};
}

/// Adds the crossing points that are no vertices yet; within the tolerance of an end they are that end.
std::vector<Cut> crossings(std::vector<Point>& points, std::map<Point, Index, Lexicographic>& vertex_at,
                           const std::vector<Edge>& edges, const EdgeTree& tree, double tolerance) {
    struct Crossing {
        std::size_t first, second;
        Point at;
    };
    std::vector<Crossing> found;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const Point p = points[edges[e].a], q = points[edges[e].b];
        tree.overlaps(tree.box(e), [&](std::size_t f) {
            if (f <= e) return;
            const Point r = points[edges[f].a], s = points[edges[f].b];
            if (!cross_properly(p, q, r, s)) return;
            Point at = crossing_point(p, q, r, s);
            Point nearest = p;
            for (Point end : {q, r, s})
                if (distance(end, at) < distance(nearest, at)) nearest = end;
            if (distance(nearest, at) <= tolerance) at = nearest;
            found.push_back({e, f, at});
        });
    }
    if (found.empty()) return {};
    if (vertex_at.empty())
        for (Index v = 0; v < points.size(); ++v) vertex_at.emplace(points[v], v);
    std::sort(found.begin(), found.end(),
              [](const Crossing& l, const Crossing& r) { return lexicographically_less(l.at, r.at); });
    std::vector<Cut> cuts;
    for (const Crossing& c : found) {
        const auto [at, is_new] = vertex_at.emplace(c.at, static_cast<Index>(points.size()));
        if (is_new) points.push_back(c.at);
        for (std::size_t e : {c.first, c.second})
            if (at->second != edges[e].a && at->second != edges[e].b) cuts.push_back({e, at->second});
    }
    return cuts;
}

/// Replaces the edges that are cut by chains through their cuts, each piece by a chain in its direction.
void split(const std::vector<Point>& points, const std::vector<Edge>& edges, std::vector<Cut> cuts,
           std::vector<SegmentPiece>& pieces) {
    const auto place = [&](const Cut& c) {
        const auto [a, b] = edges[c.edge];
        return dot(points[c.vertex] - points[a], points[b] - points[a]);
    };
    std::sort(cuts.begin(), cuts.end(), [&](const Cut& l, const Cut& r) {
        if (l.edge != r.edge) return l.edge < r.edge;
        const double at_l = place(l), at_r = place(r);
        return at_l != at_r ? at_l < at_r : lexicographically_less(points[l.vertex], points[r.vertex]);
    });
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());

    std::vector<SegmentPiece> split_pieces;
    for (const SegmentPiece& piece : pieces) {
        const VertexId from = piece.segment.a, to = piece.segment.b;
        const bool forward = lexicographically_less(points[from.index()], points[to.index()]);
        const Edge edge = forward ? Edge{from.value, to.value} : Edge{to.value, from.value};
        const auto e = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
        const auto first = std::lower_bound(cuts.begin(), cuts.end(), e,
                                            [](const Cut& c, std::size_t value) { return c.edge < value; });
        auto last = first;
        while (last != cuts.end() && last->edge == e) ++last;
        std::vector<Index> chain{edge.a};
        for (auto c = first; c != last; ++c) chain.push_back(c->vertex);
        chain.push_back(edge.b);
        if (!forward) std::reverse(chain.begin(), chain.end());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            split_pieces.push_back({{VertexId{chain[i]}, VertexId{chain[i + 1]}}, piece.parent});
    }
    pieces = std::move(split_pieces);
}

std::vector<Edge> edges_of(const std::vector<Point>& points, const std::vector<SegmentPiece>& pieces) {
    std::vector<Edge> edges;
    for (const SegmentPiece& piece : pieces) {
        Edge edge{piece.segment.a.value, piece.segment.b.value};
        if (lexicographically_less(points[edge.b], points[edge.a])) std::swap(edge.a, edge.b);
        edges.push_back(edge);
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

}  // namespace

PlanarSegments planarize(std::span<const Point> points, std::span<const Segment> segments) {
    std::vector<Point> all(points.begin(), points.end());
    std::vector<SegmentPiece> pieces;
    for (std::size_t i = 0; i < segments.size(); ++i) pieces.push_back({segments[i], static_cast<Index>(i)});
    std::map<Point, Index, Lexicographic> vertex_at;
    Box extent;
    for (Point p : points) extent.include(p);
    double tolerance = 0;
    for (int round = 0; round < most_rounds; ++round) {
        const std::vector<Edge> edges = edges_of(all, pieces);
        const EdgeTree tree(all, edges);
        if (round >= exact_rounds)
            tolerance = std::max(2 * tolerance, core::epsilon * std::max(extent.width(), extent.height()));
        std::vector<Cut> cuts = vertices_on_edges(all, edges, tree, tolerance);
        if (cuts.empty()) cuts = crossings(all, vertex_at, edges, tree, tolerance);
        if (cuts.empty()) return {{all.begin() + static_cast<std::ptrdiff_t>(points.size()), all.end()}, pieces};
        split(all, edges, std::move(cuts), pieces);
    }
    throw InputError({}, "crossing segments: rounded crossing points keep crossing others");
}

}  // namespace lamina::delaunay
