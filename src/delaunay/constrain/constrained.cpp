// The constrained triangulate(): insert segments, select triangles, list the segments that are left.
#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/triangulation.hpp>

#include "core/arguments.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "delaunay/constrain/beside_edges.hpp"
#include "delaunay/constrain/constrained_pieces.hpp"
#include "delaunay/constrain/insert_segments.hpp"
#include "delaunay/constrain/planarize.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/constrain/winding.hpp"
#include "delaunay/triangulate/arguments.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay {

namespace {

constexpr std::size_t segment_grain = 50'000;

std::vector<Segment> segments_of(const std::vector<SegmentPiece>& pieces) {
    std::vector<Segment> segments;
    segments.reserve(pieces.size());
    for (const SegmentPiece& piece : pieces) segments.push_back(piece.segment);
    return segments;
}

/// Points and segments, and which points stand for themselves.
struct MergedInput {
    std::span<const Point> points;
    std::span<const Segment> segments;        ///< between points that stand for themselves
    std::span<const std::uint32_t> stand_in;  ///< empty where all do
    std::optional<DecompositionOptions> decomposition{};
    double snap = 0;  ///< segments that may cross are led through points this near

    bool stands_for_itself(std::size_t i) const { return stand_in.empty() || stand_in[i] == i; }
};

/// The points that stand for themselves, one after another, and the segments between them.
struct DistinctInput {
    std::vector<Point> points;
    std::vector<Segment> segments;
    std::vector<Index> original;  ///< for each point its index in the input, which ascends
};

DistinctInput distinct_input(const MergedInput& input) {
    DistinctInput distinct;
    std::vector<Index> number(input.points.size(), no_index);
    for (std::size_t i = 0; i < input.points.size(); ++i) {
        if (!input.stands_for_itself(i)) continue;
        number[i] = static_cast<Index>(distinct.points.size());
        distinct.points.push_back(input.points[i]);
        distinct.original.push_back(static_cast<Index>(i));
    }
    distinct.segments.resize(input.segments.size());
    core::parallel_for(input.segments.size(), segment_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Segment& s = input.segments[i];
            distinct.segments[i] = {VertexId{number[s.a.index()]}, VertexId{number[s.b.index()]}};
        }
    });
    return distinct;
}

/// Gives the points of a triangulation their indices in the input, which has `points` of them.
void restore_indices(const std::vector<Index>& original, std::size_t points, TriangulatedPieces& triangulated) {
    assert(original.size() == triangulated.at_vertex.size());
    assert(original.empty() || original.back() < points);
    core::parallel_for(triangulated.tris.size(), segment_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t)
            for (Index& v : triangulated.tris[t].v)
                if (v != ghost_vertex) v = original[v];
    });
    core::parallel_for(triangulated.pieces.size(), segment_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            Segment& s = triangulated.pieces[i].segment;
            s = {VertexId{original[s.a.index()]}, VertexId{original[s.b.index()]}};
        }
    });
    std::vector<Index> at_vertex(points, no_index);
    for (std::size_t v = 0; v < original.size(); ++v) at_vertex[original[v]] = triangulated.at_vertex[v];
    triangulated.at_vertex = std::move(at_vertex);
}

/// Returns what became of the triangulation in pieces, of the points that stand for themselves.
PiecesTrial try_pieces(const MergedInput& input) {
    if (input.stand_in.empty()) return triangulate_in_pieces(input.points, input.segments, input.decomposition);
    const DistinctInput distinct = distinct_input(input);
    PiecesTrial trial = triangulate_in_pieces(distinct.points, distinct.segments, input.decomposition);
    if (trial.triangulated) restore_indices(distinct.original, input.points.size(), *trial.triangulated);
    return trial;
}

/// Counts one piece for the triangulation of all points at once.
DecompositionStats one_piece(std::size_t points) {
    return {.pieces = 1, .piece_vertices = points, .largest_piece = points};
}

/// Triangulates points and segments that do not cross.
TriangulatedPieces triangulate_planar(const MergedInput& input) {
    if (PiecesTrial trial = try_pieces(input); trial.triangulated) return std::move(*trial.triangulated);
    TriangulatedPieces result;
    result.tris = triangulate_points(input.points, input.stand_in);
    result.at_vertex = triangle_at_vertex(result.tris, input.points.size());
    result.pieces = insert_and_split_segments(input.points, input.segments, result.tris, result.at_vertex);
    result.stats = one_piece(input.points.size());
    return result;
}

