#include "geometry/numeric_header.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/point_runs.hpp"

namespace lamina::geometry {

namespace {

/// Returns how far a point lies outside of a box, along x or y; negative inside it.
double distance_outside(Point p, const Box& box) {
    return std::max({box.lower.x - p.x, p.x - box.upper.x, box.lower.y - p.y, p.y - box.upper.y});
}

Box box_of(PointSpan points) {
    Box box;
    for (const RowPoint& p : points) box.include(p.at);
    return box;
}

bool is_count(double value) { return value >= 2 && value <= 1e8 && value == std::floor(value); }

}  // namespace

bool have_other_columns(PointSpan run, const RowPoint& before) {
    return std::all_of(run.begin(), run.end(), [&](const RowPoint& p) { return p.columns == run[0].columns; }) &&
           run[0].columns != before.columns;
}

bool lies_far_from(Point p, PointSpan points) { return distance_outside(p, box_of(points)) > extent(points); }

std::optional<SurfaceCounts> read_counts(PointSpan points, const std::string& file) {
    const Point p = points[0].at;
    if (!is_count(p.x) || !is_count(p.y)) return std::nullopt;
    const std::size_t available = points.size() - 1;
    const SurfaceCounts counts{static_cast<std::size_t>(p.x), static_cast<std::size_t>(p.y)};
    const std::size_t total = counts.total();
    const PointSpan rest = points.subspan(1, std::min(total, available));
    const Box box = box_of(rest);
    if (rest.empty() || box.contains(p)) return std::nullopt;
    const double outside = distance_outside(p, box);
    if (total == available || (total < available && outside > extent(rest))) return counts;
    if (total > available && outside > 2 * extent(rest))
        throw InputError({file, points[0].line, {}},
                         fmt::format("the counts {} + {} announce {} points, but {} follow (put # before the line if "
                                     "it is a title)",
                                     counts.upper, counts.lower, total, available));
    return std::nullopt;
}

std::optional<std::string> why_title(PointSpan points, const CoordinateDocument& document) {
    constexpr std::size_t min_rows = 3;
    if (document.first_row.empty() || points.size() <= min_rows) return std::nullopt;
    const RowPoint& first = points[0];
    const PointSpan rest = points.subspan(1);
    const double a = first[0], b = first[1], available = static_cast<double>(rest.size());
    const bool may_be_counts = first.columns == 2 && is_count(a) && is_count(b);
    const bool is_one_loop = is_loop(rest) && !find_second_surface(rest);
    if (may_be_counts && a + b == available && !(document.has_leading_zeros && is_one_loop)) return std::nullopt;
    if (document.has_leading_zeros) return "one of its numbers starts with 0";
    const bool is_far = distance_outside(first.at, box_of(rest)) > 2 * extent(rest),
               is_apart = is_far || rest.front().at == rest.back().at;
    if (is_apart && (a == available || b == available)) return "it says how many points follow";
    const bool announces_far_more = a + b >= 2 * available;
    if (have_other_columns(rest, first) && (!may_be_counts || announces_far_more))
        return fmt::format("it has {} numbers where the coordinates have {}", first.columns, rest[0].columns);
    // Counts of a cut file may be that wrong, but the two surfaces of a section have about as many points.
    const bool differ_widely = std::max(a, b) > 2 * std::min(a, b);
    if (is_far && may_be_counts && announces_far_more && differ_widely && (is_loop(rest) || find_second_surface(rest)))
        return fmt::format("it lies far from the points, and counts of {} points cannot be meant where {} follow",
                           a + b, available);
    return std::nullopt;
}

}  // namespace lamina::geometry
