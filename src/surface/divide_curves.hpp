// The division of the curves of a closed outline into edges.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "surface/spacing.hpp"
#include "surface/spline.hpp"

namespace lamina::surface {

/// The vertices of an outline that was divided.
struct DividedCurves {
    std::vector<Point> points;
    std::vector<std::size_t> starts;  ///< per curve: index of its first point
    double deviation = 0;             ///< largest distance of the curves from the edges
};

/// Divides curves that follow each other round an outline, so that edges equidistribute the integral of ds / spacing.
/// Each curve ends where the next one starts; a single closed curve may have no corner. corner_spacing holds, per
/// curve, the largest spacing at its start; infinity means no bound. Each curve gets a whole number of edges, and an
/// even one where it turns by more than 90 degrees, so that a symmetric nose keeps its vertex.
DividedCurves divide_curves(std::span<const SplineCurve> curves, std::span<const double> corner_spacing,
                            const SpacingRule& rule);

/// Divides curves likewise, but with all spacings scaled so that there are about `edges` edges.
DividedCurves divide_curves_into(std::span<const SplineCurve> curves, std::span<const double> corner_spacing,
                                 const SpacingRule& rule, std::size_t edges);

}  // namespace lamina::surface
