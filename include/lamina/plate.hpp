// The first layer of a mesh by hand: what a flat plate needs at a Reynolds number, before there is a section.
//
// Guarantees:
//  1. plate_layer() and plate_layer_of_height() are inverse to each other.
// Limits:
//  1. A section has lower first layers at its suction peak, and higher ones where its flow is slow: solve_flow() knows both.
// Example:
//     const PlateLayer layer = plate_layer({.y_plus = 1}, 6e6);
//     assert(layer.first_height > 4.4e-6 && layer.first_height < 4.5e-6);  // chords
//     assert(layer.layers > 30 && layer.layers < 45);  // of growth 1.2
#pragma once

#include <cstddef>

#include <lamina/export.hpp>
#include <lamina/length.hpp>

namespace lamina {

/// What a flat plate as long as the chord needs. Lengths are in units of the chord.
struct PlateLayer {
    double y_plus = 0;         ///< of the top of the first layer
    double first_height = 0;   ///< its height
    double skin_friction = 0;  ///< the coefficient at the end of the plate that y+ follows from
    double thickness = 0;      ///< of the boundary layer at the end of the plate
    std::size_t layers = 0;    ///< number of layers of geometric growth that are as high as that
};

/// Returns the layer whose first height has this y+. First height and friction are those of turbulent flow at any
/// Reynolds number; the boundary layer is laminar below 1e4. Throws OptionError for numbers that are not positive, a
/// growth that is not above 1, and where no first height above 0 follows. Source: F. M. White, Fluid Mechanics, 5th ed.
/// (2003), section 7.4.
LAMINA_EXPORT PlateLayer plate_layer(YPlus y_plus, double reynolds, double chord = 1, double growth = 1.2);
/// Returns the layer of this first height, in the unit of the chord. Throws likewise.
LAMINA_EXPORT PlateLayer plate_layer_of_height(double first_height, double reynolds, double chord = 1,
                                               double growth = 1.2);

}  // namespace lamina
