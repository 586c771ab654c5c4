// Rows of an airfoil file -> blocks: runs of coordinates without anything between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/coordinate_rows.hpp"
#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// Numbers of rows beyond the first two, which stay where they are while more are added.
class FurtherNumbers {
public:
    FurtherNumbers() = default;
    FurtherNumbers(const FurtherNumbers&) = delete;
    FurtherNumbers(FurtherNumbers&&) = default;
    FurtherNumbers& operator=(const FurtherNumbers&) = delete;
    FurtherNumbers& operator=(FurtherNumbers&&) = default;
    ~FurtherNumbers() = default;

    /// Returns the place of a copy; null for no numbers.
    const double* add(std::span<const double> numbers);

private:
    std::deque<std::vector<double>> blocks_;
};

/// A point with the numbers of its row, of which x and y are the first two until columns are chosen.
struct RowPoint : SourcePoint {
    std::uint16_t columns = 2;        ///< how many numbers the row has
    const double* further = nullptr;  ///< those behind the first two, in the FurtherNumbers of the document

    /// Returns one of these numbers; 0 where the row has none there.
    double operator[](std::size_t column) const {
        if (column < 2) return column == 0 ? at.x : at.y;
        return column < columns ? further[column - 2] : 0;
    }
};

using PointRun = std::vector<RowPoint>;

/// Points of a run that stand elsewhere. Files may have millions of them, so that they are not copied to be looked at.
using PointSpan = std::span<const RowPoint>;

/// Coordinates that follow each other without a blank line, comment, label or separator between them. Each may be a
/// single point, so that the section holds what blocks have.
struct CoordinateBlock {
    std::uint32_t first = 0;                  ///< of its points; they end where those of the next block begin
    std::uint32_t title = 0, title_size = 0;  ///< the place of the text before the block
    bool after_comment = false;  ///< comments, and perhaps blank lines, are all that divides it from the block before
};

/// The blocks between two separators, which are rows "999 999".
struct CoordinateSection {
    PointRun points;  ///< of all blocks
    std::vector<CoordinateBlock> blocks;
    std::string titles;  ///< of all blocks

    /// Returns the points of a block.
    PointSpan block(std::size_t i) const {
        const std::size_t end = i + 1 < blocks.size() ? blocks[i + 1].first : points.size();
        return PointSpan(points).subspan(blocks[i].first, end - blocks[i].first);
    }

    /// Returns the text before a block.
    std::string title(std::size_t i) const { return titles.substr(blocks[i].title, blocks[i].title_size); }

    void set_title(std::size_t i, const std::string& title);

    /// Removes the first point, and its block where it has no other one.
    void remove_first_point();

    /// Removes the blocks for which `removed` is set.
    void remove_blocks(const std::vector<bool>& removed);
};

/// All coordinates of a file, and what the text round them says.
struct CoordinateDocument {
    std::deque<CoordinateSection> sections{1};
    FurtherNumbers numbers{};               ///< of the points
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
    bool has_rows = false;          ///< the file is not empty
    std::size_t fraction_line = 0;  ///< the first row of text that has a number with a fraction; 0: none
    std::string fraction_text;      ///< the start of that row, which may have been meant as coordinates
};

/// Divides the rows of a text into blocks and sections. Throws InputError, which names `file`, for damaged coordinates
/// and rows of more than `max_columns` numbers, and as RowReader does.
CoordinateDocument read_blocks(std::string_view text, const std::string& file);

}  // namespace lamina::geometry
