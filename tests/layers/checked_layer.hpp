// Layers of which check_layer() finds nothing wrong.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include <lamina/layers.hpp>

#include "layers/layer.hpp"
#include "support/layers.hpp"
#include "support/shapes.hpp"

namespace lamina::test {

/// Makes a layer and adds a test failure for each finding of check_layer().
inline Layer checked_layer(const Geometry& geometry, const LayerOptions& options, const BorderOptions& border = {}) {
    Layer layer = test::make_layer(geometry, options, border);
    for (const std::string& finding : check_layer(layer, options, border)) ADD_FAILURE() << finding;
    return layer;
}
inline Layer checked_layer(const shapes::Outline& outline, const LayerOptions& options,
                           const BorderOptions& border = {}) {
    return checked_layer(shapes::geometry({outline}), options, border);
}

}  // namespace lamina::test
