#include "geometry/characters.hpp"

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

}  // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
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
