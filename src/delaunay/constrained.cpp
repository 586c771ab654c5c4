// The constrained triangulate(): insert segments, select triangles, list the segments that are left.
#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include <lamina/triangulation.hpp>

#include "core/arguments.hpp"
#include "delaunay/insert_segments.hpp"
#include "delaunay/planarize.hpp"
#include "delaunay/regions.hpp"
#include "delaunay/triangulate_points.hpp"
#include "delaunay/winding.hpp"

namespace lamina::delaunay {

namespace {

/// A triangulation of the convex hull with the pieces of segments that it holds as constrained edges.
struct TriangulatedPieces {
    Tris tris;
    std::vector<SegmentPiece> pieces;
};

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

    bool stands_for_itself(std::size_t i) const { return stand_in.empty() || stand_in[i] == i; }
};

/// Triangulates points and segments that do not cross.
TriangulatedPieces triangulate_planar(const MergedInput& input) {
    Tris tris = triangulate_points(input.points, input.stand_in);
    std::vector<SegmentPiece> pieces = insert_and_split_segments(input.points, input.segments, tris);
    return {std::move(tris), std::move(pieces)};
}

/// Returns planarize() of the points that stand for themselves.
PlanarSegments planarize_merged(const MergedInput& input) {
    if (input.stand_in.empty()) return planarize(input.points, input.segments);
    std::vector<Point> points;
    std::vector<std::size_t> original;
    std::vector<VertexId> number(input.points.size());
    for (std::size_t i = 0; i < input.points.size(); ++i) {
        if (!input.stands_for_itself(i)) continue;
        number[i] = VertexId{points.size()};
        points.push_back(input.points[i]);
        original.push_back(i);
    }
    std::vector<Segment> segments;
    for (const Segment& s : input.segments) segments.push_back({number[s.a.index()], number[s.b.index()]});
    PlanarSegments planar = planarize(points, segments);
    const auto renumber = [&](VertexId& v) {
        const std::size_t i = v.index();
        v = VertexId{i < points.size() ? original[i] : input.points.size() + (i - points.size())};
    };
    for (SegmentPiece& piece : planar.pieces) {
        renumber(piece.segment.a);
        renumber(piece.segment.b);
    }
    return planar;
}

/// Triangulates points and segments that may cross. `steiner_points` receives the crossing points.
TriangulatedPieces triangulate_crossing(const MergedInput& input, std::vector<Point>& steiner_points) {
    Tris tris = triangulate_points(input.points, input.stand_in);
    // Most segments do not cross after all, and the insertion of those is quicker than the search for crossings.
    if (auto pieces = insert_planar_segments(input.points, input.segments, tris))
        return {std::move(tris), std::move(*pieces)};
    PlanarSegments planar = planarize_merged(input);
    steiner_points = std::move(planar.steiner_points);
    std::vector<Point> all(input.points.begin(), input.points.end());
    all.insert(all.end(), steiner_points.begin(), steiner_points.end());
    std::vector<std::uint32_t> stand_in(input.stand_in.begin(), input.stand_in.end());
    while (!stand_in.empty() && stand_in.size() < all.size()) stand_in.push_back(static_cast<Index>(stand_in.size()));
    tris = triangulate_points(all, stand_in);
    const std::vector<Segment> parts = segments_of(planar.pieces);
    const std::vector<SegmentPiece> inserted = insert_and_split_segments(all, parts, tris);
    assert(inserted.size() == parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) planar.pieces[i].repeats = inserted[i].repeats;
    return {std::move(tris), std::move(planar.pieces)};
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

/// Fills ConstrainedTriangulation::segments and ::parents with the edges of the kept triangles that are pieces of
/// segments, each edge once.
void list_segments(const Tris& kept, const std::vector<SegmentPiece>& pieces, ConstrainedTriangulation& result) {
    // Borders count, too: constrained edges on the boundary of the kept triangles became borders.
    std::vector<std::uint64_t> edges;
    for (const Tri& t : kept)
        for (unsigned e = 0; e < 3; ++e)
            if (t.n[e].is_constrained()) edges.push_back(undirected_key(t.v[next(e)], t.v[previous(e)]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<char> listed(edges.size(), 0);
    for (const SegmentPiece& piece : pieces) {
        const std::uint64_t key = undirected_key(piece.segment.a.value, piece.segment.b.value);
        const auto found = std::lower_bound(edges.begin(), edges.end(), key);
        if (found == edges.end() || *found != key) continue;
        if (std::exchange(listed[static_cast<std::size_t>(found - edges.begin())], 1)) continue;
        result.segments.push_back(piece.segment);
        result.parents.push_back(piece.parent);
    }
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
    ConstrainedTriangulation result;
    std::vector<Segment> merged_segments;
    if (options.merge_distance) {
        result.merged_into = merge_points(points, *options.merge_distance);
        core::require_indices_below(points.size(), segments);
        for (const Segment& s : segments)
            merged_segments.push_back(
                {VertexId{result.merged_into[s.a.index()]}, VertexId{result.merged_into[s.b.index()]}});
        segments = merged_segments;
    }
    if (const auto rule = winding_rule(options.keep)) {
        core::require_indices_below(points.size(), segments);
        check_closed_loops(segments, points.size(), *rule);
    }
    const MergedInput input{points, segments, result.merged_into};
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
    deselect_holes(points, options.holes, triangulated.tris, selection);
    const Tris kept = keep_selected(triangulated.tris, selection);
    result.triangles = without_ghosts(kept).triangles;
    list_segments(kept, triangulated.pieces, result);
    count_idle_segments(segments, triangulated.pieces, result);
    return result;
}

}  // namespace lamina
