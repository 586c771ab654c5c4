#include "geometry/numbered_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"
#include "geometry/numeric_header.hpp"
#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

bool is_whole(double value) { return value == std::floor(value); }

/// Makes blocks that begin at these points. The first one keeps the title.
void set_blocks(CoordinateSection& section, const std::vector<std::size_t>& starts) {
    CoordinateBlock block = section.blocks[0];
    block.after_comment = false;
    section.blocks.clear();
    for (const std::size_t start : starts) {
        block.first = static_cast<std::uint32_t>(start);
        section.blocks.push_back(std::exchange(block, {}));
    }
}

/// Rows that begin with the numbers of a curve and of a point on it.
class NumberedRows {
public:
    explicit NumberedRows(PointSpan rows) : rows_(rows) {}

    /// Looks at the next row, and returns whether it may be one of such a file.
    bool take_next() {
        const RowPoint& row = rows_[at_];
        const double curve = row[0], point = row[1];
        if (!is_whole(curve) || !is_whole(point)) return false;
        if (row.columns == 2) return close(row);
        if (row.columns < 4) return false;
        if (!starts_.empty() && curve == curve_) {
            if (is_closed_ || point != point_ + 1) return false;
        } else {
            if (!starts_.empty() && (curve < curve_ || point != first_point_)) return false;
            if (starts_.empty()) first_point_ = point;
            starts_.push_back(at_);
            is_closed_ = false;
        }
        curve_ = curve;
        point_ = point;
        ++at_;
        return true;
    }

    /// Returns whether the rows say more than that they are counted: there are several curves, or one is closed.
    bool says_more() const { return !closings_.empty() || starts_.size() > 1; }

    /// Makes the curves the blocks of a section of these rows: a row that closes a curve becomes its first point, which
    /// counts as one more. Returns notes.
    std::vector<std::string> divide(CoordinateSection& section) const {
        std::vector<std::string> notes;
        for (const auto& [row, start] : closings_) {
            RowPoint& closing = section.points[row];
            notes.push_back(fmt::format("line {}: '{} 0' closes curve {}", closing.line, closing[0], closing[0]));
            closing = section.points[start];
            closing.at.y = section.points[row - 1].at.y + 1;
        }
        set_blocks(section, starts_);
        return notes;
    }

private:
    PointSpan rows_;
    std::size_t at_ = 0;
    std::vector<std::size_t> starts_;                            ///< of curves
    std::vector<std::pair<std::size_t, std::size_t>> closings_;  ///< rows that close a curve, and its first row
    double curve_ = 0, point_ = 0, first_point_ = 0;             ///< of the last row; of the first one
    bool is_closed_ = false;

    /// Closes the last curve where a row says so.
    bool close(const RowPoint& row) {
        if (starts_.empty() || is_closed_ || row[0] != curve_ || row[1] != 0) return false;
        is_closed_ = true;
        closings_.emplace_back(at_++, starts_.back());
        return true;
    }
};

/// Returns whether a title calls the points below it a line that is no outline.
bool names_auxiliary_line(const std::string& title) {
    constexpr std::array<std::string_view, 5> names = {"camber line", "camberline", "mean line", "mean camber",
                                                       "chord line"};
    const std::string lower = core::lower_case(title);
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) { return lower.starts_with(name); });
}

}  // namespace

std::vector<std::string> divide_counted_curves(CoordinateSection& section) {
    const PointSpan rows = section.points;
    if (rows.empty() || rows[0].columns != 2) return {};
    const double points = rows[0][0], curves = rows[0][1], available = static_cast<double>(rows.size() - 1);
    const bool fits = is_whole(points) && is_whole(curves) && points >= 2 && curves >= 1 &&
                      points * curves == available && points + curves != available;
    if (!fits) return {};
    const PointSpan rest = rows.subspan(1);
    const bool is_apart = have_other_columns(rest, rows[0]) || (curves >= 2 && lies_far_from(rows[0].at, rest));
    if (!is_apart) return {};
    const std::size_t line = rows[0].line;
    section.points.erase(section.points.begin());
    std::vector<std::size_t> starts;
    for (std::size_t at = 0; at < section.points.size(); at += static_cast<std::size_t>(points)) starts.push_back(at);
    set_blocks(section, starts);
    return {fmt::format("line {}: {} curve{} of {} points", line, curves, curves == 1 ? "" : "s", points)};
}

std::vector<std::string> divide_numbered_curves(CoordinateSection& section) {
    constexpr std::size_t min_rows = 3;
    NumberedRows numbered(section.points);
    for (std::size_t i = 0; i < section.points.size(); ++i)
        if (!numbered.take_next()) return {};
    if (section.points.size() < min_rows || !numbered.says_more()) return {};
    return numbered.divide(section);
}

std::vector<std::string> remove_auxiliary_lines(CoordinateSection& section) {
    std::vector<bool> removed;
    std::vector<std::string> notes;
    for (std::size_t i = 0; i < section.blocks.size(); ++i) {
        const PointSpan points = section.block(i);
        removed.push_back(names_auxiliary_line(section.title(i)) && !is_loop(points));
        if (removed.back())
            notes.push_back(fmt::format("lines {} to {}: '{}' left out, since it is no outline", points.front().line,
                                        points.back().line, section.title(i)));
    }
    if (notes.size() == removed.size()) return {};
    section.remove_blocks(removed);
    return notes;
}

}  // namespace lamina::geometry
