#include "geometry/surface_table.hpp"

#include <algorithm>
#include <cmath>

namespace lamina::geometry {

namespace {

/// Returns whether a run has three columns, the first of which rises.
bool has_rising_x(const PointRun& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].columns != 3) return false;
        if (i > 0 && !(points[i].at.x > points[i - 1].at.x)) return false;
    }
    return true;
}

bool names_lower_first(const std::string& heading) {
    const std::size_t upper = heading.find("upper"), lower = heading.find("lower");
    return upper != std::string::npos && lower != std::string::npos && lower < upper;
}

}  // namespace

std::optional<SurfaceTable> read_surface_table(const PointRun& points, const std::string& heading) {
    if (points.size() < 5 || !has_rising_x(points)) return std::nullopt;
    const double chord = points.back().at.x - points.front().at.x;
    const bool lower_first = names_lower_first(heading);
    const auto upper_at = [&](const RowPoint& p) { return lower_first ? p.values[2] : p.values[1]; };
    const auto lower_at = [&](const RowPoint& p) { return lower_first ? p.at.y : p.values[2]; };
    // Tells whether the surfaces meet at the ends alone; `sign` is -1 if lower ordinates count downward, else 1.
    const auto are_apart = [&](double sign) {
        const auto thickness = [&](const RowPoint& p) { return upper_at(p) - sign * lower_at(p); };
        return std::abs(thickness(points.front())) <= 0.01 * chord &&
               std::abs(thickness(points.back())) <= 0.2 * chord &&
               std::all_of(points.begin() + 1, points.end() - 1, [&](const RowPoint& p) { return thickness(p) > 0; });
    };
    const bool downward = !are_apart(1);
    if (downward && !are_apart(-1)) return std::nullopt;
    SurfaceTable table{points, points, downward};
    for (std::size_t i = 0; i < points.size(); ++i) {
        table.upper[i].at.y = upper_at(points[i]);
        table.lower[i].at.y = downward ? -lower_at(points[i]) : lower_at(points[i]);
    }
    return table;
}

}  // namespace lamina::geometry
