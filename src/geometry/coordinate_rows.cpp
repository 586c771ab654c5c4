#include "geometry/coordinate_rows.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include <lamina/error.hpp>

#include "geometry/brackets.hpp"
#include "geometry/characters.hpp"
#include "geometry/coordinate_fields.hpp"

namespace lamina::geometry {

namespace {

bool has_point(const Field& f) { return f.text.find('.') != std::string::npos; }

/// Returns whether a field was written as a number without a unit, as the titles of sections may hold them.
bool is_numeric(const Field& f) {
    return (f.kind == FieldKind::number && f.unit.empty()) || f.kind == FieldKind::not_finite ||
           f.kind == FieldKind::too_extreme;
}

bool resembles_number(const Field& f) { return is_numeric(f) || f.kind == FieldKind::number_like; }

/// Returns whether a row, whatever stands before it, can only be a damaged pair of coordinates. Titles may be numbers
/// and words mixed ("63 212a"), so that decimal points are wanted too: in both fields of the first row of a file, which
/// is the place of the title, and in one field elsewhere.
bool must_be_coordinates(const std::vector<Field>& fields, bool is_first_row) {
    if (fields.size() < 2) return false;
    const Field &x = fields[0], &y = fields[1];
    if (is_numeric(x) && is_numeric(y)) return true;
    const bool resembles_pair =
        fields.size() <= 3 && resembles_number(x) && resembles_number(y) && (is_numeric(x) || is_numeric(y));
    const bool has_points = is_first_row ? has_point(x) && has_point(y) : has_point(x) || has_point(y);
    return resembles_pair && has_points;
}

/// Returns whether a row that follows coordinates can only be a damaged pair of coordinates.
bool must_be_coordinates_in_run(const std::vector<Field>& fields) {
    const Field& first = fields[0];
    // A single "nan" or "inf" may be a label.
    if (resembles_number(first)) return first.kind != FieldKind::not_finite || fields.size() > 1;
    const bool starts_with_letter = !first.text.empty() && is_letter(first.text[0]);
    return !starts_with_letter && std::any_of(fields.begin(), fields.end(), is_numeric);
}

/// Returns why the first two fields are no pair of coordinates.
std::string describe_damage(const std::vector<Field>& fields) {
    const auto end = fields.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(fields.size(), 2));
    const auto culprit = std::find_if(fields.begin(), end, [](const Field& f) { return f.kind != FieldKind::number; });
    if (culprit == end) return "one number where two are expected";
    const std::string text = printable(culprit->text);
    if (culprit->kind == FieldKind::not_finite) return fmt::format("'{}' is not a finite number", text);
    if (culprit->kind == FieldKind::too_extreme) return fmt::format("'{}' is beyond the range of numbers", text);
    return fmt::format("'{}' is not a number", text);
}

bool starts_comment(std::string_view line) {
    return line[0] == '#' || line[0] == '!' || line[0] == ';' || line[0] == '%' || line.starts_with("//");
}

/// Returns whether a text is a whole number: "17", "-3", "17.".
bool is_whole(const std::string& text) {
    const std::size_t start = text[0] == '+' || text[0] == '-' ? 1 : 0;
    const std::size_t end =
        std::find_if_not(text.begin() + static_cast<std::ptrdiff_t>(start), text.end(), is_digit) - text.begin();
    return end > start && (end == text.size() || text.substr(end) == ".");
}

/// Returns a line without the comment at its end that starts with a character for comments alone.
std::string_view without_clear_comment(std::string_view line) {
    return trimmed(line.substr(0, std::min({line.find_first_of("#!%"), line.find("//")})));
}

/// Returns a line without the comment at its end. A semicolon starts a comment where white space divides the numbers
/// before it; else it is a separator.
std::string_view without_comment(std::string_view line) {
    line = without_clear_comment(line);
    const std::size_t semicolon = line.find(';');
    if (semicolon == std::string_view::npos) return line;
    const std::string_view before = trimmed(line.substr(0, semicolon));
    const bool divided = std::any_of(before.begin(), before.end(), is_space) && read_fields(before).fields.size() >= 2;
    return divided ? before : trimmed(line);
}

/// Returns whether a line says by an arrow which number was changed: "0.99976 -0.00015 -> 0.99976 -0.000149".
bool has_arrow_between_numbers(std::string_view line) {
    const std::size_t arrow = line.find("->");
    if (arrow == std::string_view::npos) return false;
    const auto at = line.begin() + static_cast<std::ptrdiff_t>(arrow);
    return std::any_of(line.begin(), at, is_digit) && std::any_of(at, line.end(), is_digit);
}

/// Reads the fields of a line that is neither blank nor a comment into `row`.
void read_text_or_numbers(std::string_view line, bool is_first_row, TextRow& row) {
    const FieldList list = read_fields(without_comment(line));
    const std::vector<Field>& fields = list.fields;
    while (row.number_count < fields.size() && fields[row.number_count].kind == FieldKind::number) {
        const Field& field = fields[row.number_count];
        if (row.number_count < max_columns) row.values[row.number_count] = field.value;
        if (row.unit.empty()) row.unit = field.unit;
        row.has_fractions |= !is_whole(field.text);
        row.has_leading_zeros |=
            is_whole(field.text) && field.text.size() > 1 && field.text[0] == '0' && is_digit(field.text[1]);
        ++row.number_count;
    }
    row.has_remark = row.number_count < fields.size();
    row.has_arrow = has_arrow_between_numbers(line);
    row.has_separators = list.has_separators;
    row.has_comma_separators = list.has_comma_separators;
    row.has_decimal_commas = list.has_decimal_commas;
    if (row.number_count >= 2) {
        row.kind = RowKind::numbers;
        row.has_decimal_points = has_point(fields[0]) && has_point(fields[1]);
        if (row.has_remark || !row.has_fractions) row.text = printable(line);
        return;
    }
    row.kind = RowKind::text;
    row.text = printable(line);
    row.names = read_names(line);
    if (fields.empty()) return;
    if (must_be_coordinates(fields, is_first_row)) row.damage = describe_damage(fields);
    if (must_be_coordinates_in_run(fields)) row.damage_in_run = describe_damage(fields);
}

void read_comment(std::string_view line, TextRow& row) {
    row.kind = RowKind::comment;
    const std::size_t start = line.find_first_not_of("#!;%/ \t");
    if (start == std::string_view::npos) return;
    row.text = printable(line.substr(start));
    row.names = read_names(line.substr(start));
}

}  // namespace

