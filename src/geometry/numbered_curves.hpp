// Files of curves: as many curves of as many points as the first row says, or rows that begin with the numbers of a
// curve and of a point on it.
#pragma once

#include <string>
#include <vector>

#include "geometry/coordinate_blocks.hpp"

namespace lamina::geometry {

/// Divides a section into the curves of ICEM's formatted points: the first row holds the number of points of each curve
/// and the number of curves, which fit the rows that follow exactly. It has other columns than these, or lies far from
/// them. Returns notes; none where the section is no such file.
std::vector<std::string> divide_counted_curves(CoordinateSection& section);

/// Divides a section into the curves of ANSYS DesignModeler's coordinates: rows begin with the numbers of a curve and
/// of a point on it, which counts from the same number on each curve. A row of the number of a curve and 0 closes it.
/// Returns notes; none where the section is no such file.
std::vector<std::string> divide_numbered_curves(CoordinateSection& section);

/// Removes blocks that a title above them calls camber line, mean line or chord line, where others are left. Returns
/// notes.
std::vector<std::string> remove_auxiliary_lines(CoordinateSection& section);

}  // namespace lamina::geometry
