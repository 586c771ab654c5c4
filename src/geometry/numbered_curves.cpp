#include "geometry/numbered_curves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/text.hpp"
#include "geometry/join_blocks.hpp"
#include "geometry/numeric_header.hpp"
#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

bool is_whole(double value) { return value == std::floor(value); }

/// Returns the title of a section that is read anew.
std::string title_of(const CoordinateSection& section) { return section.empty() ? std::string() : section[0].title; }

/// Rows that begin with the numbers of a curve and of a point on it.
class NumberedRows {
public:
    /// Takes the next row, and returns whether it may be one of such a file.
    bool take(const RowPoint& row) {
        const double curve = row.values[0], point = row.values[1];
        if (!is_whole(curve) || !is_whole(point)) return false;
        if (row.columns == 2) return close(row);
        if (row.columns < 4) return false;
        if (!curves_.empty() && curve == curve_) {
            if (is_closed_ || point != point_ + 1) return false;
        } else {
            if (!curves_.empty() && (curve < curve_ || point != first_point_)) return false;
            if (curves_.empty()) first_point_ = point;
            curves_.push_back({});
            is_closed_ = false;
        }
        curve_ = curve;
        point_ = point;
        curves_.back().push_back(row);
        return true;
    }

    /// Returns whether the rows say more than that they are counted: there are several curves, or one is closed.
    bool says_more() const { return !notes_.empty() || curves_.size() > 1; }

    std::vector<PointRun>& curves() { return curves_; }
    std::vector<std::string>& notes() { return notes_; }

private:
    std::vector<PointRun> curves_;
    std::vector<std::string> notes_;
    double curve_ = 0, point_ = 0, first_point_ = 0;  ///< of the last row; of the first one
    bool is_closed_ = false;

    /// Closes the last curve by its first point, which counts as one more, where a row says so.
    bool close(const RowPoint& row) {
        if (curves_.empty() || is_closed_ || row.values[0] != curve_ || row.values[1] != 0) return false;
        is_closed_ = true;
        RowPoint closing = curves_.back().front();
        closing.values.set(1, point_ + 1);
        curves_.back().push_back(closing);
        notes_.push_back(fmt::format("line {}: '{} 0' closes curve {}", row.line, curve_, curve_));
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
    PointRun copies;
    const PointSpan rows = all_points(section, copies);
    if (rows.empty() || rows[0].columns != 2) return {};
    const double points = rows[0].values[0], curves = rows[0].values[1],
                 available = static_cast<double>(rows.size() - 1);
    const bool fits = is_whole(points) && is_whole(curves) && points >= 2 && curves >= 1 &&
                      points * curves == available && points + curves != available;
    if (!fits) return {};
    const PointSpan rest = rows.subspan(1);
    const bool is_apart = have_other_columns(rest, rows[0]) || (curves >= 2 && lies_far_from(rows[0].at, rest));
    if (!is_apart) return {};
    const auto step = static_cast<std::ptrdiff_t>(points);
    const std::size_t line = rows[0].line;
    CoordinateSection divided;
    for (auto at = rest.begin(); at != rest.end(); at += step)
        divided.push_back({{at, at + step}, divided.empty() ? title_of(section) : std::string(), false});
    section = std::move(divided);
    return {fmt::format("line {}: {} curve{} of {} points", line, curves, curves == 1 ? "" : "s", points)};
}

std::vector<std::string> divide_numbered_curves(CoordinateSection& section) {
    constexpr std::size_t min_rows = 3;
    NumberedRows numbered;
    std::size_t rows = 0;
    for (const CoordinateBlock& block : section)
        for (const RowPoint& row : block.points) {
            if (!numbered.take(row)) return {};
            ++rows;
        }
    if (rows < min_rows || !numbered.says_more()) return {};
    std::string title = title_of(section);
    section.clear();
    for (PointRun& curve : numbered.curves()) section.push_back({std::move(curve), std::exchange(title, {}), false});
    return std::move(numbered.notes());
}

std::vector<std::string> remove_auxiliary_lines(CoordinateSection& section) {
    const auto is_auxiliary = [](const CoordinateBlock& block) {
        return names_auxiliary_line(block.title) && !is_loop(block.points);
    };
    std::vector<std::string> notes;
    if (std::all_of(section.begin(), section.end(), is_auxiliary)) return notes;
    for (const CoordinateBlock& block : section)
        if (is_auxiliary(block))
            notes.push_back(fmt::format("lines {} to {}: '{}' left out, since it is no outline",
                                        block.points.front().line, block.points.back().line, block.title));
    std::erase_if(section, is_auxiliary);
    return notes;
}

}  // namespace lamina::geometry