/// Triangulates points and segments if these do not cross.
std::optional<TriangulatedPieces> try_planar(const MergedInput& input) {
    PiecesTrial trial = try_pieces(input);
    if (trial.triangulated || trial.crossed) return std::move(trial.triangulated);
    TriangulatedPieces result;
    result.tris = triangulate_points(input.points, input.stand_in);
    result.at_vertex = triangle_at_vertex(result.tris, input.points.size());
    UncrossedSegments uncrossed =
        insert_uncrossed_segments(input.points, input.segments, result.tris, result.at_vertex);
    if (!uncrossed.crossing.empty()) return {};
    result.pieces = std::move(uncrossed.pieces);
    result.stats = one_piece(input.points.size());
    return result;
}

/// Returns planarize() of the points that stand for themselves.
PlanarSegments planarize_merged(const MergedInput& input) {
    if (input.stand_in.empty()) return planarize(input.points, input.segments, input.snap);
    const DistinctInput distinct = distinct_input(input);
    PlanarSegments planar = planarize(distinct.points, distinct.segments, input.snap);
    const auto renumber = [&](VertexId& v) {
        const std::size_t i = v.index();
        const std::size_t count = distinct.points.size();
        v = VertexId{i < count ? distinct.original[i] : input.points.size() + (i - count)};
    };
    for (SegmentPiece& piece : planar.pieces) {
        renumber(piece.segment.a);
        renumber(piece.segment.b);
    }
    return planar;
}

/// Triangulates points and segments that may cross. `steiner_points` receives the crossing points.
TriangulatedPieces triangulate_crossing(const MergedInput& input, std::vector<Point>& steiner_points) {
    // Most segments do not cross after all, and the insertion of those is quicker than the search for crossings.
    if (input.snap == 0)
        if (auto planar = try_planar(input); planar && !may_pass_beside_vertex(input.points, input.segments, *planar))
            return std::move(*planar);
    PlanarSegments planar = planarize_merged(input);
    steiner_points = std::move(planar.steiner_points);
    std::vector<Point> all(input.points.begin(), input.points.end());
    all.insert(all.end(), steiner_points.begin(), steiner_points.end());
    std::vector<std::uint32_t> stand_in(input.stand_in.begin(), input.stand_in.end());
    while (!stand_in.empty() && stand_in.size() < all.size()) stand_in.push_back(static_cast<Index>(stand_in.size()));
    const std::vector<Segment> parts = segments_of(planar.pieces);
    TriangulatedPieces result = triangulate_planar({all, parts, stand_in, input.decomposition, 0});
    assert(result.pieces.size() == parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) planar.pieces[i].repeats = result.pieces[i].repeats;
    result.pieces = std::move(planar.pieces);
    return result;
}

/// Returns the rule by which triangles are kept, if it is one of turns.
std::optional<WindingRule> winding_rule(KeptRegion keep) {
    if (keep == KeptRegion::even_odd) return WindingRule::even_odd;
    if (keep == KeptRegion::non_zero) return WindingRule::non_zero;
    return std::nullopt;
}

TriangleSelection select_kept(const TriangulatedPieces& triangulated, KeptRegion keep, std::size_t point_count) {
    if (keep == KeptRegion::convex_hull) return select_all(triangulated.tris);
    if (keep == KeptRegion::inside_segments) return select_inside_segments(triangulated.tris);
    if (keep == KeptRegion::left_of_segments)
        return select_left_of_segments(segments_of(triangulated.pieces), triangulated.tris, point_count);
    return select_by_winding(triangulated.pieces, triangulated.tris, point_count, *winding_rule(keep));
}

/// Fills ConstrainedTriangulation::segments and ::parents with the pieces of segments that are edges of selected
/// triangles, each edge once. With `all` every triangle is selected.
void list_segments(const TriangulatedPieces& triangulated, const TriangleSelection& selection, bool all,
                   ConstrainedTriangulation& result) {
    const std::vector<SegmentPiece>& pieces = triangulated.pieces;
    const Tris& tris = triangulated.tris;
    std::vector<char> listed(pieces.size());
    constexpr std::size_t grain = 10'000;
    core::parallel_for(pieces.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            listed[i] = !pieces[i].repeats;
            if (all || !listed[i]) continue;
            const Segment s = pieces[i].segment;
            const Link left = find_edge(tris, triangulated.at_vertex, s.a.value, s.b.value);
            const Index right = tris[left.triangle()].n[left.edge()].triangle();
            listed[i] = selection[left.triangle()] || selection[right];
        }
    });
    const auto count = static_cast<std::size_t>(std::count(listed.begin(), listed.end(), 1));
    result.segments.reserve(count);
    result.parents.reserve(count);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (!listed[i]) continue;
        result.segments.push_back(pieces[i].segment);
        result.parents.push_back(pieces[i].parent);
    }
}

