// Round numbers on axes and bars.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace lamina::plot {

/// Returns 1, 2 or 5 times a power of ten, the largest that fits at least `parts` times into the range. Preconditions:
/// the range is positive.
inline double round_step(double range, double parts) {
    const double power = std::pow(10, std::floor(std::log10(range / parts)));
    double step = power;
    for (const double factor : {2.0, 5.0})
        if (range / (factor * power) >= parts) step = factor * power;
    return step;
}

/// Returns the text of a multiple of a step, with as many digits as tell it from the next one.
inline std::string step_text(double number, double step) {
    // What is left of a difference of equal numbers is no number to print.
    if (std::abs(number) < 1e-9 * step) return "0";
    const double digits = std::clamp(std::ceil(std::log10(std::abs(number) / step)) + 1, 6.0, 16.0);
    return fmt::format("{:.{}g}", number, static_cast<int>(digits));
}

}  // namespace lamina::plot
