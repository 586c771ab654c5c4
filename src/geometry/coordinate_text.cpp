// Lexing of airfoil coordinate files: one row a line.
// What a row means depends on its neighbours, too; that is decided in outlines.cpp. Here each line is judged alone.
#include "geometry/coordinate_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <lamina/error.hpp>

namespace lamina::geometry {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
// Ctrl-Z ends old DOS files.
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\x1a'; }

std::string_view trimmed(std::string_view s) {
    while (!s.empty() && is_space(s.front())) s.remove_prefix(1);
    while (!s.empty() && is_space(s.back())) s.remove_suffix(1);
    return s;
}

/// Length of the valid UTF-8 sequence at the start of s; 0 if there is none.
std::size_t utf8_length(std::string_view s) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(s[i]); };
    const std::size_t n = byte(0) < 0x80 ? 1 : byte(0) < 0xC2 ? 0 : byte(0) < 0xE0 ? 2 : byte(0) < 0xF0 ? 3 : 4;
    if (n == 0 || n > s.size() || byte(0) > 0xF4) return 0;
    for (std::size_t i = 1; i < n; ++i)
        if ((byte(i) & 0xC0) != 0x80) return 0;
    // Overlong forms, surrogates and beyond U+10FFFF.
    if ((byte(0) == 0xE0 && byte(1) < 0xA0) || (byte(0) == 0xED && byte(1) >= 0xA0) ||
        (byte(0) == 0xF0 && byte(1) < 0x90) || (byte(0) == 0xF4 && byte(1) >= 0x90))
        return 0;
    return n;
}

enum class FieldKind {
    number,
    not_finite,   ///< nan, inf
    too_extreme,  ///< over- or underflows
    number_like,  ///< starts as a number does, goes on otherwise
    word,
};

struct Field {
    std::string text;
    FieldKind kind = FieldKind::word;
    double value = 0;
};

void classify(Field& field) {
    std::string s = field.text;
    if (s.size() > 1 && s[0] == '+' && s[1] != '-') s.erase(0, 1);
    std::replace_if(
        s.begin(), s.end(), [](char c) { return c == 'd' || c == 'D'; }, 'e');
    const auto [end, error] = std::from_chars(s.data(), s.data() + s.size(), field.value);
    if (error == std::errc::invalid_argument) {
        const std::size_t at = s.find_first_not_of("+-.");
        field.kind = at != std::string::npos && is_digit(s[at])         ? FieldKind::number_like
                     : at == std::string::npos && s.find('.') != s.npos ? FieldKind::number_like  // "......"
                                                                        : FieldKind::word;
    } else if (end != s.data() + s.size()) {
        field.kind = is_letter(s[0]) ? FieldKind::word : FieldKind::number_like;  // "infinite" starts with "inf"
    } else if (error == std::errc::result_out_of_range) {
        field.kind = FieldKind::too_extreme;
    } else {
        field.kind = std::isfinite(field.value) ? FieldKind::number : FieldKind::not_finite;
    }
}

/// "12", "-0,5", "1,0e-3": what a field may look like where the comma is the decimal sign.
bool fits_decimal_comma(std::string_view s, bool& has_comma) {
    std::size_t i = !s.empty() && (s[0] == '+' || s[0] == '-') ? 1 : 0;
    const auto digits = [&] {
        const std::size_t start = i;
        while (i < s.size() && is_digit(s[i])) ++i;
        return i > start;
    };
    if (!digits()) return false;
    if (i < s.size() && s[i] == ',') {
        ++i;
        if (!digits()) return false;
        has_comma = true;
    }
    if (i < s.size() && (s[i] == 'e' || s[i] == 'E')) {
        ++i;
        if (i < s.size() && (s[i] == '+' || s[i] == '-')) ++i;
        if (!digits()) return false;
    }
    return i == s.size();
}

struct Fields {
    std::vector<Field> fields;
    bool separated = false, decimal_comma = false;
};

/// White space separates; so does one comma or semicolon with white space round it. Two in a row enclose an empty
/// field.
Fields split(std::string_view s, bool comma_separates) {
    Fields result;
    bool expect_field = false;  // after a separator
    std::size_t i = 0;
    while (i < s.size()) {
        if (is_space(s[i])) {
            ++i;
        } else if (s[i] == ';' || (comma_separates && s[i] == ',')) {
            if (expect_field || result.fields.empty()) result.fields.emplace_back();
            expect_field = true;
            result.separated = true;
            ++i;
        } else {
            const std::size_t start = i;
            while (i < s.size() && !is_space(s[i]) && s[i] != ';' && !(comma_separates && s[i] == ',')) ++i;
            result.fields.push_back({std::string(s.substr(start, i - start))});
            expect_field = false;
        }
    }
    return result;
}

Fields split_fields(std::string_view s) {
    Fields coarse = split(s, false);
    bool has_comma = false;
    const bool decimal_comma =
        coarse.fields.size() >= 2 && std::all_of(coarse.fields.begin(), coarse.fields.end(),
                                                 [&](const Field& f) { return fits_decimal_comma(f.text, has_comma); });
    if (decimal_comma && has_comma) {
        for (Field& f : coarse.fields) std::replace(f.text.begin(), f.text.end(), ',', '.');
        coarse.decimal_comma = true;
    } else {
        coarse = split(s, true);
    }
    for (Field& f : coarse.fields) classify(f);
    return coarse;
}

