// Text of an airfoil file -> rows: lines that hold coordinates, titles, comments or nothing. Each line is judged by
// itself here; coordinate_blocks.hpp judges it among its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lamina::geometry {

enum class RowKind : std::uint8_t {
    blank,
    comment,  ///< starts with # ! ; % or //
    text,     ///< titles, labels, tags
    numbers,  ///< starts with two numbers
};

/// How many numbers of a row are kept.
inline constexpr std::size_t max_columns = 8;

/// One line of a file, or one point of a line that lists several.
struct TextRow {
    std::size_t line = 0;  ///< counts from 1
    RowKind kind = RowKind::blank;
    bool has_fractions = false;         ///< one of these numbers is not written as a whole number: "17" and "17." are
    bool has_leading_zeros = false;     ///< one of these numbers is written like "0012"
    bool has_remark = false;            ///< text follows the numbers
    bool has_decimal_points = false;    ///< both of the first two numbers are written with a decimal point
    bool has_separators = false;        ///< fields are separated by commas or semicolons (CSV)
    bool has_comma_separators = false;  ///< fields are separated by commas
    bool has_decimal_commas = false;    ///< "0,5" was read as 0.5
    bool has_label = false;             ///< a label stands before the numbers
    bool has_arrow = false;             ///< an arrow stands between numbers, as in "0.1 0.02 -> 0.021"
    std::size_t number_count = 0;       ///< how many numbers the row starts with, at most `max_fields`
    std::array<double, max_columns> values{};  ///< the first of these numbers
    std::string_view unit{};                   ///< of the numbers, such as "mm"; empty: none is written behind them
    std::string label{};                       ///< of the numbers, where it tells surfaces or elements apart
    std::vector<std::string>
        names{};  ///< fields of a row without coordinates, in lower case: names of columns, perhaps
    /// Trimmed UTF-8 text of `text` and `comment` rows, and of `numbers` rows with a remark or without fractions.
    std::string text{};
    /// Why a `text` row can only be a damaged pair of coordinates; empty where it need not be one.
    std::string damage{};
    /// Why a `text` row can only be a damaged pair of coordinates where the row before it holds coordinates.
    std::string damage_in_run{};
};

/// Returns whether a row of numbers is "999 999", which divides sections.
bool is_separator(const TextRow& row);

/// Returns a row of a line that is neither blank nor a comment, as one that is not the first of its file.
TextRow read_row(std::string_view line, std::size_t number);

/// Reads the rows of a text one after the other, since all of them together would take many times its size: one for
/// each line, or several for a line that lists points in brackets. Lines end in LF, CR LF or CR. A copy reads on from
/// the same place.
class RowReader {
public:
    /// The text must outlive the reader, and its copies. Throws InputError, which names `file`, for UTF-16.
    RowReader(std::string_view text, std::string file);

    /// Returns the next row; nothing at the end. Throws InputError for NUL bytes.
    std::optional<TextRow> next();

private:
    std::string_view rest_;
    std::string file_;
    std::size_t line_ = 0;                                    ///< of the last row
    std::shared_ptr<const std::vector<std::string>> listed_;  ///< the points of that line, if it lists them in brackets
    std::size_t next_listed_ = 0;
    bool is_first_row_ = true;  ///< only blank lines and comments were read so far

    TextRow read_line(std::string_view line);
};

}  // namespace lamina::geometry
