// Source: L. Linardakis, N. Chrisochoides, Graded Delaunay decoupling method for parallel guaranteed quality planar
// mesh generation, SIAM J. Sci. Comput. 30 (2008).
#include "decoupling/separators.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/reproducible_math.hpp"
#include "core/rounding.hpp"
#include "sizing/requests.hpp"

namespace lamina::decoupling {

namespace {

/// Returns an arc length of a curve rounded to about a thousandth of a segment.
double rounded_arc_length(double s, double segment, double total) {
    return total * core::rounded_place(s / total, segment / total);
}

/// Divides a curve of length `total` into segments with equal shares of the integral of ds / h, and returns the points
/// between them. curve(s) is the point at arc length s. The integral is the trapezoidal sum over steps of about h / 8.
template <class Curve, class Size>
std::vector<Point> equidistribute(const Curve& curve, double total, const Size& size, std::size_t min_segments) {
    constexpr double steps_in_h = 8;
    std::vector<double> arc_length{0}, integral{0};  // the integral up to each arc length
    double h = size(curve(0)), inverse = 1 / h;
    while (arc_length.back() < total) {
        const double step = std::min(h / steps_in_h, total - arc_length.back());
        // Rounding might otherwise keep the last step from reaching the end.
        const double s = arc_length.back() + step < total * (1 - 1e-12) ? arc_length.back() + step : total;
        h = size(curve(s));
        const double last_inverse = std::exchange(inverse, 1 / h);
        integral.push_back(integral.back() + 0.5 * (s - arc_length.back()) * (last_inverse + inverse));
        arc_length.push_back(s);
    }
    const auto n = std::max(min_segments, static_cast<std::size_t>(std::ceil(integral.back() / sizing::frozen_share)));
    std::vector<Point> points;
    points.reserve(n - 1);
    std::size_t i = 0;
    for (std::size_t k = 1; k < n; ++k) {
        const double target = integral.back() * (static_cast<double>(k) / static_cast<double>(n));
        while (integral[i + 1] < target) ++i;
        const double step = arc_length[i + 1] - arc_length[i];
        const double share = (target - integral[i]) / (integral[i + 1] - integral[i]);
        points.push_back(curve(rounded_arc_length(arc_length[i] + share * step, steps_in_h * step, total)));
    }
    return points;
}

}  // namespace

std::vector<Point> divide_separator(Point u, Point v, const SizeField& of_region, std::size_t min_segments) {
    Box box;
    box.include(u);
    box.include(v);
    const SizeField size = of_region.restricted_to(box);
    // Lines begin at the finer end, so that both directions give the same points. Ends of symmetric lines are equally
    // fine but for rounding, which must not decide.
    constexpr double rounding = 1e-6;
    const double h_u = size(u), h_v = size(v);
    const bool forward = std::abs(h_u - h_v) > rounding * h_u ? h_u < h_v : core::is_forward(v - u);
    const Point from = forward ? u : v, to = forward ? v : u;
    const double total = distance(from, to);
    std::vector<Point> points =
        equidistribute([&](double s) { return from + (s / total) * (to - from); }, total, size, min_segments);
    if (!forward) std::reverse(points.begin(), points.end());
    return points;
}

std::vector<Point> divide_curve(std::span<const Point> curve, const SizeField& size, Point to_copy,
                                std::size_t min_segments) {
    std::vector<double> arc_length{0};
    for (std::size_t i = 1; i < curve.size(); ++i)
        arc_length.push_back(arc_length.back() + distance(curve[i - 1], curve[i]));
    const auto at = [&](double s) {
        const auto after = std::upper_bound(arc_length.begin() + 1, arc_length.end() - 1, s);
        const auto i = static_cast<std::size_t>(after - arc_length.begin());
        return curve[i - 1] +
               ((s - arc_length[i - 1]) / (arc_length[i] - arc_length[i - 1])) * (curve[i] - curve[i - 1]);
    };
    const auto smaller = [&](Point p) { return std::min(size(p), size(p + to_copy)); };
    return equidistribute(at, arc_length.back(), smaller, min_segments);
}

std::vector<Point> divide_circle(Point center, double radius, const SizeField& size, std::size_t min_segments) {
    const auto at = [&](double s) {
        return center + radius * Point{core::cos_reproducible(s / radius), core::sin_reproducible(s / radius)};
    };
    std::vector<Point> points = equidistribute(at, 2 * core::pi * radius, size, min_segments);
    points.insert(points.begin(), at(0));
    return points;
}

}  // namespace lamina::decoupling
