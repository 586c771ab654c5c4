// Numbers and text for messages and options, made with nothing but the standard library.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <lamina/export.hpp>

namespace lamina::core {

/// Returns the shortest text that reads back as the same number.
inline std::string to_text(double value) {
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}
template <std::integral Number>
std::string to_text(Number value) {
    return std::to_string(value);
}
inline std::string to_text(std::string_view text) { return std::string(text); }
inline std::string to_text(char letter) { return {letter}; }

/// Returns the number rounded to two significant digits: "4.3e+09".
inline std::string rounded_text(double value) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::scientific, 1).ptr;
    return {digits.data(), end};
}

/// Returns texts and numbers joined: concat("point ", 3, " is missing").
template <class... Parts>
std::string concat(const Parts&... parts) {
    return (std::string() + ... + to_text(parts));
}

/// Returns the parts of a text between separators, of which there is one more than separators.
LAMINA_EXPORT std::vector<std::string> split(const std::string& text, char separator);

/// Throws UsageError with this reason, which quotes the text, unless the condition holds.
LAMINA_EXPORT void require_text(bool condition, const std::string& text, const std::string& reason);

/// Returns the finite number that fills the whole text. Throws UsageError with the bare reason.
LAMINA_EXPORT double parse_number(const std::string& text);

/// Returns the finite numbers between separators. Throws UsageError with the bare reason, which quotes the text.
LAMINA_EXPORT std::vector<double> parse_numbers(const std::string& text, char separator);

/// Returns the text with its ASCII letters in lower case, whatever the locale.
LAMINA_EXPORT std::string lower_case(std::string text);

/// Returns the extension of a file's name, in lower case and with the dot.
LAMINA_EXPORT std::string extension_of(const std::filesystem::path& file);

}  // namespace lamina::core