bool is_separator(const TextRow& row) { return row.values[0] == 999.0 && row.values[1] == 999.0; }

TextRow read_row(std::string_view line, std::size_t number) {
    TextRow row;
    row.line = number;
    read_text_or_numbers(line, false, row);
    return row;
}

RowReader::RowReader(std::string_view text, std::string file) : rest_(text), file_(std::move(file)) {
    if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))
        throw InputError({file_, 1, {}}, "the text is UTF-16; save it as UTF-8 or ASCII");
    if (text.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);  // the byte order mark of UTF-8
}

std::optional<TextRow> RowReader::next() {
    TextRow row;
    if (listed_ && next_listed_ < listed_->size()) {
        row.line = line_;
        read_text_or_numbers((*listed_)[next_listed_++], false, row);
        return row;
    }
    listed_.reset();
    if (rest_.empty()) return std::nullopt;
    const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
    const std::string_view line = rest_.substr(0, end);
    rest_.remove_prefix(end);
    rest_.remove_prefix(rest_.starts_with("\r\n") ? 2 : std::min<std::size_t>(rest_.size(), 1));
    ++line_;
    if (line.find('\0') != std::string_view::npos) throw InputError({file_, line_, {}}, "not a text file (NUL byte)");
    row = read_line(trimmed(with_plain_signs(line)));
    if (row.kind != RowKind::blank && row.kind != RowKind::comment) is_first_row_ = false;
    return row;
}

/// Reads the first row of a trimmed line.
TextRow RowReader::read_line(std::string_view line) {
    TextRow row;
    row.line = line_;
    if (line.empty()) return row;
    if (starts_comment(line)) {
        read_comment(line, row);
        return row;
    }
    if (has_brackets_alone(line)) return row;
    std::vector<std::string> listed = rows_in_brackets(without_clear_comment(line));
    if (listed.empty()) {
        read_text_or_numbers(line, is_first_row_, row);
        return row;
    }
    read_text_or_numbers(listed[0], is_first_row_, row);
    listed_ = std::make_shared<const std::vector<std::string>>(std::move(listed));
    next_listed_ = 1;
    return row;
}

}  // namespace lamina::geometry
