// Rows of an airfoil file -> blocks: runs of coordinates without anything between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/coordinate_rows.hpp"
#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// A point with the numbers of its row.
struct RowPoint : SourcePoint {
    std::uint32_t columns = 2;  ///< how many numbers the row has
    RowValues values{};         ///< these numbers; x and y are the first two until columns are chosen
};

using PointRun = std::vector<RowPoint>;

/// Points of a run that stand elsewhere. Files may have millions of them, so that they are not copied to be looked at.
using PointSpan = std::span<const RowPoint>;

/// Coordinates that follow each other without a blank line, comment, label or separator between them.
struct CoordinateBlock {
    PointRun points;
    std::string title;           ///< the text before the block
    bool after_comment = false;  ///< comments, and perhaps blank lines, are all that divides it from the block before
};

/// The blocks between two separators, which are rows "999 999".
using CoordinateSection = std::vector<CoordinateBlock>;

/// All coordinates of a file, and what the text round them says.
struct CoordinateDocument {
    std::vector<CoordinateSection> sections{1};
    bool csv = false;                       ///< a row has commas or semicolons between its fields
    bool titled = false;                    ///< text stands before the first coordinates
    std::string first_comment;              ///< the first comment before the first coordinates
    std::string heading;                    ///< all text before the first coordinates, in lower case
    std::vector<std::string> column_names;  ///< fields of the last row before the first coordinates, in lower case
    std::size_t names_line = 0;             ///< the line of that row
    bool names_have_separators = false;     ///< commas or semicolons divide these fields
    std::string unit;                       ///< unit of length that the file names, such as "mm"; empty: none
    std::string first_row;                  ///< the first row of coordinates where it has whole numbers alone
    bool has_leading_zeros = false;         ///< a number of this row is written like "0012", but no later one is
    std::size_t symmetry_line = 0;          ///< the line that says that one surface stands for both; 0 where none does
    std::vector<std::string> notes;
};

/// Divides rows into blocks and sections. Throws InputError, which names `file`, for damaged coordinates and rows of
/// more than `max_columns` numbers.
CoordinateDocument split_into_blocks(const TextRows& rows, const std::string& file);

}  // namespace lamina::geometry
