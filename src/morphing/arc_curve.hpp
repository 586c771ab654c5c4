// Curves by arc length.
#pragma once

#include <vector>

#include <lamina/point.hpp>

#include "surface/spline.hpp"

namespace lamina::morphing {

/// The spline of the surface stage through some points, as a function of arc length.
class ArcCurve {
public:
    explicit ArcCurve(const surface::SmoothRun& run);

    /// Returns the arc length up to each point of the run, and up to the end of a closed one.
    const std::vector<double>& arc_lengths() const { return arc_; }
    double length() const { return arc_.back(); }
    /// Returns the point at an arc length from 0 to length().
    Point at(double arc_length) const;

private:
    surface::SplineCurve curve_;
    std::vector<double> arc_;
};

}  // namespace lamina::morphing