/// Returns the selected triangles in their order.
std::vector<Triangle> selected_triangles(const Tris& tris, const TriangleSelection& selection) {
    constexpr std::size_t grain = 50'000;
    const auto counts = core::parallel_blocks(tris.size(), grain, [&](std::size_t begin, std::size_t end) {
        const auto from = selection.begin();
        return std::count(from + std::ptrdiff_t(begin), from + std::ptrdiff_t(end), 1);
    });
    std::vector<std::size_t> first{0};
    for (const std::ptrdiff_t count : counts) first.push_back(first.back() + static_cast<std::size_t>(count));
    std::vector<Triangle> triangles(first.back());
    core::parallel_for(tris.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t place = first[begin / grain];
        for (std::size_t t = begin; t < end; ++t) {
            const Index* v = tris[t].v;
            if (selection[t]) triangles[place++] = {VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}};
        }
    });
    return triangles;
}

/// Returns whether every point stands for itself.
bool stand_for_themselves(std::span<const Index> stand_in) {
    std::size_t i = 0;
    return std::all_of(stand_in.begin(), stand_in.end(), [&](Index first) { return first == i++; });
}

/// Counts the segments that change nothing: those from a point to itself, and those that lie on earlier ones.
void count_idle_segments(std::span<const Segment> segments, const std::vector<SegmentPiece>& pieces,
                         ConstrainedTriangulation& result) {
    for (const Segment& s : segments) result.zero_length_segments += s.a == s.b;
    for (std::size_t i = 0; i < pieces.size();) {
        const Index parent = pieces[i].parent;
        bool repeats = true;
        for (; i < pieces.size() && pieces[i].parent == parent; ++i) repeats = repeats && pieces[i].repeats;
        result.repeated_segments += repeats;
    }
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedTriangulation triangulate(std::span<const Point> points, std::span<const Segment> segments,
                                     const ConstrainedOptions& options) {
    core::require_exact_range(options.holes, "hole");
    if (!(options.drop_flat >= 0 && options.drop_flat <= max_drop_flat))
        throw OptionError("drop_flat", core::concat("must be from 0 to ", max_drop_flat));
    if (options.drop_flat > 0 && options.keep != KeptRegion::convex_hull)
        throw OptionError("drop_flat", "needs the convex hull: without it, segments bound the triangles");
    ConstrainedTriangulation result;
    std::vector<Segment> merged_segments;
    std::span<const std::uint32_t> stand_in;
    if (options.merge_distance) {
        result.merged_into = merge_points(points, *options.merge_distance);
        core::require_indices_below(points.size(), segments);
        if (!stand_for_themselves(result.merged_into)) {
            stand_in = result.merged_into;
            merged_segments = segments_between(stand_in, segments);
            segments = merged_segments;
        }
    }
    if (const auto rule = winding_rule(options.keep)) {
        core::require_indices_below(points.size(), segments);
        check_closed_loops(segments, points.size(), *rule);
    }
    const MergedInput input{points, segments, stand_in, options.decomposition, options.merge_distance.value_or(0)};
    const TriangulatedPieces triangulated = options.crossings == Crossings::insert
                                                ? triangulate_crossing(input, result.steiner_points)
                                                : triangulate_planar(input);
    std::vector<Point> all;
    if (!result.steiner_points.empty()) {
        all.assign(points.begin(), points.end());
        all.insert(all.end(), result.steiner_points.begin(), result.steiner_points.end());
        points = all;
    }
    TriangleSelection selection = select_kept(triangulated, options.keep, points.size());
    result.idle_holes = deselect_holes(points, options.holes, triangulated.tris, selection);
    result.dropped_triangles = deselect_flat(points, options.drop_flat, triangulated.tris, selection);
    result.triangles = selected_triangles(triangulated.tris, selection);
    list_segments(triangulated, selection, options.keep == KeptRegion::convex_hull && options.holes.empty(), result);
    result.decomposition = triangulated.stats;
    count_idle_segments(segments, triangulated.pieces, result);
    return result;
}

}  // namespace lamina
