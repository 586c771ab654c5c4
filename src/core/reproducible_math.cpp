#include "core/reproducible_math.hpp"

#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace lamina::core {

namespace {

/// Returns sin(x + tail) by the Taylor polynomial, for |x| <= pi/4 and a tail below an ulp of x.
double sine_kernel(double x, double tail) {
    constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880, c11 = -1.0 / 39916800,
                     c13 = 1.0 / 6227020800, c15 = -1.0 / 1307674368000, c17 = 1.0 / 355687428096000;
    const double z = x * x;
    const double p = c5 + z * (c7 + z * (c9 + z * (c11 + z * (c13 + z * (c15 + z * c17)))));
    return x + (z * x * (c3 + z * p) + tail * (1.0 - 0.5 * z));
}

/// Returns cos(x + tail) by the Taylor polynomial, under the conditions of sine_kernel().
double cosine_kernel(double x, double tail) {
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800, c12 = 1.0 / 479001600,
                     c14 = -1.0 / 87178291200, c16 = 1.0 / 20922789888000;
    const double z = x * x;
    const double p = c4 + z * (c6 + z * (c8 + z * (c10 + z * (c12 + z * (c14 + z * c16)))));
    const double half = 0.5 * z;
    const double w = 1.0 - half;
    return w + (((1.0 - w) - half) + (z * z * p - x * tail));
}

/// An angle as quadrant x pi/2 + x + tail (mod 2 pi).
struct ReducedAngle {
    double x;      ///< |x| <= pi/4
    double tail;   ///< the part of the remainder that x is too short for
    int quadrant;  ///< 0 to 3
};

/// Subtracts the nearest multiple of pi/2, which is given in three parts. The first two hold 33 bits each, so that
/// their multiples below 2^20 are exact.
ReducedAngle reduce_angle(double angle) {
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

/// Returns atan(t) for 0 <= t <= 1: the arctangent of the nearest multiple of 1/8 from a table, and that of the rest by
/// its Taylor polynomial.
double arctangent_kernel(double t) {
    struct TableEntry {
        double high, low;
    };
    static constexpr TableEntry table[9] = {{0x0.0p+0, 0x0.0p+0},
                                            {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                            {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                            {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                            {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                            {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                            {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                            {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                            {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    // NOLINTNEXTLINE(bugprone-incorrect-roundings): t >= 0, and beside a tie either entry is near enough
    const int i = static_cast<int>(8.0 * t + 0.5);
    const double u = (t - 0.125 * i) / (1.0 + t * (0.125 * i));  // |u| <= 1/16
    const double z = u * u;
    const double p = z * (-1.0 / 3 + z * (1.0 / 5 + z * (-1.0 / 7 + z * (1.0 / 9 + z * (-1.0 / 11 + z * (1.0 / 13))))));
    return table[i].high + (u + (u * p + table[i].low));
}

/// ln 2 in two parts. The first holds 32 bits, so that its multiples below 2^20 are exact.
constexpr double ln2_high = 0x1.62e42feep-1, ln2_low = 0x1.a39ef35793c76p-33;

/// Returns log(1 + f) - f for |f| <= 0.42 by the series of the inverse hyperbolic tangent in t = f / (2 + f):
/// log(1 + f) = 2 t + t R = f - (f^2 / 2 - t (f^2 / 2 + R)), which adds R to a term that is exactly known.
/// It adds `low`, too.
double logarithm_kernel(double f, double low) {
    constexpr double c1 = 2.0 / 3, c2 = 2.0 / 5, c3 = 2.0 / 7, c4 = 2.0 / 9, c5 = 2.0 / 11, c6 = 2.0 / 13,
                     c7 = 2.0 / 15, c8 = 2.0 / 17, c9 = 2.0 / 19, c10 = 2.0 / 21;
    const double t = f / (2.0 + f);
    const double z = t * t, z2 = z * z, z4 = z2 * z2;  // z <= 0.0295
    const double p =
        ((c1 + z * c2) + z2 * (c3 + z * c4)) + z4 * ((c5 + z * c6) + z2 * (c7 + z * c8)) + z4 * z4 * (c9 + z * c10);
    const double half_square = 0.5 * f * f;
    return (t * (half_square + z * p) + low) - half_square;
}

/// Returns e^(x + tail) - 1 by the Taylor polynomial, for |x| <= ln(2) / 2 and a tail below an ulp of x.
double exponential_kernel(double x, double tail) {
    constexpr double c3 = 1.0 / 6, c4 = 1.0 / 24, c5 = 1.0 / 120, c6 = 1.0 / 720, c7 = 1.0 / 5040, c8 = 1.0 / 40320,
                     c9 = 1.0 / 362880, c10 = 1.0 / 3628800, c11 = 1.0 / 39916800, c12 = 1.0 / 479001600,
                     c13 = 1.0 / 6227020800;
    const double z = x * x, z2 = z * z, z4 = z2 * z2;
    const double p = ((c3 + x * c4) + z * (c5 + x * c6)) + z2 * ((c7 + x * c8) + z * (c9 + x * c10)) +
                     z4 * ((c11 + x * c12) + z * c13);
    return x + (tail + (0.5 * z + z * x * p));
}

/// Returns 2^exponent for -1022 <= exponent <= 1023.
double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

}  // namespace

double sin_reproducible(double angle) {
    const auto [x, tail, quadrant] = reduce_angle(std::abs(angle));
    const double s = quadrant % 2 == 0 ? sine_kernel(x, tail) : cosine_kernel(x, tail);
    return (quadrant >= 2) != std::signbit(angle) ? -s : s;
}

double cos_reproducible(double angle) {
    const auto [x, tail, quadrant] = reduce_angle(std::abs(angle));
    const double c = quadrant % 2 == 0 ? cosine_kernel(x, tail) : sine_kernel(x, tail);
    return quadrant == 1 || quadrant == 2 ? -c : c;
}

double atan2_reproducible(double y, double x) {
    constexpr double half_pi = 0x1.921fb54442d18p+0, half_pi_low = 0x1.1a62633145c07p-54;
    const double ax = std::abs(x), ay = std::abs(y);
    double angle = 0;  // of (ax, ay); the quotients below may underflow, which does no harm
    if (ay > ax) {
        angle = half_pi - (arctangent_kernel(ax / ay) - half_pi_low);
    } else if (ax > 0) {
        angle = arctangent_kernel(ay / ax);
    }
    if (std::signbit(x)) angle = 2 * half_pi - (angle - 2 * half_pi_low);
    return std::signbit(y) ? -angle : angle;
}

double pow_reproducible(double base, double exponent) {
    assert(base > 0 && exponent >= 0 && exponent < 2147483648.0);
    constexpr int fraction_bits = 60;
    auto whole = static_cast<std::uint32_t>(exponent);
    auto fraction = static_cast<std::uint64_t>((exponent - whole) * 0x1p60);
    double power = 1;
    // The fraction of the exponent is taken from its last bit to its first. Each bit costs a square root, which halves
    // the error made so far. Each product for the whole part adds half an ulp.
    for (int bit = 0; bit < fraction_bits; ++bit, fraction >>= 1)
        power = std::sqrt(fraction & 1 ? power * base : power);
    for (double square = base; whole > 0; whole >>= 1, square *= square)
        if (whole & 1) power *= square;
    return power;
}

double log_reproducible(double value) {
    assert(value > 0 && value < HUGE_VAL);
    constexpr std::uint64_t sqrt_half = 0x3fe6a09e00000000;  // the bits of sqrt(1/2), nearly
    const bool subnormal = value < 0x1p-1022;
    const auto bits = std::bit_cast<std::uint64_t>(subnormal ? value * 0x1p54 : value);
    // value = 2^exponent m with m from sqrt(1/2) to sqrt(2)
    const auto exponent = static_cast<std::int64_t>(bits - sqrt_half) >> 52;
    const double f = std::bit_cast<double>(bits - (static_cast<std::uint64_t>(exponent) << 52)) - 1.0;
    const auto k = static_cast<double>(subnormal ? exponent - 54 : exponent);
    return k * ln2_high + (logarithm_kernel(f, k * ln2_low) + f);
}

double exp_reproducible(double exponent) {
    if (exponent > 710.0) return HUGE_VAL;
    if (exponent < -746.0) return 0;
    const double n = std::floor(exponent * (1 / (ln2_high + ln2_low)) + 0.5);
    const double difference = exponent - n * ln2_high;
    const double second = n * ln2_low;
    const double x = difference - second;
    const double tail = (difference - x) - second;
    // Two factors reach 2^1024 and the subnormal numbers, which one cannot.
    const int whole = static_cast<int>(n), half = whole / 2;
    return ((1.0 + exponential_kernel(x, tail)) * power_of_two(half)) * power_of_two(whole - half);
}

}  // namespace lamina::core
