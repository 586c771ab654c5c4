#include "delaunay/pieces/whole_piece.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <utility>

#include "core/random.hpp"
#include "delaunay/pieces/convex_hull.hpp"
#include "delaunay/pieces/cut_line.hpp"
#include "delaunay/pieces/dividing_path.hpp"

namespace lamina::delaunay::pieces {

std::optional<SortedPoints> sort_for_cuts(std::span<const Point> points, const DecompositionOptions& options,
                                          core::BusyTimes* times) {
    if (points.size() <= options.leaf_vertices || points.size() < 4 || options.depth == 0) return {};
    return sort_points(points, times);
}

bool is_beyond_cuts(std::span<const Point> points, const DecompositionOptions& options) {
    constexpr std::size_t run_length = 64, least_samples = 200;
    if (points.size() < run_length * least_samples || options.depth == 0) return false;
    std::vector<Point> sample;  // one point of each run, since points may stand in rows
    for (std::size_t i = 0; i + run_length <= points.size(); i += run_length)
        sample.push_back(points[i + core::splitmix64(i) % run_length]);
    std::optional<SortedPoints> sorted = sort_points(sample);
    if (!sorted) return false;
    const Piece whole = whole_region(*sorted, convex_hull(*sorted));
    const std::size_t many = sample.size() / 4, middle = sample.size() / 2;
    if (whole.border.empty()) return false;
    return whole.border.size() > many || (dividing_path(*sorted, whole, Axis::x, middle).size() > many &&
                                          dividing_path(*sorted, whole, Axis::y, middle).size() > many);
}

Piece whole_region(SortedPoints& sorted, std::vector<BorderEdge> border) {
    assert(is_closed(border) && sorted.by_y.size() == sorted.points.size());
    Piece whole;
    whole.by_x = PointOrder(sorted.points.size());
    std::iota(whole.by_x.begin(), whole.by_x.end(), Index{0});
    whole.by_y = std::move(sorted.by_y);
    whole.border = std::move(border);
    return whole;
}

DecompositionOptions default_decomposition(std::size_t points) {
    // On one thread pieces cost up to a third more. From this number on, at 10 ms, a second thread saves milliseconds.
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
