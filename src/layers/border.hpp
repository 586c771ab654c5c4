// Grading of the layer's outer borders; internal to the layer stage.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>
#include <lamina/sizing.hpp>

namespace lamina {

struct GradingOptions {
    double ratio = 1.4;                        ///< largest ratio of the lengths of adjacent edges
    double gradation = 0.1;                    ///< growth of the target length per unit of distance
    double longest = HUGE_VAL;                 ///< no piece is longer
    std::span<const SizeSource> sources = {};  ///< no piece is longer than size + gradation x distance
    /// Per border and edge that comes of a division: it asks for this many times its length, and is hardly divided
    /// again; 0, or none at all, for the others, which ask for their own.
    std::span<const std::vector<double>> asks = {};
};

/// Per border and edge; edge k runs from corner k to corner k + 1.
struct GradedBorders {
    std::vector<std::vector<std::vector<Point>>> cuts;   ///< the points inside it, in order
    std::vector<std::vector<std::vector<double>>> asks;  ///< GradingOptions::asks for its pieces, should they stay
};

/// Preconditions: borders are simple and disjoint; they meet walls in vertices and whole edges of both only. What comes
/// out is so too: an edge whose division would cross something by rounding stays whole.
/// Points that divide the edges of closed borders so that lengths vary gradually along and between the borders; corners
/// stay and no edge is merged. Target length at x: min over all edges j of (what j asks for + gradation x
/// distance(x, j)), where the parts of an edge that face another one across a gap narrower than the edge count with the
/// width of the gap, and over options.sources.
GradedBorders grade_borders(std::span<const std::vector<Point>> borders, std::span<const std::vector<Point>> walls,
                            const GradingOptions& options);

}  // namespace lamina
