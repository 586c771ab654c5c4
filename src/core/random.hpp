// Random numbers that are the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace lamina::core {

/// Returns the random number of a counter: 64 bits that look independent of those of all other counters.
/// Source: G. L. Steele, D. Lea, C. H. Flood, Fast splittable pseudorandom number generators, OOPSLA (2014):
/// splitmix64, as S. Vigna put it into the public domain.
constexpr std::uint64_t splitmix64(std::uint64_t counter) {
    std::uint64_t z = counter + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// A sequence of random numbers that depends on its seed alone.
class Random {
public:
    explicit Random(std::uint64_t seed) : counter_(seed) {}

    /// Returns 64 random bits.
    std::uint64_t bits() {
        const std::uint64_t result = splitmix64(counter_);
        counter_ += 0x9e3779b97f4a7c15u;
        return result;
    }
    /// Returns a number in [0, 1).
    double real() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
    /// Returns a number in [low, high), up to rounding.
    double real(double low, double high) { return low + (high - low) * real(); }
    /// Returns a number from 0 to n - 1.
    std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }

private:
    std::uint64_t counter_;
};

}  // namespace lamina::core
