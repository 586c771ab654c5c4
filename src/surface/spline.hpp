// Interpolating cubic splines.
// Source: C. de Boor, A Practical Guide to Splines (1978), chapter 4.
#pragma once

#include <cstddef>
#include <vector>

#include <lamina/point.hpp>

#include "surface/smooth_run.hpp"

namespace lamina::surface {

/// A cubic through the points of a run, parametrised by chord length. It is once continuously differentiable, and twice
/// wherever its tangents were not limited to keep it from overshooting.
class SplineCurve {
public:
    explicit SplineCurve(const SmoothRun& run);

    /// Returns `count` consecutive pieces from piece `first` on as a curve of their own. Those of a closed curve are
    /// counted round it.
    SplineCurve part(std::size_t first, std::size_t count) const;

    bool operator==(const SplineCurve& other) const = default;

    /// Returns the number of cubic pieces. A closed curve has one per point, an open one has one less.
    std::size_t pieces() const { return t_.size() - 1; }

    /// Returns the point at `share`, in [0, 1], of a piece.
    Point at(std::size_t piece, double share) const;
    /// Returns the point at `share`, in [0, 1], of the chord length between two positions, which count in pieces from
    /// the start of the curve. Precondition: 0 <= from < to <= pieces().
    Point between(double from, double to, double share) const;
    /// Returns the derivative at `share` of a piece, a vector of about unit length.
    Point direction(std::size_t piece, double share) const;

private:
    SplineCurve() = default;

    std::vector<double> t_;      ///< chord length from the first point, per point
    std::vector<Point> points_;  ///< the first one of a closed curve stands again at the end
    std::vector<Point> slopes_;  ///< derivative by t, per point
};

}  // namespace lamina::surface
