// Last layers, made as high as the triangles beyond are wide.
#pragma once

#include <span>

#include <lamina/layers.hpp>

namespace lamina::layers {

/// Last layers become so many times as high, at the least and at the most.
inline constexpr double least_taper = 0.1, most_taper = 2.0;

/// Makes the last layer of a column so many times as high, those below by less and less, and others give way so that the
/// column keeps its end. The layers of its lower half stay. heights[0] = 0 is the wall, heights.back() the end. The upper
/// half has at least three layers.
void taper_heights(double taper, std::span<double> heights);

/// Tapers the columns of rays whose last layers are far higher or lower than the front's edges beside them are long, and
/// those beside them a little. Rays with a requested number of layers keep their heights.
void taper_columns(Rays& rays);

}  // namespace lamina::layers
