#include "geometry/scatter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "core/angles.hpp"
#include "core/reproducible_math.hpp"
#include "core/smoothing_system.hpp"

namespace lamina::geometry {

namespace {

/// So many standard deviations are certain.
constexpr double certain = 4;
/// So many are where each of some thousand points is asked.
constexpr double certain_of_many = 5;

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// ---- the measure of noise ------------------------------------------------------------------------------------------

/// Differences of points across an outline, whose direction is that of a chord over some points to both sides, so that
/// it is hardly turned by noise.
class Differences {
public:
    Differences(const PointSequence& sequence, std::size_t half_chord) : s_(sequence), half_chord_(half_chord) {}

    double median_chord() const {
        std::vector<double> lengths;
        for (std::size_t i = first(half_chord_); i < end(half_chord_); ++i) lengths.push_back(length(chord(i)));
        return median(std::move(lengths));
    }

    /// Returns p_i - (p_{i-stride} + p_{i+stride}) / 2 across the outline, of every i for which there is one.
    std::vector<double> second(std::size_t stride) const {
        std::vector<double> values;
        const std::size_t reach = std::max(stride, half_chord_);
        for (std::size_t i = first(reach); i < end(reach); ++i)
            values.push_back(across(i, at(i) - midpoint(at(i - stride), at(i + stride))));
        return values;
    }

    /// Returns the standard deviation of the points by their fourth differences.
    double noise(std::size_t stride) const {
        constexpr double quartile = 0.6744897501960817;  // of the normal distribution
        constexpr double variance = 70;  // of a fourth difference: the sum of squares of 1, -4, 6, -4, 1
        std::vector<double> values;
        const std::size_t reach = std::max(2 * stride, half_chord_);
        for (std::size_t i = first(reach); i < end(reach); ++i) {
            const Point ends = at(i - 2 * stride) + at(i + 2 * stride), next = at(i - stride) + at(i + stride);
            values.push_back(std::abs(across(i, ends - 4 * next + 6 * at(i))));
        }
        return median(std::move(values)) / (quartile * std::sqrt(variance));
    }

private:
    const PointSequence& s_;
    std::size_t half_chord_;

    // Indices are moved by the number of points, so that those before the first one of a ring are not negative.
    std::size_t first(std::size_t reach) const { return s_.points.size() + (s_.is_ring ? 0 : reach); }
    std::size_t end(std::size_t reach) const { return 2 * s_.points.size() - (s_.is_ring ? 0 : reach); }
    Point at(std::size_t i) const { return s_.points[i % s_.points.size()]; }
    Point chord(std::size_t i) const { return at(i + half_chord_) - at(i - half_chord_); }
    double across(std::size_t i, Point difference) const {
        const Point along = chord(i);
        const double size = length(along);
        return size > 0 ? cross(along, difference) / size : 0;
    }
};

/// Returns whether the signs of second differences are correlated as those of white noise are.
bool has_signs_of_noise(const std::vector<double>& differences) {
    // 2/pi arcsin of the correlations -2/3 and 1/6 of second differences.
    constexpr double expected[] = {-0.46455904, 0.10660472};
    constexpr std::size_t lags = 10;
    const double tolerance = certain / std::sqrt(static_cast<double>(differences.size()));
    for (std::size_t lag = 1; lag <= lags; ++lag) {
        double sum = 0;
        for (std::size_t i = lag; i < differences.size(); ++i) {
            const double product = differences[i] * differences[i - lag];
            sum += product > 0 ? 1 : product < 0 ? -1 : 0;
        }
        const double correlation = sum / static_cast<double>(differences.size() - lag);
        if (std::abs(correlation - (lag <= 2 ? expected[lag - 1] : 0)) > tolerance) return false;
        if (lag == 1 && correlation + tolerance > 0) return false;
    }
    return true;
}

// ---- corners -------------------------------------------------------------------------------------------------------

/// Straight lines through windows of a sequence, in constant time each. The points are parametrised by the lengths
/// between means of their neighbours, since those between the points themselves are mostly noise.
class LineFits {
public:
    explicit LineFits(const PointSequence& sequence, std::size_t half_window) {
        const std::size_t n = sequence.points.size(), rounds = sequence.is_ring ? 3 : 1;
        std::vector<Point> all;
        for (std::size_t k = 0; k < rounds * n; ++k) all.push_back(sequence.points[k % n] - sequence.points[0]);
        std::vector<Point> prefix{{0, 0}};
        for (const Point p : all) prefix.push_back(prefix.back() + p);
        Point last{};
        double t = 0;
        sums_.push_back({});
        for (std::size_t i = 0; i < all.size(); ++i) {
            const std::size_t w = std::min({half_window, i, all.size() - 1 - i});
            const Point mean = (1 / static_cast<double>(2 * w + 1)) * (prefix[i + w + 1] - prefix[i - w]);
            if (i > 0) t += distance(mean, last);
            last = mean;
            Sums sum = sums_.back();
            sum.t += t;
            sum.tt += t * t;
            sum.p = sum.p + all[i];
            sum.tp = sum.tp + t * all[i];
            sum.pp += dot(all[i], all[i]);
            sums_.push_back(sum);
        }
    }