bool has_point(const Field& f) { return f.text.find('.') != std::string::npos; }

/// Fills `damaged` and `damaged_in_run` of a row that does not start with two numbers.
void judge_text(Row& row, const std::vector<Field>& fields, bool first_content) {
    if (fields.empty()) return;
    const auto numeric = [](const Field& f) {
        return f.kind == FieldKind::number || f.kind == FieldKind::not_finite || f.kind == FieldKind::too_extreme;
    };
    const auto like = [&](const Field& f) { return numeric(f) || f.kind == FieldKind::number_like; };
    const std::size_t pair = std::min<std::size_t>(fields.size(), 2);
    const Field* culprit = nullptr;
    for (std::size_t i = 0; i < pair && !culprit; ++i)
        if (fields[i].kind != FieldKind::number) culprit = &fields[i];

    std::string reason;
    if (!culprit) {
        reason = "one number where two are expected";
    } else if (culprit->kind == FieldKind::not_finite) {
        reason = fmt::format("'{}' is not a finite number", printable(culprit->text));
    } else if (culprit->kind == FieldKind::too_extreme) {
        reason = fmt::format("'{}' is beyond the range of numbers", printable(culprit->text));
    } else {
        reason = fmt::format("'{}' is not a number", printable(culprit->text));
    }

    const bool both_numeric = fields.size() >= 2 && numeric(fields[0]) && numeric(fields[1]);
    const bool pair_like = (fields.size() == 2 || fields.size() == 3) && like(fields[0]) && like(fields[1]) &&
                           (numeric(fields[0]) || numeric(fields[1]));
    const bool pointed = first_content ? has_point(fields[0]) && has_point(fields[pair - 1])
                                       : has_point(fields[0]) || has_point(fields[pair - 1]);
    if (both_numeric || (pair_like && pointed)) row.damaged = reason;

    const bool starts_with_letter = !fields[0].text.empty() && is_letter(fields[0].text[0]);
    const bool any_number = std::any_of(fields.begin(), fields.end(), numeric);
    if (like(fields[0]) ? fields[0].kind != FieldKind::not_finite || fields.size() > 1
                        : !starts_with_letter && any_number)
        row.damaged_in_run = reason;
}

Row read_row(std::string_view line, std::size_t number, bool first_content) {
    Row row;
    row.line = number;
    line = trimmed(line);
    if (line.empty()) return row;
    if (line[0] == '#' || line[0] == '!' || line[0] == ';' || line[0] == '%' || line.starts_with("//")) {
        row.kind = RowKind::comment;
        const std::size_t start = line.find_first_not_of("#!;%/ \t");
        if (start != line.npos) row.text = printable(line.substr(start));
        return row;
    }
    const Fields found = split_fields(trimmed(line.substr(0, line.find_first_of("#!"))));
    const std::vector<Field>& fields = found.fields;
    while (row.count < fields.size() && fields[row.count].kind == FieldKind::number) {
        if (row.count < row.values.size()) row.values[row.count] = fields[row.count].value;
        ++row.count;
    }
    row.remark = row.count < fields.size();
    row.separated = found.separated;
    row.decimal_comma = found.decimal_comma;
    if (row.count >= 2) {
        row.kind = RowKind::numbers;
        row.points_written = has_point(fields[0]) && has_point(fields[1]);
        if (row.remark || row.count >= 4) row.text = printable(line);
    } else {
        row.kind = RowKind::text;
        row.text = printable(line);
        judge_text(row, fields, first_content);
    }
    return row;
}

}  // namespace

std::string printable(std::string_view bytes) {
    std::string text;
    while (!bytes.empty()) {
        const auto byte = static_cast<unsigned char>(bytes[0]);
        std::size_t n = utf8_length(bytes);
        if (n == 0) {  // Latin-1
            text += static_cast<char>(0xC0 | (byte >> 6));
            text += static_cast<char>(0x80 | (byte & 0x3F));
            n = 1;
        } else if (n == 1) {
            text += byte < 0x20 || byte == 0x7F ? ' ' : bytes[0];
        } else {
            text += bytes.substr(0, n);
        }
        bytes.remove_prefix(n);
    }
    return std::string(trimmed(text));
}

std::vector<Row> read_rows(std::string_view text, const std::string& file) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    std::vector<Row> rows;
    bool first_content = true;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = text.find_first_of("\r\n");
        const std::string_view line = text.substr(0, end);
        ++number;
        if (line.find('\0') != line.npos) throw InputError({file, number, {}}, "not a text file (NUL byte)");
        rows.push_back(read_row(line, number, first_content));
        if (rows.back().kind != RowKind::blank && rows.back().kind != RowKind::comment) first_content = false;
        if (end == text.npos) break;
        text.remove_prefix(text.substr(end).starts_with("\r\n") ? end + 2 : end + 1);
    }
    return rows;
}

}  // namespace lamina::geometry
