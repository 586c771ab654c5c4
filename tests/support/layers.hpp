// Layers made in one call, and the growth of their options.
#pragma once

#include <variant>

#include <lamina/layers.hpp>

namespace lamina::test {

/// Grows rays and closes the border.
inline Layer make_layer(const Geometry& geometry, const LayerOptions& options = {}, const BorderOptions& border = {}) {
    return close_border(grow_rays(geometry, options), border);
}

/// Returns the options of the layers in the thesis: 30 layers on a chord of 1, each 15 % higher than the one below,
/// with rays at most 4 degrees apart.
inline LayerOptions thesis_layer(CornerRays corners = CornerRays::fan) {
    LayerOptions options;
    options.first_height = 2.5e-5;
    options.growth = 1.15;
    options.layers = 30;
    options.max_ray_angle_deg = 4;
    options.corners = corners;
    return options;
}

/// Returns the first height of options that give it as a length.
inline double first_height(const LayerOptions& options) { return std::get<double>(options.first_height); }

/// Returns the growth of options that give the first height as a length.
inline LayerGrowth growth_of(const LayerOptions& options) { return layer_growth(options, 1); }

}  // namespace lamina::test
