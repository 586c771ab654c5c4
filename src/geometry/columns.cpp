#include "geometry/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "geometry/join_blocks.hpp"
#include "geometry/surface_table.hpp"

namespace lamina::geometry {

namespace {

using Rows = std::vector<RowPoint*>;
using Columns = std::vector<std::size_t>;  ///< indices of columns

constexpr std::array<std::string_view, max_columns> ordinals = {"first", "second", "third",   "fourth",
                                                                "fifth", "sixth",  "seventh", "eighth"};

/// Returns whether a row may hold the counts of a Lednicer file.
bool may_be_counts(const RowPoint& row) {
    const double a = row.values[0], b = row.values[1];
    return row.columns == 2 && a >= 2 && b >= 2 && a == std::floor(a) && b == std::floor(b);
}

/// Returns the rows that hold coordinates. Throws InputError where they differ in their number of columns.
Rows coordinate_rows(CoordinateSection& section, const std::string& file) {
    std::size_t most = 0;
    for (const CoordinateBlock& block : section)
        for (const RowPoint& row : block.points) most = std::max(most, row.columns);
    Rows rows;
    for (CoordinateBlock& block : section)
        for (RowPoint& row : block.points)
            if (most == 2 || !may_be_counts(row)) rows.push_back(&row);
    for (const RowPoint* row : rows)
        if (row->columns != rows[0]->columns)
            throw InputError({file, row->line, row->at}, fmt::format("{} numbers where line {} has {}", row->columns,
                                                                     rows[0]->line, rows[0]->columns));
    return rows;
}

// ---- evidence ------------------------------------------------------------------------------------------------------

/// Returns the name of a column without its unit: "x" of "x [m]", "x/c" and "points:0".
std::string plain_name(const std::string& name) {
    static constexpr std::array<std::array<std::string_view, 2>, 3> paraview = {
        {{"points:0", "x"}, {"points:1", "y"}, {"points:2", "z"}}};
    for (const auto& [written, meant] : paraview)
        if (name == written) return std::string(meant);
    std::string plain = name.substr(0, name.find_first_of("[("));
    if (plain.ends_with("/c")) plain.resize(plain.size() - 2);
    return plain;
}

/// Returns the only column of this name, if there is one.
std::optional<std::size_t> column_named(const std::vector<std::string>& names, std::string_view wanted) {
    const auto is_wanted = [&](const std::string& name) { return plain_name(name) == wanted; };
    if (std::count_if(names.begin(), names.end(), is_wanted) != 1) return std::nullopt;
    return static_cast<std::size_t>(std::find_if(names.begin(), names.end(), is_wanted) - names.begin());
}

/// Returns the columns that the header names x and y.
std::optional<Columns> named_columns(const std::vector<std::string>& names, std::size_t columns) {
    if (names.size() != columns) return std::nullopt;
    const auto x = column_named(names, "x"), y = column_named(names, "y"), z = column_named(names, "z");
    if (!x || (!y && !z)) return std::nullopt;
    return Columns{*x, y ? *y : *z};
}

/// Returns whether a column counts the rows: whole numbers in steps of one, which may start again after some rows.
bool counts_rows(const Rows& rows, std::size_t column) {
    constexpr std::size_t min_rows = 3;  // of one count
    const double first = rows[0]->values[column];
    if (first != std::floor(first)) return false;
    std::size_t counted = 1;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double value = rows[i]->values[column];
        const bool goes_on = value == rows[i - 1]->values[column] + 1, starts_again = value == first;
        if (!goes_on && (!starts_again || counted < min_rows)) return false;
        counted = goes_on ? counted + 1 : 1;
    }
    return counted >= min_rows;
}

double span(const Rows& rows, std::size_t column) {
    double low = rows[0]->values[column], high = low;
    for (const RowPoint* row : rows) {
        low = std::min(low, row->values[column]);
        high = std::max(high, row->values[column]);
    }
    return high - low;
}

/// Returns whether a column has the same value in all rows, but for rounding.
bool is_constant(const Rows& rows, std::size_t column, double largest_span) {
    constexpr double tolerance = 1e-9;
    return span(rows, column) <= tolerance * largest_span;
}

/// Returns the rows with three columns alone, as a table has them.
PointRun reduced_to(const Rows& rows, const Columns& columns) {
    PointRun reduced;
    reduced.reserve(rows.size());
    for (const RowPoint* row : rows) {
        RowPoint& point = reduced.emplace_back(*row);
        point.columns = columns.size();
        for (std::size_t c = 0; c < columns.size(); ++c) point.values[c] = row->values[columns[c]];
        point.at = {point.values[0], point.values[1]};
    }
    return reduced;
}

/// Returns whether three columns are a table although the first one counts the rows, as x may in per cent of the chord:
/// the surfaces meet at the nose, which x and y of a point seldom do, and are thickest before the tail.
bool is_table_of_unit_steps(const PointRun& run, const std::string& heading) {
    constexpr double nose_share = 0.01, tail_share = 0.9;  // of the largest thickness
    const std::optional<SurfaceTable> table = read_surface_table(run, heading);
    if (!table) return false;
    const auto thickness = [&](std::size_t i) { return table->upper[i].at.y - table->lower[i].at.y; };
    double largest = 0;
    for (std::size_t i = 0; i < run.size(); ++i) largest = std::max(largest, thickness(i));
    return thickness(0) <= nose_share * largest && thickness(run.size() - 1) <= tail_share * largest;
}

// ---- decision ------------------------------------------------------------------------------------------------------

class ColumnChooser {
public:
    ColumnChooser(const Rows& rows, const CoordinateDocument& document) : rows_(rows), document_(document) {
        for (std::size_t c = 0; c < rows[0]->columns; ++c) left_.push_back(c);
    }

