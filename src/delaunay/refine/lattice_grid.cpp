// Removal of vertices by rows: the columns of a row between two crossings or near a line are cleared word by word.
#include "delaunay/refine/lattice_grid.hpp"

#include <bit>

namespace lamina::delaunay {

std::size_t count_vertices(const LatticeGrid& grid) {
    std::size_t n = 0;
    for (LatticeWord w : grid.bits) n += static_cast<std::size_t>(std::popcount(w));
    return n;
}

void clear_outside(LatticeGrid& grid, std::span<const Point> points, std::span<const Segment> segments) {
    // The crossings of rows with segments, by rows and from left to right.
    std::vector<std::pair<LatticeRow, double>> crossings;
    for (const Segment& s : segments) {
        Point a = points[s.a.index()], b = points[s.b.index()];
        if (a.y > b.y) std::swap(a, b);
        const auto [first, last] = grid.rows_between(a.y, b.y);
        // Rounding may leave out a row through a or b: one row more on either side, so that the test below decides.
        for (LatticeRow j = std::max<LatticeRow>(first - 1, 0); j < std::min(last + 1, grid.rows); ++j) {
            const double y = grid.row_y(j);
            // Half-open: a border vertex on a row counts for one of its two edges. Each row then has an even number of
            // crossings.
            if (y <= a.y || y > b.y) continue;
            crossings.emplace_back(j, a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
        }
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t k = 0;
    const auto clear = [&](LatticeRow j, std::size_t first, std::size_t last) {
        LatticeWord* row = grid.row(j);
        for_columns(first, last, [&](std::size_t w, LatticeWord mask) { row[w] &= ~mask; });
    };
    for (LatticeRow j = 0; j < grid.rows; ++j) {
        std::size_t outside_from = 0;
        for (; k + 1 < crossings.size() && crossings[k].first == j; k += 2) {
            const auto [first, last] = grid.columns_between(j, crossings[k].second, crossings[k + 1].second);
            clear(j, outside_from, first);
            outside_from = std::max(outside_from, last);
        }
        clear(j, outside_from, 64 * grid.words);
    }
}

void clear_near(LatticeGrid& grid, Point a, Point b, double margin) {
    Box box;
    box.include(a);
    box.include(b);
    box.lower = box.lower - Point{margin, margin};
    box.upper = box.upper + Point{margin, margin};
    if (!box.overlaps(grid.box)) return;
    const auto [first_row, last_row] = grid.rows_between(box.lower.y, box.upper.y);
    const Point low = a.y <= b.y ? a : b, high = a.y <= b.y ? b : a;
    for (LatticeRow j = first_row; j < last_row; ++j) {
        const double y = grid.row_y(j);
        // The range in x of the part of the line within the margin of this row, widened by the margin, holds a little
        // more than the exact neighbourhood of the line.
        const double height = high.y - low.y;
        const auto x_at = [&](double at) {
            return height > 0 ? low.x + std::clamp((at - low.y) / height, 0.0, 1.0) * (high.x - low.x) : low.x;
        };
        double x0 = x_at(y - margin), x1 = x_at(y + margin);
        if (height == 0) x1 = high.x;
        const double y_distance = std::max({0.0, low.y - y, y - high.y});
        const double reach = std::sqrt(std::max(0.0, margin * margin - y_distance * y_distance));
        const auto [first, last] = grid.columns_between(j, std::min(x0, x1) - reach, std::max(x0, x1) + reach);
        LatticeWord* row = grid.row(j);
        for_columns(first, last, [&](std::size_t w, LatticeWord mask) { row[w] &= ~mask; });
    }
}

std::vector<LatticeRun> runs_of(const LatticeGrid& grid) {
    std::vector<LatticeRun> runs;
    for (LatticeRow j = 0; j < grid.rows; ++j) {
        const LatticeWord* row = grid.row(j);
        std::size_t start = 0;
        bool in_run = false;
        for (std::size_t w = 0; w < grid.words; ++w) {
            // The bits that end the present state: set ones outside a run, clear ones inside a run.
            for (LatticeWord change = in_run ? ~row[w] : row[w]; change != 0;) {
                const auto bit = static_cast<unsigned>(std::countr_zero(change));
                const std::size_t column = 64 * w + bit;
                if (in_run)
                    runs.push_back({grid.point(j, start), grid.point(j, column - 1)});
                else
                    start = column;
                in_run = !in_run;
                change = (in_run ? ~row[w] : row[w]) & ~((LatticeWord{1} << bit) - 1);
            }
        }
        if (in_run) runs.push_back({grid.point(j, start), grid.point(j, 64 * grid.words - 1)});
    }
    return runs;
}

}  // namespace lamina::delaunay
