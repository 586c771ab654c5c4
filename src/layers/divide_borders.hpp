// Division of the layer's outer borders into edges of gradually varying length.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// How the edges of closed borders are divided, per border and edge; edge k runs from corner k to corner k + 1.
struct BorderDivision {
    std::vector<std::vector<std::vector<Point>>> points;  ///< the division points inside the edge, in order
    /// For each part of the edge, how many times its own length it asks for should it become an edge of its own.
    std::vector<std::vector<std::vector<double>>> factors;
};

/// Divides the edges of closed borders so that lengths vary gradually along and between the borders; corners stay and
/// no edge is merged. The target length at x is the minimum over all edges j of (what j asks for + gradation x
/// distance(x, j)) and over options.sources. An edge asks for its own length; its parts that face another edge across a
/// gap narrower than the edge ask for the width of the gap. An edge with a factor, which came of a division, asks for
/// factor times its length and is hardly divided again; `factors` holds one per border and edge, 0 for edges without,
/// or is empty.
/// Precondition: borders are simple and disjoint; they meet walls in vertices and whole edges of both only. The result
/// is so too: an edge whose division would cross something by rounding stays whole.
BorderDivision divide_borders(std::span<const std::vector<Point>> borders, std::span<const std::vector<Point>> walls,
                              const BorderOptions& options, std::span<const std::vector<double>> factors = {});

}  // namespace lamina::layers
