// Stretches of an outline that are samples of a smooth curve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

/// The points of an outline from one corner to the next. A closed run has no corner and does not repeat its first
/// point.
struct SmoothRun {
    std::vector<Point> points;
    bool closed = false;
};

/// Cuts a closed outline at its corners, given by ascending index: one run from each corner to the next, or one closed
/// run where there is no corner.
std::vector<SmoothRun> split_at_corners(std::span<const Point> outline, std::span<const std::size_t> corners);

/// A run as an open sequence of points. A closed run goes on at both ends for at least one round and 40 points: the
/// effect of the ends on a spline fades by a factor of 0.27 per point, so that the middle round is periodic up to
/// rounding. An open run is taken as it is.
struct UnrolledRun {
    std::vector<Point> points;
    std::vector<double> t;  ///< chord length from the first point, per point
    std::size_t first = 0;  ///< index of the run's own first point
};

UnrolledRun unroll(const SmoothRun& run);

}  // namespace lamina::surface
