// Texts that are no lists of points, one in a line: PLOT3D, the points of Gmsh's .geo, and drawings.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/coordinate_blocks.hpp"
#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// Reads the outlines of a DXF or SVG drawing, of an IGES or of a STEP file; nothing for other texts. Throws
/// InputError, which says how to export points, for those without outlines, and for JSON that lists all x and then all
/// y.
std::optional<std::vector<RawOutline>> read_drawing(std::string_view text, const std::string& file, bool keep_open);

/// Returns whether a format (Element::format) is that of a drawing, whose curves are known.
bool is_drawing_format(std::string_view format);

/// Throws InputError, which says the same, for a text that cannot be read otherwise, where it is JSON or the extension
/// is that of one of these.
void refuse_unread_drawings(std::string_view text, const std::string& file);

/// Reads the points of Gmsh's geometry files, in the order in which lines and splines join them. Loops that contain all
/// others are far fields, and left out, as points on no curve are. Returns nothing for other texts. Throws InputError
/// for points that are no numbers and for outlines with curves that do not pass through their points.
std::optional<CoordinateDocument> read_gmsh_points(std::string_view text, const std::string& file);

/// Reads curves of PLOT3D grids, in two or three dimensions, one block or several: all x, then all y. The text must
/// hold exactly as many numbers as its first ones announce. Returns nothing for other texts, among them rows of two
/// numbers.
std::optional<CoordinateDocument> read_plot3d(std::string_view text);

}  // namespace lamina::geometry
