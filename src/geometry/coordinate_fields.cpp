#include "geometry/coordinate_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/text.hpp"
#include "geometry/characters.hpp"
#include "geometry/length_units.hpp"

namespace lamina::geometry {

namespace {

/// Returns the kind of a text that std::from_chars() does not understand.
FieldKind kind_of_text(const std::string& text) {
    const std::size_t first = text.find_first_not_of("+-.");
    const bool starts_with_digit = first != std::string::npos && is_digit(text[first]);
    const bool only_points = first == std::string::npos && text.find('.') != std::string::npos;  // "......"
    return starts_with_digit || only_points ? FieldKind::number_like : FieldKind::word;
}

Field make_field(std::string text) {
    Field field{std::move(text)};
    std::string s = field.text;
    if (s.size() > 1 && s[0] == '+' && s[1] != '-') s.erase(0, 1);
    std::replace_if(
        s.begin(), s.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), field.value);
    if (error == std::errc::invalid_argument) {
        field.kind = kind_of_text(s);
    } else if (const auto unit = length_unit({end, static_cast<std::size_t>(s.data() + s.size() - end)});
               unit && error == std::errc{} && std::isfinite(field.value)) {
        field.kind = FieldKind::number;
        field.unit = unit->name;
    } else if (end != s.data() + s.size()) {
        // "infinite" starts with "inf", but is a word.
        field.kind = is_letter(s[0]) ? FieldKind::word : FieldKind::number_like;
    } else if (error == std::errc::result_out_of_range) {
        field.kind = FieldKind::too_extreme;
    } else {
        field.kind = std::isfinite(field.value) ? FieldKind::number : FieldKind::not_finite;
    }
    return field;
}

/// Returns whether a text is a number where the comma is the decimal sign: "12", "-0,5", "1,0e-3", "-,5". Whether ",5"
/// is one cannot be said without other numbers.
bool fits_decimal_comma(std::string_view s) {
    std::size_t i = !s.empty() && (s[0] == '+' || s[0] == '-') ? 1 : 0;
    const auto skip_digits = [&] {
        const std::size_t start = i;
        while (i < s.size() && is_digit(s[i])) ++i;
        return i > start;
    };
    if (!skip_digits() && !(i < s.size() && s[i] == ',')) return false;
    if (i < s.size() && s[i] == ',') {
        ++i;
        if (!skip_digits()) return false;
    }
    if (i < s.size() && (s[i] == 'e' || s[i] == 'E')) {
        ++i;
        if (i < s.size() && (s[i] == '+' || s[i] == '-')) ++i;
        if (!skip_digits()) return false;
    }
    return i == s.size();
}

/// The texts of the fields of a line.
struct SplitLine {
    std::vector<std::string> texts;
    bool has_separators = false;
    bool has_comma_separators = false;
};

/// Returns the length of the quoted text at the start of s, with its quotes, or 0 if there is none. The closing quote
/// must end the field, so that the apostrophe of a title quotes nothing.
std::size_t quoted_length(std::string_view s) {
    if (s[0] != '"' && s[0] != '\'') return 0;
    const std::size_t close = s.find(s[0], 1);
    if (close == std::string_view::npos) return 0;
    const bool ends_field =
        close + 1 == s.size() || is_space(s[close + 1]) || s[close + 1] == ',' || s[close + 1] == ';';
    return ends_field ? close + 1 : 0;
}

/// Splits a line at white space, at semicolons and, if `comma_separates`, at commas; not inside quotes, which are
/// removed.
SplitLine split(std::string_view s, bool comma_separates) {
    SplitLine result;
    const auto is_separator = [&](char c) { return c == ';' || (comma_separates && c == ','); };
    bool after_separator = false;
    std::size_t i = 0;
    while (i < s.size() && result.texts.size() < max_fields) {
        if (is_space(s[i])) {
            ++i;
        } else if (is_separator(s[i])) {
            if (after_separator || result.texts.empty()) result.texts.emplace_back();
            after_separator = true;
            result.has_separators = true;
            result.has_comma_separators |= s[i] == ',';
            ++i;
        } else if (const std::size_t length = quoted_length(s.substr(i)); length > 0) {
            result.texts.emplace_back(trimmed(s.substr(i + 1, length - 2)));
            after_separator = false;
            i += length;
        } else {
            const std::size_t start = i;
            while (i < s.size() && !is_space(s[i]) && !is_separator(s[i])) ++i;
            result.texts.emplace_back(s.substr(start, i - start));
            after_separator = false;
        }
    }
    return result;
}

/// Returns whether the commas in the fields of a line, of which there must be some, are decimal signs. A comma in front
/// of the digits is one only where another field says so: "1 ,5" may be a pair of whole numbers.
bool uses_decimal_commas(const std::vector<std::string>& texts) {
    const auto has_clear_comma = [](const std::string& text) { return text.find(',', 1) != std::string::npos; };
    return texts.size() >= 2 && std::all_of(texts.begin(), texts.end(), fits_decimal_comma) &&
           std::any_of(texts.begin(), texts.end(), has_clear_comma);
}

/// Returns a line without the quotes that enclose it as a whole: "1.0 0.0" in quotes is a pair of numbers.
std::string_view without_outer_quotes(std::string_view line) {
    if (line.size() < 2 || quoted_length(line) != line.size()) return line;
    return trimmed(line.substr(1, line.size() - 2));
}

/// Joins units that stand as words behind all numbers of a line, as in "350.0 mm 0.44 mm", to these.
void join_units(std::vector<Field>& fields) {
    if (fields.size() < 4 || fields.size() % 2 != 0) return;
    for (std::size_t i = 0; i < fields.size(); i += 2)
        if (fields[i].kind != FieldKind::number || !length_unit(fields[i + 1].text)) return;
    for (std::size_t i = 0; i < fields.size(); i += 2) {
        fields[i].unit = length_unit(fields[i + 1].text)->name;
        fields[i / 2] = fields[i];
    }
    fields.resize(fields.size() / 2);
}

/// Returns a text without the quotes round it, if there are any.
std::string_view without_quotes(std::string_view text) {
    const bool is_quoted = text.size() > 1 && (text[0] == '"' || text[0] == '\'') && text.back() == text[0];
    return is_quoted ? trimmed(text.substr(1, text.size() - 2)) : text;
}

}  // namespace

