// Outlines for tests: each function returns one that is counter-clockwise and simple.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <initializer_list>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

namespace lamina::shapes {

using Outline = std::vector<Point>;

inline constexpr double full_turn = 6.283185307179586;

/// Returns points at equal distances along an open line, from its first point to its last one.
inline Outline even_points(const Outline& fine, std::size_t points) {
    std::vector<double> s{0};
    for (std::size_t i = 1; i < fine.size(); ++i) s.push_back(s.back() + distance(fine[i - 1], fine[i]));
    Outline even;
    for (std::size_t k = 0, i = 0; k < points; ++k) {
        const double at = s.back() * static_cast<double>(k) / static_cast<double>(points - 1);
        while (i + 2 < s.size() && s[i + 1] < at) ++i;
        even.push_back(fine[i] + (at - s[i]) / (s[i + 1] - s[i]) * (fine[i + 1] - fine[i]));
    }
    return even;
}

inline Outline ellipse(double a, double b, std::size_t n) {
    Outline outline;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = full_turn * static_cast<double>(i) / static_cast<double>(n);
        outline.push_back({a * std::cos(t), b * std::sin(t)});
    }
    return outline;
}

inline Outline circle(double radius, std::size_t n) { return ellipse(radius, radius, n); }

/// Returns a Joukowski section with a cusp at x = 2; `thickness` and `camber` move the centre of the circle.
inline Outline joukowski(double thickness, double camber, std::size_t n) {
    const std::complex<double> center(-thickness, camber);
    const double radius = std::abs(std::complex<double>(1, 0) - center), start = std::arg(1.0 - center);
    Outline outline;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = start + full_turn * static_cast<double>(i) / static_cast<double>(n);
        const std::complex<double> z = i == 0 ? 1.0 : center + std::polar(radius, t);
        const std::complex<double> w = z + 1.0 / z;
        outline.push_back({w.real(), w.imag()});
    }
    return outline;
}

/// Returns a symmetric section of unit chord with cosine spacing, closed by a base of the given height (0: sharp).
inline Outline section(double thickness, double base, std::size_t points_a_side) {
    const auto half = [&](double x) {
        return 1.4845 * thickness * std::sqrt(x) * (1 - x) * (1 - 0.2 * x) + 0.5 * base * x;
    };
    Outline upper;  // from the trailing edge to the nose
    for (std::size_t i = 0; i <= points_a_side; ++i) {
        const double x =
            0.5 * (1 + std::cos(0.5 * full_turn * static_cast<double>(i) / static_cast<double>(points_a_side)));
        upper.push_back({x, i == points_a_side ? 0.0 : half(x)});
    }
    Outline outline = upper;
    for (std::size_t i = points_a_side; i-- > (base > 0 ? 0u : 1u);) outline.push_back({upper[i].x, -upper[i].y});
    return outline;
}

inline Outline polygon(std::initializer_list<Point> corners) { return corners; }

