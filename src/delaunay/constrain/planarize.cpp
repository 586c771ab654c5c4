// Segments are split at their crossings in rounds. Each round finds all crossings of the present pieces exactly and
// splits all pieces at once, so the order of the segments does not matter. Before it looks for crossings, a round
// splits pieces at the vertices on them: where a vertex lies exactly on several pieces, no rounded crossing can then
// differ from it. Vertices of the input never move.
//
// At a crossing both pieces are led through a vertex that stands within the tolerance of their segments. If there is
// none, the rounded crossing becomes a vertex. In bundles and stars some ulps wide neither may be possible; then one of
// the pieces is led through an end of the other.
//
//      c     b        Of two pieces a-b and c-d that cross, one can be led through an end of the other so that both of
//       \   /         its parts are shorter than itself. Proof: let a-b be no shorter than c-d. The sides of the
//         X           quadrilateral obey ac + bd < ab + cd and cb + ad < ab + cd. If c does not serve a-b, then ac or
//       /   \         cb is at least ab; say ac >= ab. If d does not serve either, then ad >= ab (for bd >= ab would
//      a     d        give ac + bd >= 2 ab). Then bd < cd and cb < cd, so that b serves c-d.
//
// Where nothing crosses any more, pieces are led through vertices that they pass within rounding. What lies between is
// a sliver that no refinement can mend, and its vertex is a crossing that was rounded, or lies on the segment but for
// rounding. Pieces bend by less than the tolerance, and where they cross others because of that the rounds go on.
//
// Why this ends: vertices are added only at a distance from all others, so there are finitely many. Between two
// additions each round replaces pieces by strictly shorter ones, whose lengths come from a finite set.
// Sources: J. D. Hobby, Practical segment intersection with finite precision output, Comput. Geom. 13 (1999); D.
// Halperin, E. Packer, Iterated snap rounding, Comput. Geom. 23 (2002). Tolerances take the place of their pixels,
// since the points of the input lie on no grid.
#include "delaunay/constrain/planarize.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/arguments.hpp"
#include "core/bounding_box.hpp"
#include "core/lexicographic_order.hpp"
#include "core/predicates.hpp"
#include "core/segments.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/crossing_point.hpp"
#include "delaunay/constrain/piece_edges.hpp"

namespace lamina::delaunay {

namespace {

/// Two or three rounds are usual, and no trial took more than 20.
constexpr int max_planarize_rounds = 1000;

/// Pieces are led through vertices within this many roundings of a segment's largest coordinate: four ulps.
constexpr double tolerance_roundings = 8;
constexpr double max_bend_roundings = 32;
/// How far pieces may stand from their segments, in tolerances that the caller asks for: as for roundings.
constexpr double max_bend_snaps = max_bend_roundings / tolerance_roundings;

/// Edges are led through vertices beside them that stand further from both ends than this many tolerances, so that they
/// turn by less than 30 degrees there: nearer to an end, it is two vertices that rounding hardly tells apart.
constexpr double end_tolerances = 4;
/// The same for tolerances that the caller asks for: no two points of the input are nearer to each other than these, so
/// where a vertex is beside an edge, but nearer to an end, there are angles of more than 45 degrees.
constexpr double end_snaps = 0.7;
/// Such vertices stand within this many tolerances of the whole segment. Edges that are bent already may so bend a
/// little more, and max_bend() leaves room.
constexpr double beside_tolerances = 2;

/// An edge, by its index, and a vertex that divides it.
struct EdgeCut {
    std::size_t edge;
    Index vertex;
    friend bool operator==(const EdgeCut&, const EdgeCut&) = default;
};

/// The vertices that divide edges.
struct EdgeVertices {
    std::vector<EdgeCut> inside;  ///< those exactly on them
    std::vector<EdgeCut> beside;  ///< those that they pass within rounding
};

/// Two edges p-q and r-s that cross, and their rounded crossing. p is lexicographically smaller than q, r than s, and
/// p-q than r-s.
struct EdgeCrossing {
    std::size_t first, second;
    Point p, q, r, s;
    Point at;
};

/// Returns a number of roundings of the largest coordinate of a segment, but at least the same share of the smallest
/// coordinates, to which crossings are rounded, too.
double roundings_of(Point a, Point b, double roundings) {
    const double largest = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
    return roundings * std::max(core::epsilon * largest, 0.125 * min_exact_coordinate);
}

/// Splits segments in rounds.
class Planarizer {
public:
    Planarizer(std::span<const Point> points, std::span<const Segment> segments, double snap)
        : segments_(segments), snap_(snap), input_count_(points.size()), points_(points.begin(), points.end()) {
        pieces_.reserve(segments.size());
        for (std::size_t i = 0; i < segments.size(); ++i)
            if (segments[i].a != segments[i].b) pieces_.push_back({segments[i], static_cast<Index>(i)});
    }

