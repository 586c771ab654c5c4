// The target spacing of points along the curves of an outline.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include <lamina/geometry.hpp>
#include <lamina/point.hpp>

#include "core/lexicographic_order.hpp"
#include "geometry/wall_spacing.hpp"
#include "surface/spline.hpp"

namespace lamina::surface {

/// A bound on the spacing at one place of an outline.
struct PointSpacing {
    Point at;
    double spacing;
};

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
    double clearance_share;                    ///< largest spacing as a share of the free room
    std::vector<geometry::WallSpacing> walls;  ///< largest spacings at stretches of the outline
    /// Bounds that hold at the nearest point of the outline each. They may be below min_spacing.
    std::vector<PointSpacing> point_spacings;
};

/// One of the curves that follow each other round an outline. Each ends where the next one starts; a single closed
/// curve may have no corner.
struct OutlineCurve {
    SplineCurve curve;
    double start_spacing = 0;    ///< largest spacing where it starts; infinity means no bound
    bool is_kept = false;        ///< whether its edges are fixed; it is a straight line then
    std::size_t kept_edges = 1;  ///< number of equal edges, where they are fixed
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

/// A curve with samples whose spacings obey the bounds of a rule that hold along it, but not those at its ends and at
/// points.
struct SampledCurve {
    SplineCurve curve;
    CurveSamples samples;
    double turning;  ///< angle by which the curve turns from end to end, in radians, positive to the left
};
/// Sampled curves by the points where they start.
using SampledCurves = std::map<Point, SampledCurve, core::LexicographicOrder>;

/// The samples of all curves of an outline, and the angles by which the curves turn. Both lists hold one entry per
/// curve.
struct SampledOutline {
    std::vector<CurveSamples> samples;
    std::vector<double> turning;  ///< as of SampledCurve
};

/// Returns samples of each curve with the spacing that the rule allows, before gradation. The spacing of a kept curve
/// is the length of its edges, but no less than min_spacing. Curves that are in `known` already, by the same rule, are
/// taken from there; others are added.
SampledOutline sample_spacings(std::span<const OutlineCurve> curves, const SpacingRule& rule, SampledCurves& known);

/// Lowers spacings until none grows faster than `gradation` per unit of arc length, all round the outline and across
/// its corners. Kept curves stay as they are and bound the spacings at their ends.
void limit_gradation(std::span<const OutlineCurve> curves, std::vector<CurveSamples>& samples, double gradation);

/// Does the same where all spacings were limited before, and only those on both sides of the start of a curve have been
/// lowered since. Sets is_changed of the curves on which spacings are lowered.
void limit_gradation_from(std::size_t curve, std::span<const OutlineCurve> curves, std::vector<CurveSamples>& samples,
                          double gradation, std::vector<bool>& is_changed);

}  // namespace lamina::surface
