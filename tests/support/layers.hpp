// Layers made in one call, and the growth of their options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include <lamina/layers.hpp>

#include "layers/layer.hpp"
#include "layers/stages.hpp"

namespace lamina {
using namespace layers;  // tests call the stages of the layer by their names
}

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

/// Makes a layer. All lengths are in units of the shape, whatever its extent is.
inline Layer make_layer(const Geometry& geometry, const LayerOptions& options = {}, const BorderOptions& border = {}) {
    return lamina::make_layer(geometry, options, growth_of(options), border);
}

/// Returns rays in a row below a wall, so far apart. The last one and the first one are neighbours as on every element.
inline RaySet rays_in_a_row(const std::vector<double>& widths) {
    RaySet set;
    double x = 0;
    for (const double width : widths) {
        set.lines.push_back({{x, 0}, {0, -1}});
        x += width;
    }
    set.begin.push_back(widths.size());
    return set;
}

/// Returns widths of columns that are wide at first, a twentieth narrower from one to the next, so narrow in the
/// middle, and become wide again in the same way.
inline std::vector<double> widths_with_narrow_middle(double wide, double narrow, std::size_t narrow_columns) {
    std::vector<double> widths;
    for (double width = wide; width > narrow; width *= 0.95) widths.push_back(width);
    const std::vector<double> side = widths;
    widths.insert(widths.end(), narrow_columns, narrow);
    widths.insert(widths.end(), side.rbegin(), side.rend());
    return widths;
}

}  // namespace lamina::test
