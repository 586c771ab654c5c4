// Suggestions for words that are not known.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include <lamina/export.hpp>

namespace lamina {

/// Returns a word in lower case, without hyphens, underscores and blanks: spellings that differ in nothing else are
/// equal.
LAMINA_EXPORT std::string plain_word(std::string_view word);

/// Returns the fewest insertions, deletions, replacements and swaps of neighbouring letters that turn one word into the
/// other, where no letter is touched twice (the optimal string alignment distance; Damerau, CACM 7 (1964)).
LAMINA_EXPORT std::size_t edit_distance(std::string_view a, std::string_view b);

/// Returns the word of `known` that the user probably meant: the closest one, the first of several. Case, underscores
/// and hyphens do not count. Empty where none is close: more than a third of the letters differ.
LAMINA_EXPORT std::string closest_word(std::string_view word, std::span<const std::string> known);

/// Returns ": did you mean 'WORD'?" for the end of a message, or an empty text for an empty word.
LAMINA_EXPORT std::string did_you_mean(const std::string& word);

}  // namespace lamina
