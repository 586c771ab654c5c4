// Which columns of a file hold x and y.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/coordinate_blocks.hpp"
#include "geometry/surface_table.hpp"

namespace lamina::geometry {

/// The result of choose_columns(): what the columns of a section hold.
struct ColumnReading {
    std::vector<std::string> notes;     ///< on what was decided
    std::optional<SurfaceTable> table;  ///< where the rows are a table of both surfaces
};

/// Sets the coordinates of the points of a section from the columns of their rows. This evidence decides, in this
/// order:
/// - A header names one column x, and one y (or z where none is y). Where it names x, y and z, a constant one is left
///   out.
/// - A header names the columns of a table that read_named_table() knows.
/// - A column that counts the rows, in steps of one, is left out.
/// - Three columns that read_surface_table() accepts, or four that read_paired_table() does, are a table.
/// - Columns that are the same in all rows are left out.
/// Names that decide nothing are refused where columns are left that a header names.
/// Rows of two whole numbers may be the counts of a Lednicer file. They keep these two where other rows have more.
/// Throws InputError, which names `file`, for rows that differ in their number of columns, for more than two columns
/// that are left, for columns of unknown names, and for coordinates outside the exact range.
ColumnReading choose_columns(CoordinateSection& section, const CoordinateDocument& document, const std::string& file);

}  // namespace lamina::geometry
