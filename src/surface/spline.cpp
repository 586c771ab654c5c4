// Interpolating and smoothing cubic splines.
// Source: C. de Boor, A Practical Guide to Splines (1978), chapters 4 and 14; C. H. Reinsch, Smoothing by spline
// functions, Numer. Math. 10 (1967).
#include "surface/spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/angles.hpp"

namespace lamina::surface {

namespace {

/// A closed run as an open one that goes on at both ends, a round and 40 points at least: what the ends do to the round
/// between fades by 0.27 a point, so that this round is periodic to rounding. An open run as it is.
struct Unrolled {
    std::vector<Point> points;
    std::vector<double> t;  ///< chord length from the first point
    std::size_t first = 0;  ///< the run itself starts here
};

Unrolled unroll(const SmoothRun& run) {
    Unrolled u;
    u.points = run.points;
    if (run.closed) {
        const std::size_t n = run.points.size(), rounds = 1 + 40 / n;  // on each side
        for (std::size_t k = 0; k < 2 * rounds; ++k)
            u.points.insert(u.points.end(), run.points.begin(), run.points.end());
        u.points.push_back(run.points.front());
        u.first = rounds * n;
    }
    u.t.push_back(0);
    for (std::size_t i = 1; i < u.points.size(); ++i)
        u.t.push_back(u.t.back() + distance(u.points[i - 1], u.points[i]));
    return u;
}

/// Slope at the first of three points, of the parabola through them.
Point end_slope(Point secant, double h, Point next_secant, double next_h) {
    return secant + (h / (h + next_h)) * (secant - next_secant);
}

/// Slopes of the cubic spline, at its ends those of a parabola: the usual tridiagonal system, solved without pivoting.
std::vector<Point> spline_slopes(std::span<const Point> points, std::span<const double> t) {
    const std::size_t n = points.size();
    const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
    const auto secant = [&](std::size_t i) { return (1 / h(i)) * (points[i + 1] - points[i]); };
    if (n == 2) return {secant(0), secant(0)};

    std::vector<Point> slopes(n);
    std::vector<double> above(n);
    slopes[0] = end_slope(secant(0), h(0), secant(1), h(1));
    slopes[n - 1] = end_slope(secant(n - 2), h(n - 2), secant(n - 3), h(n - 3));
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = h(i - 1), after = h(i);
        const Point right = 3.0 * (after * secant(i - 1) + before * secant(i)) - after * slopes[i - 1];
        const double pivot = 2 * (before + after) - after * above[i - 1];
        above[i] = before / pivot;
        slopes[i] = (1 / pivot) * right;
    }
    for (std::size_t i = n - 1; i-- > 1;) slopes[i] = slopes[i] - above[i] * slopes[i + 1];
    return slopes;
}

/// Where spacings jump or points wiggle, the spline swings out. Tangents are kept between the directions of the chords
/// they separate, with a margin for inflections between points, and their lengths near 1:
///
///        i ____ i+1        between the chords i-1, i and i, i+1, up to a quarter of the turning at
///         /                i-1, i and i+1 beyond them
///     i-1
std::vector<Point> limited(std::vector<Point> slopes, std::span<const Point> points) {
    constexpr double margin_share = 0.25, shortest = 0.5, longest = 1.6;
    const std::size_t n = points.size();
    if (n < 3) return slopes;
    std::vector<double> turning(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
        turning[i] = core::angle_between(points[i] - points[i - 1], points[i + 1] - points[i]);
    const auto limit = [&](std::size_t i, Point chord, double lower, double upper) {
        const double size = length(slopes[i]), wanted = size > 0 ? core::angle_between(chord, slopes[i]) : 0;
        const double angle = std::clamp(wanted, lower, upper);
        const double kept = std::clamp(size, shortest, longest);
        if (angle != wanted)
            slopes[i] = kept * unit(core::rotated(chord, angle));
        else if (kept != size)
            slopes[i] = kept * unit(slopes[i]);
    };
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double margin =
            margin_share * (std::abs(turning[i - 1]) + std::abs(turning[i]) + std::abs(turning[i + 1]));
        limit(i, points[i] - points[i - 1], std::min(0.0, turning[i]) - margin, std::max(0.0, turning[i]) + margin);
    }
    const double first = std::abs(turning[1]), last = std::abs(turning[n - 2]);
    limit(0, points[1] - points[0], -first, first);
    limit(n - 1, points[n - 1] - points[n - 2], -last, last);
    return slopes;
}

}  // namespace

Curve::Curve(const SmoothRun& run) {
    const Unrolled u = unroll(run);
    const std::vector<Point> slopes = limited(spline_slopes(u.points, u.t), u.points);
    const std::size_t count = run.closed ? run.points.size() + 1 : run.points.size();
    for (std::size_t i = u.first; i < u.first + count; ++i) {
        t_.push_back(u.t[i] - u.t[u.first]);
        points_.push_back(u.points[i]);
        slopes_.push_back(slopes[i]);
    }
    if (run.closed) slopes_.back() = slopes_.front();
}

Point Curve::at(std::size_t piece, double share) const {
    const double h = t_[piece + 1] - t_[piece], u = share, v = 1 - share;
    if (share <= 0) return points_[piece];
    if (share >= 1) return points_[piece + 1];
    return v * v * (1 + 2 * u) * points_[piece] + u * u * (1 + 2 * v) * points_[piece + 1] +
           (h * u * v * v) * slopes_[piece] - (h * u * u * v) * slopes_[piece + 1];
}

