// Rounding that takes away what no decision should hang on. Two inputs that differ in their last bits, such as the same
// section in two units, give values that differ by rounding errors, which grow where values are differences of near
// ones. Rounded to fewer bits such values are equal again, unless they lie just beside a boundary.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include <lamina/point.hpp>

namespace lamina::core {

/// Returns a whole multiple of a step next to the value, an odd function of the value. The nearer one, but for the
/// multiple nearer to 0 the value has to be nearer than 0.41 steps: values in the middle between two, a third or a
/// quarter of a step from one, are common. Precondition: the step is a power of two, and the value less than 2^51
/// steps.
inline double rounded_to_multiple(double value, double step) {
    constexpr double beyond_middle = 0x1.5f06cp-4;
    // Numbers near 1.5 x 2^52 steps have no other bits than those of whole steps.
    const double whole = 0x1.8p52 * step;
    return std::copysign((std::abs(value) + beyond_middle * step + whole) - whole, value);
}

/// Returns a point with both coordinates rounded to multiples of a step, as rounded_to_multiple() does.
inline Point rounded_to_multiples(Point p, double step) {
    return {rounded_to_multiple(p.x, step), rounded_to_multiple(p.y, step)};
}

/// Returns the largest power of two that is not above a value. Precondition: the value is positive and normal.
inline double power_of_two_below(double value) {
    constexpr std::uint64_t exponent_bits = 0x7ff0'0000'0000'0000;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & exponent_bits);
}

/// Returns the step of coordinates on the borders of a row of blades of this pitch, of which the pitch is a multiple
/// once it is rounded to it. Their sums with the pitch then are exact up to 4096 pitches from the origin.
inline double border_step(double pitch) { return 0x1p-40 * power_of_two_below(pitch); }

/// Returns a place on a piece of a curve, as a share of the piece, rounded to about a thousandth of an edge, given the
/// share of the piece that an edge there takes. What is within that of an end of the piece is this end. A piece that is
/// run through the other way has the same places.
inline double rounded_place(double share, double edge_share) {
    constexpr double middle = 0.5;  // a multiple of all steps
    return middle + rounded_to_multiple(share - middle, std::min(0x1p-10 * power_of_two_below(edge_share), middle));
}

/// Returns whether a vector points to larger x or, where its x is 0 but for rounding, to larger y. Of a vector and its
/// opposite, one does.
inline bool is_forward(Point v) {
    constexpr double rounding = 1e-9;
    return std::abs(v.x) > rounding * std::abs(v.y) ? v.x > 0 : v.y > 0;
}

}  // namespace lamina::core
