// Lengths that options hold: in chords of the configuration, or in units of the input.
#pragma once

#include <cstdint>
#include <string>

#include <lamina/export.hpp>

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

/// Reads "0.003", which means chords, or "0.003u", which means units of the input. Throws UsageError with the bare
/// reason.
LAMINA_EXPORT Length parse_length(const std::string& text);
/// Returns the text that parse_length() reads back.
LAMINA_EXPORT std::string length_text(Length length);

}  // namespace lamina
