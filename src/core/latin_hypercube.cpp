#include <lamina/latin_hypercube.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

#include <lamina/error.hpp>

#include "core/random.hpp"
#include "core/reproducible_math.hpp"
#include "core/text.hpp"

namespace lamina {

namespace {

constexpr std::string_view logarithm = ":log";

std::string interval_text(const ValueInterval& interval) {
    return core::concat(interval.first, ":", interval.last, interval.by_logarithm ? logarithm : "");
}

/// Returns the value at a share of the interval.
double value_at(const ValueInterval& interval, double share) {
    const auto between = [&](double low, double high) { return low + (high - low) * share; };
    const double value = interval.by_logarithm ? core::exp_reproducible(between(core::log_reproducible(interval.first),
                                                                                core::log_reproducible(interval.last)))
                                               : between(interval.first, interval.last);
    return std::clamp(value, interval.first, interval.last);
}

}  // namespace

ValueInterval parse_interval(const std::string& text) {
    const bool by_logarithm = text.ends_with(logarithm);
    const std::vector<double> ends =
        core::parse_numbers(by_logarithm ? text.substr(0, text.size() - logarithm.size()) : text, ':');
    core::require_text(ends.size() == 2, text, "is no interval A:B or A:B:log");
    const ValueInterval interval{ends[0], ends[1], by_logarithm};
    validate(interval);
    return interval;
}

void validate(const ValueInterval& interval) {
    const auto require = [&](bool condition, const std::string& reason) {
        core::require_text(condition, interval_text(interval), reason);
    };
    require(std::isfinite(interval.first) && std::isfinite(interval.last), "holds numbers that are not finite");
    require(interval.first < interval.last, "is no interval: A must be below B");
    require(!interval.by_logarithm || interval.first > 0, "has no logarithms: A must be above 0");
}

std::vector<std::vector<double>> latin_hypercube(std::span<const ValueInterval> intervals, std::size_t count,
                                                 std::uint64_t seed) {
    core::Random random(seed);
    std::vector<std::vector<double>> samples(count);
    std::vector<std::size_t> parts(count);
    for (const ValueInterval& interval : intervals) {
        std::iota(parts.begin(), parts.end(), std::size_t{0});
        // A shuffle after Fisher and Yates: that of the standard library differs from one library to the next.
        for (std::size_t i = count; i > 1; --i) std::swap(parts[i - 1], parts[random.below(i)]);
        for (std::size_t i = 0; i < count; ++i)
            samples[i].push_back(
                value_at(interval, (static_cast<double>(parts[i]) + random.real()) / static_cast<double>(count)));
    }
    return samples;
}

}  // namespace lamina
