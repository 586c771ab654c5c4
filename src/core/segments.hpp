// Questions about segments, wedges and corners. Signs are exact (predicates.hpp) where a comment says so.
#pragma once

#include <lamina/point.hpp>
#include <lamina/predicates.hpp>

#include "core/bounding_box.hpp"

namespace lamina::core {

/// Returns whether the closed segments a-b and c-d have a point in common. Exact.
inline bool segments_meet(Point a, Point b, Point c, Point d) {
    if (!bounding_box(a, b).overlaps(bounding_box(c, d))) return false;
    const double c_side = orient2d(a, b, c), d_side = orient2d(a, b, d);
    if ((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0)) return false;
    const double a_side = orient2d(c, d, a), b_side = orient2d(c, d, b);
    // If all four signs are 0, the segments are collinear, and they meet because their boxes overlap.
    return !((a_side > 0 && b_side > 0) || (a_side < 0 && b_side < 0));
}

/// Returns whether the segments a-b and a-c leave a in the same direction. The test of collinearity is exact.
inline bool segments_fold(Point a, Point b, Point c) { return orient2d(a, b, c) == 0 && dot(b - a, c - a) > 0; }

/// Returns whether p lies strictly inside the wedge that is swept counter-clockwise from the ray apex->from to the ray
/// apex->to. Exact.
inline bool inside_wedge(Point apex, Point from, Point to, Point p) {
    if (orient2d(apex, from, to) > 0) return orient2d(apex, from, p) > 0 && orient2d(apex, p, to) > 0;
    // A wedge of 180 degrees or more holds what the closed wedge from `to` to `from` does not.
    return !(orient2d(apex, to, p) >= 0 && orient2d(apex, p, from) >= 0);
}

/// Returns whether the direction b lies less than 60 degrees counter-clockwise from the direction a, by rounded
/// arithmetic. Frozen edges that meet at less leave no room for a triangle whose angles obey a bound.
inline bool encloses_sharp_angle(Point a, Point b) {
    const double d = dot(a, b);
    return cross(a, b) > 0 && d > 0 && 4 * d * d > squared_length(a) * squared_length(b);
}

/// Returns where on the segment a-b its nearest point to p is, rounded: from 0 at a to 1 at b.
inline double share_along(Point p, Point a, Point b) {
    const Point along = b - a;
    const double span = squared_length(along);
    const double t = span > 0 ? dot(p - a, along) / span : 0.0;
    return t < 0 ? 0 : t > 1 ? 1 : t;
}

/// Returns the distance from p to the segment a-b, rounded.
inline double distance_to_segment(Point p, Point a, Point b) { return distance(p, a + share_along(p, a, b) * (b - a)); }

}  // namespace lamina::core
