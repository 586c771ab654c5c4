#include "geometry/label_column.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "geometry/characters.hpp"
#include "geometry/coordinate_fields.hpp"

namespace lamina::geometry {

namespace {

constexpr std::size_t min_labelled_rows = 3;

/// Returns the text behind the first field of a row and the separator that follows it.
std::string_view behind_first_field(std::string_view text) {
    const char quote = text.empty() ? ' ' : text[0];
    std::size_t end = quote == '"' || quote == '\'' ? text.find(quote, 1) : std::string_view::npos;
    end = end == std::string_view::npos ? text.find_first_of(" \t,;") : end + 1;
    text = trimmed(text.substr(std::min(end, text.size())));
    if (text.starts_with(',') || text.starts_with(';')) text.remove_prefix(1);
    return trimmed(text);
}

/// Returns the numbers behind the label of a row of text, as a row of their own; nothing for other rows.
std::optional<TextRow> labelled_row(const TextRow& row) {
    if (row.kind != RowKind::text || row.number_count > 0) return std::nullopt;
    TextRow numbers = read_row(behind_first_field(row.words().text), row.line);
    if (numbers.kind != RowKind::numbers) return std::nullopt;
    numbers.has_label = true;
    numbers.change_words().label = printable(read_fields(row.words().text).fields[0].text);
    return numbers;
}

/// Returns whether a row of text that is no labelled row was meant as one: numbers stand beside a field that is none.
bool is_damaged(const TextRow& row) {
    if (row.kind != RowKind::text) return false;
    const FieldList rest = read_fields(behind_first_field(row.words().text));
    return rest.fields.size() == 2 && std::any_of(rest.fields.begin(), rest.fields.end(),
                                                  [](const Field& f) { return f.kind != FieldKind::word; });
}

/// Returns whether each label of some rows stays the same for several of them.
bool labels_divide(const TextRows& rows) {
    std::size_t same = min_labelled_rows, changes = 0;
    const std::string* previous = nullptr;
    for (const TextRow& row : rows) {
        const std::string& label = row.words().label;
        if (label.empty()) continue;
        if (!previous || label == *previous) {
            same = previous ? same + 1 : 1;
        } else {
            if (same < min_labelled_rows) return false;
            same = 1;
            ++changes;
        }
        previous = &label;
    }
    return changes > 0 && same >= min_labelled_rows;
}

}  // namespace

bool is_labelled(const TextRow& row) { return labelled_row(row).has_value(); }

void read_label_column(TextRows& rows) {
    const auto is_numbers = [](const TextRow& row) { return row.kind == RowKind::numbers; };
    const auto number_rows = std::count_if(rows.begin(), rows.end(), is_numbers);
    if (number_rows > 1) return;
    const auto start = number_rows == 0 ? rows.begin() : std::find_if(rows.begin(), rows.end(), is_numbers) + 1;
    if (std::count_if(start, rows.end(), is_labelled) < static_cast<std::ptrdiff_t>(min_labelled_rows)) return;
    bool in_rows = false;
    for (auto row = start; row != rows.end(); ++row) {
        if (std::optional<TextRow> labelled = labelled_row(*row)) {
            *row = std::move(*labelled);
            in_rows = true;
        } else if (in_rows && is_damaged(*row)) {
            RowWords& words = row->change_words();
            words.damage_in_run = words.damage =
                fmt::format("'{}' is no label and two numbers, as other rows are", words.text);
        }
    }
    if (labels_divide(rows)) return;
    for (TextRow& row : rows)
        if (row.own_words) row.own_words->label.clear();
}

}  // namespace lamina::geometry
