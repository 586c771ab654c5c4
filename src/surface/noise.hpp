// Digitisation noise: points that zigzag about the curve they were read from, or that stand off it one by one.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <lamina/point.hpp>

namespace lamina::surface {

/// Returns, for each vertex of a closed outline with these turning angles in radians, whether the outline zigzags: the
/// sense of turning changes on both sides of the vertex, and it turns by more than `min_turning` there and at both
/// neighbours.
std::vector<bool> find_zigzags(std::span<const double> turning, double min_turning);

/// An estimate of the noise of an outline.
struct NoiseEstimate {
    std::size_t vertices = 0;  ///< number of vertices that zigzag
    double max_turning = 0;    ///< largest turning of these vertices, in radians
    double amplitude = 0;      ///< largest distance of these vertices from the curve, about
};

/// Estimates the noise of a closed outline. A section has a few inflections only: where the sense of turning changes at
/// three vertices in a row, and each turns by more than a flow solver overlooks (0.2 degrees), the points scatter about
/// the curve. The corners, by ascending index, are left out.
NoiseEstimate estimate_noise(std::span<const Point> outline, std::span<const std::size_t> corners);

/// Returns the indices, ascending, of points of a closed outline that stand off the curve through their neighbours, as
/// slips of the pen do. The outline turns there by more than 15 degrees to one side and, at both neighbours, to the
/// other side. Without the point it would turn at the neighbours by less than a third of that.
std::vector<std::size_t> find_misplaced_points(std::span<const Point> outline);

}  // namespace lamina::surface