    std::size_t size() const { return sums_.size() - 1; }

    struct Line {
        Point direction;
        double spread;    ///< sum of the squared distances of the parameters from their mean
        double residual;  ///< sum of the squared distances of the points from the line
    };
    /// Returns the line through the points from a to b, both included.
    Line fit(std::size_t a, std::size_t b) const {
        const Sums &x = sums_[a], &y = sums_[b + 1];
        const double n = static_cast<double>(b + 1 - a), t = (y.t - x.t) / n;
        const Point p = (1 / n) * (y.p - x.p), tp = (y.tp - x.tp) - n * t * p;
        const double spread = (y.tt - x.tt) - n * t * t;
        const Point direction = (1 / spread) * tp;
        return {direction, spread, (y.pp - x.pp) - n * dot(p, p) - spread * dot(direction, direction)};
    }

private:
    struct Sums {
        double t = 0, tt = 0, pp = 0;
        Point p{}, tp{};
    };
    std::vector<Sums> sums_;  ///< over the points before each
};

/// Searches for corners with more and more points on each side.
class CornerSearch {
public:
    CornerSearch(const PointSequence& sequence, double noise, std::size_t half_window)
        : fits_(sequence, half_window), n_(sequence.points.size()), is_ring_(sequence.is_ring), noise_(noise) {}

    std::vector<std::size_t> run() {
        for (std::size_t m = 2; m < n_ / 8; m += 1 + m / 4)
            if (!search(m)) break;
        std::vector<std::size_t> corners;
        for (const std::size_t c : found_) corners.push_back(c % n_);
        std::sort(corners.begin(), corners.end());
        return corners;
    }

private:
    struct Turn {
        std::size_t at;
        double angle, deviation;
    };
    LineFits fits_;
    std::size_t n_;
    bool is_ring_;
    double noise_;
    std::vector<std::size_t> found_;  ///< indices in the middle round of a ring

    /// Returns how many points at most a window may have to one side of i before it meets a corner or an end.
    std::size_t room(std::size_t i, bool is_after) const {
        std::size_t least = is_ring_ ? n_ / 2 : is_after ? n_ - 1 - i : i;
        for (const std::size_t c : found_) {
            const std::size_t ahead = is_after ? (c + 2 * n_ - i) % n_ : (i + n_ - c % n_) % n_;
            if (is_ring_ || (is_after ? c >= i : c <= i)) least = std::min(least, ahead);
        }
        return least;
    }

    Turn turn(std::size_t i, std::size_t m) const {
        const auto before = fits_.fit(i - m, i), after = fits_.fit(i, i + m);
        return {i, core::angle_between(before.direction, after.direction),
                noise_ * std::sqrt(1 / before.spread + 1 / after.spread)};
    }

    /// Returns whether the outline hardly turns to the same side m points before or after a corner.
    bool is_straight(const Turn& corner, std::size_t m, bool is_after) const {
        constexpr double max_share = 0.2, allowance = 2;  // as CornerFinder's share; in standard deviations
        const std::size_t i = is_after ? corner.at + m : corner.at - m;
        if (room(corner.at, is_after) < 2 * m) return true;
        const Turn beside = turn(i, m);
        const double same_side = corner.angle > 0 ? beside.angle : -beside.angle, angle = std::abs(corner.angle);
        if (angle - same_side < certain_of_many * std::hypot(corner.deviation, beside.deviation)) return false;
        return same_side < max_share * std::min(angle, core::pi - angle) + allowance * beside.deviation;
    }

    /// Returns the place between two windows that leaves the least distances from their lines.
    std::size_t best_place(std::size_t i, std::size_t m) const {
        const std::size_t first = i - std::min(2 * m, room(i, false)), last = i + std::min(2 * m, room(i, true));
        std::size_t best = i;
        double least = HUGE_VAL;
        for (std::size_t k = std::max(first + 2, i - m); k <= std::min(last - 2, i + m); ++k) {
            const double residual = fits_.fit(first, k).residual + fits_.fit(k, last).residual;
            if (residual >= least) continue;
            least = residual;
            best = k;
        }
        return best;
    }

