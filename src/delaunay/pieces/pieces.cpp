// The steps of a triangulation in pieces: sort, cut, triangulate the leaves, put their triangles one behind the other.
// Borders of leaves are edges of the triangulation of the whole, so every leaf finds its triangles of it by itself.
#include "delaunay/pieces/pieces.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "delaunay/pieces/border.hpp"
#include "delaunay/pieces/decompose.hpp"
#include "delaunay/pieces/leaf_order.hpp"
#include "delaunay/pieces/places.hpp"
#include "delaunay/triangulator.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// Vertices as numbers of the input.
using PieceTriangles = core::UninitializedArray<std::array<Index, 3>>;

/// Leaves in the order of the decomposition.
struct Pieces {
    std::vector<PieceTriangles> triangles;
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

/// The border between vertices as kernel::triangulate_in_order() numbers them.
std::vector<Segment> in_order_of_insertion(std::span<const Edge> border, std::span<const Index> order) {
    std::vector<Index> vertices;
    vertices.reserve(border.size());
    for (const Edge& e : border) vertices.push_back(e.a);
    const Places places(vertices);
    for (std::size_t i = 0; i < order.size(); ++i)
        if (const std::size_t at = places.of(order[i]); at != nowhere) vertices[at] = static_cast<Index>(i + 1);
    const auto inserted = [&](Index i) { return VertexId{vertices[places.of(i)]}; };
    std::vector<Segment> segments;
    segments.reserve(border.size());
    for (const Edge& e : border) segments.push_back({inserted(e.a), inserted(e.b)});
    return segments;
}

/// The triangles inside a leaf's border, in the numbers of the input.
PieceTriangles triangulate_leaf(const SortedPoints& sorted, Subdomain leaf) {
    std::vector<Index> numbers = leaf_order(sorted, leaf);
    leaf.by_x = {};
    leaf.by_y = {};
    delaunay::OrderedTriangulation triangulation = delaunay::triangulate_in_order(sorted.points.all(), numbers);
    const delaunay::Marks inside =
        delaunay::mark_region(triangulation, in_order_of_insertion(std::exchange(leaf.border, {}), numbers));
    // From here on each vertex's number in the input.
    for (Index& i : numbers) i = sorted.original[i];
    PieceTriangles triangles(static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1)));
    auto* to = triangles.begin();
    for (std::size_t t = 0; t < inside.size(); ++t) {
        if (!inside[t]) continue;
        const auto& v = triangulation.tris[t].v;
        *to++ = {numbers[v[0] - 1], numbers[v[1] - 1], numbers[v[2] - 1]};
    }
    return triangles;
}

