// Tables of x and the ordinates of both surfaces.
#pragma once

#include <optional>
#include <string>

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// The two surfaces of a table, both from the nose to the tail.
struct SurfaceTable {
    PointRun upper, lower;
    bool downward;  ///< the file counts lower ordinates downward
};

/// Reads three columns as x, upper and lower ordinate, or as x, lower and upper ordinate where the heading names them
/// in this order. The columns must be a table: x rises from row to row, the surfaces meet at the nose, nearly meet at
/// the tail and meet nowhere between. Where the surfaces would cross otherwise, lower ordinates count downward. Returns
/// nothing for other runs.
std::optional<SurfaceTable> read_surface_table(const PointRun& points, const std::string& heading);

}  // namespace lamina::geometry