Point Curve::direction(std::size_t piece, double share) const {
    const double h = t_[piece + 1] - t_[piece], u = share, v = 1 - share;
    return (6 * u * v / h) * (points_[piece + 1] - points_[piece]) + v * (v - 2 * u) * slopes_[piece] +
           u * (u - 2 * v) * slopes_[piece + 1];
}

namespace {

/// Points of the smoothing spline of given penalties by point (penalty over weight). With second derivatives c at the
/// inner points, the spline that minimises  sum |g_i - p_i|^2 / penalty_i + integral |g''|^2  satisfies
/// (R + Q'PQ) c = Q'p, g = p - PQ c; R tridiagonal, Q with three bands, P the diagonal of penalties. A penalty of 0
/// holds a point where it is.
class SmoothingSystem {
public:
    SmoothingSystem(std::span<const Point> points, std::span<const double> t) : points_(points) {
        for (std::size_t i = 0; i + 1 < t.size(); ++i) h_.push_back(t[i + 1] - t[i]);
    }

    std::vector<Point> solve(std::span<const double> penalty) const {
        const std::size_t n = points_.size(), m = n - 2;
        // Banded symmetric matrix: diagonal and two bands beside it, then its factors L D L'.
        std::vector<std::array<double, 3>> band(m, std::array<double, 3>{});
        std::vector<Point> c(m);
        for (std::size_t j = 0; j < m; ++j) {
            band[j][0] = (h_[j] + h_[j + 1]) / 3;
            if (j + 1 < m) band[j][1] = h_[j + 1] / 6;
            for (std::size_t k = 0; k < 3 && j + k < m; ++k) band[j][k] += product(j, j + k, penalty);
            c[j] = (1 / h_[j + 1]) * (points_[j + 2] - points_[j + 1]) - (1 / h_[j]) * (points_[j + 1] - points_[j]);
        }
        for (std::size_t j = 0; j < m; ++j) {
            const std::array<double, 3> row = band[j];
            for (std::size_t k = 1; k < 3 && j + k < m; ++k) {
                const double factor = row[k] / row[0];
                for (std::size_t l = k; l < 3; ++l) band[j + k][l - k] -= factor * row[l];
                c[j + k] = c[j + k] - factor * c[j];
            }
        }
        for (std::size_t j = m; j-- > 0;) {
            for (std::size_t k = 1; k < 3 && j + k < m; ++k) c[j] = c[j] - band[j][k] * c[j + k];
            c[j] = (1 / band[j][0]) * c[j];
        }
        std::vector<Point> smooth(points_.begin(), points_.end());
        for (std::size_t j = 0; j < m; ++j)
            for (std::size_t row = j; row < j + 3; ++row)
                smooth[row] = smooth[row] - penalty[row] * entry(row, j) * c[j];
        return smooth;
    }

private:
    std::span<const Point> points_;
    std::vector<double> h_;

    /// Q(row, j), row in j ... j + 2.
    double entry(std::size_t row, std::size_t j) const {
        if (row == j) return 1 / h_[j];
        if (row == j + 2) return 1 / h_[j + 1];
        return -1 / h_[j] - 1 / h_[j + 1];
    }
    double product(std::size_t j, std::size_t k, std::span<const double> penalty) const {
        double sum = 0;
        for (std::size_t row = k; row < j + 3; ++row) sum += penalty[row] * entry(row, j) * entry(row, k);
        return sum;
    }
};

}  // namespace

SmoothRun smoothed(const SmoothRun& run, double tolerance) {
    const std::size_t n = run.points.size();
    if (n < 3) return run;
    const Unrolled u = unroll(run);
    const SmoothingSystem system(u.points, u.t);
    std::vector<double> penalty(n);
    std::vector<double> moved(n);
    const auto solve = [&] {
        std::vector<double> unrolled(u.points.size());
        for (std::size_t i = 0; i < unrolled.size(); ++i) unrolled[i] = penalty[i % n];
        if (!run.closed) unrolled.front() = unrolled.back() = 0;
        const std::vector<Point> all = system.solve(unrolled);
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(u.first);
        SmoothRun smooth{{begin, begin + static_cast<std::ptrdiff_t>(n)}, run.closed};
        for (std::size_t i = 0; i < n; ++i) moved[i] = distance(smooth.points[i], run.points[i]);
        return smooth;
    };
    const auto beyond = [&] {
        return static_cast<std::size_t>(std::count_if(moved.begin(), moved.end(), [&](double d) {
            return !(d <= tolerance);  // NaN, too
        }));
    };
    // Penalties are cubes of a length: from that of the whole run down, until most points stay within the tolerance.
    constexpr int most_halvings = 160, most_rounds = 100;
    constexpr double strongest_hold = 0.25, target = 0.95;
    std::fill(penalty.begin(), penalty.end(), u.t.back() * u.t.back() * u.t.back());
    SmoothRun smooth = solve();
    for (int k = 0; k < most_halvings && 4 * beyond() > n; ++k) {
        for (double& p : penalty) p *= 0.5;
        smooth = solve();
    }
    for (int k = 0; k < most_rounds && beyond() > 0; ++k) {
        for (std::size_t i = 0; i < n; ++i)
            if (moved[i] > target * tolerance) penalty[i] *= std::max(strongest_hold, target * tolerance / moved[i]);
        smooth = solve();
    }
    for (int k = 0; k < most_halvings && beyond() > 0; ++k) {
        for (double& p : penalty) p *= 0.5;
        smooth = solve();
    }
    return beyond() == 0 ? smooth : run;
}

}  // namespace lamina::surface
