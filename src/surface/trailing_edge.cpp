#include "surface/features.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/reproducible_math.hpp"
#include "surface/corners.hpp"

namespace lamina::surface {

namespace {

Box box_of(std::span<const Point> points) {
    Box box;
    for (const Point p : points) box.include(p);
    return box;
}

/// Returns the rearmost sharp corner behind the middle of the element that is none of the base's; else the middle of
/// the base; else the rearmost vertex (of equal ones the lowest).
Point trailing_edge_of(std::span<const Point> points, std::span<const double> turnings,
                       const std::optional<Base>& base) {
    const double middle_x = box_of(points).center().x;
    std::optional<Point> corner;
    Point rearmost = points[0];
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Point p = points[i];
        if (p.x > rearmost.x || (p.x == rearmost.x && p.y < rearmost.y)) rearmost = p;
        const bool sharp = core::degrees(turnings[i]) > sharp_corner_deg && p.x > middle_x;
        if (sharp && !(base && (i == base->first || i == base->last)) && (!corner || p.x > corner->x)) corner = p;
    }
    if (!base) return corner.value_or(rearmost);
    const Point middle = midpoint(points[base->first], points[base->last]);
    return corner && corner->x > middle.x ? *corner : middle;
}

}  // namespace

std::optional<Base> find_base(std::span<const Point> points, std::span<const double> turnings) {
    const Box box = box_of(points);
    std::optional<Base> base;
    double rearmost = box.center().x;
    const std::size_t n = points.size();
    const auto is_corner = [&](std::size_t i) {
        const double turning = core::degrees(turnings[i]);
        return turning > 45 && turning < 135;
    };
    for (std::size_t i = 0; i < n; ++i) {
        if (!is_corner(i)) continue;
        std::size_t j = (i + 1) % n;
        while (j != i && std::abs(core::degrees(turnings[j])) < 1) j = (j + 1) % n;
        if (j == i || !is_corner(j)) continue;
        const bool is_short = distance(points[i], points[j]) < 0.5 * std::max(box.width(), box.height());
        const double x = midpoint(points[i], points[j]).x;
        if (!is_short || x <= rearmost) continue;
        base = {i, j};
        rearmost = x;
    }
    return base;
}

void find_trailing_edge(std::span<const Point> outline, OutlineFeatures& features) {
    const std::vector<double> angles = turnings(outline);
    features.base = find_base(outline, angles);
    features.trailing_edge = trailing_edge_of(outline, angles, features.base);
}

}  // namespace lamina::surface
