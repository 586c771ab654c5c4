#include "geometry/half_section.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <lamina/error.hpp>

namespace lamina::geometry {

namespace {

using SourcePoints = std::vector<SourcePoint>;

/// Returns how far a point may stand from the line of symmetry and still be on it, as by rounding.
double tolerance(const SourcePoints& points) {
    constexpr double share = 1e-6;  // of the extent: the last of the six digits that files usually have
    return share * extent(points);
}

/// Returns where the longest edge of a closed outline starts.
std::size_t longest_edge(const SourcePoints& points) {
    std::size_t longest = 0;
    double longest_length = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double length = distance(points[i].at, points[(i + 1) % points.size()].at);
        if (length > longest_length) {
            longest = i;
            longest_length = length;
        }
    }
    return longest;
}

/// Points of a closed outline that follow each other.
struct AxisStretch {
    std::size_t first, count;
};

/// Returns the longest stretch of points that stand at this ordinate.
AxisStretch longest_at(double y, const SourcePoints& points) {
    const std::size_t n = points.size();
    const double near = tolerance(points);
    const auto is_there = [&](std::size_t i) { return std::abs(points[i % n].at.y - y) <= near; };
    AxisStretch longest{0, 0};
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_there(i) || is_there(i + n - 1)) continue;
        std::size_t count = 1;
        while (count < n && is_there(i + count)) ++count;
        if (count > longest.count) longest = {i, count};
    }
    return longest;
}

/// Returns a closed outline as a run without the side that closes it: the points on the lowest or the highest ordinate,
/// if these reach from end to end, else the longest edge.
///
///       _________               _________
///     /           \           /           \       The run begins and ends where that side does, and has none of the
///    |_._._._._._.__>        |              >     points between.
///
SourcePoints opened_at_axis(SourcePoints points) {
    constexpr double min_share = 0.9;  // of the extent
    const auto [lowest, highest] = std::minmax_element(
        points.begin(), points.end(), [](const SourcePoint& a, const SourcePoint& b) { return a.at.y < b.at.y; });
    const std::size_t n = points.size();
    std::size_t begin = longest_edge(points) + 1, count = n;
    for (const double y : {lowest->at.y, highest->at.y}) {
        const AxisStretch axis = longest_at(y, points);
        const std::size_t last = axis.first + axis.count - 1;
        if (axis.count < 3 || axis.count == n) continue;
        if (distance(points[axis.first].at, points[last % n].at) < min_share * extent(points)) continue;
        begin = last;
        count = n + 2 - axis.count;
    }
    std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(begin % n), points.end());
    points.resize(count);
    return points;
}

bool is_on(const SourcePoint& p, double line, const SourcePoints& points) {
    return std::abs(p.at.y - line) <= tolerance(points);
}

}  // namespace

std::optional<double> symmetry_line(const SourcePoints& points) {
    if (points.size() < 3) return std::nullopt;
    const double first = points.front().at.y, last = points.back().at.y, near = tolerance(points);
    if (std::abs(first - last) > near && std::abs(first) > near && std::abs(last) > near) return std::nullopt;
    const double line = std::abs(first - last) <= near ? first : 0;
    const auto is_above = [&](const SourcePoint& p) { return p.at.y >= line - near; };
    const auto is_below = [&](const SourcePoint& p) { return p.at.y <= line + near; };
    const bool one_side =
        std::all_of(points.begin(), points.end(), is_above) || std::all_of(points.begin(), points.end(), is_below);
    return one_side ? std::optional(line) : std::nullopt;
}

bool is_closed_half(const SourcePoints& points) {
    constexpr double min_share = 0.9, max_step = 0.05;  // of the extent; longer edges at the nose draw no round one
    constexpr double min_slope = 1.7;                   // the tangent of about 60 degrees
    if (points.size() < 4) return false;
    SourcePoints run = opened_at_axis(points);
    if (run.front().at.x > run.back().at.x) std::reverse(run.begin(), run.end());
    const Point nose = run.front().at, tail = run.back().at, step = run[1].at - nose;
    return tail.x - nose.x >= min_share * extent(run) && std::abs(tail.y - nose.y) <= tolerance(run) &&
           std::abs(step.y) > min_slope * std::abs(step.x) && length(step) <= max_step * extent(run) &&
           symmetry_line(run);
}

SourcePoints mirrored_half(SourcePoints points, const std::string& file) {
    const InputPlace place{file, points.empty() ? 0 : points[0].line, {}};
    if (points.size() > 3 && points.front().at == points.back().at) {
        points.pop_back();
        points = opened_at_axis(std::move(points));
    }
    const std::optional<double> line = symmetry_line(points);
    if (!line)
        throw InputError(place,
                         "no half of a symmetric section, as --mirror-half asks for: its ends must stand on y = 0, or "
                         "both at another y, and all points on one side of that line");
    const SourcePoint &first = points.front(), &last = points.back();
    const bool starts_at_tail = !is_on(first, *line, points) || (is_on(last, *line, points) && first.at.x > last.at.x);
    if (!starts_at_tail) std::reverse(points.begin(), points.end());
    const std::size_t given = points.size();
    const bool sharp_tail = is_on(points.front(), *line, points);
    for (std::size_t i = given - 1; i-- > (sharp_tail ? 1u : 0u);)
        points.push_back({{points[i].at.x, 2 * *line - points[i].at.y}, points[i].line});
    if (sharp_tail) points.push_back(points.front());
    return points;
}

}  // namespace lamina::geometry
