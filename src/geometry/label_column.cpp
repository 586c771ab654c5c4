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
    TextRow numbers = read_row(behind_first_field(row.text), row.line);
    if (numbers.kind != RowKind::numbers) return std::nullopt;
    numbers.has_label = true;
    numbers.label = printable(read_fields(row.text).fields[0].text);
    return numbers;
}

/// Returns whether a row of text that is no labelled row was meant as one: numbers stand beside a field that is none.
bool is_damaged(const TextRow& row) {
    if (row.kind != RowKind::text) return false;
    const FieldList rest = read_fields(behind_first_field(row.text));
    return rest.fields.size() == 2 && std::any_of(rest.fields.begin(), rest.fields.end(),
                                                  [](const Field& f) { return f.kind != FieldKind::word; });
}

/// Looks at labels one after the other.
class LabelCount {
public:
    void add(const std::string& label) {
        ++count_;
        if (label.empty()) return;
        if (same_ > 0 && label != last_) {
            stay_ &= same_ >= min_labelled_rows;
            same_ = 0;
            ++changes_;
        }
        ++same_;
        last_ = label;
    }

    std::size_t count() const { return count_; }

    /// Returns whether each label stays the same for several rows, and there are several labels.
    bool divide() const { return changes_ > 0 && stay_ && same_ >= min_labelled_rows; }

private:
    std::size_t count_ = 0, same_ = 0, changes_ = 0;
    bool stay_ = true;
    std::string last_;
};

}  // namespace

LabelledRowReader::LabelledRowReader(std::string_view text, const std::string& file) : rows_(text, file) {
    find_labels(rows_);
}

void LabelledRowReader::find_labels(RowReader rows) {
    std::size_t number_rows = 0;
    LabelCount labels;
    while (const std::optional<TextRow> row = rows.next()) {
        if (row->kind == RowKind::numbers) {
            if (++number_rows > 1) return;
            labels = {};
        } else if (const std::optional<TextRow> labelled = labelled_row(*row)) {
            labels.add(labelled->label);
        }
    }
    has_labels_ = labels.count() >= min_labelled_rows;
    labels_divide_ = labels.divide();
    is_counted_ = number_rows == 1;
}

std::optional<TextRow> LabelledRowReader::next() {
    std::optional<TextRow> row = rows_.next();
    if (!has_labels_ || !row) return row;
    if (row->kind == RowKind::numbers) {
        is_counted_ = false;
    } else if (is_counted_) {
        return row;
    } else if (std::optional<TextRow> labelled = labelled_row(*row)) {
        row = std::move(labelled);
        in_labelled_rows_ = true;
        if (!labels_divide_) row->label.clear();
    } else if (in_labelled_rows_ && is_damaged(*row)) {
        row->damage_in_run = row->damage =
            fmt::format("'{}' is no label and two numbers, as other rows are", row->text);
    }
    return row;
}

}  // namespace lamina::geometry
