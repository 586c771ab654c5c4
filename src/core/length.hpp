// Lengths as text.
#pragma once

#include <string>

#include <lamina/export.hpp>
#include <lamina/length.hpp>

namespace lamina::core {

/// Reads "0.003", which means chords, or "0.003u", which means units of the input. Throws UsageError with the bare
/// reason.
LAMINA_EXPORT Length parse_length(const std::string& text);
/// Returns the text that parse_length() reads back.
LAMINA_EXPORT std::string length_text(Length length);

}  // namespace lamina::core
