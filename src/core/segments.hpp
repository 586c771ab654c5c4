// Exact questions about segments and wedges that the layer stage asks again and again.
#pragma once

#include <lamina/point.hpp>
#include <lamina/predicates.hpp>

namespace lamina::core {

inline Box bounding_box(Point a, Point b) {
    Box box;
    box.include(a);
    box.include(b);
    return box;
}

/// True if the closed segments a-b and c-d have a point in common. Exact.
inline bool segments_meet(Point a, Point b, Point c, Point d) {
    if (!bounding_box(a, b).overlaps(bounding_box(c, d))) return false;
    const double c_side = orient2d(a, b, c), d_side = orient2d(a, b, d);
    if ((c_side > 0 && d_side > 0) || (c_side < 0 && d_side < 0)) return false;
    const double a_side = orient2d(c, d, a), b_side = orient2d(c, d, b);
    // All four zero: collinear, and then overlapping boxes mean overlapping segments.
    return !((a_side > 0 && b_side > 0) || (a_side < 0 && b_side < 0));
}

/// True if a-b and a-c leave a in the same direction. Exact for the collinearity.
inline bool segments_fold(Point a, Point b, Point c) { return orient2d(a, b, c) == 0 && dot(b - a, c - a) > 0; }

/// True if p lies strictly inside the wedge swept counter-clockwise from apex->from to apex->to. Exact.
inline bool inside_wedge(Point apex, Point from, Point to, Point p) {
    if (orient2d(apex, from, to) > 0) return orient2d(apex, from, p) > 0 && orient2d(apex, p, to) > 0;
    return !(orient2d(apex, to, p) >= 0 && orient2d(apex, p, from) >= 0);
}

/// Returns whether b lies less than 60 degrees counter-clockwise from a. Frozen edges that meet so leave no room for a
/// triangle whose angles obey a bound.
inline bool encloses_sharp_angle(Point a, Point b) {
    const double d = dot(a, b);
    return cross(a, b) > 0 && d > 0 && 4 * d * d > squared_length(a) * squared_length(b);
}

inline double distance_to_segment(Point p, Point a, Point b) {
    const Point along = b - a;
    const double span = squared_length(along);
    double t = span > 0 ? dot(p - a, along) / span : 0.0;
    t = t < 0 ? 0 : t > 1 ? 1 : t;
    return distance(p, a + t * along);
}

}  // namespace lamina::core
