#include "geometry/trailing_edge.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/angles.hpp"
#include "core/bounding_box.hpp"
#include "core/reproducible_math.hpp"
#include "geometry/sharp_corner.hpp"

namespace lamina::geometry {

namespace {

std::optional<Base> find_base(std::span<const Point> points, std::span<const double> turning) {
    constexpr double min_corner_deg = 45, max_corner_deg = 135;
    constexpr double max_straight_deg = 1;    // of vertices between the two corners
    constexpr double max_length_share = 0.5;  // of the longer side of the box
    const Box box = core::bounding_box(points);
    std::optional<Base> base;
    double rearmost = box.center().x;
    const std::size_t n = points.size();
    const auto is_corner = [&](std::size_t i) {
        const double angle_deg = core::degrees(turning[i]);
        return angle_deg > min_corner_deg && angle_deg < max_corner_deg;
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_corner(i)) continue;
        std::size_t j = (i + 1) % n;
        double length =
            distance(points[i], points[j]);  // of the way: a fine outline turns so little all round its nose
        while (j != i && std::abs(core::degrees(turning[j])) < max_straight_deg) {
            length += distance(points[j], points[(j + 1) % n]);
            j = (j + 1) % n;
        }
        if (j == i || !is_corner(j)) continue;
        const bool is_short = length < max_length_share * core::longer_side(box);
        const double x = midpoint(points[i], points[j]).x;
        if (!is_short || x <= rearmost) continue;
        base = {i, j};
        rearmost = x;
    }
    return base;
}

/// Returns the rearmost sharp corner behind the middle of the element that is none of the base's; else the middle of
/// the base; else the rearmost vertex (of equal ones the lowest).
Point trailing_edge_of(std::span<const Point> points, std::span<const double> turning,
                       const std::optional<Base>& base) {
    const double middle_x = core::bounding_box(points).center().x;
    std::optional<Point> corner;
    Point rearmost = points[0];
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point p = points[i];
        if (p.x > rearmost.x || (p.x == rearmost.x && p.y < rearmost.y)) rearmost = p;
        const bool is_sharp = core::degrees(turning[i]) > sharp_corner_deg && p.x > middle_x;
        const bool is_at_base = base && (i == base->first || i == base->last);
        if (is_sharp && !is_at_base && (!corner || p.x > corner->x)) corner = p;
    }
    if (!base) return corner.value_or(rearmost);
    const Point middle = midpoint(points[base->first], points[base->last]);
    return corner && corner->x > middle.x ? *corner : middle;
}

}  // namespace

std::vector<double> turning_angles(std::span<const Point> outline) {
    const std::size_t n = outline.size();
    std::vector<double> result(n);
    for (std::size_t i = 0; i < n; ++i)
        result[i] = core::angle_between(outline[i] - outline[(i + n - 1) % n], outline[(i + 1) % n] - outline[i]);
    return result;
}

void find_trailing_edge(std::span<const Point> outline, OutlineFeatures& features) {
    const std::vector<double> turning = turning_angles(outline);
    features.base = find_base(outline, turning);
    features.trailing_edge = trailing_edge_of(outline, turning, features.base);
}

TailCorners tail_corners(std::span<const Point> outline, const OutlineFeatures& features) {
    const std::optional<Base>& base = features.base;
    if (base && features.trailing_edge == midpoint(outline[base->first], outline[base->last]))
        return {base->last, base->first};
    const auto corner = std::find(outline.begin(), outline.end(), features.trailing_edge);
    const auto vertex = static_cast<std::size_t>(corner - outline.begin());
    return {vertex, vertex};
}

std::size_t farthest_vertex(std::span<const Point> outline, Point p) {
    const auto nearer = [p](Point a, Point b) { return squared_length(a - p) < squared_length(b - p); };
    return static_cast<std::size_t>(std::max_element(outline.begin(), outline.end(), nearer) - outline.begin());
}

}  // namespace lamina::geometry
