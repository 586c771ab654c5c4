// Segments are split at their crossings in rounds. Each round finds all crossings of the present pieces exactly, rounds
// them, and splits all pieces at once, so the order of the segments does not matter. Before it looks for crossings, a
// round splits pieces at the vertices on them: where a vertex lies exactly on several pieces, no rounded crossing can
// then differ from it. Bundles of segments some ulps apart cross again and again when rounded; after some rounds pieces
// are therefore drawn to the vertices within a growing tolerance. Vertices of the input never move.
// Source: J. D. Hobby, Practical segment intersection with finite precision output, Comput. Geom. 13 (1999); the
// tolerance here takes the place of his hot pixels.
#include "delaunay/planarize.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include <lamina/error.hpp>

#include "core/bounding_box.hpp"
#include "core/box_tree.hpp"
#include "core/predicates.hpp"

namespace lamina::delaunay {

namespace {

/// Two or three rounds are usual. After `exact_rounds` the tolerance, at first an ulp of the extent, doubles each
/// round.
constexpr int exact_rounds = 6;
constexpr int max_planarize_rounds = 32;

struct Lexicographic {
    bool operator()(Point a, Point b) const { return lexicographically_less(a, b); }
};

/// An edge that one or several pieces run along, in either direction. Its geometry is looked at only once.
struct PieceEdge {
    Index a, b;  ///< a is lexicographically smaller than b
    friend bool operator==(const PieceEdge&, const PieceEdge&) = default;
    friend bool operator<(const PieceEdge& l, const PieceEdge& r) { return l.a != r.a ? l.a < r.a : l.b < r.b; }
};

/// An edge, by its index, and a vertex that divides it.
struct EdgeCut {
    std::size_t edge;
    Index vertex;
    friend bool operator==(const EdgeCut&, const EdgeCut&) = default;
};

/// Orders the items, which are indices of centers, so that neighbours in the order are neighbours in the plane. Halves
/// the items across the longer side of their box, and each half again.
void order_by_position(std::span<std::size_t> items, const std::vector<Point>& centers) {
    if (items.size() <= 4) return;
    Box box;
    for (std::size_t i : items) box.include(centers[i]);
    const bool by_x = box.width() > box.height();
    const auto middle = items.begin() + static_cast<std::ptrdiff_t>(items.size() / 2);
    std::nth_element(items.begin(), middle, items.end(), [&](std::size_t l, std::size_t r) {
        const double a = by_x ? centers[l].x : centers[l].y, b = by_x ? centers[r].x : centers[r].y;
        return a != b ? a < b : l < r;
    });
    order_by_position(items.first(items.size() / 2), centers);
    order_by_position(items.subspan(items.size() / 2), centers);
}

/// Finds edges by their bounding boxes.
class PieceEdgeTree {
public:
    PieceEdgeTree(const std::vector<Point>& points, const std::vector<PieceEdge>& edges)
        : boxes_(edges.size()), order_(edges.size()), tree_(sorted_boxes(points, edges)) {}

    const Box& box(std::size_t edge) const { return boxes_[edge]; }
    /// Calls visit(edge) for each edge whose box overlaps this one.
    template <class Visit>
    void overlaps(const Box& box, Visit&& visit) const {
        tree_.overlaps(box, [&](std::size_t i) { visit(order_[i]); });
    }

private:
    std::vector<Box> sorted_boxes(const std::vector<Point>& points, const std::vector<PieceEdge>& edges) {
        std::vector<Point> centers;
        centers.reserve(edges.size());
        for (std::size_t i = 0; i < edges.size(); ++i) {
            boxes_[i].include(points[edges[i].a]);
            boxes_[i].include(points[edges[i].b]);
            centers.push_back(boxes_[i].center());
        }
        std::iota(order_.begin(), order_.end(), std::size_t{0});
        order_by_position(order_, centers);
        std::vector<Box> sorted;
        sorted.reserve(order_.size());
        for (std::size_t i : order_) sorted.push_back(boxes_[i]);
        return sorted;
    }

