// Tables of both surfaces of a section, row by row.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/column_names.hpp"
#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// The two surfaces of a table, both from the nose to the tail.
struct SurfaceTable {
    PointRun upper, lower;
    std::string contents;  ///< what the columns hold, for a note: "x, upper and lower ordinates"
};

/// Reads three columns as x, upper and lower ordinate, or as x, lower and upper ordinate where the heading names them
/// in this order. The columns must be a table: x rises from row to row, the surfaces meet at the nose, nearly meet at
/// the tail and meet nowhere between. Where the surfaces would cross otherwise, lower ordinates count downward. Returns
/// nothing for other rows.
std::optional<SurfaceTable> read_surface_table(PointSpan rows, const std::array<std::size_t, 3>& columns,
                                               const std::string& heading);

/// Reads four columns as x and y of one surface, and x and y of the other, in rows that both begin at the nose or both
/// at the tail. Each x must rise or fall all along, and the two surfaces have both ends in common. Returns nothing for
/// other rows.
std::optional<SurfaceTable> read_paired_table(PointSpan rows, const std::array<std::size_t, 4>& columns);

/// Reads the columns of `rows` as the header names them: x with upper and lower ordinates; x and y of each surface; x
/// with thickness and camber, which give the surfaces at camber +- thickness / 2; x with thickness alone, of a
/// symmetric section. Rows run either way. Returns nothing where the roles are not those of a table. Throws InputError,
/// which names `file`, where x turns back.
std::optional<SurfaceTable> read_named_table(const PointRun& rows, const std::vector<ColumnRole>& roles,
                                             const std::string& file);

}  // namespace lamina::geometry
