#include "delaunay/constrain/crossing_point.hpp"

#include <algorithm>
#include <cmath>

#include <lamina/predicates.hpp>

#include "core/predicates.hpp"

namespace lamina::delaunay {

namespace {

/// Returns whether a-v is shorter than a-b, by the sign of |v - a|^2 - |b - a|^2, which factors so that little is lost
/// to rounding where v is near b.
bool is_shorter(Point a, Point v, Point b) { return dot(v - b, (v - a) + (b - a)) < 0; }

/// Returns the nearest number in the range of exact predicates. Precondition: the magnitude is not above the range.
double round_to_exact_range(double c) {
    const double magnitude = std::abs(c);
    if (magnitude >= min_exact_coordinate) return c;
    return magnitude < 0.5 * min_exact_coordinate ? 0 : std::copysign(min_exact_coordinate, c);
}

}  // namespace

bool shortens(Point a, Point b, Point v) { return is_shorter(a, v, b) && is_shorter(b, v, a); }

bool cross_properly(Point p, Point q, Point r, Point s) {
    const double pr = core::inline_orient2d(p, q, r), ps = core::inline_orient2d(p, q, s);
    if (!((pr > 0 && ps < 0) || (pr < 0 && ps > 0))) return false;
    const double rp = core::inline_orient2d(r, s, p), rq = core::inline_orient2d(r, s, q);
    return (rp > 0 && rq < 0) || (rp < 0 && rq > 0);
}

Point crossing_point(Point p, Point q, Point r, Point s) {
    double t = cross(r - p, s - r) / cross(q - p, s - r);
    // If even the directions round to parallel, the larger of the first ends lies on both edges.
    if (std::isnan(t)) return lexicographically_less(p, r) ? r : p;
    t = std::clamp(t, 0.0, 1.0);
    const Point x = p + t * (q - p);
    const auto between = [](double value, double a, double b, double c, double d) {
        return std::clamp(round_to_exact_range(value), std::max(std::min(a, b), std::min(c, d)),
                          std::min(std::max(a, b), std::max(c, d)));
    };
    return {between(x.x, p.x, q.x, r.x, s.x), between(x.y, p.y, q.y, r.y, s.y)};
}

}  // namespace lamina::delaunay
