// Text of an airfoil file -> rows: which lines hold coordinates, which are titles, comments or blank.
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

struct Row {
    std::size_t line = 0;  ///< 1-based
    RowKind kind = RowKind::blank;
    std::size_t count = 0;           ///< leading numbers of a `numbers` row
    std::array<double, 3> values{};  ///< the first three of them
    bool remark = false;             ///< text follows the numbers
    bool points_written = false;     ///< both of the first two numbers are written with a decimal point
    bool separated = false;          ///< by commas or semicolons (CSV)
    bool decimal_comma = false;      ///< "0,5" was read as 0.5
    std::string text;                ///< of `text` and `comment` rows, UTF-8, trimmed

    /// Why a `text` row can only be a damaged pair of coordinates; empty = it need not be.
    std::string damaged;
    /// The same where the row before it holds coordinates.
    std::string damaged_in_run;
};

/// Lines end in LF, CR LF or CR. Numbers are decimal, correctly rounded, independent of the locale; Fortran's D
/// exponents and a leading + are understood. Throws InputError (naming `file`) for NUL bytes.
std::vector<Row> read_rows(std::string_view text, const std::string& file);

/// Printable UTF-8: bytes that are not valid UTF-8 are taken as Latin-1, control characters become spaces; trimmed.
std::string printable(std::string_view bytes);

}  // namespace lamina::geometry