    PlanarSegments run() {
        for (int round = 0; round < max_planarize_rounds; ++round) {
            edges_ = edges_of(points_, pieces_);
            set_tolerances();
            const PieceEdgeTree tree(points_, edges_.edges, tolerances_);
            EdgeVertices vertices = vertices_of_edges(tree);
            std::vector<EdgeCut> cuts = std::move(vertices.inside);
            if (cuts.empty()) {
                const std::vector<EdgeCrossing> crossings = find_crossings(tree);
                if (!crossings.empty()) {
                    cuts = cuts_at_crossings(crossings);
                    if (cuts.empty()) fail(crossings.front());
                    last_ = crossings.front();
                } else if (vertices.beside.empty() || round + 1 == max_planarize_rounds) {
                    return result();
                } else {
                    cuts = std::move(vertices.beside);
                }
            }
            split_pieces(std::move(cuts));
        }
        fail(last_);
    }

private:
    void set_tolerances();
    bool passes_beside(std::size_t edge, Index v) const;
    EdgeVertices vertices_of_edges(const PieceEdgeTree& tree) const;
    std::vector<EdgeCrossing> find_crossings(const PieceEdgeTree& tree) const;
    std::vector<EdgeCut> cuts_at_crossings(const std::vector<EdgeCrossing>& crossings);
    Index meeting_vertex(const EdgeCrossing& crossing);
    bool is_new_place(const EdgeCrossing& crossing) const;
    void lead_through_end(const EdgeCrossing& crossing, std::vector<EdgeCut>& cuts) const;
    void sort_cuts(std::vector<EdgeCut>& cuts) const;
    std::vector<Index> chain_of(std::size_t edge, const std::vector<EdgeCut>& cuts) const;
    void split_pieces(std::vector<EdgeCut> cuts);
    PlanarSegments result() const;
    void refuse_bends(const std::vector<SegmentPiece>& pieces) const;
    [[noreturn]] void fail(const EdgeCrossing& crossing) const;

