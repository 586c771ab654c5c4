// The heights of last layers, made to match the triangles beyond.
#pragma once

#include <span>

#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the stretch, above this layer, with which the last layer of a column becomes `ratio` times as high and the column
/// keeps its end. heights[0] = 0 is the wall. Precondition: at least two layers lie above `above`.
Stretch stretch_to_last_spacing(double ratio, std::span<const double> heights, std::uint32_t above);

/// Changes the last layers of columns that are far higher or lower than the front's edges beside them are long, and those
/// beside them a little. Columns with a requested number of layers keep their heights.
void fit_end_spacings(Rays& rays);

}  // namespace lamina::layers
