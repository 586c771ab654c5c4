// A set of vertices of an equilateral lattice, as rows of bits. Odd rows are shifted by half an edge. Set operations
// work on 64 vertices at a time.
//
//     row j + 1   . 1 1 1 1 .
//     row j       1 1 1 1 1 .
//
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <lamina/ids.hpp>
#include <lamina/point.hpp>

namespace lamina::delaunay {

/// The height of a row of an equilateral lattice over its edge: sqrt(3) / 2.
inline constexpr double lattice_row_height = 0.86602540378443865;

/// 64 bits of a row.
using LatticeWord = std::uint64_t;
/// The number of a row, counted from below.
using LatticeRow = std::int64_t;

/// The vertices of one level's lattice.
struct LatticeGrid {
    double edge = 0;  ///< length of a lattice edge
    Point origin;     ///< the vertex in column 0 of row 0
    Box box;          ///< the part of the plane that the rows cover
    LatticeRow rows = 0;
    std::size_t words = 0;  ///< words of a row
    std::vector<LatticeWord> bits;

    bool is_empty() const { return box.lower.x > box.upper.x; }
    void include(const Box& b) {
        box.include(b.lower);
        box.include(b.upper);
    }
    /// Makes the rows that cover the box, without vertices.
    void allocate() {
        rows = static_cast<LatticeRow>(box.height() / (edge * lattice_row_height)) + 2;
        words = static_cast<std::size_t>(box.width() / edge / 64) + 2;
        bits.assign(static_cast<std::size_t>(rows) * words, 0);
        origin = box.lower;
    }
    /// Returns how far row j is shifted to the right, in edges.
    double shift(LatticeRow j) const { return (j & 1) != 0 ? 0.5 : 0.0; }
    /// Returns the vertex in column i of row j.
    Point point(LatticeRow j, std::size_t i) const {
        return {origin.x + edge * (static_cast<double>(i) + shift(j)),
                origin.y + (edge * lattice_row_height) * static_cast<double>(j)};
    }
    double row_y(LatticeRow j) const { return origin.y + (edge * lattice_row_height) * static_cast<double>(j); }
    /// Returns the rows with y in [low, high], as a half-open range.
    std::pair<LatticeRow, LatticeRow> rows_between(double low, double high) const {
        const double step = edge * lattice_row_height;
        const double first = std::ceil((low - origin.y) / step), last = std::floor((high - origin.y) / step) + 1;
        return {static_cast<LatticeRow>(std::clamp(first, 0.0, static_cast<double>(rows))),
                static_cast<LatticeRow>(std::clamp(last, 0.0, static_cast<double>(rows)))};
    }
    /// Returns the columns of row j with x in [low, high], as a half-open range.
    std::pair<std::size_t, std::size_t> columns_between(LatticeRow j, double low, double high) const {
        const auto count = static_cast<double>(64 * words);
        const double first = std::ceil((low - origin.x) / edge - shift(j));
        const double last = std::floor((high - origin.x) / edge - shift(j)) + 1;
        return {static_cast<std::size_t>(std::clamp(first, 0.0, count)),
                static_cast<std::size_t>(std::clamp(last, 0.0, count))};
    }
    LatticeWord* row(LatticeRow j) { return bits.data() + static_cast<std::size_t>(j) * words; }
    const LatticeWord* row(LatticeRow j) const { return bits.data() + static_cast<std::size_t>(j) * words; }
};

/// Calls f(word, mask) for the words of columns [first, last).
template <class F>
void for_columns(std::size_t first, std::size_t last, F&& f) {
    while (first < last) {
        const std::size_t word = first / 64, from = first % 64;
        const std::size_t to = std::min<std::size_t>(64, from + (last - first));
        const LatticeWord mask =
            (to == 64 ? ~LatticeWord{0} : (LatticeWord{1} << to) - 1) & ~((LatticeWord{1} << from) - 1);
        f(word, mask);
        first += to - from;
    }
}

/// Returns the number of vertices.
std::size_t count_vertices(const LatticeGrid& grid);

/// Removes every vertex that does not lie inside the region on the left of the segments.
void clear_outside(LatticeGrid& grid, std::span<const Point> points, std::span<const Segment> segments);

/// Removes the vertices within `margin` of the straight line a-b, and a few more.
void clear_near(LatticeGrid& grid, Point a, Point b, double margin);

/// Vertices that follow each other in a row, by the first and the last.
struct LatticeRun {
    Point first, last;
};

/// Returns all runs, row by row.
std::vector<LatticeRun> runs_of(const LatticeGrid& grid);

}  // namespace lamina::delaunay