    /// Returns the ends of a segment, the lexicographically smaller one first, so that rounding does not depend on the
    /// direction.
    std::pair<Point, Point> ends_of(Index segment) const {
        const Point a = points_[segments_[segment].a.index()], b = points_[segments_[segment].b.index()];
        return lexicographically_less(a, b) ? std::pair{a, b} : std::pair{b, a};
    }
    double tolerance(Index segment) const {
        const auto [a, b] = ends_of(segment);
        return std::max(roundings_of(a, b, tolerance_roundings), snap_);
    }
    double distance_from(Index segment, Point p) const {
        const auto [a, b] = ends_of(segment);
        return core::distance_to_segment(p, a, b);
    }
    double edge_tolerance(std::size_t edge) const { return tolerances_[edge]; }
    bool is_end(std::size_t edge, Index v) const { return v == edges_.edges[edge].a || v == edges_.edges[edge].b; }
    /// Returns whether an edge ends at v or may be led through it.
    bool fits(std::size_t edge, Index v) const {
        if (is_end(edge, v)) return true;
        const auto [a, b] = edges_.edges[edge];
        const auto parents = edges_.parents_of(edge);
        return shortens(points_[a], points_[b], points_[v]) &&
               std::all_of(parents.begin(), parents.end(),
                           [&](Index i) { return distance_from(i, points_[v]) <= tolerance(i); });
    }
    /// Calls visit(v) for each vertex whose coordinates differ from those of p by `reach` at most.
    template <class Visit>
    void for_vertices_near(Point p, double reach, Visit&& visit) const {
        const Point lower = p - Point{reach, reach}, upper = p + Point{reach, reach};
        auto at = vertex_at_.lower_bound(lower);
        while (at != vertex_at_.end() && at->first.x <= upper.x) {
            const Point q = at->first;
            if (q.y < lower.y) {
                at = vertex_at_.lower_bound({q.x, lower.y});
            } else if (q.y > upper.y) {
                at = vertex_at_.upper_bound({q.x, HUGE_VAL});
            } else {
                visit(at->second);
                ++at;
            }
        }
    }