    /// Returns the columns that are left: x and y, or the three columns of a table.
    Columns choose() {
        if (const auto named = named_columns(document_.column_names, left_.size())) {
            if (*named != Columns{0, 1} || left_.size() > 2)
                notes_.push_back(
                    fmt::format("line {}: x and y read from the {} and {} column, as the header names them",
                                rows_[0]->line, ordinals[(*named)[0]], ordinals[(*named)[1]]));
            return *named;
        }
        leave_out_counter();
        if (!is_table()) leave_out_constants();
        return left_;
    }

    std::vector<std::string> notes() { return std::move(notes_); }

private:
    const Rows& rows_;
    const CoordinateDocument& document_;
    Columns left_;
    std::vector<std::string> notes_;

    void leave_out(std::size_t column, const std::string& reason) {
        std::erase(left_, column);
        notes_.push_back(fmt::format("line {}: {} column ignored, {}", rows_[0]->line, ordinals[column], reason));
    }

    void leave_out_counter() {
        if (left_.size() < 3) return;
        const auto counter =
            std::find_if(left_.begin(), left_.end(), [&](std::size_t c) { return counts_rows(rows_, c); });
        if (counter == left_.end()) return;
        if (left_.size() == 3 && counter == left_.begin() &&
            is_table_of_unit_steps(reduced_to(rows_, left_), document_.heading))
            return;
        leave_out(*counter, "it counts the points");
    }

    double largest_span() const {
        double largest = 0;
        for (const std::size_t c : left_) largest = std::max(largest, span(rows_, c));
        return largest;
    }

    /// Returns whether the columns are a table of both surfaces. A constant ordinate is the flat lower surface of one
    /// only where the heading says so; else it is z.
    bool is_table() const {
        if (left_.size() != 3) return false;
        const double largest = largest_span();
        const bool has_constant =
            std::any_of(left_.begin(), left_.end(), [&](std::size_t c) { return is_constant(rows_, c, largest); });
        const bool named = document_.heading.find("upper") != std::string::npos &&
                           document_.heading.find("lower") != std::string::npos;
        return (!has_constant || named) && read_surface_table(reduced_to(rows_, left_), document_.heading).has_value();
    }

    void leave_out_constants() {
        const double largest = largest_span();
        const Columns candidates(left_.rbegin(), left_.rend());
        for (const std::size_t c : candidates)
            if (left_.size() > 2 && is_constant(rows_, c, largest))
                leave_out(c, fmt::format("{} throughout", rows_[0]->values[c]));
    }
};

[[noreturn]] void refuse_columns(const Rows& rows, const Columns& left, const std::string& file) {
    const auto differs = [&](const RowPoint* row) { return row->values[left[2]] != rows[0]->values[left[2]]; };
    const RowPoint* row = *std::find_if(rows.begin(), rows.end(), differs);
    const std::string reason = left.size() == 3 ? " (and no table of x, upper and lower ordinates: x falls, or the "
                                                  "surfaces cross)"
                                                : "";
    throw InputError({file, row->line, row->at},
                     fmt::format("{} columns that vary, where x and y are expected{}; keep two, or name x and y in a "
                                 "header line",
                                 left.size() == 3 ? "three" : std::to_string(left.size()), reason));
}

void check_range(const CoordinateSection& section, const std::string& file) {
    for (const CoordinateBlock& block : section)
        for (const RowPoint& p : block.points)
            if (!in_exact_range(p.at))
                throw InputError({file, p.line, p.at},
                                 fmt::format("coordinates must be 0 or of a magnitude from {} to {}",
                                             min_exact_coordinate, max_exact_coordinate));
}

}  // namespace

std::vector<std::string> choose_columns(CoordinateSection& section, const CoordinateDocument& document,
                                        const std::string& file) {
    const Rows rows = coordinate_rows(section, file);
    if (rows.empty()) return {};
    ColumnChooser chooser(rows, document);
    const Columns columns = chooser.choose();
    PointRun chosen = reduced_to(rows, columns);
    const bool is_table = columns.size() == 3 && rows.size() == all_points(section).size() &&
                          read_surface_table(chosen, document.heading);
    if (columns.size() > 2 && !is_table) refuse_columns(rows, columns, file);
    for (std::size_t i = 0; i < rows.size(); ++i) *rows[i] = chosen[i];
    check_range(section, file);
    return chooser.notes();
}

}  // namespace lamina::geometry
