// The measures of a triangle that refinement and smoothing decide by.
#pragma once

#include <array>
#include <span>

#include <lamina/point.hpp>

#include "delaunay/triangulate/triangles.hpp"

namespace lamina::delaunay {

/// The measures of a triangle that the decisions hang on.
struct TriangleShape {
    std::array<double, 3> squared;  ///< squared length of edge e
    double area2;                   ///< twice the area

    /// Returns the shortest edge.
    unsigned shortest() const {
        const unsigned m = squared[1] < squared[0] ? 1 : 0;
        return squared[2] < squared[m] ? 2 : m;
    }
    /// Returns the shortest edge or, of edges that are equally long but for rounding, the first.
    unsigned base() const {
        constexpr double clearly_shorter = 1 - 1e-6;
        const unsigned m = squared[1] < clearly_shorter * squared[0] ? 1 : 0;
        return squared[2] < clearly_shorter * squared[m] ? 2 : m;
    }
    /// Returns the longest edge.
    unsigned longest() const {
        const unsigned m = squared[1] > squared[0] ? 1 : 0;
        return squared[2] > squared[m] ? 2 : m;
    }
    double squared_sum() const { return squared[0] + squared[1] + squared[2]; }
};

inline TriangleShape shape_of(std::span<const Point> points, const Tri& t) {
    const Point a = points[t.v[0]], b = points[t.v[1]], c = points[t.v[2]];
    return {{squared_length(c - b), squared_length(a - c), squared_length(b - a)}, cross(b - a, c - a)};
}

/// Returns whether a triangle's smallest angle is below a bound, given the squared sine of the bound, the squared edges
/// and twice the area: sin^2 of the smallest angle is (2 area)^2 / (product of the two longer squared edges).
inline bool is_angle_below(double squared_sine, double ab, double bc, double ca, double shortest, double area2) {
    return area2 * area2 * shortest < squared_sine * (ab * bc * ca);
}

/// Returns the centre of the circle through a, b and c, rounded.
inline Point circumcentre(Point a, Point b, Point c) {
    const Point ab = b - a, ac = c - a;
    const double twice = 2 * cross(ab, ac), bb = squared_length(ab), cc = squared_length(ac);
    return a + Point{(ac.y * bb - ab.y * cc) / twice, (ab.x * cc - ac.x * bb) / twice};
}

}  // namespace lamina::delaunay
