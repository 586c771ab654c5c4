#include "geometry/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <lamina/error.hpp>
#include <lamina/predicates.hpp>

#include "geometry/characters.hpp"
#include "geometry/column_names.hpp"

namespace lamina::geometry {

namespace {

using Rows = std::vector<RowPoint*>;       ///< in a section
using Columns = std::vector<std::size_t>;  ///< indices of columns

constexpr std::array<std::string_view, max_columns> ordinals = {"first", "second", "third",   "fourth",
                                                                "fifth", "sixth",  "seventh", "eighth"};

/// Returns whether a row may hold the counts of a Lednicer file.
bool may_be_counts(const RowPoint& row) {
    const double a = row[0], b = row[1];
    return row.columns == 2 && a >= 2 && b >= 2 && a == std::floor(a) && b == std::floor(b);
}

/// Returns whether the header names the coordinates of both surfaces, of which one may end before the other.
bool names_both_surfaces(const CoordinateDocument& document) {
    const std::vector<ColumnRole> roles = column_roles(document.column_names);
    return column_with(roles, ColumnRole::upper_x) && column_with(roles, ColumnRole::lower_x);
}

/// Returns the rows that hold coordinates. Throws InputError where they differ in their number of columns.
Rows coordinate_rows(CoordinateSection& section, const CoordinateDocument& document, const std::string& file) {
    std::uint16_t most = 0;
    for (const RowPoint& row : section.points) most = std::max(most, row.columns);
    const bool may_be_short = most > 2 && names_both_surfaces(document);
    Rows rows;
    rows.reserve(section.points.size());
    for (RowPoint& row : section.points)
        if (most == 2 || may_be_short || !may_be_counts(row)) rows.push_back(&row);
    for (const RowPoint* row : rows)
        if (row->columns != rows[0]->columns && !(may_be_short && row->columns == 2))
            throw InputError({file, row->line, row->at}, fmt::format("{} numbers where line {} has {}", row->columns,
                                                                     rows[0]->line, rows[0]->columns));
    return rows;
}

// ---- evidence ------------------------------------------------------------------------------------------------------

/// Returns whether a column counts the rows: whole numbers in steps of one, which may start again after some rows.
bool counts_rows(const Rows& rows, std::size_t column) {
    constexpr std::size_t min_rows = 3;  // of one count
    const double first = (*rows[0])[column];
    if (first != std::floor(first)) return false;
    std::size_t counted = 1;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const double value = (*rows[i])[column];
        const bool goes_on = value == (*rows[i - 1])[column] + 1, starts_again = value == first;
        if (!goes_on && (!starts_again || counted < min_rows)) return false;
        counted = goes_on ? counted + 1 : 1;
    }
    return counted >= min_rows;
}

/// Returns whether a column of whole numbers changes only where a column that counts rows starts again.
bool numbers_curves(const Rows& rows, std::size_t column, std::size_t counter) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const RowPoint& row = *rows[i];
        if (row[column] != std::floor(row[column])) return false;
        if (i > 0 && row[counter] == (*rows[i - 1])[counter] + 1 && row[column] != (*rows[i - 1])[column]) return false;
    }
    return true;
}

double span(const Rows& rows, std::size_t column) {
    double low = (*rows[0])[column], high = low;
    for (const RowPoint* row : rows) {
        low = std::min(low, (*row)[column]);
        high = std::max(high, (*row)[column]);
    }
    return high - low;
}

/// Returns whether a column has the same value in all rows, but for rounding.
bool is_constant(const Rows& rows, std::size_t column, double largest_span) {
    constexpr double tolerance = 1e-9;
    return span(rows, column) <= tolerance * largest_span;
}

/// Returns copies of some rows.
PointRun copies_of(const Rows& rows) {
    PointRun run;
    run.reserve(rows.size());
    for (const RowPoint* row : rows) run.push_back(*row);
    return run;
}

