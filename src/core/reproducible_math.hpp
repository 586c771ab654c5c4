// Elementary functions that return the same bits on every machine, since they use only + - * /, std::sqrt and
// std::floor, all of which are exactly specified. The C library's sin, cos, atan2 and pow differ between versions; use
// the functions below wherever a point is placed or a decision made.
// Source: W. J. Cody, W. Waite, Software Manual for the Elementary Functions (1980). Errors stay below about one unit
// in the last place (tests/core/reproducible_math_test.cpp).
#pragma once

#include <lamina/export.hpp>

namespace lamina::core {

inline constexpr double pi = 0x1.921fb54442d18p+1;
constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

/// Returns the sine of an angle in radians, |angle| <= 1e6. The function is odd, exactly.
LAMINA_EXPORT double sin_reproducible(double angle);

/// Returns the cosine of an angle in radians, |angle| <= 1e6. The function is even, exactly.
LAMINA_EXPORT double cos_reproducible(double angle);

/// Returns the angle of the vector (x, y) in [-pi, pi], as std::atan2 does for finite arguments. The function is odd in
/// y, exactly.
LAMINA_EXPORT double atan2_reproducible(double y, double x);

/// Returns base^exponent for finite base > 0 and 0 <= exponent < 2^31. Whole and half powers are made of products and
/// one square root.
LAMINA_EXPORT double pow_reproducible(double base, double exponent);

/// Returns the natural logarithm of a finite value > 0, subnormal ones included.
LAMINA_EXPORT double log_reproducible(double value);

/// Returns e^exponent for a finite exponent: 0 below -745.2, infinity above 709.8, as std::exp does.
LAMINA_EXPORT double exp_reproducible(double exponent);

/// Returns the angle of the vector (x, y) to 2e-15 radians, for x >= 0 and y >= 0 that are not both 0. It is inline and
/// has no branches, for statistics of many angles. Turned by -pi/8 or -3 pi/8 the vector is within pi/8 of the x axis,
/// where arctan(u) / u is a polynomial in u^2 (Chebyshev nodes, degree 9, relative error 1e-15).
inline double first_quadrant_angle(double y, double x) {
    const bool steep = y > x;
    const double tangent = steep ? 0x1.3504f333f9de6p+1 : 0x1.a827999fcef32p-2;
    const double u = (y - tangent * x) / (x + tangent * y);
    const double z = u * u;
    // Estrin's scheme has a chain of 4 dependent steps instead of 9.
    const double z2 = z * z, z4 = z2 * z2;
    const double p01 = 0x1.ffffffffffff7p-1 - 0x1.5555555550697p-2 * z;
    const double p23 = 0x1.999999922cffap-3 - 0x1.249246f68f241p-3 * z;
    const double p45 = 0x1.c71bcaa82de12p-4 - 0x1.744ea12fe95dbp-4 * z;
    const double p67 = 0x1.3a4ed9d1662d7p-4 - 0x1.0a7c2d0b92b5ep-4 * z;
    const double p89 = 0x1.9ba0e636ba92ep-5 - 0x1.9ec902f46e221p-6 * z;
    const double p = (p01 + z2 * p23) + z4 * ((p45 + z2 * p67) + z4 * p89);
    return (steep ? 0.375 * pi : 0.125 * pi) + u * p;
}

}  // namespace lamina::core
