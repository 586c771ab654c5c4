// The layer that a flat plate needs: first height by y+, and layers up to the boundary layer's thickness.
#include <lamina/plate.hpp>

#include <algorithm>
#include <cmath>

#include <lamina/error.hpp>

#include "core/option_builders.hpp"
#include "core/reproducible_math.hpp"
#include "flow/boundary_layer.hpp"
#include "layers/growth.hpp"

namespace lamina {

PlateLayer plate_layer(YPlus y_plus, double reynolds, double chord, double growth) {
    require_in_range(numbers_above(1), growth, "growth");
    PlateLayer layer{.y_plus = y_plus.y_plus, .first_height = layers::first_height_for(y_plus.y_plus, reynolds, chord)};
    const double in_wall_units = y_plus.y_plus * chord / (reynolds * layer.first_height);
    layer.skin_friction = 2 * in_wall_units * in_wall_units;
    const bool turbulent = !flow::is_laminar({.reynolds = reynolds});
    layer.thickness = chord * flow::flat_plate(1, 1 / reynolds, turbulent).thickness;
    // n layers are h (r^n - 1) / (r - 1) high.
    const double added = layer.thickness * (growth - 1) / layer.first_height;
    if (!std::isfinite(added) || !std::isfinite(layer.first_height))
        throw OptionError("y_plus", "is out of range at this Reynolds number: no first height above 0 follows from it");
    const double layers = core::log_reproducible(1 + added) / core::log_reproducible(growth);
    layer.layers = static_cast<std::size_t>(std::max(1.0, std::ceil(layers)));
    return layer;
}

PlateLayer plate_layer_of_height(double first_height, double reynolds, double chord, double growth) {
    require_in_range(positive_numbers, first_height, "first_height");
    const double height_of_one = layers::first_height_for(1, reynolds, chord);
    return plate_layer({first_height / height_of_one}, reynolds, chord, growth);
}

}  // namespace lamina
