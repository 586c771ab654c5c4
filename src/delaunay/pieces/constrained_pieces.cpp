// The steps of a constrained triangulation in pieces: cut the points into leaves; triangulate every leaf and insert the
// segments that lie inside it; join the leaves; insert the other segments. Borders of leaves are edges of the
// triangulation without segments. They stay edges where no segment crosses them, so what is inserted in a leaf is
// constrained Delaunay in the whole.
#include "delaunay/constrain/constrained_pieces.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <utility>

#include <lamina/delaunay.hpp>

#include "core/parallel.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/pieces/convex_hull.hpp"
#include "delaunay/pieces/cut_piece.hpp"
#include "delaunay/pieces/insert_in_parts.hpp"
#include "delaunay/pieces/leaf_brio.hpp"
#include "delaunay/pieces/vertex_index_map.hpp"
#include "delaunay/pieces/whole_piece.hpp"
#include "delaunay/triangulate/conditions.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Vertices::leaf of a vertex on the border of a leaf, which belongs to several.
constexpr Index on_border = no_index;

/// What the leaves know of all vertices. Each leaf writes the entries of the vertices inside it.
struct Vertices {
    std::vector<Index> leaf;                   ///< for each point the leaf that it lies inside of, or on_border
    core::UninitializedArray<Index> inserted;  ///< its number in the triangulation of that leaf
};

/// A border edge of a leaf: the triangle inside has it on its left, from a to b.
struct BorderSide {
    Index a, b;
    Link inside;
};

/// A leaf with the segments inside it. Points have their indices in the input; links are between its own triangles.
struct ConstrainedLeaf {
    Tris tris;                         ///< borders have no neighbour
    std::vector<BorderSide> sides;     ///< what is to be joined there
    std::vector<SegmentPiece> pieces;  ///< of the segments that were inserted
    std::vector<Index> deferred;       ///< segments that meet the border
};

/// Segments by the leaves that hold their ends.
struct DealtSegments {
    std::vector<Index> order;  ///< the segments of leaf 0, of leaf 1, ..., and those of no single leaf
    std::vector<std::size_t> first;

    std::span<const Index> of(std::size_t leaf) const {
        return std::span(order).subspan(first[leaf], first[leaf + 1] - first[leaf]);
    }
};

/// Appends the leaves of a piece in the order of the decomposition.
std::vector<Piece> cut_into_leaves(const SortedPoints& sorted, Piece piece, const DecompositionOptions& options,
                                   DecompositionStats& stats) {
    std::vector<Piece> leaves;
    if (!is_leaf(piece, options)) {
        if (std::optional<PieceHalves> halves = cut_piece(sorted, piece, stats)) {
            DecompositionStats high_stats;
            std::vector<Piece> high;
            core::parallel_invoke(
                [&] { leaves = cut_into_leaves(sorted, std::move(halves->low), options, stats); },
                [&] { high = cut_into_leaves(sorted, std::move(halves->high), options, high_stats); });
            add(stats, high_stats);
            std::move(high.begin(), high.end(), std::back_inserter(leaves));
            return leaves;
        }
        ++stats.uncut;
    }
    stats.pieces += 1;
    stats.piece_vertices += piece.size();
    stats.largest_piece = std::max(stats.largest_piece, piece.size());
    leaves.push_back(std::move(piece));
    return leaves;
}

Vertices find_leaves(const SortedPoints& sorted, std::span<const Piece> leaves) {
    Vertices vertices{std::vector<Index>(sorted.points.size(), 0),
                      core::UninitializedArray<Index>(sorted.points.size())};
    for (const Piece& leaf : leaves)
        for (const BorderEdge& e : leaf.border) vertices.leaf[sorted.original[e.a]] = on_border;
    core::parallel_for(leaves.size(), 1, [&](std::size_t begin, std::size_t) {
        for (const Index i : leaves[begin].by_x) {
            Index& leaf = vertices.leaf[sorted.original[i]];
            if (leaf != on_border) leaf = static_cast<Index>(begin);
        }
    });
    return vertices;
}

