// Curves of drawings: rational B-splines in space or in the plane of the outline. Lines, polylines, arcs, ellipses and
// Bezier curves have this form exactly, so that one value holds each of them, and points are samples of it.
//
// Source: L. Piegl, W. Tiller, The NURBS Book (1997), chapters 4 and 7.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::geometry {

/// A point of space, or a vector.
struct Point3 {
    double x = 0, y = 0, z = 0;
};

inline Point3 operator+(Point3 a, Point3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Point3 operator*(double s, Point3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Point3 cross(Point3 a, Point3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point3 a) { return std::sqrt(dot(a, a)); }
/// Returns the vector scaled to length 1; another one where it is zero.
inline Point3 unit_or(Point3 a, Point3 otherwise) { return length(a) > 0 ? (1 / length(a)) * a : otherwise; }

/// A map of space: origin + x * a + y * b + z * c.
struct Frame3 {
    Point3 origin{}, a{1, 0, 0}, b{0, 1, 0}, c{0, 0, 1};

    Point3 operator()(Point3 p) const { return origin + p.x * a + p.y * b + p.z * c; }
    /// Returns the map that takes the other one first.
    Frame3 after(const Frame3& first) const {
        const auto turned = [this](Point3 v) { return v.x * a + v.y * b + v.z * c; };
        return {(*this)(first.origin), turned(first.a), turned(first.b), turned(first.c)};
    }
};

/// The largest degree of a curve.
inline constexpr std::size_t max_curve_degree = 25;

/// A rational B-spline, between two of its parameters.
template <class Position>
struct BSpline {
    std::size_t degree = 1;
    std::vector<double> knots;  ///< ascending; degree + 1 more than control points
    std::vector<Position> control;
    std::vector<double> weights;  ///< positive, one per control point; empty: all are 1
    double first = 0, last = 1;   ///< the parameters of its ends, first < last

    /// Returns whether it is a polyline.
    bool is_straight() const { return degree == 1; }
};
using SpaceCurve = BSpline<Point3>;
using PlaneCurve = BSpline<Point>;

SpaceCurve polyline(std::vector<Point3> vertices);
SpaceCurve bezier(std::vector<Point3> control);
/// Returns center + cos(t) u + sin(t) v for t from `from` over an angle of at most a whole turn, in radians.
SpaceCurve elliptic_arc(Point3 center, Point3 u, Point3 v, double from, double sweep);
/// Returns the arc of a circle from a to b in a plane of constant z; `bulge` is the tangent of a quarter of its angle,
/// positive where it turns left.
SpaceCurve bulged_arc(Point3 a, Point3 b, double bulge);

/// Sets the ends of a curve to the range in which its parameters define it.
void use_whole_range(SpaceCurve& curve);

/// Returns why a curve cannot be evaluated; empty where it can: numbers of knots and weights, their order and sign.
std::string defect_of(const SpaceCurve& curve);

SpaceCurve mapped(SpaceCurve curve, const Frame3& frame);

/// Returns the point at a parameter. Precondition: the curve has no defect.
Point at(const PlaneCurve& curve, double parameter);
Point3 at(const SpaceCurve& curve, double parameter);

/// Returns the parameters at which the pieces of a curve begin and end, ascending, from its first to its last one.
std::vector<double> piece_ends(const PlaneCurve& curve);

/// Returns a vector along the curve at one of its parameters, on the side of larger parameters or on the other.
Point direction(const PlaneCurve& curve, double parameter, bool is_ahead);

}  // namespace lamina::geometry
