#include "surface/spline.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/angles.hpp"

namespace lamina::surface {

namespace {

/// Returns the slope at the first of three points of the parabola through them.
Point end_slope(Point secant, double h, Point next_secant, double next_h) {
    return secant + (h / (h + next_h)) * (secant - next_secant);
}

/// Returns the slopes of the cubic spline, which are those of parabolas at its ends. They solve the usual tridiagonal
/// system, which needs no pivoting.
std::vector<Point> spline_slopes(std::span<const Point> points, std::span<const double> t) {
    const std::size_t n = points.size();
    const auto h = [&](std::size_t i) { return t[i + 1] - t[i]; };
    const auto secant = [&](std::size_t i) { return (1 / h(i)) * (points[i + 1] - points[i]); };
    if (n == 2) return {secant(0), secant(0)};

    std::vector<Point> slopes(n);
    std::vector<double> upper_band(n);
    slopes[0] = end_slope(secant(0), h(0), secant(1), h(1));
    slopes[n - 1] = end_slope(secant(n - 2), h(n - 2), secant(n - 3), h(n - 3));
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = h(i - 1), after = h(i);
        const Point right = 3.0 * (after * secant(i - 1) + before * secant(i)) - after * slopes[i - 1];
        const double pivot = 2 * (before + after) - after * upper_band[i - 1];
        upper_band[i] = before / pivot;
        slopes[i] = (1 / pivot) * right;
    }
    for (std::size_t i = n - 1; i-- > 1;) slopes[i] = slopes[i] - upper_band[i] * slopes[i + 1];
    return slopes;
}

/// Limits slopes where the spline would overshoot, since spacings jump or points wiggle. Each slope is kept between the
/// directions of the two chords at its point, with a margin for inflections between points, and its length near 1:
///
///        i ____ i+1        The slope at i lies between the chords from i-1 to i and from i to i+1, or beyond them by
///         /                at most a quarter of the turning at i-1, i and i+1 together.
///     i-1
///
/// Where one of the two chords is more than 20 times as long as the other one, the slope is near its direction: as on
/// the flank behind a small round nose, the long edge would otherwise bulge by its share of what the short one turns.
std::vector<Point> limit_slopes(std::vector<Point> slopes, std::span<const Point> points) {
    constexpr double margin_share = 0.25, min_length = 0.5, max_length = 1.6, max_chord_ratio = 20;
    const std::size_t n = points.size();
    if (n < 3) return slopes;
    std::vector<double> turning(n);
    for (std::size_t i = 1; i + 1 < n; ++i)
        turning[i] = core::angle_between(points[i] - points[i - 1], points[i + 1] - points[i]);
    const auto limit = [&](std::size_t i, Point chord, double lower, double upper) {
        const double given_length = length(slopes[i]);
        const double given_angle = given_length > 0 ? core::angle_between(chord, slopes[i]) : 0;
        const double limited_length = std::clamp(given_length, min_length, max_length);
        const double limited_angle = std::clamp(given_angle, lower, upper);
        if (limited_angle != given_angle) {
            slopes[i] = limited_length * unit(core::rotated(chord, limited_angle));
        } else if (limited_length != given_length) {
            slopes[i] = limited_length * unit(slopes[i]);
        }
    };
    const auto chord = [&](std::size_t i) { return distance(points[i], points[i + 1]); };
    // Returns the share of the turning between two chords that counts on the first of them.
    const auto share_on = [&](double on, double other) { return std::min(1.0, max_chord_ratio * other / on); };
    const auto turning_on_next = [&](std::size_t i) {
        return i > 0 ? std::abs(turning[i]) * share_on(chord(i), chord(i - 1)) : 0;
    };
    const auto turning_on_last = [&](std::size_t i) {
        return i + 1 < n ? std::abs(turning[i]) * share_on(chord(i - 1), chord(i)) : 0;
    };
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double margin = margin_share * (turning_on_next(i - 1) + std::abs(turning[i]) + turning_on_last(i + 1));
        const double share = std::min(share_on(chord(i - 1), chord(i)), share_on(chord(i), chord(i - 1)));
        double lower = std::min(0.0, turning[i]) - margin, upper = std::max(0.0, turning[i]) + margin;
        if (share < 1) {
            const double direction = chord(i) > chord(i - 1) ? turning[i] : 0;  // of the longer chord
            lower = direction + share * (lower - direction);
            upper = direction + share * (upper - direction);
        }
        limit(i, points[i] - points[i - 1], lower, upper);
    }
    const double first = turning_on_last(1), last = turning_on_next(n - 2);
    limit(0, points[1] - points[0], -first, first);
    limit(n - 1, points[n - 1] - points[n - 2], -last, last);
    return slopes;
}

}  // namespace

SplineCurve::SplineCurve(const SmoothRun& run) {
    const UnrolledRun unrolled = unroll(run);
    const std::vector<Point> slopes = limit_slopes(spline_slopes(unrolled.points, unrolled.t), unrolled.points);
    const std::size_t count = run.closed ? run.points.size() + 1 : run.points.size();
    for (std::size_t i = unrolled.first; i < unrolled.first + count; ++i) {
        t_.push_back(unrolled.t[i] - unrolled.t[unrolled.first]);
        points_.push_back(unrolled.points[i]);
        slopes_.push_back(slopes[i]);
    }
    if (run.closed) slopes_.back() = slopes_.front();
}

SplineCurve SplineCurve::part(std::size_t first, std::size_t count) const {
    SplineCurve part;
    part.t_.push_back(0);
    part.points_.push_back(points_[first]);
    part.slopes_.push_back(slopes_[first]);
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t piece = (first + k) % pieces();
        part.t_.push_back(part.t_.back() + (t_[piece + 1] - t_[piece]));
        part.points_.push_back(points_[piece + 1]);
        part.slopes_.push_back(slopes_[piece + 1]);
    }
    return part;
}

Point SplineCurve::at(std::size_t piece, double share) const {
    const double h = t_[piece + 1] - t_[piece], u = share, v = 1 - share;
    if (share <= 0) return points_[piece];
    if (share >= 1) return points_[piece + 1];
    return v * v * (1 + 2 * u) * points_[piece] + u * u * (1 + 2 * v) * points_[piece + 1] +
           (h * u * v * v) * slopes_[piece] - (h * u * u * v) * slopes_[piece + 1];
}

Point SplineCurve::between(double from, double to, double share) const {
    const auto length_at = [&](double position) {
        const auto piece = std::min(static_cast<std::size_t>(position), pieces() - 1);
        return t_[piece] + (position - static_cast<double>(piece)) * (t_[piece + 1] - t_[piece]);
    };
    const double start = length_at(from), t = start + share * (length_at(to) - start);
    const auto next = std::upper_bound(t_.begin() + 1, t_.end() - 1, t);
    const auto piece = static_cast<std::size_t>(next - t_.begin()) - 1;
    return at(piece, (t - t_[piece]) / (t_[piece + 1] - t_[piece]));
}

Point SplineCurve::direction(std::size_t piece, double share) const {
    const double h = t_[piece + 1] - t_[piece], u = share, v = 1 - share;
    return (6 * u * v / h) * (points_[piece + 1] - points_[piece]) + v * (v - 2 * u) * slopes_[piece] +
           u * (u - 2 * v) * slopes_[piece + 1];
}

}  // namespace lamina::surface
