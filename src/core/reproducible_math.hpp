// Functions that give the same bits on every machine: only + - * /, std::sqrt and std::floor, all exactly specified.
// The C library's sin, cos, atan2 and pow differ between versions; wherever a point is placed or a decision made, use
// these. Source: W. J. Cody, W. Waite, Software Manual for the Elementary Functions (1980): argument reduction by pi/2
// in three parts, Taylor polynomials on [-pi/4, pi/4]; arctangent from a table at multiples of 1/8. Errors stay below
// one unit in the last place or so (tests/core/reproducible_math_test.cpp).
#pragma once

#include <cassert>
#include <cmath>
#include <cstdint>

namespace lamina::core {

inline constexpr double pi = 0x1.921fb54442d18p+1;
constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

namespace reproducible_detail {

/// sin(x + tail) for |x| <= pi/4, tail below an ulp of x.
inline double sine_kernel(double x, double tail) {
    constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880, c11 = -1.0 / 39916800,
                     c13 = 1.0 / 6227020800, c15 = -1.0 / 1307674368000, c17 = 1.0 / 355687428096000;
    const double z = x * x;
    const double p = c5 + z * (c7 + z * (c9 + z * (c11 + z * (c13 + z * (c15 + z * c17)))));
    return x + (z * x * (c3 + z * p) + tail * (1.0 - 0.5 * z));
}

/// cos(x + tail), same conditions.
inline double cosine_kernel(double x, double tail) {
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800, c12 = 1.0 / 479001600,
                     c14 = -1.0 / 87178291200, c16 = 1.0 / 20922789888000;
    const double z = x * x;
    const double p = c4 + z * (c6 + z * (c8 + z * (c10 + z * (c12 + z * (c14 + z * c16)))));
    const double half = 0.5 * z;
    const double w = 1.0 - half;
    return w + (((1.0 - w) - half) + (z * z * p - x * tail));
}

struct ReducedAngle {
    double x, tail;
    int quadrant;  ///< 0..3
};

/// angle = quadrant pi/2 + x + tail (mod 2 pi), |x| <= pi/4. The first two parts of pi/2 hold 33 bits, so their
/// multiples below 2^20 are exact.
inline ReducedAngle reduce_angle(double angle) {
    assert(std::abs(angle) <= 1e6);
    constexpr double part1 = 0x1.921fb544p+0, part2 = 0x1.0b4611a6p-34, part3 = 0x1.3198a2e037073p-69;
    const double n = std::floor(angle * (2 / pi) + 0.5);
    const double first = angle - n * part1;
    const double second = n * part2;
    const double difference = first - second;
    const double third = ((first - difference) - second) - n * part3;
    const double x = difference + third;
    return {x, (difference - x) + third, static_cast<int>(n - 4.0 * std::floor(n / 4.0))};
}

/// atan(t) for 0 <= t <= 1.
inline double arctangent_kernel(double t) {
    struct Entry {
        double high, low;
    };
    static constexpr Entry table[9] = {{0x0.0p+0, 0x0.0p+0},
                                       {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                       {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                       {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                       {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                       {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                       {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                       {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                       {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    const int i = static_cast<int>(8.0 * t + 0.5);
    const double u = (t - 0.125 * i) / (1.0 + t * (0.125 * i));  // |u| <= 1/16
    const double z = u * u;
    const double p = z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13))))));
    return table[i].high + (u + (u * p + table[i].low));
}

}  // namespace reproducible_detail

/// Sine of an angle in radians, |angle| <= 1e6. Odd, exactly.
inline double sin_reproducible(double angle) {
    const auto [x, tail, quadrant] = reproducible_detail::reduce_angle(std::abs(angle));
    const double s =
        quadrant % 2 == 0 ? reproducible_detail::sine_kernel(x, tail) : reproducible_detail::cosine_kernel(x, tail);
    return (quadrant >= 2) != std::signbit(angle) ? -s : s;
}

/// Cosine of an angle in radians, |angle| <= 1e6. Even, exactly.
inline double cos_reproducible(double angle) {
    const auto [x, tail, quadrant] = reproducible_detail::reduce_angle(std::abs(angle));
    const double c =
        quadrant % 2 == 0 ? reproducible_detail::cosine_kernel(x, tail) : reproducible_detail::sine_kernel(x, tail);
    return quadrant == 1 || quadrant == 2 ? -c : c;
}

/// base^exponent for finite base > 0 and 0 <= exponent < 2^31; whole and half powers by products and one square root.
/// The fraction of the exponent goes from its last bit to its first, one square root each, which halves every error
/// made before; products for the whole part add half an ulp each.
inline double pow_reproducible(double base, double exponent) {
    assert(base > 0 && exponent >= 0 && exponent < 2147483648.0);
    constexpr int fraction_bits = 60;
    auto whole = static_cast<std::uint32_t>(exponent);
    auto fraction = static_cast<std::uint64_t>((exponent - whole) * 0x1p60);
    double power = 1;
    for (int bit = 0; bit < fraction_bits; ++bit, fraction >>= 1)
        power = std::sqrt(fraction & 1 ? power * base : power);
    for (double square = base; whole > 0; whole >>= 1, square *= square)
        if (whole & 1) power *= square;
    return power;
}

/// Angle of the vector (x, y), x >= 0 and y >= 0 but not both 0, to 2e-15 radians and without branches: for statistics
/// of many angles. Turned by -pi/8 or -3 pi/8 the vector is within pi/8 of the x axis; arctan(u) / u there is a
/// polynomial in u^2 (Chebyshev nodes, degree 9, relative error 1e-15).
inline double first_quadrant_angle(double y, double x) {
    const bool steep = y > x;
    const double tangent = steep ? 0x1.3504f333f9de6p+1 : 0x1.a827999fcef32p-2;
    const double u = (y - tangent * x) / (x + tangent * y);
    const double z = u * u;
    // Estrin's scheme: a chain of 4 steps instead of 9.
    const double z2 = z * z, z4 = z2 * z2;
    const double p01 = 0x1.ffffffffffff7p-1 - 0x1.5555555550697p-2 * z;
    const double p23 = 0x1.999999922cffap-3 - 0x1.249246f68f241p-3 * z;
    const double p45 = 0x1.c71bcaa82de12p-4 - 0x1.744ea12fe95dbp-4 * z;
    const double p67 = 0x1.3a4ed9d1662d7p-4 - 0x1.0a7c2d0b92b5ep-4 * z;
    const double p89 = 0x1.9ba0e636ba92ep-5 - 0x1.9ec902f46e221p-6 * z;
    const double p = (p01 + z2 * p23) + z4 * ((p45 + z2 * p67) + z4 * p89);
    return (steep ? 0.375 * pi : 0.125 * pi) + u * p;
}

/// Angle of the vector (x, y) in [-pi, pi], as std::atan2 for finite arguments; odd in y, exactly.
/// The quotient may underflow harmlessly.
inline double atan2_reproducible(double y, double x) {
    constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;
    const double ax = std::abs(x), ay = std::abs(y);
    double angle = 0;  // of (ax, ay)
    if (ay > ax) {
        angle = half_pi - (reproducible_detail::arctangent_kernel(ax / ay) - half_pi_low);
    } else if (ax > 0) {
        angle = reproducible_detail::arctangent_kernel(ay / ax);
    }
    if (std::signbit(x)) angle = 2 * half_pi - (angle - 2 * half_pi_low);
    return std::signbit(y) ? -angle : angle;
}

}  // namespace lamina::core