    std::vector<Box> boxes_;
    std::vector<std::size_t> order_;  ///< the edges in the order of the tree's items
    core::BoxTree tree_;
};

/// Returns whether p lies within the tolerance of a-b and divides it into two shorter edges. The second condition keeps
/// edges from being cut without end.
bool divides(Point a, Point b, Point p, double tolerance) {
    const double ab = squared_length(b - a);
    const double area2 = cross(b - a, p - a);
    return area2 * area2 <= tolerance * tolerance * ab && dot(p - a, p - b) < 0 && squared_length(p - a) < ab &&
           squared_length(p - b) < ab;
}

/// Returns the vertices inside edges: exactly on them, or within the tolerance.
std::vector<EdgeCut> vertices_on_edges(const std::vector<Point>& points, const std::vector<PieceEdge>& edges,
                                       const PieceEdgeTree& tree, double tolerance) {
    std::vector<EdgeCut> cuts;
    for (Index v = 0; v < points.size(); ++v) {
        const Point p = points[v], reach{tolerance, tolerance};
        tree.overlaps({p - reach, p + reach}, [&](std::size_t e) {
            const auto [a, b] = edges[e];
            if (v == a || v == b) return;
            // A vertex on the line and in the box lies on the edge.
            if ((core::inline_orient2d(points[a], points[b], p) == 0 && tree.box(e).contains(p)) ||
                (tolerance > 0 && divides(points[a], points[b], p, tolerance)))
                cuts.push_back({e, v});
        });
    }
    return cuts;
}

/// Returns whether the insides of p-q and r-s have one point in common. Exact.
bool cross_properly(Point p, Point q, Point r, Point s) {
    const double pr = core::inline_orient2d(p, q, r), ps = core::inline_orient2d(p, q, s);
    if (!((pr > 0 && ps < 0) || (pr < 0 && ps > 0))) return false;
    const double rp = core::inline_orient2d(r, s, p), rq = core::inline_orient2d(r, s, q);
    return (rp > 0 && rq < 0) || (rp < 0 && rq > 0);
}

/// Returns the crossing of p-q and r-s, rounded, but within the boxes of both.
/// Precondition: p is lexicographically smaller than q, and r than s.
Point crossing_point(Point p, Point q, Point r, Point s) {
    if (lexicographically_less(r, p) || (r == p && lexicographically_less(s, q))) {
        std::swap(p, r);
        std::swap(q, s);
    }
    double t = cross(r - p, s - r) / cross(q - p, s - r);
    // If even the directions round to parallel, the larger of the first ends lies on both edges.
    if (std::isnan(t)) return lexicographically_less(p, r) ? r : p;
    t = std::clamp(t, 0.0, 1.0);
    const Point x = p + t * (q - p);
    const auto between = [](double value, double a, double b, double c, double d) {
        return std::clamp(value, std::max(std::min(a, b), std::min(c, d)), std::min(std::max(a, b), std::max(c, d)));
    };
    return {between(x.x, p.x, q.x, r.x, s.x), between(x.y, p.y, q.y, r.y, s.y)};
}

/// Two edges that cross, and their rounded crossing point.
struct EdgeCrossing {
    std::size_t first, second;
    Point at;
};

/// Returns the crossing point of p-q and r-s or, if the nearest of their ends is within the tolerance of it, that end.
Point snapped_crossing_point(Point p, Point q, Point r, Point s, double tolerance) {
    const Point at = crossing_point(p, q, r, s);
    Point nearest = p;
    for (Point end : {q, r, s})
        if (distance(end, at) < distance(nearest, at)) nearest = end;
    return distance(nearest, at) <= tolerance ? nearest : at;
}

/// Returns all crossings of edges, sorted by their points.
std::vector<EdgeCrossing> find_crossings(const std::vector<Point>& points, const std::vector<PieceEdge>& edges,
                                         const PieceEdgeTree& tree, double tolerance) {
    std::vector<EdgeCrossing> found;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const Point p = points[edges[e].a], q = points[edges[e].b];
        tree.overlaps(tree.box(e), [&](std::size_t f) {
            if (f <= e) return;
            const Point r = points[edges[f].a], s = points[edges[f].b];
            if (cross_properly(p, q, r, s)) found.push_back({e, f, snapped_crossing_point(p, q, r, s, tolerance)});
        });
    }
    std::sort(found.begin(), found.end(),
              [](const EdgeCrossing& l, const EdgeCrossing& r) { return lexicographically_less(l.at, r.at); });
    return found;
}

using VertexAtPoint = std::map<Point, Index, Lexicographic>;

/// Returns the cuts of edges at their crossings. Appends the crossing points that are no vertices yet. `vertex_at` is
/// empty at first; from the first crossing on it holds all points.
std::vector<EdgeCut> cuts_at_crossings(std::vector<Point>& points, VertexAtPoint& vertex_at,
                                       const std::vector<PieceEdge>& edges, const PieceEdgeTree& tree,
                                       double tolerance) {
    const std::vector<EdgeCrossing> found = find_crossings(points, edges, tree, tolerance);
    if (found.empty()) return {};
    if (vertex_at.empty())
        for (Index v = 0; v < points.size(); ++v) vertex_at.emplace(points[v], v);
    std::vector<EdgeCut> cuts;
    for (const EdgeCrossing& c : found) {
        const auto [at, is_new] = vertex_at.emplace(c.at, static_cast<Index>(points.size()));
        if (is_new) points.push_back(c.at);
        for (std::size_t e : {c.first, c.second})
            if (at->second != edges[e].a && at->second != edges[e].b) cuts.push_back({e, at->second});
    }
    return cuts;
}

/// Sorts the cuts by edges, and those of one edge from a to b, and removes repeated ones.
void sort_cuts(const std::vector<Point>& points, const std::vector<PieceEdge>& edges, std::vector<EdgeCut>& cuts) {
    const auto position = [&](const EdgeCut& c) {
        const auto [a, b] = edges[c.edge];
        return dot(points[c.vertex] - points[a], points[b] - points[a]);
    };
    std::sort(cuts.begin(), cuts.end(), [&](const EdgeCut& l, const EdgeCut& r) {
        if (l.edge != r.edge) return l.edge < r.edge;
        const double at_l = position(l), at_r = position(r);
        return at_l != at_r ? at_l < at_r : lexicographically_less(points[l.vertex], points[r.vertex]);
    });
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
}

/// Replaces each piece whose edge is cut by a chain of pieces through the cuts, in the direction of the piece.
void split_pieces(const std::vector<Point>& points, const std::vector<PieceEdge>& edges, std::vector<EdgeCut> cuts,
                  std::vector<SegmentPiece>& pieces) {
    sort_cuts(points, edges, cuts);
    std::vector<SegmentPiece> result;
    for (const SegmentPiece& piece : pieces) {
        const VertexId from = piece.segment.a, to = piece.segment.b;
        const bool forward = lexicographically_less(points[from.index()], points[to.index()]);
        const PieceEdge edge = forward ? PieceEdge{from.value, to.value} : PieceEdge{to.value, from.value};
        const auto e = static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), edge) - edges.begin());
        const auto first = std::lower_bound(cuts.begin(), cuts.end(), e,
                                            [](const EdgeCut& c, std::size_t value) { return c.edge < value; });
        auto last = first;
        while (last != cuts.end() && last->edge == e) ++last;
        std::vector<Index> chain{edge.a};
        for (auto c = first; c != last; ++c) chain.push_back(c->vertex);
        chain.push_back(edge.b);
        if (!forward) std::reverse(chain.begin(), chain.end());
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            result.push_back({{VertexId{chain[i]}, VertexId{chain[i + 1]}}, piece.parent});
    }
    pieces = std::move(result);
}

