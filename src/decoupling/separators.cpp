// Sources: J. K. Pardue, thesis (2015), chapter 5, equation 1; L. Linardakis, N. Chrisochoides, Graded Delaunay
// decoupling method for parallel guaranteed quality planar mesh generation, SIAM J. Sci. Comput. 30 (2008).
#include "decoupling/separators.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/reproducible_math.hpp"
#include "core/rounding.hpp"

namespace lamina::decoupling {

namespace {

/// Returns an arc length of a curve rounded to about a thousandth of a segment.
double rounded_arc_length(double s, double segment, double total) {
    return total * core::rounded_place(s / total, segment / total);
}

/// Divides a curve of length `total` into segments with equal shares of the integral of ds / h, and returns the points
/// between them. curve(s) is the point at arc length s. The integral is the trapezoidal sum over steps of about h / 8.
template <class Curve>
std::vector<Point> equidistribute(const Curve& curve, double total, const SizeField& size, std::size_t min_segments) {
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
    const auto n = std::max(min_segments, static_cast<std::size_t>(std::ceil(integral.back() / frozen_share)));
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

/// Returns k of equation 1 where the area A of triangles is that of the equilateral triangle of edge h.
double k_value(double h) { return 0.5 * std::sqrt(equilateral_area * h * h / std::sqrt(2.0)); }

/// Returns the number of segments that the k rule gives to a stretch between ends with these k values, or 0 where it
/// gives none.
double k_rule_count(double stretch, double k_u, double k_v) {
    const double n = std::ceil(stretch / (2 * std::min(k_u, k_v)));
    return n <= std::sqrt(3.0) * stretch / (2 * std::max(k_u, k_v)) ? n : 0;
}

/// Divides the line from u to v by the k rule. Precondition: h is no larger at u than at v.
std::vector<Point> divide_by_k_rule(Point u, Point v, const SizeField& size, std::size_t min_segments) {
    std::vector<Point> points;
    const double total = distance(u, v);
    const auto at = [&](double s) { return u + (s / total) * (v - u); };
    double from = 0;
    while (from < total) {
        const double k_u = k_value(size(at(from)));
        double stretch = total - from;
        double n = k_rule_count(stretch, k_u, k_value(size(at(from + stretch))));
        // A nearer end is chosen until there is a whole number in the range, or one segment is left.
        while (n == 0 && stretch > 4 * k_u) {
            stretch *= 0.9;
            n = k_rule_count(stretch, k_u, k_value(size(at(from + stretch))));
        }
        if (n == 0) {
            stretch = std::min(1.9 * k_u, total - from);
            n = 1;
        }
        if (from == 0 && stretch == total) n = std::max(n, static_cast<double>(min_segments));
        for (double i = 1; i <= n; ++i)
            points.push_back(at(rounded_arc_length(from + stretch * (i / n), stretch / n, total)));
        from += stretch;
        // A remainder far below one segment is joined to the last one.
        if (total - from < k_u / 4) break;
    }
    points.pop_back();
    return points;
}

}  // namespace

std::vector<Point> divide_separator(Point u, Point v, const SeparatorSpacing& spacing, std::size_t min_segments) {
    Box box;
    box.include(u);
    box.include(v);
    const SizeField size = spacing.size.restricted_to(box);
    const SeparatorRule rule = spacing.rule;
    // Lines begin at the finer end, so that both directions give the same points. Ends of symmetric lines are equally
    // fine but for rounding, which must not decide.
    constexpr double rounding = 1e-6;
    const double h_u = size(u), h_v = size(v);
    const bool forward = std::abs(h_u - h_v) > rounding * h_u ? h_u < h_v : core::is_forward(v - u);
    const Point from = forward ? u : v, to = forward ? v : u;
    const double total = distance(from, to);
    std::vector<Point> points =
        rule == SeparatorRule::k_rule
            ? divide_by_k_rule(from, to, size, min_segments)
            : equidistribute([&](double s) { return from + (s / total) * (to - from); }, total, size, min_segments);
    if (!forward) std::reverse(points.begin(), points.end());
    return points;
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
