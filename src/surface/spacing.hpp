// The division of a closed outline's curves into edges.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "surface/spline.hpp"

namespace lamina::surface {

/// What edges are wanted, in units of the input.
struct SpacingRule {
    double longest;
    double shortest;     ///< nothing else asks for less
    double turning;      ///< of the curve along an edge, in radians
    double tolerance;    ///< of an edge from the curve
    double growth;       ///< of the spacing per unit of arc length
    double worst_ratio;  ///< of the spacings on both sides of a corner
    /// Free room outside of a point of the outline, by the point and the unit normal; empty = no limit.
    std::function<double(Point, Point)> room;
    double room_share;  ///< of that room
};

struct Division {
    std::vector<Point> points;
    /// By curve: index of its first point.
    std::vector<std::size_t> starts;
    double deviation = 0;  ///< largest distance of the curves from the edges
};

/// Divides curves that follow each other round an outline, each ending where the next one starts (a single closed one
/// may have no corner). corner_spacing: by curve, wanted where it starts, infinite for no wish. Each curve gets a whole
/// number of edges, an even one where it turns by more than 90 degrees, so that a symmetric nose keeps its vertex.
Division divide(std::span<const Curve> curves, std::span<const double> corner_spacing, const SpacingRule& rule);

/// The same with all wishes scaled so that there are about `edges` edges.
Division divide_into(std::span<const Curve> curves, std::span<const double> corner_spacing, const SpacingRule& rule,
                     std::size_t edges);

}  // namespace lamina::surface
