#include "geometry/characters.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace lamina::geometry {

namespace {

/// Returns the length of the valid UTF-8 sequence at the start of s, 0 if there is none. Precondition: s is not empty.
std::size_t utf8_length(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const std::size_t n = byte(0) < 0x80 ? 1 : byte(0) < 0xC2 ? 0 : byte(0) < 0xE0 ? 2 : byte(0) < 0xF0 ? 3 : 4;
    if (n == 0 || n > s.size() || byte(0) > 0xF4) return 0;
    for (std::size_t i = 1; i < n; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    // Overlong forms, surrogates and numbers beyond U+10FFFF are not valid.
    if ((byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) >= 0xA0) ||
        (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) >= 0x90))
        return 0;
    return n;
}

/// A character of a text and the bytes that it takes.
struct Character {
    char32_t code;
    std::size_t length;
};

/// Returns the first character of s. A byte that is not valid UTF-8 is one of Latin-1. Precondition: s is not empty.
Character first_character(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<char32_t>(static_cast<unsigned char>(s[i])); };
    const std::size_t n = utf8_length(s);
    if (n <= 1) return {byte(0), 1};
    char32_t code = byte(0) & (0x7Fu >> n);
    for (std::size_t i = 1; i < n; ++i) code = (code << 6) | (byte(i) & 0x3Fu);
    return {code, n};
}

/// Returns whether a character beyond ASCII is white space, or takes no room at all.
bool is_wide_space(char32_t c) {
    constexpr std::array<char32_t, 7> others{0xA0, 0x1680, 0x202F, 0x205F, 0x2060, 0x3000, 0xFEFF};
    return (c >= 0x2000 && c <= 0x200B) || std::find(others.begin(), others.end(), c) != others.end();
}

/// Returns whether a character beyond ASCII is a minus sign, a hyphen or a dash; 0x96 is the dash of Windows.
bool is_dash(char32_t c) { return (c >= 0x2010 && c <= 0x2014) || c == 0x2212 || c == 0xFF0D || c == 0x96; }

/// Returns whether a minus sign may stand behind a text: at the start of a number, or of its exponent.
bool may_precede_sign(std::string_view text) {
    constexpr std::string_view exponents = "eEdD";
    if (text.empty()) return true;
    const char last = text.back();
    if (exponents.find(last) != std::string_view::npos)
        return text.size() > 1 && (is_digit(text[text.size() - 2]) || text[text.size() - 2] == '.');
    return !is_digit(last) && !is_letter(last) && last != '.';
}

}  // namespace

std::string with_plain_signs(std::string_view line) {
    std::string plain;
    plain.reserve(line.size());
    while (!line.empty()) {
        const auto [code, length] = first_character(line);
        const std::string_view bytes = line.substr(0, length);
        line.remove_prefix(length);
        const bool before_number = !line.empty() && (is_digit(line[0]) || line[0] == '.' || line[0] == ',');
        if (is_wide_space(code)) {
            plain += ' ';
        } else if (is_dash(code) && before_number && may_precede_sign(plain)) {
            plain += '-';
        } else {
            plain += bytes;
        }
    }
    return plain;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return trimmed(line.substr(0, line.find('\r')));
}

std::string printable(std::string_view bytes) {
    std::string text;
    while (!bytes.empty()) {
        const auto byte = static_cast<unsigned char>(bytes[0]);
        std::size_t n = utf8_length(bytes);
        if (n == 0) {  // a byte of Latin-1 becomes two of UTF-8
            text += static_cast<char>(0xC0 | (byte >> 6));
            text += static_cast<char>(0x80 | (byte & 0x3F));
            n = 1;
        } else if (n == 1) {
            text += byte < 0x20 || byte == 0x7F ? ' ' : bytes[0];
        } else {
            text += bytes.substr(0, n);
        }
        bytes.remove_prefix(n);
    }
    return std::string(trimmed(text));
}

}  // namespace lamina::geometry
