// A straight panel of vortices or sources, and the stream function and velocity that it induces at a point.
// Source: J. Katz, A. Plotkin, Low-Speed Aerodynamics, 2nd ed. (2001), section 10.3; M. Drela, XFOIL (1989).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "core/reproducible_math.hpp"

namespace lamina::flow {

/// A node as seen from a point.
struct SeenNode {
    Point to;                 ///< the vector to it
    double squared_distance;  ///< at least 1e-300, so that logarithms are finite
};

inline SeenNode see(Point node, Point from) {
    const Point to = node - from;
    return {to, std::max(squared_length(to), 1e-300)};
}

/// A node as seen from a point, with the logarithm of the squared distance.
struct LoggedNode : SeenNode {
    double log_distance2;
};

inline LoggedNode see_with_log(Point node, Point from) {
    const SeenNode seen = see(node, from);
    return {seen, core::log_reproducible(seen.squared_distance)};
}

/// A panel as seen from a point, in its own coordinates: xi along the panel from its first node, eta to its left.
struct SeenPanel {
    double length;
    Point along;     ///< unit vector
    double xi, eta;  ///< of the point
    double angle;    ///< between the directions to both nodes, from 0 to pi
    double signed_angle() const { return eta < 0 ? -angle : angle; }
};

/// Returns the angle between two directions, from 0 to pi. Where one of them is no direction the angle is 0.
inline double unsigned_angle(Point a, Point b) {
    const double c = dot(a, b);
    const double quarter = core::first_quadrant_angle(std::abs(cross(a, b)), std::max(std::abs(c), 1e-300));
    return c < 0 ? core::pi - quarter : quarter;
}

/// `length` and `along` are those of the vector from a to b, which are not the same node.
inline SeenPanel see_panel(const SeenNode& a, const SeenNode& b, double length, Point along) {
    return {length, along, -dot(a.to, along), -dot(a.to, perpendicular(along)), unsigned_angle(a.to, b.to)};
}

/// The integrals of ln r and of (t / length) ln r over the panel, where t runs from its first node.
struct PanelIntegrals {
    double constant, linear;
};

inline PanelIntegrals integrate_log(const SeenPanel& panel, const LoggedNode& a, const LoggedNode& b) {
    const double constant = 0.5 * ((panel.length - panel.xi) * b.log_distance2 + panel.xi * a.log_distance2) -
                            panel.length + std::abs(panel.eta) * panel.angle;
    const double about_foot =
        0.25 * (b.squared_distance * (b.log_distance2 - 1) - a.squared_distance * (a.log_distance2 - 1));
    return {constant, (about_foot + panel.xi * constant) / panel.length};
}

/// Returns the logarithm of the ratio of the distances of two nodes. It does not depend on the unit of lengths, as a
/// difference of logarithms would by its rounding.
inline double log_of_ratio(const SeenNode& b, const SeenNode& a) {
    return 0.5 * core::log_reproducible(b.squared_distance / a.squared_distance);
}

/// Returns 2 pi times the stream function of a panel of sources of unit strength. It needs the angle of the direction
/// from the panel's first node to the point, measured from the panel, which must not jump along a body. `is_at_start`
/// marks that node, where there is no such angle.
inline double source_stream_function(const SeenPanel& panel, const SeenNode& a, const SeenNode& b,
                                     double direction_angle, bool is_at_start) {
    if (is_at_start) return core::pi * panel.length;
    return panel.length * direction_angle + (panel.length - panel.xi) * panel.signed_angle() -
           panel.eta * log_of_ratio(b, a);
}

/// Returns the velocity that a sheet of vortices induces, whose strength is `first` at its first node and grows by
/// `slope` per unit of length.
inline Point vortex_velocity(const SeenPanel& panel, const SeenNode& a, const SeenNode& b, double first, double slope) {
    const double log_ratio = log_of_ratio(b, a), angle = panel.signed_angle();
    const double here = first + slope * panel.xi;
    const double along = -(here * angle + slope * panel.eta * log_ratio);
    const double across = -(here * log_ratio + slope * (panel.length - panel.eta * angle));
    return (1 / (2 * core::pi)) * (along * panel.along + across * perpendicular(panel.along));
}

/// Returns the velocity that a sheet of sources of constant strength induces.
inline Point source_velocity(const SeenPanel& panel, const SeenNode& a, const SeenNode& b, double strength) {
    const double log_ratio = log_of_ratio(b, a);
    return (strength / (2 * core::pi)) *
           ((-log_ratio) * panel.along + panel.signed_angle() * perpendicular(panel.along));
}

}  // namespace lamina::flow