/// Returns whether three columns are a table although the first one counts the rows, as x may in per cent of the chord:
/// the surfaces meet at the nose, which x and y of a point seldom do, and are thickest before the tail.
bool is_table_of_unit_steps(const PointRun& run, const std::array<std::size_t, 3>& columns,
                            const std::string& heading) {
    constexpr double nose_share = 0.01, tail_share = 0.9;  // of the largest thickness
    const std::optional<SurfaceTable> table = read_surface_table(run, columns, heading);
    if (!table) return false;
    const auto thickness = [&](std::size_t i) { return table->upper[i].at.y - table->lower[i].at.y; };
    double largest = 0;
    for (std::size_t i = 0; i < run.size(); ++i) largest = std::max(largest, thickness(i));
    return thickness(0) <= nose_share * largest && thickness(run.size() - 1) <= tail_share * largest;
}

// ---- decision ------------------------------------------------------------------------------------------------------

/// Returns whether the line of names above the coordinates can only be a header: one name for each column, and either x
/// is among them, or both thickness and camber, or all of them are divided by separators, as those of the numbers are.
bool is_header(const CoordinateDocument& document, const std::vector<ColumnRole>& roles, std::size_t columns) {
    const std::vector<std::string>& names = document.column_names;
    const bool is_words = std::all_of(names.begin(), names.end(), [](const std::string& name) {
        return !name.empty() && (is_letter(name[0]) || static_cast<unsigned char>(name[0]) >= 0x80);
    });
    if (names.size() != columns || !is_words) return false;
    const auto has = [&](ColumnRole role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
    if (columns == 2) return roles[0] == ColumnRole::x;  // a title of two words may end with x
    const bool names_thickness = has(ColumnRole::thickness) || has(ColumnRole::half_thickness);
    return has(ColumnRole::x) || has(ColumnRole::upper_x) || (names_thickness && has(ColumnRole::camber)) ||
           (document.names_have_separators && document.csv);
}

class ColumnChooser {
public:
    ColumnChooser(const Rows& rows, const CoordinateDocument& document, const std::string& file)
        : rows_(rows), document_(document), file_(file) {
        for (std::size_t c = 0; c < rows[0]->columns; ++c) left_.push_back(c);
        if (document.column_names.size() == left_.size()) roles_ = column_roles(document.column_names);
    }

    /// Decides which columns are read: two, or those of a table. Throws InputError where more are left. `is_complete`
    /// says whether no row beside them may hold counts, so that they may be a table.
    void choose(bool is_complete) {
        if (choose_by_names() || read_table_by_names()) return;
        leave_out_counter();
        if (is_complete && read_table_by_evidence()) return;
        leave_out_constants();
        require_known_names();
        if (left_.size() > 2) refuse_columns();
    }

    const Columns& left() const { return left_; }

    ColumnReading take() { return {std::move(notes_), std::move(table_)}; }

private:
    const Rows& rows_;
    const CoordinateDocument& document_;
    const std::string& file_;
    Columns left_;
    std::vector<ColumnRole> roles_;  ///< one for each column, or none where the file has no header
    std::vector<std::string> notes_;
    std::optional<SurfaceTable> table_;

    /// Leaves the columns that the header names x and y. Where it names z, too, x or y may be the constant one.
    bool choose_by_names() {
        std::optional<std::size_t> x = column_with(roles_, ColumnRole::x), y = column_with(roles_, ColumnRole::y);
        const auto z = column_with(roles_, ColumnRole::z);
        if (!x || (!y && !z)) return false;
        if (y && z) {
            const double largest = std::max({span(rows_, *x), span(rows_, *y), span(rows_, *z)});
            if (is_constant(rows_, *y, largest)) y = z;
            if (is_constant(rows_, *x, largest)) x = std::exchange(y, z);
        }
        const Columns named{*x, y ? *y : *z};
        if (named != Columns{0, 1} || left_.size() > 2)
            notes_.push_back(fmt::format("line {}: x and y read from the {} and {} column, as the header names them",
                                         rows_[0]->line, ordinals[named[0]], ordinals[named[1]]));
        left_ = named;
        return true;
    }

    bool read_table_by_names() {
        if (!roles_.empty()) table_ = read_named_table(copies_of(rows_), roles_, file_);
        const bool has_thickness =
            column_with(roles_, ColumnRole::thickness) || column_with(roles_, ColumnRole::half_thickness);
        // The camber that belongs to a thickness may have a name that is not known.
        if (table_ && has_thickness && !column_with(roles_, ColumnRole::camber)) require_known_names();
        return table_.has_value();
    }

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
            is_table_of_unit_steps(copies_of(rows_), {left_[0], left_[1], left_[2]}, document_.heading))
            return;
        const std::size_t number = *counter;
        if (number > 0 && left_.size() > 3 && numbers_curves(rows_, number - 1, number))
            leave_out(number - 1, "it numbers the curves");
        leave_out(number, "it counts the points");
    }

    double largest_span() const {
        double largest = 0;
        for (const std::size_t c : left_) largest = std::max(largest, span(rows_, c));
        return largest;
    }

    /// Reads the columns as a table of both surfaces where their numbers show that they are one. A constant ordinate is
    /// the flat lower surface of one only where the heading says so; else it is z.
    bool read_table_by_evidence() {
        const double largest = largest_span();
        const bool has_constant =
            std::any_of(left_.begin(), left_.end(), [&](std::size_t c) { return is_constant(rows_, c, largest); });
        const bool named = document_.heading.find("upper") != std::string::npos &&
                           document_.heading.find("lower") != std::string::npos;
        if (left_.size() == 3 && (!has_constant || named))
            table_ = read_surface_table(copies_of(rows_), {left_[0], left_[1], left_[2]}, document_.heading);
        else if (left_.size() == 4 && !has_constant)
            table_ = read_paired_table(copies_of(rows_), {left_[0], left_[1], left_[2], left_[3]});
        if (table_ && !named) require_known_names();
        return table_.has_value();
    }

    void leave_out_constants() {
        const double largest = largest_span();
        const Columns candidates(left_.rbegin(), left_.rend());
        for (const std::size_t c : candidates)
            if (left_.size() > 2 && is_constant(rows_, c, largest))
                leave_out(c, fmt::format("{} throughout", (*rows_[0])[c]));
    }

    /// Throws InputError where a header names columns that are left and its names do not say how to read them.
    void require_known_names() const {
        if (!is_header(document_, roles_, rows_[0]->columns)) return;
        std::vector<std::string> unknown;
        for (const std::size_t c : left_)
            if (roles_[c] == ColumnRole::unknown) unknown.push_back("'" + document_.column_names[c] + "'");
        if (unknown.empty()) return;
        throw InputError({file_, document_.names_line, {}},
                         fmt::format("the header names {} column{} {}, whose meaning is unknown; names that are known: "
                                     "x with y; x with upper and lower; xu, yu, xl, yl; x with thickness and camber",
                                     unknown.size() == 1 ? "a" : std::to_string(unknown.size()),
                                     unknown.size() == 1 ? "" : "s", fmt::join(unknown, ", ")));
    }

    [[noreturn]] void refuse_columns() const {
        const auto differs = [&](const RowPoint* row) { return (*row)[left_[2]] != (*rows_[0])[left_[2]]; };
        const RowPoint* row = *std::find_if(rows_.begin(), rows_.end(), differs);
        const std::string reason = left_.size() == 3
                                       ? " (and no table of x, upper and lower ordinates: x falls, or the "
                                         "surfaces cross)"
                                       : "";
        throw InputError({file_, row->line, row->at},
                         fmt::format("{} columns that vary, where x and y are expected{}; keep two, or name x and y in "
                                     "a header line",
                                     left_.size() == 3 ? "three" : std::to_string(left_.size()), reason));
    }
};

void check_range(const PointRun& points, const std::string& file) {
    for (const RowPoint& p : points)
        if (!in_exact_range(p.at))
            throw InputError({file, p.line, p.at}, fmt::format("coordinates must be 0 or of a magnitude from {} to {}",
                                                               min_exact_coordinate, max_exact_coordinate));
}

}  // namespace

ColumnReading choose_columns(CoordinateSection& section, const CoordinateDocument& document, const std::string& file) {
    const Rows rows = coordinate_rows(section, document, file);
    if (rows.empty()) return {};
    ColumnChooser chooser(rows, document, file);
    chooser.choose(rows.size() == section.points.size());
    for (RowPoint* row : rows) {
        row->at = {(*row)[chooser.left()[0]], (*row)[chooser.left()[1]]};
        row->columns = 2;
    }
    ColumnReading reading = chooser.take();
    if (reading.table) {
        check_range(reading.table->upper, file);
        check_range(reading.table->lower, file);
    } else {
        check_range(section.points, file);
    }
    return reading;
}

}  // namespace lamina::geometry
