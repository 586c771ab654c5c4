// The division of fronts into edges of gradually varying length, which makes them outer borders.
#pragma once

#include <span>
#include <vector>

#include <lamina/point.hpp>

#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// How the edges of fronts are divided. Both members hold one entry per front and edge; edge k runs from corner k to
/// corner k + 1.
struct BorderDivision {
    std::vector<std::vector<std::vector<Point>>> points;  ///< the division points inside the edge, in order
    std::vector<std::vector<double>> excess;              ///< length of the edge over the target length along it
};

/// Divides the edges of fronts so that lengths vary gradually along and between the fronts. Corners stay, and no edges
/// are merged. The target length at x is the minimum over all edges j of (the length that j requests + gradation x
/// distance(x, j)) and likewise over options.sources. An edge requests its own length. Where parts of it face another
/// edge across a gap narrower than the edge, they request the width of the gap. least_requests holds one length per
/// front and edge, or is empty; no edge requests less than that. whole_up_to holds one number per front and edge, or is
/// empty: that many times its target length an edge may be long and stay whole, but where it is longer than a source
/// asks for. The points of an edge of the wall are on its curve. Edges that lie back to back, as both sides of a sheet
/// without layers, get the same points. Precondition: the fronts are simple and disjoint; they meet walls only in
/// vertices and whole edges of both. The result is so, too: an edge whose division would cross something by rounding
/// stays whole.
BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> least_requests = {},
                              std::span<const std::vector<double>> whole_up_to = {},
                              const PlaceOnWall& place_on_wall = {});

}  // namespace lamina::layers
