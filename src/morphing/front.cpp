// Source: G. H. Golub, C. F. Van Loan, Matrix Computations (4th ed., 2013), section 4.1.2. Without roots,
// systems of twice the size have factors of just twice the size.
// Libraries of dense matrices choose the order of sums by the processor, and contract them: their factors have other
// bits on other machines.
#include "morphing/front.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "core/parallel.hpp"

namespace lamina::morphing {

namespace {

/// Products are subtracted from squares of so many rows and columns, which the registers of processors hold.
constexpr std::size_t tile = 4;
/// Columns are factored in groups of so many: a tile's packed rows stay in the nearest cache.
constexpr std::size_t columns_at_once = 48;
/// Where fewer products are to be subtracted, threads cost more than they save.
constexpr std::size_t products_for_threads = 1'000'000;
constexpr std::size_t tiles_of_a_thread = 8;

using Tile = std::array<std::array<double, tile>, tile>;  // by columns

/// Rows of some factored columns: the numbers of a tile's rows in one column stand beside each other.
class PackedRows {
public:
    /// Packs the columns from `begin` to `end`, below them.
    PackedRows(const Panel& panel, std::size_t begin, std::size_t end)
        : columns_(end - begin),
          values_((panel.rows - end + tile - 1) / tile * tile * columns_),
          times_pivots_(values_) {
        for (std::size_t k = 0; k < columns_; ++k) {
            const double* const column = panel.values.data() + (begin + k) * panel.rows;
            const double pivot = column[begin + k];
            for (std::size_t i = end; i < panel.rows; ++i) {
                const std::size_t row = i - end, at = (row / tile * columns_ + k) * tile + row % tile;
                values_[at] = column[i];
                times_pivots_[at] = pivot * column[i];
            }
        }
    }

    std::size_t columns() const { return columns_; }
    const double* rows_of(std::size_t t) const { return values_.data() + t * columns_ * tile; }
    const double* rows_times_pivots_of(std::size_t t) const { return times_pivots_.data() + t * columns_ * tile; }

private:
    std::size_t columns_;
    std::vector<double> values_, times_pivots_;
};

/// Subtracts the products of some rows, as PackedRows has them, with those of others.
void subtract_products(const double* rows, const double* columns, std::size_t n, Tile& numbers) {
    Tile sum = numbers;
    for (std::size_t k = 0; k < n; ++k, rows += tile, columns += tile)
        for (std::size_t j = 0; j < tile; ++j)
            for (std::size_t i = 0; i < tile; ++i) sum[j][i] -= columns[j] * rows[i];
    numbers = sum;
}

/// Subtracts the columns of a group from those after them, and divides them by their pivots, which stay there.
bool factor_columns(const Panel& panel, std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
        double* const column = panel.values.data() + j * panel.rows;
        for (std::size_t k = begin; k < j; ++k) {
            const double* const before = panel.values.data() + k * panel.rows;
            const double factor = before[k] * before[j];
            for (std::size_t i = j; i < panel.rows; ++i) column[i] -= factor * before[i];
        }
        if (!(column[j] > 0)) return false;
        for (std::size_t i = j + 1; i < panel.rows; ++i) column[i] /= column[j];
    }
    return true;
}

/// The matrix of a front: the columns of a panel and, after them, those of what is below it.
class Front {
public:
    Front(const Panel& panel, std::vector<double>& below) : panel_(panel), below_(below) {}

    std::size_t rows() const { return panel_.rows; }

    /// Returns a number on or below the diagonal. Those of the rows after it stand behind it.
    double* at(std::size_t row, std::size_t column) const {
        const std::size_t columns = panel_.columns;
        return column < columns ? panel_.values.data() + column * panel_.rows + row
                                : below_.data() + (column - columns) * (panel_.rows - columns) + (row - columns);
    }

private:
    Panel panel_;
    std::vector<double>& below_;
};

/// Subtracts the products of rows from the tile on their crossing. On the diagonal and at the end it is a part of one.
void subtract_tile(const Front& front, const PackedRows& packed, std::size_t first, std::size_t i, std::size_t j) {
    const std::size_t row = first + i * tile, column = first + j * tile;
    const std::size_t rows = std::min(tile, front.rows() - row), columns = std::min(tile, front.rows() - column);
    const auto first_row = [&](std::size_t c) { return i == j ? c : 0; };
    Tile numbers{};
    for (std::size_t c = 0; c < columns; ++c)
        std::copy_n(front.at(row + first_row(c), column + c), rows - first_row(c), &numbers[c][first_row(c)]);
    subtract_products(packed.rows_of(i), packed.rows_times_pivots_of(j), packed.columns(), numbers);
    for (std::size_t c = 0; c < columns; ++c)
        std::copy_n(&numbers[c][first_row(c)], rows - first_row(c), front.at(row + first_row(c), column + c));
}

/// Subtracts the products of a group of factored columns from all numbers after them.
void subtract_columns(const Panel& panel, const Front& front, std::size_t begin, std::size_t end) {
    if (end == front.rows()) return;
    const PackedRows packed(panel, begin, end);
    const std::size_t left = front.rows() - end, tiles = (left + tile - 1) / tile;
    const bool alone = left * left * (end - begin) / 2 < products_for_threads;
    core::parallel_for(tiles, alone ? tiles : tiles_of_a_thread, [&](std::size_t first, std::size_t last) {
        for (std::size_t j = first; j < last; ++j)
            for (std::size_t i = j; i < tiles; ++i) subtract_tile(front, packed, end, i, j);
    });
}

}  // namespace

bool factor_panel(Panel panel, std::vector<double>& below) {
    assert(panel.values.size() == panel.rows * panel.columns);
    assert(below.size() == (panel.rows - panel.columns) * (panel.rows - panel.columns));
    const Front front(panel, below);
    for (std::size_t begin = 0; begin < panel.columns; begin += columns_at_once) {
        const std::size_t end = std::min(begin + columns_at_once, panel.columns);
        if (!factor_columns(panel, begin, end)) return false;
        subtract_columns(panel, front, begin, end);
    }
    return true;
}

}  // namespace lamina::morphing
