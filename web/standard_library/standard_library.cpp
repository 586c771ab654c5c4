#include "standard_library.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include <fast_float/fast_float.h>
#include <fmt/format.h>

namespace {

/// Copies a text to [first, last).
std::to_chars_result copied(std::string_view text, char* first, char* last) {
    if (static_cast<std::size_t>(last - first) < text.size()) return {last, std::errc::value_too_large};
    return {std::copy(text.begin(), text.end(), first), std::errc{}};
}

/// Reads a number. Where its digits stand for one beyond the largest, the value stays and the error says so.
template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
    Number read = 0;
    const auto [end, error] = fast_float::from_chars(first, last, read);
    if (error != std::errc{}) return {end, error};
    const char* behind_sign = first + (*first == '-' ? 1 : 0);
    const bool begins_with_digits = (*behind_sign >= '0' && *behind_sign <= '9') || *behind_sign == '.';
    if (std::isinf(read) && begins_with_digits) return {end, std::errc::result_out_of_range};
    value = read;
    return {end, std::errc{}};
}

}  // namespace

namespace std {

to_chars_result to_chars(char* first, char* last, double value) {
    // The shortest digits, in the notation that takes less room, and without an exponent where both take the same
    // (C++20, 20.19.2). {fmt} has the same digits but chooses the notation by the exponent alone.
    fmt::memory_buffer scientific;
    fmt::format_to(fmt::appender(scientific), "{:e}", value);
    if (!std::isfinite(value) || value == 0) {
        scientific.clear();
        fmt::format_to(fmt::appender(scientific), "{}", value);
        return copied({scientific.data(), scientific.size()}, first, last);
    }
    const string_view text(scientific.data(), scientific.size());
    const size_t e = text.find('e');
    const int exponent = atoi(string(text.substr(e + 1)).c_str());
    const int sign = value < 0 ? 1 : 0, digits = static_cast<int>(e) - sign - (e > size_t(sign) + 1 ? 1 : 0);
    int fixed_length = sign + digits + 1;                            // a point between two digits
    if (exponent >= digits - 1) fixed_length = sign + exponent + 1;  // a whole number
    if (exponent < 0) fixed_length = sign + 1 + digits - exponent;   // 0.00ddd
    if (fixed_length > static_cast<int>(text.size())) return copied(text, first, last);
    fmt::memory_buffer fixed;
    fmt::format_to(fmt::appender(fixed), "{:.{}f}", value, std::max(0, digits - 1 - exponent));
    return copied({fixed.data(), fixed.size()}, first, last);
}

to_chars_result to_chars(char* first, char* last, double value, chars_format format, int precision) {
    fmt::memory_buffer text;
    const fmt::appender out(text);
    if (format == chars_format::scientific)
        fmt::format_to(out, "{:.{}e}", value, precision);
    else if (format == chars_format::fixed)
        fmt::format_to(out, "{:.{}f}", value, precision);
    else
        fmt::format_to(out, "{:.{}g}", value, precision);
    return copied({text.data(), text.size()}, first, last);
}

from_chars_result from_chars(const char* first, const char* last, double& value) { return read(first, last, value); }
from_chars_result from_chars(const char* first, const char* last, float& value) { return read(first, last, value); }

}  // namespace std