inline Outline wedge() { return polygon({{0, 0}, {1, -0.1}, {1, 0.1}}); }
inline Outline diamond() { return polygon({{-1, 0}, {0, -0.3}, {1, 0}, {0, 0.3}}); }
inline Outline box() { return polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}); }
inline Outline l_shape() { return polygon({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}); }
/// Returns a C that opens to the right; its lips are `lips` apart.
inline Outline c_shape(double lips) {
    return polygon({{0, 0},
                    {2, 0},
                    {2, 1 - 0.5 * lips},
                    {1.8, 1 - 0.5 * lips},
                    {1.8, 0.2},
                    {0.2, 0.2},
                    {0.2, 1.8},
                    {1.8, 1.8},
                    {1.8, 1 + 0.5 * lips},
                    {2, 1 + 0.5 * lips},
                    {2, 2},
                    {0, 2}});
}
/// Returns a plate with a V cut from above, `width` wide at the top.
inline Outline v_notch(double width) {
    return polygon({{0, 0}, {4, 0}, {4, 1}, {2 + 0.5 * width, 1}, {2, 0.2}, {2 - 0.5 * width, 1}, {0, 1}});
}
/// Returns a comb with its teeth upward and slots of width `gap` between them.
inline Outline comb(std::size_t teeth, double gap) {
    Outline outline{{0, -0.2}};
    const double pitch = 0.2 + gap, width = static_cast<double>(teeth) * pitch - gap;
    outline.push_back({width, -0.2});
    for (std::size_t k = teeth; k-- > 0;) {
        const double left = static_cast<double>(k) * pitch;
        outline.insert(outline.end(), {{left + 0.2, 1}, {left, 1}});
        if (k > 0) outline.insert(outline.end(), {{left, 0}, {left - gap, 0}});
    }
    return outline;
}
/// Returns a plate of unit length with a half-circle for a nose and a square base.
inline Outline plate(double thickness, std::size_t nose_points) {
    Outline outline;
    const double r = 0.5 * thickness;
    for (std::size_t i = 0; i <= nose_points; ++i) {
        const double t = full_turn * (0.25 + 0.5 * static_cast<double>(i) / static_cast<double>(nose_points));
        outline.push_back({r + r * std::cos(t), r * std::sin(t)});
    }
    outline.insert(outline.end(), {{1, -r}, {1, r}});
    return outline;
}

/// Returns Koch's snowflake of 12 x 4^(level - 1) sides between its tips at a distance of 1 from the origin.
inline Outline snowflake(int level) {
    Outline sides{{1, 0}, {-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};
    for (int k = 0; k < level; ++k) {
        Outline finer;
        for (std::size_t i = 0; i < sides.size(); ++i) {
            const Point a = sides[i], b = sides[(i + 1) % sides.size()], third = (1.0 / 3) * (b - a);
            const Point tip = midpoint(a, b) - std::sqrt(0.75) * perpendicular(third);
            for (const Point p : {a, a + third, tip, b - third}) finer.push_back(p);
        }
        sides = std::move(finer);
    }
    return sides;
}

/// Returns a random polygon that is star-shaped about the origin, hence simple; its radii lie from min_radius to 1.
inline Outline star(std::size_t n, double min_radius, std::mt19937& random) {
    const auto uniform = [&] { return static_cast<double>(random()) / 4294967296.0; };
    Outline outline;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = full_turn * (static_cast<double>(i) + 0.8 * uniform()) / static_cast<double>(n);
        const double r = min_radius + (1 - min_radius) * uniform();
        outline.push_back({r * std::cos(t), r * std::sin(t)});
    }
    return outline;
}

/// Returns the outline with each edge divided into equal parts.
inline Outline refined(const Outline& outline, std::size_t parts) {
    Outline result;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Point a = outline[i], b = outline[(i + 1) % outline.size()];
        for (std::size_t k = 0; k < parts; ++k)
            result.push_back(a + (static_cast<double>(k) / static_cast<double>(parts)) * (b - a));
    }
    return result;
}

/// Returns the outline turned about the origin by an angle in radians, then scaled, then shifted.
inline Outline moved(Outline outline, double angle, double scale, Point shift) {
    const double c = std::cos(angle), s = std::sin(angle);
    for (Point& p : outline) p = shift + scale * Point{c * p.x - s * p.y, s * p.x + c * p.y};
    return outline;
}

/// Returns the outline mirrored in the x axis, counter-clockwise again, starting at the same point.
inline Outline mirrored(Outline outline) {
    for (Point& p : outline) p.y = -p.y;
    std::reverse(outline.begin() + 1, outline.end());
    return outline;
}

/// Returns the outline with point `first` at its start.
inline Outline started_at(Outline outline, std::size_t first) {
    std::rotate(outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(first), outline.end());
    return outline;
}

/// Returns the outlines as elements named body0, body1 ...
inline Geometry geometry(std::initializer_list<Outline> outlines) {
    Geometry result;
    for (const Outline& outline : outlines) {
        Element element;
        element.name = "body" + std::to_string(result.elements.size());
        element.points = outline;
        result.elements.push_back(std::move(element));
    }
    return result;
}

}  // namespace lamina::shapes
