// The steps of a triangulation in pieces: sort the points, cut them into leaves, triangulate the leaves, and put their
// triangles one behind the other. Borders of leaves are edges of the triangulation of the whole, so the triangles
// inside every leaf are triangles of the whole.
#include "delaunay/pieces/pieces.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>

#include <lamina/delaunay.hpp>
#include <lamina/error.hpp>

#include "core/parallel.hpp"
#include "delaunay/constrain/regions.hpp"
#include "delaunay/pieces/convex_hull.hpp"
#include "delaunay/pieces/cut_piece.hpp"
#include "delaunay/pieces/grow_in_parts.hpp"
#include "delaunay/pieces/leaf_brio.hpp"
#include "delaunay/pieces/vertex_index_map.hpp"
#include "delaunay/pieces/whole_piece.hpp"
#include "delaunay/triangulate/triangulate_points.hpp"

namespace lamina::delaunay::pieces {

namespace {

/// The triangles of a leaf; their vertices are indices into the input.
using LeafTriangles = core::UninitializedArray<std::array<Index, 3>>;

/// The leaves of a piece, in the order of the decomposition.
struct Leaves {
    std::vector<LeafTriangles> triangles;
    DecompositionStats stats;
};

/// Returns a closed border between vertices as triangulate_in_order() numbers them: point order[i] is vertex i + 1.
std::vector<Segment> in_insertion_numbers(std::span<const BorderEdge> border, std::span<const Index> order) {
    std::vector<Index> vertices;
    vertices.reserve(border.size());
    for (const BorderEdge& e : border) vertices.push_back(e.a);
    const VertexIndexMap map(vertices);
    // From here on `vertices` holds the new numbers.
    for (std::size_t i = 0; i < order.size(); ++i)
        if (const std::size_t at = map.find(order[i]); at != not_found) vertices[at] = static_cast<Index>(i + 1);
    const auto inserted = [&](Index i) { return VertexId{vertices[map.find(i)]}; };
    std::vector<Segment> segments;
    segments.reserve(border.size());
    for (const BorderEdge& e : border) segments.push_back({inserted(e.a), inserted(e.b)});
    return segments;
}

/// Returns the triangles inside the border of a leaf.
LeafTriangles triangulate_leaf(const SortedPoints& sorted, Piece leaf) {
    std::vector<Index> order = leaf_brio(sorted, leaf);
    leaf.by_x = {};
    leaf.by_y = {};
    OrderedTriangulation triangulation = triangulate_in_order(sorted.points.all(), order);
    const TriangleSelection inside =
        select_region(triangulation, in_insertion_numbers(std::exchange(leaf.border, {}), order));
    // From here on `order` holds for each vertex its index in the input.
    for (Index& i : order) i = sorted.original[i];
    LeafTriangles triangles(static_cast<std::size_t>(std::count(inside.begin(), inside.end(), 1)));
    auto* to = triangles.begin();
    for (std::size_t t = 0; t < inside.size(); ++t) {
        if (!inside[t]) continue;
        // The border is closed, so the vertex at infinity is outside.
        assert(!triangulation.tris[t].is_ghost());
        const auto& v = triangulation.tris[t].v;
        *to++ = {order[v[0] - 1], order[v[1] - 1], order[v[2] - 1]};
    }
    return triangles;
}

/// Triangulates a piece: cuts it and triangulates both parts, at the same time where a thread is free, or triangulates
/// the whole if it is a leaf or no cut is good.
Leaves triangulate_piece(const SortedPoints& sorted, Piece piece, const DecompositionOptions& options,
                         core::BusyTimes* times) {
    Leaves leaves;
    if (!is_leaf(piece, options)) {
        std::optional<PieceHalves> halves;
        {
            const core::BusyTimes::Scope busy(times, cutting);
            halves = cut_piece(sorted, piece, leaves.stats);
        }
        if (halves) {
            Leaves low, high;
            core::parallel_invoke([&] { low = triangulate_piece(sorted, std::move(halves->low), options, times); },
                                  [&] { high = triangulate_piece(sorted, std::move(halves->high), options, times); });
            leaves.triangles = std::move(low.triangles);
            std::move(high.triangles.begin(), high.triangles.end(), std::back_inserter(leaves.triangles));
            add(leaves.stats, low.stats);
            add(leaves.stats, high.stats);
            return leaves;
        }
        ++leaves.stats.uncut;
    }
    leaves.stats.pieces = 1;
    leaves.stats.piece_vertices = leaves.stats.largest_piece = piece.size();
    const core::BusyTimes::Scope busy(times, triangulating);
    leaves.triangles.push_back(triangulate_leaf(sorted, std::move(piece)));
    return leaves;
}

/// Triangulates a region and puts the triangles of all leaves one behind the other. Every leaf is freed once its
/// triangles are copied.
PiecewiseTriangulation triangulate_and_join(const SortedPoints& sorted, Piece region,
                                            const DecompositionOptions& options, core::BusyTimes* times) {
    PiecewiseTriangulation result;
    Leaves leaves;
    [[maybe_unused]] const std::size_t border_edges = region.border.size();
    // Room for all triangles is made while the first cut keeps one thread busy.
    core::parallel_invoke([&] { leaves = triangulate_piece(sorted, std::move(region), options, times); },
                          [&, vertices = region.size()] {
                              const core::BusyTimes::Scope busy(times, triangulating);
                              result.triangles.resize(2 * vertices);
                          });
    result.stats = leaves.stats;
    result.first.push_back(0);
    for (const LeafTriangles& leaf : leaves.triangles) result.first.push_back(result.first.back() + leaf.size());
    // Each triangle has three edges, and each edge inside the region belongs to two triangles.
    assert(result.first.back() <= result.triangles.size() && (result.first.back() + border_edges) % 2 == 0);
    result.triangles.resize(result.first.back());
    core::parallel_for(leaves.triangles.size(), 1, [&](std::size_t begin, std::size_t) {
        const core::BusyTimes::Scope busy(times, triangulating);
        const LeafTriangles leaf = std::move(leaves.triangles[begin]);
        std::transform(leaf.begin(), leaf.end(), result.triangles.begin() + std::ptrdiff_t(result.first[begin]),
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

/// Returns the border with the numbers of SortedPoints in the place of indices into the input.
std::vector<BorderEdge> in_sorted_numbers(const SortedPoints& sorted, std::span<const Segment> border) {
    core::UninitializedArray<Index> numbers(sorted.original.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[sorted.original[i]] = static_cast<Index>(i);
    std::vector<BorderEdge> edges;
    edges.reserve(border.size());
    for (const Segment& s : border) edges.push_back({numbers[s.a.index()], numbers[s.b.index()]});
    return edges;
}

}  // namespace

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, const DecompositionOptions& options,
                                             core::BusyTimes* times) {
    std::optional<SortedPoints> sorted;
    Piece whole;
    {
        const core::BusyTimes::Scope busy(times, cutting);
        if (!is_beyond_cuts(points, options)) sorted = sort_for_cuts(points, options, times);
        if (sorted) whole = whole_region(*sorted, convex_hull(*sorted));
    }
    if (!whole.border.empty()) return triangulate_and_join(*sorted, std::move(whole), options, times);
    const core::BusyTimes::Scope busy(times, triangulating);
    return one_piece(triangulate_in_parts(points), points.size());
}

PiecewiseTriangulation triangulate_in_pieces(std::span<const Point> points, std::span<const Segment> border,
                                             const DecompositionOptions& options, core::BusyTimes* times) {
    std::size_t fallbacks = 0;
    std::optional<SortedPoints> sorted;
    Piece whole;
    {
        const core::BusyTimes::Scope busy(times, cutting);
        sorted = sort_for_cuts(points, options, times);
        if (sorted) whole = whole_region(*sorted, in_sorted_numbers(*sorted, border));
    }
    if (sorted) {
        try {
            return triangulate_and_join(*sorted, std::move(whole), options, times);
        } catch (const InputError&) {
            // The error names crossing segments by their numbers in a piece. The triangulation of all points at once
            // names them by their indices in the input.
            fallbacks = 1;
        }
    }
    const core::BusyTimes::Scope busy(times, triangulating);
    auto result =
        one_piece(triangulate(points, border, {.keep = KeptRegion::left_of_segments}).triangles, points.size());
    result.stats.fallbacks = fallbacks;
    return result;
}

}  // namespace lamina::delaunay::pieces

namespace lamina {

using namespace delaunay::pieces;

Triangulation triangulate(std::span<const Point> points) {
    return triangulate(points, default_decomposition(points.size()));
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
