// Layers in one call, and numbers of their options.
#pragma once

#include <variant>

#include <lamina/layers.hpp>

namespace lamina::test {

inline Layer make_layer(const Geometry& geometry, const LayerOptions& options = {}, const BorderOptions& border = {}) {
    return close_border(grow_rays(geometry, options), border);
}

/// The first height of options that give it as a number.
inline double first_height(const LayerOptions& options) { return std::get<double>(options.first_height); }

/// The growth of options that give the first height as a number.
inline LayerGrowth growth_of(const LayerOptions& options) { return layer_growth(options, 1); }

}  // namespace lamina::test
