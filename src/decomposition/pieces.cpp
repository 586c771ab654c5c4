// The steps of a triangulation in pieces: sort, cut, triangulate the leaves, put their triangles one behind the other.
// Borders of leaves are edges of the triangulation of the whole, so every leaf finds its triangles of it by itself.
#include "decomposition/pieces.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "core/parallel.hpp"
#include "decomposition/border.hpp"
#include "decomposition/decompose.hpp"
#include "kernel/triangulator.hpp"

namespace lamina::decomposition {

namespace {

/// Leaves in the order of the decomposition.
struct Pieces {
    std::vector<std::vector<Triangle>> triangles;
    DecompositionStats stats;
};

void add(DecompositionStats& sum, const DecompositionStats& stats) {
    sum.pieces += stats.pieces;
    sum.piece_vertices += stats.piece_vertices;
    sum.largest_piece = std::max(sum.largest_piece, stats.largest_piece);
    sum.crossing_cuts += stats.crossing_cuts;
    sum.unbalanced_cuts += stats.unbalanced_cuts;
    sum.uncut += stats.uncut;
    sum.fallbacks += stats.fallbacks;
}

/// The triangles inside a leaf's border, in the numbers of the input.
std::vector<Triangle> triangulate_leaf(const SortedPoints& sorted, Subdomain leaf) {
    leaf.by_y = {};
    const std::span<const Index> numbers = leaf.by_x.all();
    std::vector<Point> points;
    points.reserve(numbers.size());
    for (const Index i : numbers) points.push_back(sorted.points[i]);
    const auto local = [&](Index i) {
        return VertexId{
            static_cast<std::size_t>(std::lower_bound(numbers.begin(), numbers.end(), i) - numbers.begin())};
    };
    std::vector<Segment> border;
    border.reserve(leaf.border.size());
    for (const Edge& e : leaf.border) border.push_back({local(e.a), local(e.b)});

    kernel::Tris tris = kernel::triangulate_points(points);
    std::vector<kernel::SegmentPiece> split = kernel::insert_and_split_segments(points, border, tris);
    border.clear();
    for (const kernel::SegmentPiece& piece : split) border.push_back(piece.segment);
    const kernel::Marks marks = kernel::mark_not_right_of_segments(border, tris, points.size());
    std::vector<Triangle> triangles;
    triangles.reserve(static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1)));
    const auto original = [&](Index i) { return VertexId{sorted.original[numbers[i]]}; };
    for (std::size_t t = 0; t < tris.size(); ++t)
        if (marks[t]) triangles.push_back({original(tris[t].v[0]), original(tris[t].v[1]), original(tris[t].v[2])});
    return triangles;
}

Pieces triangulate(const SortedPoints& sorted, Subdomain subdomain, const DecompositionOptions& options) {
    Pieces pieces;
    if (!is_leaf(subdomain, options)) {
        if (std::optional<Halves> halves = cut_subdomain(sorted, subdomain, pieces.stats)) {
            Pieces low, high;
            parallel_invoke([&] { low = triangulate(sorted, std::move(halves->low), options); },
                            [&] { high = triangulate(sorted, std::move(halves->high), options); });
            pieces.triangles = std::move(low.triangles);
            std::move(high.triangles.begin(), high.triangles.end(), std::back_inserter(pieces.triangles));
            add(pieces.stats, low.stats);
            add(pieces.stats, high.stats);
            return pieces;
        }
        ++pieces.stats.uncut;
    }
    pieces.stats.pieces = 1;
    pieces.stats.piece_vertices = pieces.stats.largest_piece = subdomain.size();
    pieces.triangles.push_back(triangulate_leaf(sorted, std::move(subdomain)));
    return pieces;
}

/// One behind the other; every piece is freed once it is copied.
PiecewiseTriangulation join(Pieces pieces) {
    PiecewiseTriangulation result;
    result.stats = pieces.stats;
    result.first.push_back(0);
    for (const auto& piece : pieces.triangles) result.first.push_back(result.first.back() + piece.size());
    result.triangles.reserve(result.first.back());
    for (auto& piece : pieces.triangles) {
        result.triangles.insert(result.triangles.end(), piece.begin(), piece.end());
        piece = {};
    }
    return result;
}

PiecewiseTriangulation one_piece(std::vector<Triangle> triangles, std::size_t vertices) {
    PiecewiseTriangulation result;
    result.first = {0, triangles.size()};
    result.triangles = std::move(triangles);
    result.stats = {.pieces = 1, .piece_vertices = vertices, .largest_piece = vertices};
    return result;
}

/// Whole sets in the two orders; nothing where the triangulation of all points by one kernel is called for: because
/// they are few, or because it names what is wrong with them.
std::optional<SortedPoints> sort_for_cuts(std::span<const Point> points, const DecompositionOptions& options) {
    if (points.size() <= options.leaf_vertices || points.size() < 4 || options.depth == 0) return {};
    if (!std::all_of(points.begin(), points.end(), in_exact_range)) return {};
    std::optional<SortedPoints> sorted = sort_points(points);
    if (has_duplicates(*sorted)) return {};
    return sorted;
}

/// The whole region as a subdomain.
Subdomain whole(SortedPoints& sorted, std::vector<Edge> border) {
    Subdomain root;
    root.by_x = Order(sorted.points.size());
    std::iota(root.by_x.data(), root.by_x.data() + root.by_x.size(), Index{0});
    root.by_y = Order(sorted.by_y);
    sorted.by_y = {};
    root.border = std::move(border);
    return root;
}

}  // namespace

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, const DecompositionOptions& options) {
    std::optional<SortedPoints> sorted = sort_for_cuts(points, options);
    std::vector<Edge> hull = sorted ? convex_hull(*sorted) : std::vector<Edge>{};
    if (hull.empty())
        return one_piece(kernel::without_ghosts(kernel::triangulate_points(points)).triangles, points.size());
    return join(triangulate(*sorted, whole(*sorted, std::move(hull)), options));
}

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, std::span<const Segment> border,
                                             const DecompositionOptions& options) {
    std::size_t fallbacks = 0;
    if (std::optional<SortedPoints> sorted = sort_for_cuts(points, options)) {
        std::vector<Index> place(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) place[sorted->original[i]] = static_cast<Index>(i);
        std::vector<Edge> edges;
        for (const Segment& s : border) edges.push_back({place[s.a.index()], place[s.b.index()]});
        place = {};
        try {
            return join(triangulate(*sorted, whole(*sorted, std::move(edges)), options));
        } catch (const InputError&) {
            // Segments that cross are named by their numbers in a piece. The whole set names them right.
            fallbacks = 1;
        }
    }
    auto result =
        one_piece(constrained_delaunay(points, border, {.keep = Keep::left_of_segments}).triangles, points.size());
    result.stats.fallbacks = fallbacks;
    return result;
}

}  // namespace lamina::decomposition

namespace lamina {

Triangulation parallel_delaunay(std::span<const Point> points, const DecompositionOptions& options) {
    return {decomposition::triangulate_in_pieces(points, options).triangles};
}

}  // namespace lamina
