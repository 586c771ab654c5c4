// Text of an airfoil file -> rows: lines that hold coordinates, titles, comments or nothing. Each line is judged by
// itself here; coordinate_blocks.hpp judges it among its neighbours.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
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

/// The first numbers of a row, at most `max_columns`. Most rows have two, so that further ones stand apart.
class RowValues {
public:
    RowValues() = default;
    RowValues(const RowValues& other) : pair_(other.pair_) {
        if (other.further_) further_ = std::make_unique<Further>(*other.further_);
    }
    RowValues(RowValues&&) noexcept = default;
    RowValues& operator=(const RowValues& other) { return *this = RowValues(other); }
    RowValues& operator=(RowValues&&) noexcept = default;
    ~RowValues() = default;

    /// Returns a number, below `max_columns`; 0 where the row has none there.
    double operator[](std::size_t i) const {
        if (i < pair_.size()) return pair_[i];
        return further_ ? (*further_)[i - pair_.size()] : 0;
    }

    void set(std::size_t i, double value) {
        if (i < pair_.size()) {
            pair_[i] = value;
            return;
        }
        if (!further_) further_ = std::make_unique<Further>();
        (*further_)[i - pair_.size()] = value;
    }

private:
    using Further = std::array<double, max_columns - 2>;
    std::array<double, 2> pair_{};
    std::unique_ptr<Further> further_;
};

/// The texts of a row.
struct RowWords {
    std::string_view unit;           ///< of the numbers, such as "mm"; empty: none is written behind them
    std::string label;               ///< of the numbers, where it tells surfaces or elements apart
    std::vector<std::string> names;  ///< fields of a row without coordinates, in lower case: names of columns, perhaps
    /// Trimmed UTF-8 text of `text` and `comment` rows, and of `numbers` rows with a remark or without fractions that
    /// may stand before the first points or be a note.
    std::string text;
    /// Why a `text` row can only be a damaged pair of coordinates; empty where it need not be one.
    std::string damage;
    /// Why a `text` row can only be a damaged pair of coordinates where the row before it holds coordinates.
    std::string damage_in_run;
};

/// One line of a file. A file may have millions of a few bytes each, so that what few rows have stands apart.
struct TextRow {
    std::uint32_t line = 0;  ///< counts from 1
    RowKind kind = RowKind::blank;
    bool has_fractions : 1 = false;       ///< one of these numbers is not written as a whole number: "17" and "17." are
    bool has_leading_zeros : 1 = false;   ///< one of these numbers is written like "0012"
    bool has_remark : 1 = false;          ///< text follows the numbers
    bool has_decimal_points : 1 = false;  ///< both of the first two numbers are written with a decimal point
    bool has_separators : 1 = false;      ///< fields are separated by commas or semicolons (CSV)
    bool has_comma_separators : 1 = false;  ///< fields are separated by commas
    bool has_decimal_commas : 1 = false;    ///< "0,5" was read as 0.5
    bool has_label : 1 = false;             ///< a label stands before the numbers
    std::uint16_t number_count : 15 = 0;    ///< how many numbers the row starts with, at most `max_fields`
    bool has_arrow : 1 = false;             ///< an arrow stands between numbers, as in "0.1 0.02 -> 0.021"
    RowValues values;                       ///< the first of these numbers
    std::unique_ptr<RowWords> own_words;    ///< none where all of them are empty

    /// Returns the texts of the row, empty ones where it has none.
    const RowWords& words() const {
        static const RowWords none;
        return own_words ? *own_words : none;
    }

    /// Returns the texts of the row, to be changed.
    RowWords& change_words() {
        if (!own_words) own_words = std::make_unique<RowWords>();
        return *own_words;
    }
};

/// The rows of a file; a deque takes no more room while it grows.
using TextRows = std::deque<TextRow>;

/// Returns whether a row of numbers is "999 999", which divides sections.
bool is_separator(const TextRow& row);

/// Returns a row of a line that is neither blank nor a comment, as one that is not the first of its file.
TextRow read_row(std::string_view line, std::size_t number);

/// Returns the rows of a text: one for each line, or several for a line that lists points in brackets. Of very long runs of
/// rows without numbers only the first ones and the last text stay. Lines end in LF,
/// CR LF or CR. Throws InputError, which names `file`, for NUL bytes.
TextRows read_rows(std::string_view text, const std::string& file);

}  // namespace lamina::geometry
