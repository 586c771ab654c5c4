// Colours and scales of colours.
#pragma once

#include <cstdint>

namespace lamina::plot {

/// Red, green and blue, each from 0 to 1.
struct Color {
    double r, g, b;
};

/// Pictures are drawn on paper, with ink.
inline constexpr Color paper{1, 1, 1}, ink{0.13, 0.16, 0.22};

/// Returns a for t = 0, b for t = 1, and a mixture between.
Color mix(Color a, Color b, double t);

/// Returns a colour of a scale from dark blue (t = 0) over green to yellow (t = 1). Equal steps look equal, in grey and
/// to the colour-blind as well. Source: viridis, S. van der Walt and N. Smith, matplotlib (2015), nine of its entries.
Color viridis(double t);

/// Returns a soft colour that differs clearly from those of the neighbouring numbers: the hues are multiples of the
/// golden ratio.
Color distinct_color(std::uint32_t number);

}  // namespace lamina::plot