Pieces triangulate(const SortedPoints& sorted, Subdomain subdomain, const DecompositionOptions& options,
                   core::BusyTimes* times) {
    Pieces pieces;
    if (!is_leaf(subdomain, options)) {
        std::optional<Halves> halves;
        {
            const core::BusyTimes::Scope busy(times, cutting);
            halves = cut_subdomain(sorted, subdomain, pieces.stats);
        }
        if (halves) {
            Pieces low, high;
            core::parallel_invoke([&] { low = triangulate(sorted, std::move(halves->low), options, times); },
                                  [&] { high = triangulate(sorted, std::move(halves->high), options, times); });
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
    const core::BusyTimes::Scope busy(times, triangulating);
    pieces.triangles.push_back(triangulate_leaf(sorted, std::move(subdomain)));
    return pieces;
}

/// The pieces' triangles one behind the other; every piece is freed once it is copied.
PiecewiseTriangulation triangulate_and_join(const SortedPoints& sorted, Subdomain root,
                                            const DecompositionOptions& options, core::BusyTimes* times) {
    PiecewiseTriangulation result;
    Pieces pieces;
    // Room for all triangles is made while the first cut keeps one thread busy.
    core::parallel_invoke([&] { pieces = triangulate(sorted, std::move(root), options, times); },
                          [&, vertices = root.size()] {
                              const core::BusyTimes::Scope busy(times, triangulating);
                              result.triangles.resize(2 * vertices);
                          });
    result.stats = pieces.stats;
    result.first.push_back(0);
    for (const auto& piece : pieces.triangles) result.first.push_back(result.first.back() + piece.size());
    result.triangles.resize(result.first.back());
    core::parallel_for(pieces.triangles.size(), 1, [&](std::size_t begin, std::size_t) {
        const core::BusyTimes::Scope busy(times, triangulating);
        const PieceTriangles piece = std::move(pieces.triangles[begin]);
        std::transform(piece.begin(), piece.end(), result.triangles.begin() + std::ptrdiff_t(result.first[begin]),
                       [](const std::array<Index, 3>& v) {
                           return Triangle{{VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}}};
                       });
    });
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
std::optional<SortedPoints> sort_for_cuts(std::span<const Point> points, const DecompositionOptions& options,
                                          core::BusyTimes* times) {
    if (points.size() <= options.leaf_vertices || points.size() < 4 || options.depth == 0) return {};
    return sort_points(points, times);
}

std::vector<Edge> in_sorted_numbers(const SortedPoints& sorted, std::span<const Segment> border) {
    core::UninitializedArray<Index> place(sorted.original.size());
    for (std::size_t i = 0; i < place.size(); ++i) place[sorted.original[i]] = static_cast<Index>(i);
    std::vector<Edge> edges;
    edges.reserve(border.size());
    for (const Segment& s : border) edges.push_back({place[s.a.index()], place[s.b.index()]});
    return edges;
}

/// The whole region as a subdomain.
Subdomain whole(SortedPoints& sorted, std::vector<Edge> border) {
    Subdomain root;
    root.by_x = Order(sorted.points.size());
    std::iota(root.by_x.begin(), root.by_x.end(), Index{0});
    root.by_y = std::move(sorted.by_y);
    root.border = std::move(border);
    return root;
}

}  // namespace

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, const DecompositionOptions& options,
                                             core::BusyTimes* times) {
    std::optional<SortedPoints> sorted;
    Subdomain root;
    {
        const core::BusyTimes::Scope busy(times, cutting);
        sorted = sort_for_cuts(points, options, times);
        if (sorted) root = whole(*sorted, convex_hull(*sorted));
    }
    if (!root.border.empty()) return triangulate_and_join(*sorted, std::move(root), options, times);
    const core::BusyTimes::Scope busy(times, triangulating);
    return one_piece(delaunay::without_ghosts(delaunay::triangulate_points(points)).triangles, points.size());
}

DecompositionOptions usual_decomposition(std::size_t points) {
    // On one thread pieces cost up to a third more; from here on, 10 ms, a second one saves milliseconds
    // (docs/decisions/0013).
    constexpr std::size_t worth_cutting = 50'000;
    if (points < worth_cutting) return {.depth = 0};
    return {};
}

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, std::span<const Segment> border,
                                             const DecompositionOptions& options, core::BusyTimes* times) {
    std::size_t fallbacks = 0;
    std::optional<SortedPoints> sorted;
    Subdomain root;
    {
        const core::BusyTimes::Scope busy(times, cutting);
        sorted = sort_for_cuts(points, options, times);
        if (sorted) root = whole(*sorted, in_sorted_numbers(*sorted, border));
    }
    if (sorted) {
        try {
            return triangulate_and_join(*sorted, std::move(root), options, times);
        } catch (const InputError&) {
            // Segments that cross are named by their numbers in a piece. The whole set names them right.
            fallbacks = 1;
        }
    }
    const core::BusyTimes::Scope busy(times, triangulating);
    auto result = one_piece(triangulate(points, border, {.keep = Keep::left_of_segments}).triangles, points.size());
    result.stats.fallbacks = fallbacks;
    return result;
}

}  // namespace lamina::delaunay::pieces

namespace lamina {

using namespace delaunay::pieces;

Triangulation triangulate(std::span<const Point> points) {
    return triangulate(points, usual_decomposition(points.size()));
}

Triangulation triangulate(std::span<const Point> points, const DecompositionOptions& options) {
    validate(options);
    const auto start = std::chrono::steady_clock::now();
    core::BusyTimes times;
    PiecewiseTriangulation pieces = triangulate_in_pieces(points, options, &times);
    const double elapsed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Triangulation result{std::move(pieces.triangles), pieces.stats};
    for (std::size_t i = 0; i < times.threads(); ++i)
        result.threads.push_back({times.seconds(i, cutting), times.seconds(i, triangulating), times.idle(i, elapsed)});
    return result;
}

}  // namespace lamina