/// Returns the edges that the pieces run along, sorted, each once.
std::vector<PieceEdge> edges_of(const std::vector<Point>& points, const std::vector<SegmentPiece>& pieces) {
    std::vector<PieceEdge> edges;
    edges.reserve(pieces.size());
    for (const SegmentPiece& piece : pieces) {
        PieceEdge edge{piece.segment.a.value, piece.segment.b.value};
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
    pieces.reserve(segments.size());
    for (std::size_t i = 0; i < segments.size(); ++i) pieces.push_back({segments[i], static_cast<Index>(i)});
    VertexAtPoint vertex_at;
    Box extent;
    for (Point p : points) extent.include(p);
    double tolerance = 0;
    for (int round = 0; round < max_planarize_rounds; ++round) {
        const std::vector<PieceEdge> edges = edges_of(all, pieces);
        const PieceEdgeTree tree(all, edges);
        if (round >= exact_rounds) tolerance = std::max(2 * tolerance, core::epsilon * core::longer_side(extent));
        std::vector<EdgeCut> cuts = vertices_on_edges(all, edges, tree, tolerance);
        if (cuts.empty()) cuts = cuts_at_crossings(all, vertex_at, edges, tree, tolerance);
        if (cuts.empty()) return {{all.begin() + static_cast<std::ptrdiff_t>(points.size()), all.end()}, pieces};
        split_pieces(all, edges, std::move(cuts), pieces);
    }
    throw InputError({}, "crossing segments: rounded crossing points keep crossing others");
}

}  // namespace lamina::delaunay
