#include <lamina/value_range.hpp>

#include <cmath>
#include <cstdint>

#include <lamina/error.hpp>

#include "core/text.hpp"

namespace lamina {

namespace {

constexpr double most_values = 10'000;
/// A last value that is missed by less than this share of a step belongs to the range: (0.3 - 0) / 0.1 is below 3.
constexpr double rounding_share = 1e-9;

/// Returns the number of steps up to the last value.
double steps_in(const ValueRange& range) {
    return std::floor((range.last - range.first) / range.step + rounding_share);
}

/// Returns the power of ten by which both numbers become whole ones; 0 where none up to 10^9 does.
double decimal_unit(double a, double b) {
    constexpr double greatest = 0x1p53, most = 1e9;  // whole numbers up to the first have one double each
    const auto is_decimal = [&](double number, double unit) {
        const double whole = std::round(number * unit);
        return std::abs(whole) < greatest && whole / unit == number;
    };
    for (double unit = 1; unit <= most; unit *= 10)
        if (is_decimal(a, unit) && is_decimal(b, unit)) return unit;
    return 0;
}

}  // namespace

bool is_range(const std::string& text) { return text.find(':') != std::string::npos; }

ValueRange parse_range(const std::string& text) {
    const std::vector<double> numbers = core::parse_numbers(text, ':');
    core::require_text(numbers.size() == 2 || numbers.size() == 3, text, "is no range A:B or A:B:STEP");
    const ValueRange range{numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1};
    validate(range);
    return range;
}

void validate(const ValueRange& range) {
    const auto require = [&](bool condition, const std::string& reason) {
        core::require_text(condition, range_text(range), reason);
    };
    require(std::isfinite(range.first) && std::isfinite(range.last) && std::isfinite(range.step),
            "holds numbers that are not finite");
    require(range.step > 0, "has a step that is not above 0");
    require(range.first <= range.last, "ends before it begins: A is above B");
    require(steps_in(range) < most_values, "has more than 10000 values");
}

std::string range_text(const ValueRange& range) { return core::concat(range.first, ":", range.last, ":", range.step); }

std::vector<double> values_of(const ValueRange& range) {
    const double unit = decimal_unit(range.first, range.step);
    const double first = std::round(range.first * unit), step = std::round(range.step * unit);
    std::vector<double> values;
    for (std::int64_t i = 0; i <= static_cast<std::int64_t>(steps_in(range)); ++i) {
        const auto n = static_cast<double>(i);
        values.push_back(unit > 0 ? (first + n * step) / unit : range.first + n * range.step);
    }
    return values;
}

}  // namespace lamina
