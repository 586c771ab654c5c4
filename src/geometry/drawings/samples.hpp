// Points on the curves of a chain, so dense that a spline through them is the curve.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "geometry/drawings/chains.hpp"
#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// The points of a chain in their order; of a closed one the last repeats the first.
struct SampledChain {
    std::vector<SourcePoint> points;
    bool has_curves =
        false;  ///< whether some of it is not straight; the vertices of polylines are all that is known else
};

/// Returns a few points of a chain, for its box and its area.
std::vector<Point> rough_points(std::span<const FlatCurve> curves, const Chain& chain);

/// Samples a chain: straight parts have their vertices alone, and curves so many points that no edge leaves the curve
/// by more than `max_deviation`, turns by more than some degrees or is longer than 1 % of `size`. Between two corners
/// neighbouring edges differ by a factor of about 2 at most, for which straight parts beside curves are divided.
/// Corners are the places where a chain with curves turns at once by more than a degree. Throws InputError for too many
/// points.
SampledChain sample(std::span<const FlatCurve> curves, const Chain& chain, double size, double max_deviation,
                    const std::string& file);

}  // namespace lamina::geometry