/// Deals the segments to the leaves. Those between vertices on borders, and those between different leaves, belong to
/// none; they stand behind all others.
DealtSegments deal_segments(std::span<const Segment> segments, const std::vector<Index>& leaf_of, std::size_t leaves) {
    std::vector<Index> home(segments.size());
    core::parallel_for(segments.size(), 50'000, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Index a = leaf_of[segments[i].a.index()], b = leaf_of[segments[i].b.index()];
            home[i] = static_cast<Index>(leaves);
            if (a != on_border && (a == b || b == on_border)) home[i] = a;
            if (a == on_border && b != on_border) home[i] = b;
        }
    });
    DealtSegments dealt{std::vector<Index>(segments.size()), std::vector<std::size_t>(leaves + 2, 0)};
    for (const Index h : home) ++dealt.first[h + 1];
    for (std::size_t l = 0; l + 1 < dealt.first.size(); ++l) dealt.first[l + 1] += dealt.first[l];
    std::vector<std::size_t> place(dealt.first.begin(), dealt.first.end() - 1);
    for (std::size_t i = 0; i < segments.size(); ++i) dealt.order[place[home[i]]++] = static_cast<Index>(i);
    return dealt;
}

/// Triangulates one leaf and inserts its segments.
class LeafTriangulator {
public:
    LeafTriangulator(const SortedPoints& sorted, Piece leaf, std::span<const Segment> segments, Vertices& vertices)
        : segments_(segments), vertices_(vertices), border_(std::move(leaf.border)), map_(border_vertices(sorted)) {
        std::vector<Index> order = leaf_brio(sorted, leaf);
        triangulation_ = triangulate_in_order(sorted.points.all(), order);
        original_.push_back(no_index);
        for (const Index i : order) original_.push_back(sorted.original[i]);
        on_border_.resize(map_size_);
        for (Index v = 1; v < original_.size(); ++v) {
            if (is_on_border(v))
                on_border_[map_.find(original_[v])] = v;
            else
                vertices.inserted[original_[v]] = v;
        }
    }

    ConstrainedLeaf run(std::span<const Index> mine) {
        std::vector<Segment> border;
        for (const BorderEdge& e : border_) border.push_back({VertexId{inserted(e.a)}, VertexId{inserted(e.b)}});
        const TriangleSelection inside = select_region(triangulation_, border);
        ConstrainedLeaf leaf;
        insert(mine, leaf);
        copy_inside(inside, leaf);
        return leaf;
    }

private:
    /// Gives border edges, and returns their first vertices, the indices of the input.
    std::vector<Index> border_vertices(const SortedPoints& sorted) {
        std::vector<Index> first;
        for (BorderEdge& e : border_) {
            e = {sorted.original[e.a], sorted.original[e.b]};
            first.push_back(e.a);
        }
        map_size_ = first.size();
        return first;
    }

    /// Returns whether a vertex, by its number here, is on the border of this leaf or of another.
    bool is_on_border(Index v) const { return vertices_.leaf[original_[v]] == on_border; }

    /// Returns the number here of a point, or no_index if it is on the border of other leaves alone.
    Index inserted(Index point) const {
        if (vertices_.leaf[point] != on_border) return vertices_.inserted[point];
        const std::size_t at = map_.find(point);
        return at == not_found ? no_index : on_border_[at];
    }

