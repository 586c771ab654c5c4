#include "core/suggestion.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "core/edit_distance.hpp"
#include "core/text.hpp"

namespace lamina::core {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    // Rows of the table of distances between the beginnings of both words: the last but one, the last, and this one.
    std::vector<std::size_t> two_before(b.size() + 1), before(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::swap(two_before, before);
        std::swap(before, row);
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = a[i - 1] == b[j - 1];
            row[j] = std::min({before[j] + 1, row[j - 1] + 1, before[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                row[j] = std::min(row[j], two_before[j - 2] + 1);
        }
    }
    return row[b.size()];
}

}  // namespace lamina::core

namespace lamina {

std::string plain_word(std::string_view word) {
    std::string letters = core::lower_case(std::string(word));
    std::erase_if(letters, [](char c) { return c == '-' || c == '_' || c == ' '; });
    return letters;
}

std::string closest_word(std::string_view word, std::span<const std::string> known) {
    const std::string meant = plain_word(word);
    constexpr std::size_t max_length = 64;  // longer words are no misspelt names
    std::string closest;
    if (meant.empty() || meant.size() > max_length) return closest;
    std::size_t least = (meant.size() + 2) / 3 + 1;
    for (const std::string& candidate : known) {
        const std::string letters = plain_word(candidate);
        const std::size_t distance = core::edit_distance(meant, letters);
        // A word of which no letter is left is another word.
        if (distance >= std::min(least, std::max(meant.size(), letters.size()))) continue;
        least = distance;
        closest = candidate;
    }
    return closest;
}

std::string did_you_mean(const std::string& word) { return word.empty() ? "" : ": did you mean '" + word + "'?"; }

}  // namespace lamina
