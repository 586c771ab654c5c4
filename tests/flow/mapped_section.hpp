// Sections with a potential flow that is known exactly: images of a circle.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::test {

using Complex = std::complex<double>;

/// The image of a circle through 1, whose centre is `center`, under the map of Karman and Trefftz with this trailing
/// edge angle in radians; 0: that of Joukowski. Source: L. M. Milne-Thomson, Theoretical Aerodynamics, 4th ed. (1966),
/// sections 6.0 and 7.
struct MappedSection {
    Complex center;
    double trailing_edge_angle = 0;

    double radius() const { return std::abs(1.0 - center); }
    double power() const { return 2 - trailing_edge_angle / M_PI; }

    Complex map(Complex z) const {
        const Complex q = std::pow((z - 1.0) / (z + 1.0), power());
        return power() * (1.0 + q) / (1.0 - q);
    }
    Complex map_slope(Complex z) const {
        const Complex q = std::pow((z - 1.0) / (z + 1.0), power());
        return 4 * power() * power() / (z * z - 1.0) * q / ((1.0 - q) * (1.0 - q));
    }
    /// Returns the point of the circle at this angle from the trailing edge, counter-clockwise.
    Complex circle(double angle) const { return center + (1.0 - center) * std::polar(1.0, angle); }

    /// Returns the outline, counter-clockwise from the trailing edge.
    std::vector<Point> outline(std::size_t n) const {
        std::vector<Point> points{{power(), 0}};
        for (std::size_t i = 1; i < n; ++i) {
            const Complex w = map(circle(2 * M_PI * static_cast<double>(i) / static_cast<double>(n)));
            points.push_back({w.real(), w.imag()});
        }
        return points;
    }
    /// Returns the circulation over 2 pi, clockwise, that makes the trailing edge a stagnation point of the circle.
    double vortex(double alpha) const {
        const Complex d = 1.0 - center;
        return (Complex(0, 1) * (std::polar(1.0, -alpha) - std::polar(1.0, alpha) * radius() * radius() / (d * d)) * d)
            .real();
    }
    /// Returns the speed at the point of the section at this angle on the circle, not at its trailing edge.
    double speed(double angle, double alpha) const {
        const Complex z = circle(angle), d = z - center;
        const Complex in_circle_plane = std::polar(1.0, -alpha) -
                                        std::polar(1.0, alpha) * radius() * radius() / (d * d) +
                                        Complex(0, 1) * vortex(alpha) / d;
        return std::abs(in_circle_plane / map_slope(z));
    }
    double chord() const {
        double lower = HUGE_VAL, upper = -HUGE_VAL;
        for (const Point p : outline(20000)) {
            lower = std::min(lower, p.x);
            upper = std::max(upper, p.x);
        }
        return upper - lower;
    }
    double lift(double alpha) const { return 4 * M_PI * vortex(alpha) / chord(); }
};

}  // namespace lamina::test
