// The target spacing of points along the curves of an outline.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

#include "surface/spline.hpp"

namespace lamina::surface {

/// Bounds on the edges of an outline. Lengths are in units of the input.
struct SpacingRule {
    double max_spacing;
    double min_spacing;       ///< no other bound asks for less
    double max_turning;       ///< of the curve along an edge, in radians
    double tolerance;         ///< largest distance of an edge from the curve
    double gradation;         ///< growth of the spacing per unit of arc length
    double max_corner_ratio;  ///< of the lengths of the edges on both sides of a corner
    /// Returns the free room outside of a point of the outline, given the point and the outward unit normal there. May
    /// be empty.
    std::function<double(Point, Point)> clearance;
    double clearance_share;          ///< largest spacing as a share of the free room
    std::vector<WallSpacing> walls;  ///< largest spacings at stretches of the outline
};

/// A sample of a curve, with the target spacing there.
struct CurveSample {
    std::size_t piece;  ///< index of the curve's cubic piece
    double share;       ///< position on the piece, from 0 to 1
    double arc_length;  ///< from the start of the curve, about
    Point at;
    double spacing;  ///< target length of edges
};
using CurveSamples = std::vector<CurveSample>;

/// Returns samples of each curve with the spacing that the rule allows, before gradation. corner_spacing holds, per
/// curve, the largest spacing at its start; infinity means no bound. Curves follow each other round an outline.
std::vector<CurveSamples> sample_spacings(std::span<const SplineCurve> curves, std::span<const double> corner_spacing,
                                          const SpacingRule& rule);

/// Lowers spacings until none grows faster than `gradation` per unit of arc length, all round the outline and across
/// its corners.
void limit_gradation(std::vector<CurveSamples>& curves, double gradation);

/// Returns the angle by which a curve turns from one sample to another, in radians, positive to the left.
double turning_between(const SplineCurve& curve, const CurveSample& from, const CurveSample& to);

}  // namespace lamina::surface
