#include "flow/coves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/angles.hpp"

namespace lamina::flow {

namespace {

/// Coves are deeper than this share of the section's extent, over which directions at corners are taken, too: the
/// longest panel (contour.cpp).
constexpr double least_depth = 0.02;
/// The wall turns away from the flow at the corner of a cove by more than this.
constexpr double min_turning_deg = 30;
/// Layers come back at this share of the cove's wall. Lift of 30P-30N and CRM-HL changes by 0.2 % between 0.8 and 0.95,
/// and more flows are found with the latter.
constexpr double share_at_return = 0.95;
constexpr int parts_of_curve = 16;

/// A side from the nose to the trailing edge, as the last points of an outline.
struct Side {
    const std::vector<Point>& points;
    std::size_t nose;
    double sign;  ///< 1 where its outer side is on the right

    std::size_t end() const { return points.size() - 1; }
    /// Returns the point at a distance along the outline from one of its points, on or back; its end where it is
    /// shorter.
    Point at_distance(std::size_t from, double length, bool on) const {
        for (std::size_t i = from; i != (on ? end() : 0); on ? ++i : --i) {
            const std::size_t next = on ? i + 1 : i - 1;
            const double edge = distance(points[i], points[next]);
            if (edge >= length) return points[i] + length / edge * (points[next] - points[i]);
            length -= edge;
        }
        return points[on ? end() : 0];
    }
};

Side last_side(const std::vector<Point>& points) {
    const Point end = points.back();
    const auto nearer = [&](Point a, Point b) { return squared_length(a - end) < squared_length(b - end); };
    const auto nose = static_cast<std::size_t>(std::max_element(points.begin(), points.end(), nearer) - points.begin());
    double area = 0;  // of the outline, twice
    for (std::size_t i = 0; i + 1 < points.size(); ++i) area += cross(points[i] - end, points[i + 1] - end);
    return {points, nose, area > 0 ? 1.0 : -1.0};
}

/// Returns the length of the wall from a point of a side up to where layers come back if they leave there.
double length_of_cove(const Side& side, std::size_t corner) {
    double whole = 0;
    for (std::size_t i = corner; i < side.end(); ++i) whole += distance(side.points[i], side.points[i + 1]);
    return share_at_return * whole;
}

/// Returns how deep the wall of the cove lies behind the line between its ends; nothing where it crosses the line.
std::optional<double> depth_of_cove(const Side& side, std::size_t corner) {
    const double length = length_of_cove(side, corner);
    const Point from = side.points[corner], along = unit(side.at_distance(corner, length, true) - from);
    double depth = 0, s = 0;
    for (std::size_t i = corner + 1; i < side.end(); ++i) {
        s += distance(side.points[i - 1], side.points[i]);
        if (s >= length) break;
        const double behind = side.sign * cross(along, side.points[i] - from);
        if (behind < 0) return {};
        depth = std::max(depth, behind);
    }
    return depth;
}

/// Returns the corner at which the wall turns away from the flow most of all behind which there is a cove.
std::optional<std::size_t> corner_of_cove(const Side& side, const std::vector<bool>& is_corner, double extent,
                                          double to_next) {
    const std::vector<Point>& p = side.points;
    std::optional<std::size_t> corner;
    double sharpest = core::radians(min_turning_deg);
    for (std::size_t i = side.nose; i < side.end(); ++i) {
        if (!is_corner[i] || length_of_cove(side, i) <= to_next) continue;
        const Point before = side.at_distance(i, least_depth * extent, false),
                    behind = side.at_distance(i, least_depth * extent, true);
        const double turning = side.sign * core::angle_between(p[i] - before, behind - p[i]);
        if (turning <= sharpest || depth_of_cove(side, i).value_or(0) < least_depth * extent) continue;
        corner = i;
        sharpest = turning;
    }
    return corner;
}

}  // namespace

void fair_cove(std::vector<Point>& points, std::vector<bool>& is_corner, double extent, double to_next) {
    const Side side = last_side(points);
    const std::optional<std::size_t> corner = corner_of_cove(side, is_corner, extent, to_next);
    if (!corner) return;
    const double length = length_of_cove(side, *corner), step = least_depth * extent;
    const Point c = points[*corner], r = side.at_distance(*corner, length, true);
    const double third = distance(c, r) / 3;
    const Point leaving = c + third * unit(c - side.at_distance(*corner, step, false)),
                arriving = r - third * unit(side.at_distance(*corner, length + step, true) - r);
    std::vector<Point> faired(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(*corner) + 1);
    for (int k = 1; k <= parts_of_curve; ++k) {
        const double t = static_cast<double>(k) / parts_of_curve, u = 1 - t;
        faired.push_back(u * u * u * c + 3 * u * u * t * leaving + 3 * u * t * t * arriving + t * t * t * r);
    }
    std::vector<bool> corners(is_corner.begin(), is_corner.begin() + static_cast<std::ptrdiff_t>(*corner) + 1);
    corners.resize(faired.size());
    constexpr double same = 1e-6;  // a point that is as near to r is r
    double s = 0;
    for (std::size_t i = *corner + 1; i < points.size(); ++i) {
        s += distance(points[i - 1], points[i]);
        if (s <= length + same * extent) continue;
        faired.push_back(points[i]);
        corners.push_back(is_corner[i]);
    }
    points = std::move(faired);
    is_corner = std::move(corners);
}

}  // namespace lamina::flow