    /// Inserts those of the segments that stay inside the border.
    void insert(std::span<const Index> mine, ConstrainedLeaf& leaf) {
        std::vector<Segment> here;
        std::vector<Index> parents;
        for (const Index i : mine) {
            const Index a = inserted(segments_[i].a.value), b = inserted(segments_[i].b.value);
            if (a == no_index || b == no_index) {
                leaf.deferred.push_back(i);
                continue;
            }
            here.push_back({VertexId{a}, VertexId{b}});
            parents.push_back(i);
        }
        const auto [pieces, crossing, beyond] =
            insert_uncrossed_segments(triangulation_.vertices, here, triangulation_.tris, triangulation_.at_vertex);
        for (const Index i : crossing) leaf.deferred.push_back(parents[i]);
        for (std::size_t i = 0; i < pieces.size();) {
            std::size_t end = i;
            bool meets_border = false;
            for (; end < pieces.size() && pieces[end].parent == pieces[i].parent; ++end)
                meets_border |= is_on_border(pieces[end].segment.a.value) && is_on_border(pieces[end].segment.b.value);
            const Index parent = parents[pieces[i].parent];
            if (meets_border) leaf.deferred.push_back(parent);
            for (; i < end; ++i) {
                if (meets_border) continue;
                const auto [a, b] = pieces[i].segment;
                leaf.pieces.push_back(
                    {{VertexId{original_[a.value]}, VertexId{original_[b.value]}}, parent, pieces[i].repeats});
            }
        }
    }

    /// Copies the triangles inside. Edges between vertices on borders are constrained by deferred segments alone, and
    /// so not yet.
    void copy_inside(const TriangleSelection& inside, ConstrainedLeaf& leaf) const {
        const Tris& tris = triangulation_.tris;
        std::vector<Index> place(tris.size(), no_index);
        Index count = 0;
        for (std::size_t t = 0; t < tris.size(); ++t)
            if (inside[t]) place[t] = count++;
        leaf.tris.resize(count);
        for (std::size_t t = 0; t < tris.size(); ++t) {
            if (!inside[t]) continue;
            assert(!tris[t].is_ghost());
            Tri& copy = leaf.tris[place[t]];
            for (unsigned e = 0; e < 3; ++e) {
                const Index a = tris[t].v[next(e)], b = tris[t].v[previous(e)];
                const Link n = tris[t].n[e];
                copy.v[e] = original_[tris[t].v[e]];
                if (!inside[n.triangle()])
                    leaf.sides.push_back({original_[a], original_[b], Link(place[t], e)});
                else
                    copy.n[e] = Link(place[n.triangle()], n.edge(),
                                     n.is_constrained() && !(is_on_border(a) && is_on_border(b)));
            }
        }
        assert(are_linked(leaf.tris));
    }

    std::span<const Segment> segments_;
    const Vertices& vertices_;
    std::vector<BorderEdge> border_;  ///< between indices of the input
    std::size_t map_size_ = 0;
    VertexIndexMap map_;            ///< of the vertices of the border
    std::vector<Index> on_border_;  ///< for each of them its number here
    OrderedTriangulation triangulation_;
    std::vector<Index> original_;  ///< for each vertex its index in the input
};

/// Makes neighbours of the triangles at both sides of each border edge. Returns the sides without a partner, which are
/// the edges of the hull.
std::vector<BorderSide> connect_sides(std::vector<BorderSide> sides, Tris& tris) {
    const auto key = [](const BorderSide& s) { return undirected_key(s.a, s.b); };
    std::sort(sides.begin(), sides.end(),
              [&](const BorderSide& s, const BorderSide& t) { return key(s) != key(t) ? key(s) < key(t) : s.a < t.a; });
    std::vector<BorderSide> hull;
    for (std::size_t i = 0; i < sides.size(); ++i) {
        if (i + 1 < sides.size() && key(sides[i]) == key(sides[i + 1])) {
            connect(tris, sides[i].inside.triangle(), sides[i].inside.edge(), sides[i + 1].inside);
            // The triangles lie on two sides of the edge, and there is no third one.
            assert(is_linked(tris, sides[i].inside.triangle(), sides[i].inside.edge()));
            assert(i + 2 == sides.size() || key(sides[i]) != key(sides[i + 2]));
            ++i;
        } else {
            hull.push_back(sides[i]);
        }
    }
    return hull;
}

