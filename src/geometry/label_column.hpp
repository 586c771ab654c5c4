// Rows that begin with a label instead of a number: "P1 0.5 0.06", "upper,0.5,0.06".
#pragma once

#include <vector>

#include "geometry/coordinate_rows.hpp"

namespace lamina::geometry {

/// Returns whether a row of text consists of a label and two numbers or more.
bool is_labelled(const TextRow& row);

/// Makes rows of numbers of the text rows of a file that consist of a label and two numbers or more, where there are at
/// least three and no other rows of numbers, but perhaps one before them, which counts them. Labels that stay the same
/// for three rows or more, all along, are those of surfaces or elements, and remain as TextRow::label; others number or
/// name single points.
void read_label_column(TextRows& rows);

}  // namespace lamina::geometry
