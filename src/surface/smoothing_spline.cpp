#include "surface/smoothing_spline.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace lamina::surface {

namespace {

/// The linear system of a smoothing spline with one penalty per point (penalty over weight). The spline g minimises sum
/// |g_i - p_i|^2 / penalty_i + integral |g''|^2. Its second derivatives c at the inner points satisfy (R + Q'PQ) c =
/// Q'p, and g = p - PQ c, where R is tridiagonal, Q has three bands, and P is the diagonal of the penalties. A penalty
/// of 0 holds a point where it is.
class SmoothingSystem {
public:
    SmoothingSystem(std::span<const Point> points, std::span<const double> t) : points_(points) {
        for (std::size_t i = 0; i + 1 < t.size(); ++i) h_.push_back(t[i + 1] - t[i]);
    }

    /// Returns the values of the spline at the points.
    std::vector<Point> solve(std::span<const double> penalty) const {
        const std::size_t n = points_.size(), m = n - 2;
        // The banded symmetric matrix, as its diagonal and two bands beside it, and later its factors L D L'.
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
    std::vector<double> h_;  ///< chord length from each point to the next

    /// Returns Q(row, j) for row from j to j + 2.
    double entry(std::size_t row, std::size_t j) const {
        if (row == j) return 1 / h_[j];
        if (row == j + 2) return 1 / h_[j + 1];
        return -1 / h_[j] - 1 / h_[j + 1];
    }
    /// Returns (Q'PQ)(j, k) for k from j to j + 2.
    double product(std::size_t j, std::size_t k, std::span<const double> penalty) const {
        double sum = 0;
        for (std::size_t row = k; row < j + 3; ++row) sum += penalty[row] * entry(row, j) * entry(row, k);
        return sum;
    }
};

/// A run, its penalties, and the points of the smoothing spline with these penalties.
class RunSmoother {
public:
    RunSmoother(const SmoothRun& run, double tolerance)
        : run_(run), tolerance_(tolerance), unrolled_(unroll(run)), system_(unrolled_.points, unrolled_.t) {}

    const SmoothRun& result() const { return smooth_; }

    /// Returns the number of points that moved by more than the tolerance; NaN counts as more.
    std::size_t count_moved_too_far() const {
        return static_cast<std::size_t>(
            std::count_if(moved_.begin(), moved_.end(), [&](double d) { return !(d <= tolerance_); }));
    }

    /// Solves with one penalty for all points: the cube of the chord length of the whole run, since penalties are cubes
    /// of lengths.
    void start() {
        const double length = unrolled_.t.back();
        penalty_.assign(run_.points.size(), length * length * length);
        solve();
    }

    void halve_penalties() {
        for (double& p : penalty_) p *= 0.5;
        solve();
    }

    /// Lowers the penalties of points that moved too far, or nearly so, in proportion to their excess.
    void hold_back() {
        constexpr double min_factor = 0.25, target_share = 0.95;
        const double target = target_share * tolerance_;
        for (std::size_t i = 0; i < penalty_.size(); ++i)
            if (moved_[i] > target) penalty_[i] *= std::max(min_factor, target / moved_[i]);
        solve();
    }

private:
    const SmoothRun& run_;
    double tolerance_;
    UnrolledRun unrolled_;
    SmoothingSystem system_;
    std::vector<double> penalty_;  ///< per point of the run
    std::vector<double> moved_;    ///< distance of each point from where it was
    SmoothRun smooth_;

    void solve() {
        const std::size_t n = run_.points.size();
        std::vector<double> penalty(unrolled_.points.size());
        for (std::size_t i = 0; i < penalty.size(); ++i) penalty[i] = penalty_[i % n];
        if (!run_.closed) penalty.front() = penalty.back() = 0;
        const std::vector<Point> all = system_.solve(penalty);
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(unrolled_.first);
        smooth_ = {{begin, begin + static_cast<std::ptrdiff_t>(n)}, run_.closed};
        moved_.resize(n);
        for (std::size_t i = 0; i < n; ++i) moved_[i] = distance(smooth_.points[i], run_.points[i]);
    }
};

}  // namespace

SmoothRun smoothed(const SmoothRun& run, double tolerance) {
    constexpr int max_halvings = 160, max_rounds = 100;
    const std::size_t n = run.points.size();
    if (n < 3) return run;
    RunSmoother smoother(run, tolerance);
    smoother.start();
    // One penalty for all points is lowered until three quarters of them stay within the tolerance, then the others are
    // held back. Whatever still moves too far makes all penalties smaller.
    for (int k = 0; k < max_halvings && 4 * smoother.count_moved_too_far() > n; ++k) smoother.halve_penalties();
    for (int k = 0; k < max_rounds && smoother.count_moved_too_far() > 0; ++k) smoother.hold_back();
    for (int k = 0; k < max_halvings && smoother.count_moved_too_far() > 0; ++k) smoother.halve_penalties();
    return smoother.count_moved_too_far() == 0 ? smoother.result() : run;
}

}  // namespace lamina::surface
