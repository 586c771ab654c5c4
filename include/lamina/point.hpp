// Points of the plane, vectors between them, and boxes. Lengths in lamina are in units of the input; angles are in
// radians unless a name ends in _deg. Results are rounded: whoever decides by a sign needs predicates.hpp.
//
// Example:
//     Box box;
//     for (const Point p : {Point{0, 0}, Point{4, 2}}) box.include(p);
//     assert(box.width() == 4 && box.contains(box.center()) && distance(box.center(), {2, 2}) == 1);
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

/// Two-dimensional viscous meshes round airfoils, and the Delaunay kernel that makes them.
namespace lamina {

/// A point of the plane, or the vector to it from the origin.
struct Point {
    double x = 0;  ///< abscissa
    double y = 0;  ///< ordinate
    /// Returns whether both coordinates are equal.
    friend constexpr bool operator==(Point a, Point b) { return a.x == b.x && a.y == b.y; }
};

constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }  ///< the sum of two vectors
constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }  ///< the vector from b to a
constexpr Point operator-(Point a) { return {-a.x, -a.y}; }                     ///< the opposite vector
constexpr Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }     ///< the vector scaled by s

constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }    ///< the scalar product
constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }  ///< the cross product
constexpr double squared_length(Point a) { return dot(a, a); }              ///< the squared length of a vector
inline double length(Point a) { return std::sqrt(squared_length(a)); }      ///< the length of a vector
inline double distance(Point a, Point b) { return length(b - a); }          ///< the distance between two points
/// Returns the point halfway between two points.
constexpr Point midpoint(Point a, Point b) { return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)}; }
constexpr Point perpendicular(Point a) { return {-a.y, a.x}; }  ///< the vector turned left by 90 degrees
inline Point unit(Point a) { return (1.0 / length(a)) * a; }    ///< the vector scaled to length 1; it is not zero

/// Returns whether a comes before b in the order by x and then by y, to which every tie rule of lamina goes back.
constexpr bool lexicographically_less(Point a, Point b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

/// An axis-parallel box that includes its border. It is empty, as a new box is, where lower exceeds upper.
struct Box {
    Point lower{HUGE_VAL, HUGE_VAL};    ///< smallest x and y
    Point upper{-HUGE_VAL, -HUGE_VAL};  ///< largest x and y

    /// Enlarges the box to hold a point.
    constexpr void include(Point p) {
        lower = {p.x < lower.x ? p.x : lower.x, p.y < lower.y ? p.y : lower.y};
        upper = {p.x > upper.x ? p.x : upper.x, p.y > upper.y ? p.y : upper.y};
    }
    /// Returns whether a point lies in the box or on its border.
    constexpr bool contains(Point p) const {
        return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y;
    }
    /// Returns whether two boxes have a point in common.
    constexpr bool overlaps(const Box& o) const {
        return lower.x <= o.upper.x && o.lower.x <= upper.x && lower.y <= o.upper.y && o.lower.y <= upper.y;
    }
    /// Returns the common part of two boxes, which is empty where they do not overlap.
    constexpr Box intersection(const Box& o) const {
        return {{std::max(lower.x, o.lower.x), std::max(lower.y, o.lower.y)},
                {std::min(upper.x, o.upper.x), std::min(upper.y, o.upper.y)}};
    }
    /// Returns the corners counter-clockwise, from the lower left one on.
    constexpr std::array<Point, 4> corners() const { return {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}; }
    constexpr double width() const { return upper.x - lower.x; }       ///< the extent in x
    constexpr double height() const { return upper.y - lower.y; }      ///< the extent in y
    constexpr Point center() const { return midpoint(lower, upper); }  ///< the middle of the box
};

}  // namespace lamina
