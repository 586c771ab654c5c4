#include "delaunay/pieces/whole_piece.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace lamina::delaunay::pieces {

std::optional<SortedPoints> sort_for_cuts(std::span<const Point> points, const DecompositionOptions& options,
                                          core::BusyTimes* times) {
    if (points.size() <= options.leaf_vertices || points.size() < 4 || options.depth == 0) return {};
    return sort_points(points, times);
}

Piece whole_region(SortedPoints& sorted, std::vector<BorderEdge> border) {
    Piece whole;
    whole.by_x = PointOrder(sorted.points.size());
    std::iota(whole.by_x.begin(), whole.by_x.end(), Index{0});
    whole.by_y = std::move(sorted.by_y);
    whole.border = std::move(border);
    return whole;
}

DecompositionOptions default_decomposition(std::size_t points) {
    // On one thread pieces cost up to a third more. From this number on, at 10 ms, a second thread saves milliseconds
    // (docs/decisions/0013).
    constexpr std::size_t min_points_to_cut = 50'000;
    if (points < min_points_to_cut) return {.depth = 0};
    return {};
}

void add(DecompositionStats& sum, const DecompositionStats& stats) {
    sum.pieces += stats.pieces;
    sum.piece_vertices += stats.piece_vertices;
    sum.largest_piece = std::max(sum.largest_piece, stats.largest_piece);
    sum.crossing_cuts += stats.crossing_cuts;
    sum.unbalanced_cuts += stats.unbalanced_cuts;
    sum.long_cuts += stats.long_cuts;
    sum.uncut += stats.uncut;
    sum.fallbacks += stats.fallbacks;
}

}  // namespace lamina::delaunay::pieces
