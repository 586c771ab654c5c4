// Smooth curves through the points of an outline.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

/// Points of an outline from corner to corner; a closed run has no corner and does not repeat its first point.
struct SmoothRun {
    std::vector<Point> points;
    bool closed = false;
};

/// A cubic through points p(t), t the chord length from the first; once differentiable, twice wherever the points
/// allow.
class Curve {
public:
    explicit Curve(const SmoothRun& run);

    /// The number of pieces; a closed curve has as many as points, an open one one less.
    std::size_t pieces() const { return t_.size() - 1; }
    /// Parameters of the piece's ends.
    double start(std::size_t piece) const { return t_[piece]; }
    double end(std::size_t piece) const { return t_[piece + 1]; }

    /// The point at `share` in [0, 1] of a piece, and the derivative there (about of unit length).
    Point at(std::size_t piece, double share) const;
    Point direction(std::size_t piece, double share) const;

private:
    std::vector<double> t_;
    std::vector<Point> points_, slopes_;  ///< a closed curve's first stands again at the end
};

/// The run with every point moved by at most `tolerance`, ends of an open run by nothing, such that the integral of the
/// squared second derivative is about the least that this allows: a smoothing spline of as large a penalty as most
/// points allow, those that it would move too far held back by weights. Source: C. H. Reinsch, Smoothing by spline
/// functions, Numer. Math. 10 (1967).
SmoothRun smoothed(const SmoothRun& run, double tolerance);

}  // namespace lamina::surface
