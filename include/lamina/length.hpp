// Lengths that options hold: in chords of the configuration, or in units of the input.
//
// Example:
//     LayerOptions layer;
//     layer.first_height = 1e-5;              // chords
//     layer.thickness = input_units(0.02);    // units of the coordinates
//     assert(in_units(*layer.thickness, 0.5) == 0.02 && in_chords(*layer.thickness, 0.5) == 0.04);
#pragma once

#include <cstdint>

namespace lamina {

/// The units that a length may be counted in.
enum class LengthUnit : std::uint8_t {
    chord,  ///< reference chords: reference_conditions() of conditions.hpp
    input,  ///< units of the input
};

/// A height, thickness, size or distance. A plain number converts to that many chords.
struct Length {
    double value = 0;                     ///< the number
    LengthUnit unit = LengthUnit::chord;  ///< what it counts

    constexpr Length() = default;
    /// Makes a length in chords.
    constexpr Length(double chords) : value(chords) {}  // NOLINT(*-explicit-*): chords are what numbers mean
    /// Makes a length in either unit.
    constexpr Length(double number, LengthUnit counted) : value(number), unit(counted) {}
    /// Returns whether numbers and units are equal.
    friend constexpr bool operator==(const Length&, const Length&) = default;
};

/// Returns a length of so many units of the input.
constexpr Length input_units(double value) { return {value, LengthUnit::input}; }
/// Returns the length in units of the input, where a chord has so many of them.
constexpr double in_units(Length length, double chord) {
    return length.unit == LengthUnit::input ? length.value : length.value * chord;
}
/// Returns the length in chords of so many units of the input.
constexpr double in_chords(Length length, double chord) {
    return length.unit == LengthUnit::chord ? length.value : length.value / chord;
}

/// A first height that follows from the flow (conditions.hpp): the top of the first layer lies at this y+ on a flat
/// plate as long as the chord: y+ chord / (Re sqrt(cf / 2)), with cf = 0.026 / Re^(1/7).
struct YPlus {
    double y_plus = 1;  ///< height of the first layer in units of the viscous length
};

}  // namespace lamina
