// Rows that begin with a label instead of a number: "P1 0.5 0.06", "upper,0.5,0.06".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/coordinate_rows.hpp"

namespace lamina::geometry {

/// Reads the rows of a text. Text rows that consist of a label and two numbers or more become rows of numbers where the
/// text has at least three of them and no other rows of numbers, but perhaps one before them, which counts them. Labels
/// that stay the same for three rows or more, all along, are those of surfaces or elements, and remain as
/// TextRow::label; others number or name single points.
class LabelledRowReader {
public:
    /// Reads the rows of a text as RowReader does. Throws InputError as RowReader::next() does.
    LabelledRowReader(std::string_view text, const std::string& file);

    /// Returns the next row; nothing at the end.
    std::optional<TextRow> next();

private:
    RowReader rows_;
    bool has_labels_ = false;        ///< whether labelled rows are rows of numbers
    bool labels_divide_ = false;     ///< whether their labels stay
    bool is_counted_ = false;        ///< a row of numbers stands before them
    bool in_labelled_rows_ = false;  ///< whether there were some

    void find_labels(RowReader rows);
};

}  // namespace lamina::geometry
