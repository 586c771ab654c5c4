// Digitisation noise: points that zigzag about the curve they were read from.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

struct Noise {
    std::size_t vertices = 0;  ///< that zigzag
    double turning = 0;        ///< the most of them, in radians
    double amplitude = 0;      ///< about the largest distance from the curve between the zigzag
};

/// A section has a few inflections; where the sense of turning changes at three vertices in a row, and by more than the
/// eye of a flow solver misses (0.2 degrees), the points scatter about the curve. `corners` are left out, ascending.
Noise find_noise(std::span<const Point> outline, std::span<const std::size_t> corners);

/// Points that stand off the curve through their neighbours, as slips of the pen do: the outline turns there by more
/// than 15 degrees to one side and, at both neighbours, to the other; without the point it would turn at the neighbours
/// by less than a third of that. Ascending.
std::vector<std::size_t> find_misplaced(std::span<const Point> outline);

}  // namespace lamina::surface
