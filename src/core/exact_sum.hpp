// Sums of floating-point numbers that depend neither on the order of the numbers nor on how they were put together.
// Source: R. M. Neal, Fast exact summation using small and large superaccumulators, arXiv:1505.05571 (2015).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <lamina/export.hpp>

#include "core/packing.hpp"

namespace lamina::core {

/// The exact sum of up to 2^30 numbers: a fixed-point number wide enough for every finite double. Each of its digits
/// holds 32 bits and leaves the other half of its word to carries.
class LAMINA_EXPORT ExactSum {
public:
    /// Add a number, and all numbers of another sum. What is not finite makes the value not finite, too.
    void add(double number);
    void add(const ExactSum& other);

    /// Returns the sum as a double: the sum of one number is that number.
    double value() const;

    /// Puts the sum for another process, and takes it.
    void put(Packer& packer) const;
    static ExactSum get(Unpacker& unpacker);

private:
    /// Digits for the exponents from 2^-1074, that of the least double, beyond 2^1024 by as much as carries may need.
    static constexpr std::size_t digits = 68;
    std::array<std::int64_t, digits> digits_{};  ///< digit i counts 2^(32 i - 1074)
    double not_finite_ = 0;                      ///< sum of the numbers that are not finite

    /// Brings all digits into the range of 32 bits. Returns whether the sum is negative; the digits are then those of
    /// its opposite.
    bool normalize();
};

}  // namespace lamina::core
