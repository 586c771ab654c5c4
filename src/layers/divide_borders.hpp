// The division of fronts into edges of gradually varying length, which makes them outer borders.
#pragma once

#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// How the edges of fronts are divided. Both members hold one list per front and edge; edge k runs from corner k to
/// corner k + 1.
struct BorderDivision {
    std::vector<std::vector<std::vector<Point>>> points;  ///< the division points inside the edge, in order
    /// One number per part of the edge: the target length there over the length of the part, at least 1.
    std::vector<std::vector<std::vector<double>>> target_factors;
};

/// Divides the edges of fronts so that lengths vary gradually along and between the fronts. Corners stay, and no edges
/// are merged. The target length at x is the minimum over all edges j of (the length that j requests + gradation x
/// distance(x, j)) and likewise over options.sources. An edge requests its own length. Where parts of it face another
/// edge across a gap narrower than the edge, they request the width of the gap. target_factors holds one number per
/// front and edge, or is empty. A number above 0 is for an edge that comes of a division: the edge requests this many
/// times its length and is hardly divided again.
/// Precondition: the fronts are simple and disjoint; they meet walls only in vertices and whole edges of both. The
/// result is so, too: an edge whose division would cross something by rounding stays whole.
BorderDivision divide_borders(std::span<const std::vector<Point>> fronts, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> target_factors = {});

}  // namespace lamina::layers
