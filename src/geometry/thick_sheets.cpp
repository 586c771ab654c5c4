// Sheets for the panel method, which needs bodies with an inside.
#include <algorithm>
#include <cmath>
#include <utility>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/segments.hpp"
#include "geometry/sheet_curve.hpp"
#include "geometry/sheets.hpp"
#include "geometry/trailing_edge.hpp"

namespace lamina::geometry {

namespace {

/// Returns the smallest distance of a curve from other elements.
double room_round(const Geometry& geometry, std::size_t element, const std::vector<Point>& curve) {
    double room = HUGE_VAL;
    const core::BoxTree own = tree_of_curve(curve, false);
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        if (e == element) continue;
        const std::vector<Point>& p = geometry.elements[e].points;
        const core::BoxTree other = tree_of_curve(p, true);
        for (const Point q : p)
            room = own.min_distance(
                q, room, [&](std::size_t k) { return core::distance_to_segment(q, curve[k], curve[k + 1]); });
        for (const Point q : curve)
            room = other.min_distance(
                q, room, [&](std::size_t i) { return core::distance_to_segment(q, p[i], p[(i + 1) % p.size()]); });
    }
    return room;
}

/// Returns a curve with vertices at these shares of its length, and at its own.
std::vector<std::pair<Point, double>> divided_at(const std::vector<Point>& curve, std::vector<double> shares) {
    const double whole = curve_length(curve);
    std::vector<double> begins{0};
    for (std::size_t k = 0; k + 1 < curve.size(); ++k)
        begins.push_back(begins.back() + distance(curve[k], curve[k + 1]) / whole);
    for (std::size_t k = 1; k + 1 < curve.size(); ++k) shares.push_back(begins[k]);
    std::sort(shares.begin(), shares.end());
    std::vector<std::pair<Point, double>> points;
    constexpr double least_step = 1e-5;
    std::size_t k = 0;
    for (const double share : shares) {
        if (!points.empty() && share - points.back().second < least_step) continue;
        while (k + 2 < curve.size() && begins[k + 1] <= share) ++k;
        const double t = std::clamp((share - begins[k]) / (begins[k + 1] - begins[k]), 0.0, 1.0);
        points.emplace_back(curve[k] + t * (curve[k + 1] - curve[k]), share);
    }
    points.back() = {curve.back(), 1};
    return points;
}

/// Returns the outline of a section round a sheet from its nose to its tail, with the thickness of NACA sections but
/// for the curvature behind the nose: sqrt(s) (1 - s).
std::vector<Point> section_round(const std::vector<Point>& curve, double thickness) {
    constexpr std::size_t steps = 48;
    constexpr double most_of_shape = 0.3849;  // of sqrt(s) (1 - s), at s = 1/3
    std::vector<double> shares;
    for (std::size_t i = 0; i <= steps; ++i) {
        const double angle = core::pi * static_cast<double>(i) / static_cast<double>(steps);
        shares.push_back(0.5 * (1 - core::cos_reproducible(angle)));
    }
    const std::vector<std::pair<Point, double>> places = divided_at(curve, std::move(shares));
    std::vector<Point> points(places.size());
    std::transform(places.begin(), places.end(), points.begin(), [](const auto& place) { return place.first; });
    std::vector<Point> below, above;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double s = places[i].second, half = 0.5 * thickness / most_of_shape * std::sqrt(s) * (1 - s);
        const Point left = half * left_of_curve(points, i);
        below.push_back(points[i] - left);
        above.push_back(points[i] + left);
    }
    below.back() = points.back();
    for (std::size_t i = above.size() - 1; i-- > 1;) below.push_back(above[i]);
    return below;
}

/// Leaves the sheets on the wall of an element out.
void leave_sheets_out(Element& element) {
    const std::size_t n = element.points.size();
    std::vector<char> is_left_out(n);
    for (const SheetRange& range : sheet_ranges(element))
        for (std::size_t i = range.first + 1; i <= range.last; ++i) is_left_out[i % n] = 1;
    Element kept = element;
    kept.points.clear();
    kept.lines.clear();
    kept.given_corners.clear();
    kept.features = {};
    for (std::size_t i = 0; i < n; ++i) {
        if (is_left_out[i] != 0) continue;
        const bool is_foot = std::any_of(element.sheets.begin(), element.sheets.end(),
                                         [&](const SheetSides& s) { return s.begin == element.points[i]; });
        if (!is_foot && std::binary_search(element.given_corners.begin(), element.given_corners.end(), i))
            kept.given_corners.push_back(kept.points.size());
        kept.points.push_back(element.points[i]);
        if (i < element.lines.size()) kept.lines.push_back(element.lines[i]);
    }
    kept.sheets.clear();
    kept.parts.clear();
    element = std::move(kept);
}

}  // namespace

Geometry with_thickness(Geometry geometry) {
    constexpr double share_of_length = 0.02, share_of_room = 0.25;
    const Geometry given = geometry;
    for (std::size_t e = 0; e < geometry.elements.size(); ++e) {
        Element& element = geometry.elements[e];
        if (!is_sheet(element)) {
            if (!element.sheets.empty()) leave_sheets_out(element);
            continue;
        }
        const SheetRange range = sheet_ranges(element)[0];
        const auto begin = element.points.begin();
        std::vector<Point> curve(begin + static_cast<std::ptrdiff_t>(range.first),
                                 begin + static_cast<std::ptrdiff_t>(range.tip) + 1);
        OutlineFeatures features;
        find_trailing_edge(element.points, features);
        if (distance(curve.front(), features.trailing_edge) < distance(curve.back(), features.trailing_edge))
            std::reverse(curve.begin(), curve.end());
        const double room = given.elements.size() > 1 ? room_round(given, e, curve) : HUGE_VAL;
        element.points = section_round(curve, std::min(share_of_length * curve_length(curve), share_of_room * room));
        element.lines.clear();
        element.features = {};
        element.given_corners.clear();
        element.sheets.clear();
    }
    return geometry;
}

}  // namespace lamina::geometry
