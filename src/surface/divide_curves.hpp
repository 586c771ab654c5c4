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
    std::vector<double> positions;    ///< per point: where it is on its curve, in pieces from the start
    std::vector<std::size_t> starts;  ///< per curve: index of its first point
    double deviation = 0;             ///< largest distance of the curves from the edges
};

/// Divides the curves of an outline so that edges equidistribute the integral of ds / spacing. Each curve that is not
/// kept gets a whole number of edges, and an even one where it turns by more than 90 degrees, so that a symmetric nose
/// keeps its vertex. `known` holds samples of curves, as for sample_spacings().
DividedCurves divide_curves(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known);

/// Divides curves likewise, but with all spacings scaled so that there are about `edges` edges.
DividedCurves divide_curves_into(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known,
                                 std::size_t edges);

/// Returns, per curve, the integral of ds / spacing along each of its pieces: the number of edges, a real one, that the
/// rule puts in place of it.
std::vector<std::vector<double>> edges_of_pieces(std::span<const OutlineCurve> curves, const SpacingRule& rule,
                                                 SampledCurves& known);

/// Returns the least number of edges of a curve that is not kept. An outline has at least three edges.
std::size_t least_edges_of_curve(std::span<const OutlineCurve> curves);

/// Curves that get a number of edges together.
struct CurveGroup {
    std::vector<std::size_t> curves;  ///< their numbers; none is kept
    std::size_t edges = 0;
};

/// Divides curves likewise, but into exactly so many edges in each group: its spacings are scaled so that the integrals
/// of ds / spacing amount to that number, and each curve gets the whole number of edges nearest to its integral, odd or
/// even, of which the largest remainders take what is left. Precondition: each curve that is not kept is in one group,
/// and each group has least_edges_of_curve() for each of its curves.
DividedCurves divide_curves_exactly(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known,
                                    std::span<const CurveGroup> groups);

}  // namespace lamina::surface