/// Puts a ghost triangle on each edge of the hull, behind the other triangles.
///
///           infinity
///          /        \         The ghost of the hull edge from a to b, which has the inside on its left, is
///       a ---------- b        (b, a, infinity). Across a-infinity lies the ghost of the hull edge that ends at a.
///          inside
void add_ghosts(const std::vector<BorderSide>& hull, Index first, Tris& tris) {
    std::vector<std::pair<Index, Index>> ending_at;  // vertices with the ghosts of the hull edges that end there
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const auto ghost = static_cast<Index>(first + i);
        tris[ghost].v[0] = hull[i].b;
        tris[ghost].v[1] = hull[i].a;
        tris[ghost].v[2] = ghost_vertex;
        connect(tris, hull[i].inside.triangle(), hull[i].inside.edge(), Link(ghost, 2));
        ending_at.push_back({hull[i].b, ghost});
    }
    std::sort(ending_at.begin(), ending_at.end());
    for (std::size_t i = 0; i < hull.size(); ++i) {
        const auto before = std::lower_bound(ending_at.begin(), ending_at.end(), std::pair{hull[i].a, Index{0}});
        assert(before != ending_at.end() && before->first == hull[i].a);
        connect(tris, static_cast<Index>(first + i), 0, Link(before->second, 1));
    }
    assert(tris.size() == first + hull.size());
    assert(std::all_of(ending_at.begin(), ending_at.end(), [&](const auto& g) { return is_linked(tris, g.second); }));
}

/// Copies the triangles of the leaves one behind the other, closes them with ghosts and links all of them. `result`
/// has room for all.
void join_leaves(std::span<const ConstrainedLeaf> leaves, const std::vector<Index>& leaf_of,
                 TriangulatedPieces& result) {
    Tris& tris = result.tris;
    std::vector<Index> first{0};
    std::vector<BorderSide> sides;
    for (const ConstrainedLeaf& leaf : leaves) {
        for (const BorderSide& s : leaf.sides)
            sides.push_back({s.a, s.b, Link(s.inside.triangle() + first.back(), s.inside.edge())});
        first.push_back(first.back() + static_cast<Index>(leaf.tris.size()));
    }
    core::parallel_for(leaves.size(), 1, [&](std::size_t begin, std::size_t) {
        Index to = first[begin];
        for (Tri t : leaves[begin].tris) {
            for (Link& n : t.n)
                if (!n.is_border()) n = Link(n.triangle() + first[begin], n.edge(), n.is_constrained());
            for (const Index v : t.v)
                if (leaf_of[v] != on_border) result.at_vertex[v] = to;
            tris[to++] = t;
        }
    });
    for (const BorderSide& s : sides) result.at_vertex[s.a] = s.inside.triangle();
    const std::vector<BorderSide> hull = connect_sides(std::move(sides), tris);
    tris.resize(first.back() + hull.size());
    add_ghosts(hull, first.back(), tris);
    assert(is_sphere(tris, leaf_of.size()));
}

/// Puts lists of pieces, each of which has all pieces of its segments, in the order of the segments.
std::vector<SegmentPiece> in_order_of_segments(std::span<const std::vector<SegmentPiece>* const> lists,
                                               std::size_t segments) {
    std::vector<std::size_t> place(segments + 1, 0);
    core::parallel_for(lists.size(), 1, [&](std::size_t begin, std::size_t) {
        for (const SegmentPiece& piece : *lists[begin]) ++place[piece.parent + 1];
    });
    for (std::size_t i = 0; i < segments; ++i) place[i + 1] += place[i];
    std::vector<SegmentPiece> ordered(place.back());
    core::parallel_for(lists.size(), 1, [&](std::size_t begin, std::size_t) {
        for (const SegmentPiece& piece : *lists[begin]) ordered[place[piece.parent]++] = piece;
    });
    return ordered;
}

