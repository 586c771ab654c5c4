// The stretch with which a column of layers ends at a given height.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "layers/parameters.hpp"
#include "layers/stages.hpp"

namespace lamina::layers {

/// Returns the last layer below those that are stretched: half of the layers keep their heights, and so does the first.
inline std::uint32_t last_unstretched(std::uint32_t layers) { return std::max(layers / 2, std::uint32_t{1}); }

/// Stretches a column. heights[0] = 0 is the wall.
void stretch_heights(const Stretch& stretch, std::span<double> heights);

/// Returns the number of layers that end at `height` with the stretch that is nearest to 1. heights: those of
/// unstretched layers, heights[0] = 0 and heights[1] <= height.
std::uint32_t layers_up_to(double height, std::span<const double> heights);

/// The numbers of layers with which a column can end at a height.
struct LayerRange {
    std::uint32_t least, most;
};

/// Returns the numbers next to `wanted` with which the column ends at `height`, if it is stretched by no more than
/// max_stretch. heights: those of unstretched layers.
LayerRange layer_range(double height, std::span<const double> heights, std::uint32_t wanted);

/// Returns the stretch, by up to max_stretch, with which n layers end at `height` but for rounding, or next to it; none
/// for one layer, whose height no stretch changes.
Stretch stretch_of_layers(double height, std::span<const double> heights, std::uint32_t n);

/// Returns the height of the topmost of n layers with that stretch.
double stretched_last_spacing(double height, std::span<const double> heights, std::uint32_t n);

// The heights of last layers, made to match the triangles beyond.

/// Returns the stretch, above this layer, with which the last layer of a column becomes `ratio` times as high and the
/// column keeps its end. heights[0] = 0 is the wall. Precondition: at least two layers lie above `above`.
Stretch stretch_to_last_spacing(double ratio, std::span<const double> heights, std::uint32_t above);

/// Changes the last layers of columns that are far higher or lower than the front's edges beside them are long, and
/// those beside them a little. Columns with a requested number of layers keep their heights.
void fit_end_spacings(Rays& rays);

}  // namespace lamina::layers