std::vector<std::string> read_names(std::string_view line) {
    constexpr std::string_view tecplot = "variables", separators = ";,\t";
    const std::string lower = core::lower_case(std::string(line));
    std::string_view rest = trimmed(lower);
    if (const std::size_t equals = rest.find('='); rest.starts_with(tecplot) && equals != std::string_view::npos)
        rest = trimmed(rest.substr(equals + 1));
    const auto separator = std::find_if(separators.begin(), separators.end(),
                                        [&](char c) { return rest.find(c) != std::string_view::npos; });
    std::vector<std::string> names;
    if (separator != separators.end()) {
        for (const std::string& name : core::split(std::string(rest), *separator))
            names.emplace_back(without_quotes(trimmed(name)));
        return names;
    }
    for (std::string& text : split(rest, false).texts) {
        const bool is_unit = !names.empty() && (text[0] == '[' || text[0] == '(');
        if (is_unit)
            names.back() += ' ' + text;
        else
            names.push_back(std::move(text));
    }
    return names;
}

FieldList read_fields(std::string_view line) {
    line = without_outer_quotes(line);
    FieldList result;
    SplitLine parts = split(line, false);
    result.has_decimal_commas = uses_decimal_commas(parts.texts);
    if (result.has_decimal_commas) {
        for (std::string& text : parts.texts) std::replace(text.begin(), text.end(), ',', '.');
    } else {
        parts = split(line, true);
        // In a line whose fields are quoted or divided by semicolons, decimal commas stand within the fields.
        for (std::string& text : parts.texts)
            if (text.find(',') != std::string::npos && fits_decimal_comma(text)) {
                std::replace(text.begin(), text.end(), ',', '.');
                result.has_decimal_commas = true;
            }
    }
    result.has_separators = parts.has_separators;
    result.has_comma_separators = parts.has_comma_separators;
    for (std::string& text : parts.texts) result.fields.push_back(make_field(std::move(text)));
    join_units(result.fields);
    return result;
}

}  // namespace lamina::geometry
