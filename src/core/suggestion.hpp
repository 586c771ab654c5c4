// Suggestions for words that are not known.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <lamina/export.hpp>

namespace lamina {

/// Returns a word in lower case, without hyphens, underscores and blanks.
LAMINA_EXPORT std::string plain_word(std::string_view word);
/// Returns the word of `known` that the user probably meant, by plain_word(): the closest one, the first of several.
/// Empty where none is close: more than a third of the letters differ.
LAMINA_EXPORT std::string closest_word(std::string_view word, std::span<const std::string> known);
/// Returns the option of meshes that other programs, or people, call by this word, such as "first-height" for
/// "firstLayerHeight" and "alpha" for "aoa"; empty where there is none.
LAMINA_EXPORT std::string option_elsewhere(std::string_view word);
/// Returns the option of `known` that the user probably meant: the one that has this name elsewhere, or else
/// closest_word().
LAMINA_EXPORT std::string meant_option(std::string_view word, std::span<const std::string> known);
/// Returns ": did you mean 'WORD'?" for the end of a message, or an empty text for an empty word.
LAMINA_EXPORT std::string did_you_mean(const std::string& word);

}  // namespace lamina
