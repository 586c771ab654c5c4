// Constrained Delaunay triangulation: the steps of triangulate().
#include <algorithm>
#include <utility>

#include <lamina/delaunay.hpp>

#include "delaunay/planarize.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay {

namespace {

struct Constraints {
    Tris tris;
    std::vector<SegmentPiece> pieces;
};

Constraints insert_pieces(std::span<const Point> points, std::span<const Segment> segments, Tris tris) {
    std::vector<SegmentPiece> pieces = insert_and_split_segments(points, segments, tris);
    return {std::move(tris), std::move(pieces)};
}

/// The same where segments may cross; `added` receives the crossing points.
Constraints insert_crossing(std::span<const Point> points, std::span<const Segment> segments,
                            std::vector<Point>& added) {
    // Duplicate points and bad segments are refused before anything is made of them.
    Tris tris = triangulate_points(points);
    check_segments(points, segments, tris);
    PlanarSegments planar = planarize(points, segments);
    added = std::move(planar.steiner_points);
    std::vector<Point> all(points.begin(), points.end());
    all.insert(all.end(), added.begin(), added.end());
    if (!added.empty()) tris = triangulate_points(all);
    std::vector<Segment> pieces;
    for (const SegmentPiece& piece : planar.pieces) pieces.push_back(piece.segment);
    insert_segments(all, pieces, tris);
    return {std::move(tris), std::move(planar.pieces)};
}

Marks mark_kept(const Constraints& constraints, Keep keep, std::size_t point_count) {
    if (keep == Keep::convex_hull) return mark_all(constraints.tris);
    if (keep == Keep::inside_segments) return mark_inside_segments(constraints.tris);
    std::vector<Segment> pieces;
    for (const SegmentPiece& piece : constraints.pieces) pieces.push_back(piece.segment);
    return mark_left_of_segments(pieces, constraints.tris, point_count);
}

std::uint64_t key(Index a, Index b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

/// Each edge of the triangles kept that is a piece, once.
void list_segments(const Tris& kept, const std::vector<SegmentPiece>& pieces, ConstrainedTriangulation& result) {
    std::vector<std::uint64_t> edges;  // borders, too: a segment on the rim of what is kept has lost its mark
    for (const Tri& t : kept)
        for (unsigned e = 0; e < 3; ++e)
            if (t.n[e].is_constrained()) edges.push_back(key(t.v[next(e)], t.v[previous(e)]));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<char> listed(edges.size(), 0);
    for (const SegmentPiece& piece : pieces) {
        const auto at = std::lower_bound(edges.begin(), edges.end(), key(piece.segment.a.value, piece.segment.b.value));
        if (at == edges.end() || *at != key(piece.segment.a.value, piece.segment.b.value)) continue;
        char& done = listed[static_cast<std::size_t>(at - edges.begin())];
        if (std::exchange(done, 1)) continue;
        result.segments.push_back(piece.segment);
        result.parents.push_back(piece.parent);
    }
}

}  // namespace

}  // namespace lamina::delaunay

namespace lamina {

using namespace delaunay;

ConstrainedTriangulation triangulate(std::span<const Point> points, std::span<const Segment> segments,
                                     const ConstrainedOptions& options) {
    ConstrainedTriangulation result;
    const Constraints constraints = options.crossings == Crossings::insert
                                        ? insert_crossing(points, segments, result.steiner_points)
                                        : insert_pieces(points, segments, triangulate_points(points));
    std::vector<Point> all;
    if (!result.steiner_points.empty()) {
        all.assign(points.begin(), points.end());
        all.insert(all.end(), result.steiner_points.begin(), result.steiner_points.end());
        points = all;
    }
    Marks marks = mark_kept(constraints, options.keep, points.size());
    carve_holes(points, options.holes, constraints.tris, marks);
    const Tris kept = keep_marked(constraints.tris, marks);
    result.triangles = without_ghosts(kept).triangles;
    list_segments(kept, constraints.pieces, result);
    return result;
}

}  // namespace lamina
