#include "geometry/length_units.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "geometry/characters.hpp"

namespace lamina::geometry {

namespace {

struct WrittenUnit {
    std::string_view written;
    LengthUnitName unit;
};

constexpr LengthUnitName micrometre{"um", 1e-6}, millimetre{"mm", 1e-3}, centimetre{"cm", 1e-2}, metre{"m", 1},
    inch{"in", 0.0254}, feet{"ft", 0.3048};

constexpr std::array<WrittenUnit, 22> units = {{{"um", micrometre},
                                                {"\xC2\xB5m", micrometre},  // the micro sign
                                                {"\xCE\xBCm", micrometre},  // the letter mu
                                                {"mm", millimetre},
                                                {"millimeter", millimetre},
                                                {"millimeters", millimetre},
                                                {"millimetre", millimetre},
                                                {"millimetres", millimetre},
                                                {"cm", centimetre},
                                                {"centimeters", centimetre},
                                                {"centimetres", centimetre},
                                                {"m", metre},
                                                {"meter", metre},
                                                {"meters", metre},
                                                {"metre", metre},
                                                {"metres", metre},
                                                {"in", inch},
                                                {"inch", inch},
                                                {"inches", inch},
                                                {"ft", feet},
                                                {"foot", feet},
                                                {"feet", feet}}};

/// Returns the words and numbers of a text, in lower case, and apart from them its brackets, "=" and ":".
std::vector<std::string> words_of(std::string_view text) {
    constexpr std::string_view signs = "()[]=:", spaces = " \t,;\"'";
    std::vector<std::string> words;
    bool goes_on = false, is_number = false;
    for (const char c : core::lower_case(std::string(text))) {
        const bool is_sign = signs.find(c) != std::string_view::npos, in_number = is_digit(c) || c == '.';
        if (is_sign) words.emplace_back(1, c);
        const bool part = !is_sign && spaces.find(c) == std::string_view::npos;
        if (part && (!goes_on || in_number != is_number)) words.emplace_back();  // "250mm" is two words
        if (part) words.back() += c;
        goes_on = part;
        is_number = in_number;
    }
    return words;
}

}  // namespace

std::optional<LengthUnitName> length_unit(std::string_view text) {
    const std::string lower = core::lower_case(std::string(text));
    const auto found = std::find_if(units.begin(), units.end(), [&](const auto& u) { return u.written == lower; });
    return found == units.end() ? std::nullopt : std::optional(found->unit);
}

std::optional<LengthUnitName> unit_of_title(std::string_view title, double length) {
    constexpr double tolerance = 0.01;  // of the length
    constexpr std::size_t longest = 1000;
    if (title.size() > longest) return std::nullopt;
    const std::vector<std::string> words = words_of(title);
    const auto word = [&](std::size_t i) { return i < words.size() ? std::string_view(words[i]) : std::string_view(); };
    const auto is_one_of = [](std::string_view text, std::initializer_list<std::string_view> these) {
        return std::find(these.begin(), these.end(), text) != these.end();
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        const bool is_linked = is_one_of(word(i + 1), {"=", ":", "is", "of"}) ||
                               (word(i + 1) == "in" && length_unit(word(i + 2)));  // or the unit is "in" itself
        const std::size_t next = i + (is_linked ? 2 : 1);
        const bool in_brackets = is_one_of(word(i), {"(", "["}) && is_one_of(word(i + 2), {")", "]"});
        if (in_brackets || is_one_of(word(i), {"unit", "units", "in"}))
            if (const auto unit = length_unit(word(next))) return unit;
        if (!is_one_of(word(i), {"chord", "length"})) continue;
        double number = 0;
        const std::string_view text = word(next);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error == std::errc() && std::abs(number - length) <= tolerance * length) return length_unit(word(next + 1));
    }
    return std::nullopt;
}

}  // namespace lamina::geometry
