// Numbers that differ little from one to the next, as bits for another process.
#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace lamina::core {

/// Puts numbers by their differences from the one before: a bit where they are equal, three where they differ by 1,
/// five where they differ by 2 or 3. These are the Elias gamma codes of the differences, those of either sign in turns.
/// Source: P. Elias, Universal codeword sets and representations of the integers, IEEE Trans. Inf. Theory 21 (1975).
class DifferencePacker {
public:
    void put(std::uint32_t number) {
        const std::int64_t difference = std::int64_t{number} - std::exchange(last_, std::int64_t{number});
        const auto code = 1 + (difference <= 0 ? static_cast<std::uint64_t>(-2 * difference)
                                               : static_cast<std::uint64_t>(2 * difference - 1));
        const int more = std::bit_width(code) - 1;
        put_bits(0, more);
        put_bits(1, 1);
        put_bits(code - (std::uint64_t{1} << more), more);
    }
    std::string take() {
        if (filled_ > 0) put_bits(0, (8 - filled_ % 8) % 8);
        return std::move(bytes_);
    }

private:
    std::string bytes_;
    std::int64_t last_ = 0;
    std::uint64_t bits_ = 0;  ///< those that fill no byte yet
    int filled_ = 0;          ///< their number, below 8

    /// Puts so many bits, the lowest one first, up to 34.
    void put_bits(std::uint64_t bits, int count) {
        bits_ |= bits << filled_;
        for (filled_ += count; filled_ >= 8; filled_ -= 8, bits_ >>= 8)
            bytes_.push_back(static_cast<char>(bits_ & 255));
    }
};

/// Takes them in the same order. Precondition: what is asked for was put there.
class DifferenceUnpacker {
public:
    explicit DifferenceUnpacker(std::string_view bytes) : bytes_(bytes) {}

    /// Bits without a number behind the last one are 0, and each number has one that is not.
    bool at_end() const { return place_ >= 8 * bytes_.size() || window() == 0; }
    std::uint32_t get() {
        constexpr int all_at_once = 28;  // bits of a code that are in one window with the zeros before them
        std::uint64_t bits = window();
        const int more = std::countr_zero(bits);
        place_ += static_cast<std::size_t>(more) + 1;
        bits = more <= all_at_once ? bits >> (more + 1) : window();
        const std::uint64_t highest = std::uint64_t{1} << more;
        const std::uint64_t code = highest + (bits & (highest - 1));
        place_ += static_cast<std::size_t>(more);
        const auto half = static_cast<std::int64_t>(code / 2);
        last_ += code % 2 == 0 ? half : -half;
        assert(place_ <= 8 * bytes_.size());
        return static_cast<std::uint32_t>(last_);
    }

private:
    std::string_view bytes_;
    std::size_t place_ = 0;  ///< in bits
    std::int64_t last_ = 0;

    /// Returns the next 57 bits or more; zeros behind the end.
    std::uint64_t window() const {
        std::uint64_t bits = 0;
        const std::size_t byte = place_ / 8;
        assert(byte < bytes_.size());
        if (byte + sizeof bits <= bytes_.size())
            std::memcpy(&bits, bytes_.data() + byte, sizeof bits);
        else
            std::memcpy(&bits, bytes_.data() + byte, bytes_.size() - byte);
        return bits >> place_ % 8;
    }
};

}  // namespace lamina::core