    /// Adds corners that windows of m points tell from noise. Returns whether noise hides some from them yet.
    bool search(std::size_t m) {
        constexpr double min_turning = core::radians(10);  // of corners, as of CornerFinder
        std::vector<Turn> turns;
        bool is_hidden = false;
        const std::size_t first = is_ring_ ? n_ : m, end = is_ring_ ? 2 * n_ : n_ - m;
        for (std::size_t i = first; i < end; ++i) {
            if (room(i, false) < m || room(i, true) < m) continue;
            const Turn t = turn(i, m);
            const double hidden = certain_of_many * std::sqrt(2.0) * t.deviation;
            is_hidden = is_hidden || hidden > min_turning;
            if (std::abs(t.angle) > std::max(min_turning, hidden)) turns.push_back(t);
        }
        std::stable_sort(turns.begin(), turns.end(),
                         [](const Turn& a, const Turn& b) { return std::abs(a.angle) > std::abs(b.angle); });
        std::vector<std::size_t> seen;
        for (const Turn& t : turns) {
            const bool is_near = std::any_of(seen.begin(), seen.end(), [&](std::size_t k) {
                const std::size_t apart = k > t.at ? k - t.at : t.at - k;
                return std::min(apart, is_ring_ ? n_ - apart : apart) <= m;
            });
            if (is_near || room(t.at, false) < m || room(t.at, true) < m) continue;
            seen.push_back(t.at);
            if (!is_straight(t, m, false) || !is_straight(t, m, true)) continue;
            found_.push_back(best_place(t.at, m));
        }
        return is_hidden;
    }
};

// ---- smoothing -----------------------------------------------------------------------------------------------------

/// A stretch between two corners that becomes a smoothing spline.
class NoisyStretch {
public:
    NoisyStretch(std::vector<Point> points, double noise) : points_(std::move(points)), noise_(noise) {}

    /// Returns the points on the spline, whose ends are free.
    std::vector<Point> smoothed() {
        if (points_.size() < 3) return points_;
        std::vector<double> t(points_.size());
        for (std::size_t i = 0; i < t.size(); ++i) t[i] = static_cast<double>(i);
        const std::vector<Point> rough = fit(t);
        for (std::size_t i = 1; i < t.size(); ++i) {
            // Points that were equal by rounding are moved apart.
            const double least = 1e-9 * noise_;
            t[i] = t[i - 1] + std::max(distance(rough[i - 1], rough[i]), least);
        }
        return fit(t);
    }

    /// Returns the points on the spline of the last penalties from one fixed end to another.
    std::vector<Point> between(Point first, Point last) {
        if (points_.size() < 3) return {first, last};
        points_.front() = first;
        points_.back() = last;
        penalty_.front() = penalty_.back() = 0;
        return core::SmoothingSystem(points_, t_).solve(penalty_);
    }

private:
    std::vector<Point> points_;
    double noise_;
    std::vector<double> t_, penalty_;

    /// Lowers the penalty until stretches of points move no farther than their noise, first alike, then where they
    /// still do.
    std::vector<Point> fit(const std::vector<double>& t) {
        constexpr int max_halvings = 160, max_rounds = 12;
        constexpr std::size_t share =
            20;  // one of so many may still move too far before penalties are lowered one by one
        constexpr double factor = 0.5;
        t_ = t;
        const core::SmoothingSystem system(points_, t_);
        const double length = t_.back();
        penalty_.assign(points_.size(), length * length * length);
        std::vector<Point> smooth = system.solve(penalty_);
        for (int k = 0; k < max_halvings; ++k) {
            const std::vector<bool> excess = moved_too_far(smooth);
            if (share * static_cast<std::size_t>(std::count(excess.begin(), excess.end(), true)) <= excess.size())
                break;
            for (double& p : penalty_) p *= 0.5;
            smooth = system.solve(penalty_);
        }
        for (int k = 0; k < max_rounds; ++k) {
            const std::vector<bool> excess = moved_too_far(smooth);
            if (std::find(excess.begin(), excess.end(), true) == excess.end()) break;
            for (std::size_t i = 0; i < excess.size(); ++i)
                if (excess[i]) penalty_[i] *= factor;
            smooth = system.solve(penalty_);
        }
        return smooth;
    }

