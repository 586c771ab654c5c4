// Last layers of narrow columns, lowered towards the triangles beyond.
#pragma once

#include <span>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// No last layer becomes lower than this share of its height.
inline constexpr double least_taper = 0.4;

/// Lowers the last layer of a column to this share of its height, those below by less and less, and moves them up so that
/// the column keeps its end. The layers of its lower half stay. heights[0] = 0 is the wall, heights.back() the end.
void taper_heights(double taper, std::span<double> heights);

/// Tapers the columns of rays whose last layers are far higher than the front's edges beside them are long, and those
/// beside them a little. Rays with a requested number of layers keep their heights.
void taper_tall_columns(Rays& rays);

}  // namespace lamina::layers
