// How far a word is from another.
#pragma once

#include <cstddef>
#include <string_view>

namespace lamina::core {

/// Returns the fewest insertions, deletions, replacements and swaps of neighbouring letters that turn one word into the
/// other, where no letter is touched twice (the optimal string alignment distance; Damerau, CACM 7 (1964)).
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace lamina::core
