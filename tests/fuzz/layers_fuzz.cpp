// Grows layers round one or two star-shaped bodies, whose rays get in each other's way. The layer must have no defect.
#include <cmath>

#include <lamina/error.hpp>
#include <lamina/geometry.hpp>
#include <lamina/layers.hpp>

#include "core/reproducible_math.hpp"
#include "fuzz/fuzz.hpp"
#include "layers/layer.hpp"

namespace {

/// Returns a closed outline whose distance from its centre changes from point to point.
lamina::Element read_body(lamina::fuzz::Numbers& numbers, lamina::Point centre) {
    lamina::Element body;
    const std::size_t n = 4 + numbers.below(28);
    for (std::size_t i = 0; i < n; ++i) {
        const double turn = lamina::core::radians(360.0 * static_cast<double>(i) / static_cast<double>(n));
        const double radius = numbers.real(0.02, 0.5);
        body.points.push_back(centre + radius * lamina::Point{lamina::core::cos_reproducible(turn),
                                                              lamina::core::sin_reproducible(turn)});
    }
    return body;
}

}  // namespace

void lamina::fuzz::fuzz(std::span<const std::uint8_t> input) {
    Numbers numbers(input);
    LayerOptions options;
    options.first_height = input_units(numbers.real(1e-6, 1e-2));
    options.growth = numbers.real(1, 1.6);
    options.layers = static_cast<std::uint32_t>(1 + numbers.below(20));
    options.max_ray_angle_deg = numbers.real(2, 60);
    options.corners = static_cast<CornerRays>(numbers.below(2));
    const bool two = numbers.below(2) == 0;
    const double gap = numbers.real(0, 1.2);
    Geometry geometry;
    geometry.elements.push_back(read_body(numbers, {0, 0}));
    geometry.elements.back().name = "first";
    if (two) {
        geometry.elements.push_back(read_body(numbers, {0.4 + gap, 0.1}));
        geometry.elements.back().name = "second";
    }
    try {
        check_simple(geometry);
        const layers::Layer layer = layers::make_layer(geometry, options);
        require(check_layer(layer, options).empty(), "the layer has a defect");
        fill_layer(layer, LayerTopology::delaunay);
    } catch (const Error&) {
    }
}