    std::span<const Segment> segments_;
    double snap_;  ///< tolerance that the caller asks for
    std::size_t input_count_;
    std::vector<Point> points_;  ///< of the input, then the crossings
    std::vector<SegmentPiece> pieces_;
    PieceEdges edges_;                ///< of the pieces of this round
    std::vector<double> tolerances_;  ///< for each edge the smallest of the segments along it
    std::map<Point, Index, core::LexicographicOrder> vertex_at_;  ///< all points, from the first crossing on
    EdgeCrossing last_{};
};

void Planarizer::set_tolerances() {
    tolerances_.clear();
    tolerances_.reserve(edges_.edges.size());
    for (std::size_t e = 0; e < edges_.edges.size(); ++e) {
        double smallest = HUGE_VAL;
        for (const Index parent : edges_.parents_of(e)) smallest = std::min(smallest, tolerance(parent));
        tolerances_.push_back(smallest);
    }
}

/// Returns whether an edge is to be led through v, which does not lie on it, because it passes v within rounding.
bool Planarizer::passes_beside(std::size_t edge, Index v) const {
    const auto [a, b] = edges_.edges[edge];
    const Point along = points_[b] - points_[a], to_v = points_[v] - points_[a];
    const double reach = tolerances_[edge], length = std::sqrt(squared_length(along));
    if (!(std::abs(cross(along, to_v)) <= reach * length)) return false;
    const double at = dot(to_v, along) / length;
    const double from_ends = (reach > snap_ ? end_tolerances : end_snaps) * reach;
    if (!(at > from_ends) || !(length - at > from_ends)) return false;
    if (!shortens(points_[a], points_[b], points_[v])) return false;
    const auto parents = edges_.parents_of(edge);
    return std::all_of(parents.begin(), parents.end(),
                       [&](Index i) { return distance_from(i, points_[v]) <= beside_tolerances * tolerance(i); });
}

/// Returns the vertices that lie inside edges, exactly, and those that edges pass within rounding.
EdgeVertices Planarizer::vertices_of_edges(const PieceEdgeTree& tree) const {
    EdgeVertices found;
    for (Index v = 0; v < points_.size(); ++v) {
        const Point p = points_[v];
        tree.overlaps({p, p}, [&](std::size_t e) {
            if (is_end(e, v)) return;
            const auto [a, b] = edges_.edges[e];
            if (core::inline_orient2d(points_[a], points_[b], p) != 0) {
                if (passes_beside(e, v)) found.beside.push_back({e, v});
            } else if (core::bounding_box(points_[a], points_[b]).overlaps({p, p})) {
                // A vertex on the line and in the box lies on the edge.
                found.inside.push_back({e, v});
            }
        });
    }
    return found;
}

/// Returns all crossings of edges, sorted by their points and then by the ends of the edges.
std::vector<EdgeCrossing> Planarizer::find_crossings(const PieceEdgeTree& tree) const {
    // Where magnitudes differ by more, the crossing must be rounded on the edge with the smaller ones.
    constexpr double similar_magnitudes = 4;
    const auto key = [](const EdgeCrossing& c) {
        return std::tie(c.at.x, c.at.y, c.p.x, c.p.y, c.q.x, c.q.y, c.r.x, c.r.y, c.s.x, c.s.y);
    };
    std::vector<EdgeCrossing> found;
    for (std::size_t i = 0; i < edges_.edges.size(); ++i) {
        tree.overlaps(tree.box(i), [&](std::size_t j) {
            if (j <= i) return;
            EdgeCrossing c{i, j, {}, {}, {}, {}, {}};
            const auto set_ends = [&] {
                c.p = points_[edges_.edges[c.first].a], c.q = points_[edges_.edges[c.first].b];
                c.r = points_[edges_.edges[c.second].a], c.s = points_[edges_.edges[c.second].b];
            };
            set_ends();
            if (!cross_properly(c.p, c.q, c.r, c.s)) return;
            if (lexicographically_less(c.r, c.p) || (c.r == c.p && lexicographically_less(c.s, c.q))) {
                std::swap(c.first, c.second);
                set_ends();
            }
            const bool on_second = edge_tolerance(c.first) > similar_magnitudes * edge_tolerance(c.second);
            c.at = on_second ? crossing_point(c.r, c.s, c.p, c.q) : crossing_point(c.p, c.q, c.r, c.s);
            found.push_back(c);
        });
    }
    std::sort(found.begin(), found.end(),
              [&](const EdgeCrossing& l, const EdgeCrossing& r) { return key(l) < key(r); });
    return found;
}

/// Returns the cuts of edges at their crossings, and adds the crossings that become vertices.
std::vector<EdgeCut> Planarizer::cuts_at_crossings(const std::vector<EdgeCrossing>& crossings) {
    if (vertex_at_.empty())
        for (Index v = 0; v < points_.size(); ++v) vertex_at_.emplace(points_[v], v);
    std::vector<EdgeCut> cuts;
    for (const EdgeCrossing& c : crossings) {
        Index v = meeting_vertex(c);
        if (v == no_index && is_new_place(c)) {
            v = static_cast<Index>(points_.size());
            assert(vertex_at_.find(c.at) == vertex_at_.end());
            points_.push_back(c.at);
            vertex_at_.emplace(c.at, v);
        }
        if (v == no_index) {
            lead_through_end(c, cuts);
            continue;
        }
        for (const std::size_t e : {c.first, c.second})
            if (!is_end(e, v)) cuts.push_back({e, v});
    }
    return cuts;
}

/// Returns the vertex nearest to a crossing that both edges may be led through; no_index if there is none.
Index Planarizer::meeting_vertex(const EdgeCrossing& c) {
    Index nearest = no_index;
    const auto consider = [&](Index v) {
        if (v == nearest || !fits(c.first, v) || !fits(c.second, v)) return;
        if (nearest != no_index) {
            const double d = squared_length(points_[v] - c.at), least = squared_length(points_[nearest] - c.at);
            if (d > least || (d == least && lexicographically_less(points_[nearest], points_[v]))) return;
        }
        nearest = v;
    };
    for (const std::size_t e : {c.first, c.second}) {
        consider(edges_.edges[e].a);
        consider(edges_.edges[e].b);
    }
    for_vertices_near(c.at, std::max(edge_tolerance(c.first), edge_tolerance(c.second)), consider);
    return nearest;
}

/// Returns whether a crossing divides both edges and stands apart from all vertices.
bool Planarizer::is_new_place(const EdgeCrossing& c) const {
    if (!shortens(c.p, c.q, c.at) || !shortens(c.r, c.s, c.at)) return false;
    bool apart = true;
    for_vertices_near(c.at, 0.25 * std::min(edge_tolerance(c.first), edge_tolerance(c.second)),
                      [&](Index) { apart = false; });
    return apart;
}

/// Cuts one of two crossing edges at an end of the other that shortens it: the way that bends segments the least in
/// relation to their tolerances.
void Planarizer::lead_through_end(const EdgeCrossing& c, std::vector<EdgeCut>& cuts) const {
    EdgeCut best{0, no_index};
    double least_bend = HUGE_VAL;
    const auto consider = [&](std::size_t edge, std::size_t other) {
        const auto [a, b] = edges_.edges[edge];
        for (const Index v : {edges_.edges[other].a, edges_.edges[other].b}) {
            if (!shortens(points_[a], points_[b], points_[v])) continue;
            double bend = 0;
            for (const Index i : edges_.parents_of(edge))
                bend = std::max(bend, distance_from(i, points_[v]) / tolerance(i));
            if (bend >= least_bend) continue;
            least_bend = bend;
            best = {edge, v};
        }
    };
    consider(c.first, c.second);
    consider(c.second, c.first);
    if (best.vertex != no_index) cuts.push_back(best);
}

/// Sorts the cuts by edges, and those of one edge from a to b, and removes repeated ones.
void Planarizer::sort_cuts(std::vector<EdgeCut>& cuts) const {
    const auto position = [&](const EdgeCut& c) {
        const auto [a, b] = edges_.edges[c.edge];
        return dot(points_[c.vertex] - points_[a], points_[b] - points_[a]);
    };
    std::sort(cuts.begin(), cuts.end(), [&](const EdgeCut& l, const EdgeCut& r) {
        if (l.edge != r.edge) return l.edge < r.edge;
        const double at_l = position(l), at_r = position(r);
        return at_l != at_r ? at_l < at_r : lexicographically_less(points_[l.vertex], points_[r.vertex]);
    });
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
}

/// Returns the vertices of an edge from a to b with its cuts, which are sorted. If a part between two cuts would be as
/// long as the edge, only the first cut counts.
std::vector<Index> Planarizer::chain_of(std::size_t edge, const std::vector<EdgeCut>& cuts) const {
    const auto first = std::lower_bound(cuts.begin(), cuts.end(), edge,
                                        [](const EdgeCut& c, std::size_t value) { return c.edge < value; });
    auto last = first;
    while (last != cuts.end() && last->edge == edge) ++last;
    const auto [a, b] = edges_.edges[edge];
    const double length = squared_length(points_[b] - points_[a]);
    const auto too_long = [&](const EdgeCut& c, const EdgeCut& d) {
        return !(squared_length(points_[d.vertex] - points_[c.vertex]) < length);
    };
    if (std::adjacent_find(first, last, too_long) != last) last = first + 1;
    std::vector<Index> chain{a};
    for (auto c = first; c != last; ++c) {
        assert(c->vertex < points_.size() && !is_end(edge, c->vertex));
        chain.push_back(c->vertex);
    }
    chain.push_back(b);
    return chain;
}

/// Replaces each piece whose edge is cut by a chain of pieces through the cuts, in the direction of the piece.
void Planarizer::split_pieces(std::vector<EdgeCut> cuts) {
    sort_cuts(cuts);
    std::vector<SegmentPiece> result;
    result.reserve(pieces_.size() + cuts.size());
    for (const SegmentPiece& piece : pieces_) {
        const PieceEdge edge = edge_of(points_, piece.segment);
        std::vector<Index> chain = chain_of(edges_.find(edge), cuts);
        if (chain.front() != piece.segment.a.value) std::reverse(chain.begin(), chain.end());
        assert(chain.front() == piece.segment.a.value && chain.back() == piece.segment.b.value);
        for (std::size_t i = 0; i + 1 < chain.size(); ++i)
            result.push_back({{VertexId{chain[i]}, VertexId{chain[i + 1]}}, piece.parent});
    }
    pieces_ = std::move(result);
}

/// Appends the pieces of one segment without detours: where several were led through the same vertex, what lies between
/// is left out. Where detours overlap, the direction decides, so the chain is walked from its smaller end.
void append_without_detours(std::span<const Point> points, std::span<const SegmentPiece> chain,
                            std::vector<SegmentPiece>& result) {
    const VertexId from = chain.front().segment.a, to = chain.back().segment.b;
    const bool forward = lexicographically_less(points[from.index()], points[to.index()]);
    std::vector<VertexId> vertices{from};
    for (const SegmentPiece& piece : chain) {
        assert(piece.segment.a == vertices.back());
        vertices.push_back(piece.segment.b);
    }
    if (!forward) std::reverse(vertices.begin(), vertices.end());
    std::map<VertexId, std::size_t> last_visit;
    for (std::size_t i = 0; i < vertices.size(); ++i) last_visit[vertices[i]] = i;
    std::vector<VertexId> direct;
    for (std::size_t i = 0; i < vertices.size(); i = last_visit[vertices[i]] + 1) direct.push_back(vertices[i]);
    if (!forward) std::reverse(direct.begin(), direct.end());
    assert(direct.front() == from && direct.back() == to);
    for (std::size_t i = 0; i + 1 < direct.size(); ++i)
        result.push_back({{direct[i], direct[i + 1]}, chain.front().parent});
}

PlanarSegments Planarizer::result() const {
    PlanarSegments planar{{points_.begin() + static_cast<std::ptrdiff_t>(input_count_), points_.end()}, {}};
    for (std::size_t i = 0; i < pieces_.size();) {
        std::size_t end = i;
        while (end < pieces_.size() && pieces_[end].parent == pieces_[i].parent) ++end;
        const std::span<const SegmentPiece> chain = std::span(pieces_).subspan(i, end - i);
        if (chain.size() < 3)
            planar.pieces.insert(planar.pieces.end(), chain.begin(), chain.end());
        else
            append_without_detours(points_, chain, planar.pieces);
        i = end;
    }
    refuse_bends(planar.pieces);
    return planar;
}

/// Throws InputError, with a segment and one that it shares a vertex with, where pieces stand too far from the segment.
void Planarizer::refuse_bends(const std::vector<SegmentPiece>& pieces) const {
    for (const SegmentPiece& piece : pieces) {
        const VertexId v = piece.segment.b;
        const Point at = points_[v.index()];
        const auto [a, b] = ends_of(piece.parent);
        if (distance_from(piece.parent, at) <= std::max(max_bend(a, b), max_bend_snaps * snap_)) continue;
        const auto other = std::find_if(pieces.begin(), pieces.end(), [&](const SegmentPiece& o) {
            return o.parent != piece.parent && (o.segment.a == v || o.segment.b == v);
        });
        const Index second = other == pieces.end() ? piece.parent : other->parent;
        throw InputError({.at = at, .segments = {piece.parent, second}},
                         core::segment_name(segments_, piece.parent) + " crosses " +
                             core::segment_name(segments_, second) + " where rounding would bend it too far");
    }
}

/// Throws the error for a crossing that cannot be resolved.
void Planarizer::fail(const EdgeCrossing& c) const {
    const Index first = edges_.parents_of(c.first).front(), second = edges_.parents_of(c.second).front();
    throw InputError(
        {.at = c.at, .segments = {first, second}},
        core::concat(core::segment_name(segments_, first), " crosses ", core::segment_name(segments_, second),
                     ", and their crossing cannot be rounded to a vertex"));
}

}  // namespace

PlanarSegments planarize(std::span<const Point> points, std::span<const Segment> segments, double snap) {
    return Planarizer(points, segments, snap).run();
}

double max_bend(Point a, Point b) { return roundings_of(a, b, max_bend_roundings); }

PassingDistances passing_distances(Point a, Point b) {
    const double tolerance = roundings_of(a, b, tolerance_roundings);
    return {tolerance, end_tolerances * tolerance};
}

}  // namespace lamina::delaunay
