#include "surface/smoothing_spline.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/smoothing_system.hpp"

namespace lamina::surface {

namespace {

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
    core::SmoothingSystem system_;
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
