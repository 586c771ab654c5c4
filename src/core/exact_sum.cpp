#include "core/exact_sum.hpp"

#include <bit>
#include <cmath>

namespace lamina::core {

namespace {

constexpr unsigned bits_per_digit = 32, bits_of_mantissa = 52;
constexpr int lowest_exponent = -1074;
constexpr std::uint64_t digit_mask = (std::uint64_t{1} << bits_per_digit) - 1;

}  // namespace

void ExactSum::add(double number) {
    if (!std::isfinite(number)) {
        not_finite_ += number;
        return;
    }
    const auto bits = std::bit_cast<std::uint64_t>(number);
    const auto biased = static_cast<unsigned>(bits >> bits_of_mantissa & 0x7ff);
    std::uint64_t mantissa = bits & ((std::uint64_t{1} << bits_of_mantissa) - 1);
    if (biased > 0) mantissa |= std::uint64_t{1} << bits_of_mantissa;
    // The lowest bit of the mantissa counts 2^(place - 1074).
    const unsigned place = biased > 0 ? biased - 1 : 0, shift = place % bits_per_digit;
    std::int64_t* digit = &digits_[place / bits_per_digit];
    const std::uint64_t low = (mantissa & digit_mask) << shift, high = (mantissa >> bits_per_digit) << shift;
    const std::uint64_t parts[3] = {low & digit_mask, (low >> bits_per_digit) + (high & digit_mask),
                                    high >> bits_per_digit};
    for (std::size_t i = 0; i < 3; ++i)
        digit[i] += std::signbit(number) ? -static_cast<std::int64_t>(parts[i]) : static_cast<std::int64_t>(parts[i]);
}

void ExactSum::add(const ExactSum& other) {
    for (std::size_t i = 0; i < digits; ++i) digits_[i] += other.digits_[i];
    not_finite_ += other.not_finite_;
}

bool ExactSum::normalize() {
    const auto carry = [&] {
        for (std::size_t i = 0; i + 1 < digits; ++i) {
            const std::int64_t over = digits_[i] >> bits_per_digit;  // rounded down
            digits_[i] -= over * (std::int64_t{1} << bits_per_digit);
            digits_[i + 1] += over;
        }
    };
    carry();
    if (digits_.back() >= 0) return false;
    for (std::int64_t& digit : digits_) digit = -digit;
    carry();
    return true;
}

double ExactSum::value() const {
    if (not_finite_ != 0) return not_finite_;
    ExactSum sum = *this;
    const bool negative = sum.normalize();
    double value = 0;
    for (std::size_t i = 0; i < digits; ++i)
        if (sum.digits_[i] != 0)
            value +=
                std::ldexp(static_cast<double>(sum.digits_[i]), static_cast<int>(bits_per_digit * i) + lowest_exponent);
    return negative ? -value : value;
}

void ExactSum::put(Packer& packer) const {
    ExactSum sum = *this;
    packer.put(static_cast<std::uint8_t>(sum.normalize()));
    packer.put(not_finite_);
    std::size_t begin = 0, end = digits;
    while (begin < end && sum.digits_[begin] == 0) ++begin;
    while (end > begin && sum.digits_[end - 1] == 0) --end;
    packer.put_short(begin);
    packer.put_short(end - begin);
    for (; begin < end; ++begin) packer.put_short(static_cast<std::uint64_t>(sum.digits_[begin]));
}

ExactSum ExactSum::get(Unpacker& unpacker) {
    ExactSum sum;
    const bool negative = unpacker.get<std::uint8_t>() != 0;
    sum.not_finite_ = unpacker.get<double>();
    const std::size_t begin = unpacker.get_short(), end = begin + unpacker.get_short();
    for (std::size_t i = begin; i < end; ++i) {
        const auto digit = static_cast<std::int64_t>(unpacker.get_short());
        sum.digits_[i] = negative ? -digit : digit;
    }
    return sum;
}

}  // namespace lamina::core
