// Numbers that carry their derivatives, so that equations are written once and Newton's matrix follows from them.
// Source: A. Griewank, A. Walther, Evaluating Derivatives, 2nd ed. (2008), section 3.1 (forward mode).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "core/reproducible_math.hpp"

namespace lamina::flow::coupled {

/// A number with its derivatives by ten others.
struct Dual {
    static constexpr std::size_t slots = 10;
    double value = 0;
    std::array<double, slots> by{};

    Dual() = default;
    Dual(double number) : value(number) {}  // NOLINT: constants are numbers without derivatives
};

inline double value_of(double a) { return a; }
inline double value_of(const Dual& a) { return a.value; }

/// Returns the number that derivatives in this slot are taken by.
inline Dual variable(double value, std::size_t slot) {
    Dual result(value);
    result.by[slot] = 1;
    return result;
}

/// Returns f(a) with a given value and derivative f'(a).
inline Dual chain(const Dual& a, double value, double derivative) {
    Dual result(value);
    for (std::size_t k = 0; k < Dual::slots; ++k) result.by[k] = derivative * a.by[k];
    return result;
}

/// Returns f(a, b) with a given value and partial derivatives.
inline Dual chain(const Dual& a, const Dual& b, double value, double by_a, double by_b) {
    Dual result(value);
    for (std::size_t k = 0; k < Dual::slots; ++k) result.by[k] = by_a * a.by[k] + by_b * b.by[k];
    return result;
}

inline Dual operator+(const Dual& a, const Dual& b) { return chain(a, b, a.value + b.value, 1, 1); }
inline Dual operator-(const Dual& a, const Dual& b) { return chain(a, b, a.value - b.value, 1, -1); }
inline Dual operator-(const Dual& a) { return chain(a, -a.value, -1); }
inline Dual operator*(const Dual& a, const Dual& b) { return chain(a, b, a.value * b.value, b.value, a.value); }
inline Dual operator/(const Dual& a, const Dual& b) {
    const double in_b = 1 / b.value, value = a.value * in_b;
    return chain(a, b, value, in_b, -value * in_b);
}
inline Dual operator+(const Dual& a, double b) { return chain(a, a.value + b, 1); }
inline Dual operator+(double a, const Dual& b) { return b + a; }
inline Dual operator-(const Dual& a, double b) { return chain(a, a.value - b, 1); }
inline Dual operator-(double a, const Dual& b) { return chain(b, a - b.value, -1); }
inline Dual operator*(const Dual& a, double b) { return chain(a, a.value * b, b); }
inline Dual operator*(double a, const Dual& b) { return b * a; }
inline Dual operator/(const Dual& a, double b) { return a * (1 / b); }
inline Dual operator/(double a, const Dual& b) { return chain(b, a / b.value, -a / (b.value * b.value)); }

// The same functions of numbers without derivatives.
inline double log(double a) { return core::log_reproducible(a); }
inline double exp(double a) { return core::exp_reproducible(a); }
inline double tanh(double a) {
    const double e = core::exp_reproducible(-2 * std::abs(a)), size = (1 - e) / (1 + e);
    return a < 0 ? -size : size;
}
inline double power(double base, double exponent) { return exp(exponent * log(base)); }
inline double squared(double a) { return a * a; }

inline Dual log(const Dual& a) { return chain(a, core::log_reproducible(a.value), 1 / a.value); }
inline Dual exp(const Dual& a) {
    const double value = core::exp_reproducible(a.value);
    return chain(a, value, value);
}
inline Dual sqrt(const Dual& a) {
    const double value = std::sqrt(a.value);
    return chain(a, value, 0.5 / value);
}
/// The hyperbolic tangent.
inline Dual tanh(const Dual& a) {
    const double value = tanh(a.value);
    return chain(a, value, 1 - value * value);
}
/// Returns base^exponent. Precondition: base > 0.
inline Dual power(const Dual& base, double exponent) {
    const double value = power(base.value, exponent);
    return chain(base, value, exponent * value / base.value);
}
inline Dual squared(const Dual& a) { return a * a; }

inline const Dual& larger(const Dual& a, const Dual& b) { return a.value < b.value ? b : a; }
/// Returns a number, or a limit, which has no derivatives, where the number is below it.
inline Dual at_least(const Dual& a, double limit) { return a.value < limit ? Dual(limit) : a; }
inline Dual at_most(const Dual& a, double limit) { return a.value > limit ? Dual(limit) : a; }

}  // namespace lamina::flow::coupled
