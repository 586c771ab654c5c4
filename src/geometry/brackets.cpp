#include "geometry/brackets.hpp"

#include <algorithm>
#include <cstddef>

#include "geometry/characters.hpp"
#include "geometry/coordinate_fields.hpp"

namespace lamina::geometry {

namespace {

constexpr std::string_view opening_brackets = "([{", closing_brackets = ")]}";

bool is_opening(char c) { return opening_brackets.find(c) != std::string_view::npos; }

bool is_bracket(char c) { return is_opening(c) || closing_brackets.find(c) != std::string_view::npos; }

/// Returns whether nothing but white space and separators stands in a text.
bool only_separates(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return is_space(c) || c == ',' || c == ';'; });
}

/// Returns a text without separators at its end, which belong to the list that holds it.
std::string_view without_last_separators(std::string_view text) {
    while (!text.empty() && only_separates(text.substr(text.size() - 1))) text.remove_suffix(1);
    return text;
}

/// Returns whether a text that stands before the first bracket with numbers may belong to a list: nothing, the start of
/// an outer list, or a name to which the list is assigned.
bool may_start_list(std::string_view text) {
    text = trimmed(text);
    return only_separates(text) || is_opening(text.back()) || text.back() == '=';
}

/// Returns the texts within the innermost brackets of a line that is part of a list; nothing for other lines.
std::vector<std::string_view> innermost_texts(std::string_view line) {
    std::vector<std::string_view> texts;
    std::size_t start = 0;  // of the text that ends at the next bracket
    for (std::size_t i = 0; i <= line.size(); ++i) {
        const bool at_end = i == line.size();
        if (!at_end && !is_bracket(line[i])) continue;
        const std::string_view text = line.substr(start, i - start);
        const bool opened = start > 0 && is_opening(line[start - 1]), closed = !at_end && !is_opening(line[i]);
        const bool is_inner = (opened || start == 0) && (closed || at_end) && !only_separates(text);
        if (is_inner) {
            if (texts.empty() && start > 0 && !may_start_list(line.substr(0, start - 1))) return {};
            texts.push_back(without_last_separators(text));
        } else if (!texts.empty() && !only_separates(text)) {
            return {};
        }
        start = i + 1;
    }
    return texts;
}

/// Returns the parts of a text between semicolons if each has two fields or more, else the text.
std::vector<std::string> divided_at_semicolons(std::string_view text) {
    std::vector<std::string> parts;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find(';', at), text.size());
        parts.emplace_back(text.substr(at, end - at));
        at = end + 1;
    }
    const bool all_rows = std::all_of(parts.begin(), parts.end(),
                                      [](const std::string& part) { return read_fields(part).fields.size() >= 2; });
    return all_rows ? parts : std::vector<std::string>{std::string(text)};
}

/// Returns whether a row can only be meant as numbers: fields that resemble them, or one with a decimal point beside a
/// damaged one.
bool is_meant_as_numbers(const std::string& row) {
    std::size_t words = 0, fractions = 0;
    for (const Field& field : read_fields(row).fields) {
        words += field.kind == FieldKind::word;
        fractions += field.kind == FieldKind::number && field.text.find('.') != std::string::npos;
    }
    return words == 0 || (words == 1 && fractions > 0);
}

}  // namespace

std::vector<std::string> rows_in_brackets(std::string_view line) {
    if (std::none_of(line.begin(), line.end(), is_bracket)) return {};
    std::vector<std::string> rows;
    bool single = true;
    for (const std::string_view text : innermost_texts(line)) {
        for (std::string& row : divided_at_semicolons(text)) rows.push_back(std::move(row));
        single &= read_fields(rows.back()).fields.size() == 1;
    }
    if (!std::all_of(rows.begin(), rows.end(), is_meant_as_numbers)) return {};
    if (!single) return rows;
    if (rows.size() < 2) return {};
    std::string row;
    for (const std::string& field : rows) row += field + ' ';
    return {row};
}

bool has_brackets_alone(std::string_view line) {
    return std::all_of(line.begin(), line.end(), [](char c) { return is_bracket(c) || only_separates({&c, 1}); });
}

}  // namespace lamina::geometry
