// Samples of several intervals at once, as for a data set of many conditions.
//
// Guarantees:
//  1. In n samples every interval is divided into n equal parts (equal in the logarithm, where it says so), and each
//     part holds the value of one sample, somewhere in it (M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21
//     (1979), section 2.2).
//  2. Samples depend on intervals, number and seed alone: they are the same to the last bit everywhere.
// Limits:
//  1. Nothing keeps samples apart in more than one dimension: pairs of intervals may be covered unevenly.
// Example:
//     const std::vector<ValueInterval> intervals{{-4, 8}, parse_interval("1e5:1e7:log")};
//     const auto samples = latin_hypercube(intervals, 4, 1);
//     assert(samples.size() == 4 && samples[0].size() == 2);
//     assert(std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s[0] < -1; }) == 1);
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <lamina/export.hpp>

namespace lamina {

/// The numbers between two of them.
struct ValueInterval {
    double first = 0;           ///< the smallest
    double last = 1;            ///< the largest, above `first`
    bool by_logarithm = false;  ///< whether logarithms are taken evenly, and not values; `first` is above 0 then
};

/// Reads "A:B" or "A:B:log". Throws UsageError with the bare reason, as validate().
LAMINA_EXPORT ValueInterval parse_interval(const std::string& text);
/// Throws UsageError for ends that are not finite or not in their order, and for logarithms of what is not above 0.
LAMINA_EXPORT void validate(const ValueInterval& interval);
/// Returns `count` samples, each with a value of every interval. Precondition: validate() of each.
LAMINA_EXPORT std::vector<std::vector<double>> latin_hypercube(std::span<const ValueInterval> intervals,
                                                               std::size_t count, std::uint64_t seed);

}  // namespace lamina
