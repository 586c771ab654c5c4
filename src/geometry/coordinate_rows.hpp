// Text of an airfoil file -> rows: lines that hold coordinates, titles, comments or nothing. Each line is judged by
// itself here; coordinate_blocks.hpp judges it among its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::geometry {

enum class RowKind {
    blank,
    comment,  ///< starts with # ! ; % or //
    text,     ///< titles, labels, tags
    numbers,  ///< starts with two numbers
};

/// How many numbers of a row are kept.
inline constexpr std::size_t max_columns = 8;

/// One line of a file.
struct TextRow {
    std::size_t line = 0;  ///< counts from 1
    RowKind kind = RowKind::blank;
    std::size_t number_count = 0;              ///< how many numbers the row starts with
    std::array<double, max_columns> values{};  ///< the first of these numbers
    bool has_fractions = false;         ///< one of these numbers is not written as a whole number: "17" and "17." are
    bool has_leading_zeros = false;     ///< one of these numbers is written like "0012"
    bool has_remark = false;            ///< text follows the numbers
    bool has_arrow = false;             ///< an arrow stands between numbers, as in "0.1 0.02 -> 0.021"
    bool has_decimal_points = false;    ///< both of the first two numbers are written with a decimal point
    bool has_separators = false;        ///< fields are separated by commas or semicolons (CSV)
    bool has_comma_separators = false;  ///< fields are separated by commas
    bool has_decimal_commas = false;    ///< "0,5" was read as 0.5
    bool has_label = false;             ///< a label stands before the numbers
    std::string_view unit;              ///< of the numbers, such as "mm"; empty: none is written behind them
    std::string label;                  ///< of the numbers, where it tells surfaces or elements apart
    std::vector<std::string> names;  ///< fields of a row without coordinates, in lower case: names of columns, perhaps
    /// Trimmed UTF-8 text of `text` and `comment` rows, and of `numbers` rows with a remark or without fractions.
    std::string text;
    /// Why a `text` row can only be a damaged pair of coordinates; empty where it need not be one.
    std::string damage;
    /// Why a `text` row can only be a damaged pair of coordinates where the row before it holds coordinates.
    std::string damage_in_run;
};

/// Returns a row of a line that is neither blank nor a comment, as one that is not the first of its file.
TextRow read_row(std::string_view line, std::size_t number);

/// Returns the rows of a text: one for each line, or several for a line that lists points in brackets. Of very long runs of
/// rows without numbers only the first ones and the last text stay. Lines end in LF,
/// CR LF or CR. Throws InputError, which names `file`, for NUL bytes.
std::vector<TextRow> read_rows(std::string_view text, const std::string& file);

}  // namespace lamina::geometry
