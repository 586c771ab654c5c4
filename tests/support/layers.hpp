// Layers made in one call, and the growth of their options.
#pragma once

#include <cstdint>
#include <variant>

#include <lamina/layers.hpp>

namespace lamina::test {

/// Returns the options of so many layers, each higher than the one below by the growth.
inline LayerOptions layers_of(double first_height, double growth, std::uint32_t layers) {
    LayerOptions options;
    options.first_height = first_height;
    options.growth = growth;
    options.layers = layers;
    return options;
}

/// Returns the options of the layers in the thesis: 30 layers on a chord of 1, each 15 % higher than the one below,
/// with rays at most 4 degrees apart.
inline LayerOptions thesis_layer(CornerRays corners = CornerRays::fan) {
    LayerOptions options = layers_of(2.5e-5, 1.15, 30);
    options.max_ray_angle_deg = 4;
    options.corners = corners;
    return options;
}

/// Returns the first height of options that give it as a length.
inline double first_height(const LayerOptions& options) { return std::get<Length>(options.first_height).value; }

/// Returns the growth of options that give the first height as a length, round a chord of 1.
inline LayerGrowth growth_of(const LayerOptions& options) {
    validate(options);
    return layer_growth(options, {});
}

/// Grows rays and closes the border. All lengths are in units of the shape, whatever its extent is.
inline Layer make_layer(const Geometry& geometry, const LayerOptions& options = {}, const BorderOptions& border = {}) {
    return close_border(grow_rays(geometry, options, growth_of(options)), border);
}

}  // namespace lamina::test
