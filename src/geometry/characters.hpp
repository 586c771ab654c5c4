// The characters of airfoil files: classes of ASCII characters that do not depend on the locale, and printable UTF-8.
#pragma once

#include <string>
#include <string_view>

namespace lamina::geometry {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }
inline bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
/// Returns whether a character is white space within a line. Ctrl-Z, which ends old DOS files, counts as such.
inline bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\x1a'; }

/// Returns whether a character is white space or ends a line.
inline bool is_blank(char c) { return is_space(c) || c == '\n' || c == '\r'; }

/// Returns the text without white space at both ends.
std::string_view trimmed(std::string_view text);

/// Returns the text without white space and ends of lines at both ends.
std::string_view without_blanks(std::string_view text);

/// Returns the line at the start of a text, trimmed, and removes it.
std::string_view take_line(std::string_view& text);

/// Returns a line with ASCII characters in the place of those that only look like them: spaces for no-break and other
/// white space of Unicode or Latin-1, minus signs for dashes before digits, as word processors write them. Dashes
/// within words and numbers ("63-012") stay.
std::string with_plain_signs(std::string_view line);

/// Returns bytes as trimmed, printable UTF-8. Bytes that are not valid UTF-8 are taken as Latin-1; control characters
/// become spaces.
std::string printable(std::string_view bytes);

}  // namespace lamina::geometry
