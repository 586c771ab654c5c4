// Numbers and text for messages and options, made with nothing but the standard library.
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
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

/// A part of concat(): a text or a number. Plain values instead of types keep what a call compiles to small.
class TextPart {
public:
    TextPart(std::string_view text) : text_(text) {}
    TextPart(const char* text) : text_(text) {}
    TextPart(const std::string& text) : text_(text) {}
    TextPart(char letter) : kind_(Kind::letter), letter_(letter) {}
    TextPart(double number) : kind_(Kind::number), number_(number) {}
    TextPart(std::signed_integral auto integer) : kind_(Kind::integer), integer_(integer) {}
    TextPart(std::unsigned_integral auto natural) : kind_(Kind::natural), natural_(natural) {}

    /// Returns the part as text.
    std::string text() const;

private:
    enum class Kind { text, letter, number, integer, natural };
    Kind kind_ = Kind::text;
    std::string_view text_;
    char letter_ = 0;
    double number_ = 0;
    std::int64_t integer_ = 0;
    std::uint64_t natural_ = 0;
};

/// Returns the texts of the parts, joined.
LAMINA_EXPORT std::string joined_text(std::initializer_list<TextPart> parts);

/// Returns texts and numbers joined: concat("point ", 3, " is missing").
template <class... Parts>
std::string concat(const Parts&... parts) {
    return joined_text({TextPart(parts)...});
}

/// Returns a number with its noun: "1 corner", "2 corners".
inline std::string counted(std::size_t n, std::string_view noun) { return concat(n, " ", noun, n == 1 ? "" : "s"); }

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

}  // namespace lamina::core