/// Says of each piece whether an earlier segment has the same one, as if the segments had been inserted in their order.
void find_repeats(std::vector<SegmentPiece>& pieces) {
    const auto repeats = [](const SegmentPiece& piece) { return piece.repeats; };
    if (std::none_of(pieces.begin(), pieces.end(), repeats)) return;
    std::vector<std::pair<std::uint64_t, Index>> edges;
    for (std::size_t i = 0; i < pieces.size(); ++i)
        edges.push_back({undirected_key(pieces[i].segment.a.value, pieces[i].segment.b.value), static_cast<Index>(i)});
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i)
        pieces[edges[i].second].repeats = i > 0 && edges[i - 1].first == edges[i].first;
}

/// Inserts the segments of no leaf, and those that leaves have deferred. Returns whether none of them crosses another.
bool insert_deferred(std::span<const Point> points, std::span<const Segment> segments, std::span<const Index> homeless,
                     std::span<const ConstrainedLeaf> leaves, TriangulatedPieces& result) {
    std::vector<Index> deferred(homeless.begin(), homeless.end());
    for (const ConstrainedLeaf& leaf : leaves)
        deferred.insert(deferred.end(), leaf.deferred.begin(), leaf.deferred.end());
    std::sort(deferred.begin(), deferred.end());
    const InsertedInParts inserted = insert_in_parts(points, segments, deferred, result.tris, result.at_vertex);
    if (inserted.crossed) return false;
    std::vector<const std::vector<SegmentPiece>*> lists;
    for (const std::vector<SegmentPiece>& pieces : inserted.pieces) lists.push_back(&pieces);
    for (const ConstrainedLeaf& leaf : leaves) lists.push_back(&leaf.pieces);
    result.pieces = in_order_of_segments(lists, segments.size());
    find_repeats(result.pieces);
    return true;
}

bool are_among(std::span<const Segment> segments, std::size_t points) {
    return std::all_of(segments.begin(), segments.end(),
                       [&](const Segment& s) { return s.a.index() < points && s.b.index() < points; });
}

}  // namespace

}  // namespace lamina::delaunay::pieces

namespace lamina::delaunay {

using namespace pieces;

PiecesTrial triangulate_in_pieces(std::span<const Point> points, std::span<const Segment> segments,
                                  const std::optional<DecompositionOptions>& options) {
    if (options) validate(*options);
    const DecompositionOptions limits = options.value_or(default_decomposition(points.size()));
    if (is_beyond_cuts(points, limits)) return {};
    std::optional<SortedPoints> sorted = sort_for_cuts(points, limits);
    if (!sorted || !are_among(segments, points.size())) return {};
    Piece whole = whole_region(*sorted, convex_hull(*sorted));
    if (whole.border.empty()) return {};

    TriangulatedPieces result;
    std::vector<Piece> pieces;
    core::parallel_invoke([&] { pieces = cut_into_leaves(*sorted, std::move(whole), limits, result.stats); },
                          [&] {  // room is made while the first cut keeps one thread busy
                              result.tris.resize(2 * points.size());
                              result.at_vertex.resize(points.size());
                          });
    if (pieces.size() == 1) return {};
    Vertices vertices = find_leaves(*sorted, pieces);
    const DealtSegments dealt = deal_segments(segments, vertices.leaf, pieces.size());
    std::vector<ConstrainedLeaf> leaves(pieces.size());
    core::parallel_for(pieces.size(), 1, [&](std::size_t begin, std::size_t) {
        leaves[begin] = LeafTriangulator(*sorted, std::move(pieces[begin]), segments, vertices).run(dealt.of(begin));
    });
    join_leaves(leaves, vertices.leaf, result);
    if (!insert_deferred(points, segments, dealt.of(leaves.size()), leaves, result)) return {std::nullopt, true};
    return {std::move(result)};
}

}  // namespace lamina::delaunay