    /// Returns, per point, whether the points around it moved to one side by more, in the mean, than noise explains.
    std::vector<bool> moved_too_far(std::span<const Point> smooth) const {
        constexpr std::size_t half_windows[] = {5, 20};  // those of a nose are few
        const std::size_t n = points_.size();
        std::vector<Point> prefix{{0, 0}};
        for (std::size_t i = 0; i < n; ++i) prefix.push_back(prefix.back() + (1 / noise_) * (smooth[i] - points_[i]));
        std::vector<bool> excess(n);
        for (const std::size_t half_window : half_windows)
            for (std::size_t i = 0; i < n; ++i) {
                const std::size_t first = i - std::min(i, half_window), end = std::min(n, i + half_window + 1);
                // The sum scatters by the root of the number of points in each coordinate. NaN counts as too far.
                const double most = certain * certain * static_cast<double>(end - first);
                if (!(squared_length(prefix[end] - prefix[first]) <= most)) excess[i] = true;
            }
        return excess;
    }
};

}  // namespace

std::optional<double> white_noise(const PointSequence& sequence) {
    constexpr std::size_t min_scattered = 100;          // fewer are never certain
    constexpr double min_turning = core::radians(0.2);  // what a flow solver overlooks
    constexpr double min_chord = 8;                     // in standard deviations, so that noise turns it little
    constexpr double scatter_of_median = 1.1664;        // standard deviation of the estimate times sqrt(n)
    const std::size_t n = sequence.points.size();
    if (n < min_scattered) return {};
    std::size_t half_chord = 2;
    double noise = 0;
    for (;; half_chord *= 2) {
        if (half_chord > n / 16) return {};
        const Differences differences(sequence, half_chord);
        noise = differences.noise(1);
        if (!(noise > 0)) return {};
        if (differences.median_chord() >= min_chord * noise) break;
    }
    const Differences differences(sequence, half_chord);
    const double spacing = differences.median_chord() / static_cast<double>(2 * half_chord);
    if (std::sqrt(6.0) * noise < min_turning * spacing) return {};
    // The estimates of two distances scatter by sqrt(2) each, and neighbouring differences have points in common.
    const double tolerance = certain * 2 * scatter_of_median / std::sqrt(static_cast<double>(n));
    for (const std::size_t stride : {2u, 3u})
        if (std::abs(differences.noise(stride) - noise) > tolerance * noise) return {};
    if (!has_signs_of_noise(differences.second(1))) return {};
    return noise;
}

std::vector<std::size_t> find_corners_above_noise(const PointSequence& sequence, double noise) {
    // Means over so many points scatter by a small part of the distance between them.
    const std::size_t n = sequence.points.size();
    std::size_t half_window = 2;
    while (half_window < n / 16 && Differences(sequence, half_window).median_chord() < 8 * noise) half_window *= 2;
    return CornerSearch(sequence, noise, half_window).run();
}

std::vector<Point> without_noise(const PointSequence& sequence, std::span<const std::size_t> corners, double noise) {
    const std::vector<Point>& given = sequence.points;
    const std::size_t n = given.size();
    const auto points_from = [&](std::size_t first, std::size_t count) {
        std::vector<Point> points;
        for (std::size_t k = 0; k < count; ++k) points.push_back(given[(first + k) % n]);
        return points;
    };
    if (sequence.is_ring && corners.empty()) {
        const std::vector<Point> smooth = NoisyStretch(points_from(0, 3 * n), noise).smoothed();
        const auto first = smooth.begin() + static_cast<std::ptrdiff_t>(n);
        return {first, first + static_cast<std::ptrdiff_t>(n)};
    }
    std::vector<std::size_t> ends(corners.begin(), corners.end());
    if (!sequence.is_ring) {
        if (ends.empty() || ends.front() != 0) ends.insert(ends.begin(), 0);
        if (ends.back() != n - 1) ends.push_back(n - 1);
    }
    const std::size_t count = sequence.is_ring ? ends.size() : ends.size() - 1;
    std::vector<NoisyStretch> stretches;
    std::vector<Point> at_end(ends.size());  // sums of the places where the splines of both sides end
    for (std::size_t k = 0; k < count; ++k) {
        const std::size_t first = ends[k], last = k + 1 < ends.size() ? ends[k + 1] : ends[0] + n;
        const std::vector<Point> smooth =
            stretches.emplace_back(points_from(first, last + 1 - first), noise).smoothed();
        at_end[k] = at_end[k] + smooth.front();
        at_end[(k + 1) % ends.size()] = at_end[(k + 1) % ends.size()] + smooth.back();
    }
    std::vector<Point> result(n);
    for (std::size_t k = 0; k < ends.size(); ++k) {
        const bool is_between_two = sequence.is_ring || (k > 0 && k + 1 < ends.size());
        if (is_between_two) at_end[k] = 0.5 * at_end[k];
    }
    for (std::size_t k = 0; k < count; ++k) {
        const std::vector<Point> smooth = stretches[k].between(at_end[k], at_end[(k + 1) % ends.size()]);
        for (std::size_t j = 0; j < smooth.size(); ++j) result[(ends[k] + j) % n] = smooth[j];
    }
    return result;
}

}  // namespace lamina::geometry
