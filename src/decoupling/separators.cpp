// Sources: J. K. Pardue, thesis (2015), chapter 5, equation 1; L. Linardakis, N. Chrisochoides, Graded Delaunay
// decoupling method for parallel guaranteed quality planar mesh generation, SIAM J. Sci. Comput. 30 (2008).
#include "decoupling/separators.hpp"

#include <algorithm>
#include <cmath>

#include "core/equilateral.hpp"
#include "core/reproducible_math.hpp"

namespace lamina::decoupling {

namespace {

/// Equal shares of the integral of ds / h along a curve, point(s) at arc length s: the points between them. The
/// integral is the trapezoidal sum over steps of about h / 8.
template <class Curve>
std::vector<Point> equidistribute(const Curve& point, double total, const SizeField& size, std::size_t fewest) {
    std::vector<double> at{0}, integral{0};  // arc length, integral up to there
    double h = size(point(0));
    while (at.back() < total) {
        const double step = std::min(h / 8, total - at.back());
        // The last step would otherwise be lost to rounding.
        const double s = at.back() + step < total * (1 - 1e-12) ? at.back() + step : total;
        const double ahead = size(point(s));
        integral.push_back(integral.back() + 0.5 * (s - at.back()) * (1 / h + 1 / ahead));
        at.push_back(s);
        h = ahead;
    }
    const auto n = std::max(fewest, static_cast<std::size_t>(std::ceil(integral.back() / frozen_share)));
    std::vector<Point> points;
    points.reserve(n - 1);
    std::size_t i = 0;
    for (std::size_t k = 1; k < n; ++k) {
        const double wanted = integral.back() * (static_cast<double>(k) / static_cast<double>(n));
        while (integral[i + 1] < wanted) ++i;
        const double share = (wanted - integral[i]) / (integral[i + 1] - integral[i]);
        points.push_back(point(at[i] + share * (at[i + 1] - at[i])));
    }
    return points;
}

double k_value(double h) { return 0.5 * std::sqrt(core::equilateral_area * h * h / std::sqrt(2.0)); }

/// The number of segments the k rule gives to a stretch between ends of these k values, 0 if it gives none.
double k_rule_count(double stretch, double k_u, double k_v) {
    const double n = std::ceil(stretch / (2 * std::min(k_u, k_v)));
    return n <= std::sqrt(3.0) * stretch / (2 * std::max(k_u, k_v)) ? n : 0;
}

std::vector<Point> cut_by_k_rule(Point u, Point v, const SizeField& size, std::size_t fewest) {
    std::vector<Point> points;
    const double total = distance(u, v);
    const auto at = [&](double s) { return u + (s / total) * (v - u); };
    double from = 0;
    while (from < total) {
        const double k_u = k_value(size(at(from)));
        double stretch = total - from;
        double n = k_rule_count(stretch, k_u, k_value(size(at(from + stretch))));
        // Choose a nearer v until there is an integer in the range. A stretch of one segment always ends the search.
        while (n == 0 && stretch > 4 * k_u) {
            stretch *= 0.9;
            n = k_rule_count(stretch, k_u, k_value(size(at(from + stretch))));
        }
        if (n == 0) {
            stretch = std::min(1.9 * k_u, total - from);
            n = 1;
        }
        if (from == 0 && stretch == total) n = std::max(n, static_cast<double>(fewest));
        for (double i = 1; i <= n; ++i) points.push_back(at(from + stretch * (i / n)));
        from += stretch;
        // A remainder far below one segment is joined to the last.
        if (total - from < k_u / 4) {
            break;
        }
    }
    points.pop_back();
    return points;
}

}  // namespace

std::vector<Point> separate(Point u, Point v, const Separation& separation, std::size_t fewest) {
    const auto& [size, rule] = separation;
    // Always from the finer end (ties: the smaller point), so that both directions give the same points.
    const double hu = size(u), hv = size(v);
    const bool forward = hu != hv ? hu < hv : lexicographically_less(u, v);
    const Point from = forward ? u : v, to = forward ? v : u;
    const double total = distance(from, to);
    std::vector<Point> points =
        rule == SeparatorRule::k_rule
            ? cut_by_k_rule(from, to, size, fewest)
            : equidistribute([&](double s) { return from + (s / total) * (to - from); }, total, size, fewest);
    if (!forward) std::reverse(points.begin(), points.end());
    return points;
}

std::vector<Point> divide_circle(Point center, double radius, const SizeField& size, std::size_t fewest) {
    const auto at = [&](double s) {
        return center + radius * Point{core::cos_reproducible(s / radius), core::sin_reproducible(s / radius)};
    };
    std::vector<Point> points = equidistribute(at, 2 * core::pi * radius, size, fewest);
    points.insert(points.begin(), at(0));
    return points;
}

}  // namespace lamina::decoupling
