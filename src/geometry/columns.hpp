// Which columns of a file hold x and y.
#pragma once

#include <string>
#include <vector>

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// Sets the coordinates of the points of a section from the columns of their rows. Where there are more than two, this
/// evidence decides, in this order:
/// - A header names one column x, and one y (or z where none is y).
/// - A column that counts the rows, in steps of one, is left out.
/// - Three columns that read_surface_table() accepts stay, as the first three values of their rows.
/// - Columns that are the same in all rows are left out.
/// Rows of two whole numbers may be the counts of a Lednicer file. They keep these two where other rows have more.
/// Returns notes on what was decided. Throws InputError, which names `file`, for rows that differ in their number of
/// columns, for more than two columns that are left, and for coordinates outside the exact range.
std::vector<std::string> choose_columns(CoordinateSection& section, const CoordinateDocument& document,
                                        const std::string& file);

}  // namespace lamina::geometry
