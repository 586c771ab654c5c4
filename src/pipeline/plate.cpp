// The layer that a flat plate needs: first height by y+, and layers up to the boundary layer's thickness.
#include <lamina/plate.hpp>

#include <cmath>

#include "core/option_builders.hpp"
#include "flow/boundary_layer.hpp"
#include "layers/growth.hpp"

namespace lamina {

PlateLayer plate_layer(YPlus y_plus, double reynolds, double chord, double growth) {
    require_in_range(numbers_above(1), growth, "growth");
    PlateLayer layer{.y_plus = y_plus.y_plus, .first_height = layers::first_height_for(y_plus.y_plus, reynolds, chord)};
    const double in_wall_units = y_plus.y_plus * chord / (reynolds * layer.first_height);
    layer.skin_friction = 2 * in_wall_units * in_wall_units;
    const bool turbulent = !flow::is_laminar({.reynolds = reynolds});
    layer.thickness = flow::flat_plate(chord, chord / reynolds, turbulent).thickness;
    double height = layer.first_height;
    for (double top = 0; top < layer.thickness; height *= growth, ++layer.layers) top += height;
    return layer;
}

PlateLayer plate_layer_of_height(double first_height, double reynolds, double chord, double growth) {
    require_in_range(positive_numbers, first_height, "first_height");
    const double height_of_one = layers::first_height_for(1, reynolds, chord);
    return plate_layer({first_height / height_of_one}, reynolds, chord, growth);
}

}  // namespace lamina
