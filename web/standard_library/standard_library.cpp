#include "standard_library.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
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

/// The decimal number d.ddd * 10^exponent.
struct Decimal {
    std::string digits;  ///< without zeros at either end
    int exponent = 0;    ///< of the first digit
};

/// Returns the shortest decimal number that is read back as this one. Precondition: value > 0.
Decimal shortest(double value) {
    const std::string text = fmt::format("{}", value), mantissa = text.substr(0, text.find('e'));
    Decimal decimal;
    if (mantissa.size() < text.size()) decimal.exponent = std::atoi(text.c_str() + mantissa.size() + 1);
    decimal.exponent += static_cast<int>(std::min(mantissa.find('.'), mantissa.size())) - 1;
    for (const char c : mantissa)
        if (c != '.') decimal.digits += c;
    const std::size_t zeros = decimal.digits.find_first_not_of('0');
    decimal.exponent -= static_cast<int>(zeros);
    decimal.digits = decimal.digits.substr(zeros, decimal.digits.find_last_not_of('0') + 1 - zeros);
    return decimal;
}

std::string scientific_text(const Decimal& decimal) {
    const std::string rest = decimal.digits.substr(1);
    return fmt::format("{}{}{}e{}{:02}", decimal.digits[0], rest.empty() ? "" : ".", rest,
                       decimal.exponent < 0 ? '-' : '+', std::abs(decimal.exponent));
}

std::size_t fixed_length(const Decimal& decimal) {
    const int digits = static_cast<int>(decimal.digits.size()), exponent = decimal.exponent;
    if (exponent < 0) return static_cast<std::size_t>(1 - exponent + digits);  // 0.00ddd
    return static_cast<std::size_t>(exponent >= digits - 1 ? exponent + 1 : digits + 1);
}

std::string fixed_text(const Decimal& decimal, double value) {
    const auto& [digits, exponent] = decimal;
    if (exponent < 0) return "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (whole < digits.size()) return digits.substr(0, whole) + "." + digits.substr(whole);
    return fmt::format("{:.0f}", value);  // large whole numbers have all their digits
}

/// Reads a number. Where it is beyond the largest or below the smallest, the value stays and the error says so.
template <class Number>
std::from_chars_result read(const char* first, const char* last, Number& value) {
    Number read = 0;
    const auto [end, error] = fast_float::from_chars(first, last, read);
    if (error != std::errc{}) return {end, error};
    const std::string_view text(first, static_cast<std::size_t>(end - first));
    const std::string_view mantissa = text.substr(0, text.find_first_of("eE"));
    const bool has_digits = mantissa.find_first_of("0123456789") != text.npos;
    const bool is_not_zero = mantissa.find_first_of("123456789") != text.npos;
    if ((std::isinf(read) && has_digits) || (read == 0 && is_not_zero)) return {end, std::errc::result_out_of_range};
    value = read;
    return {end, std::errc{}};
}

}  // namespace

namespace std {

to_chars_result to_chars(char* first, char* last, double value) {
    if (!std::isfinite(value) || value == 0) return copied(fmt::format("{}", value), first, last);
    const Decimal decimal = shortest(std::abs(value));
    const string sign = value < 0 ? "-" : "", scientific = sign + scientific_text(decimal);
    // The notation that takes less room, and the one without an exponent where both take the same (C++20, 20.19.2).
    if (fixed_length(decimal) > scientific.size() - sign.size()) return copied(scientific, first, last);
    return copied(sign + fixed_text(decimal, std::abs(value)), first, last);
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
