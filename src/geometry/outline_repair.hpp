// Raw outline -> closed counter-clockwise element, every change reported.
#pragma once

#include <lamina/geometry.hpp>

#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// Removes repeated neighbours (nearer than 1e-12 of the extent, as after rounding), merges neighbours within 1e-4 of
/// the extent whose other edges cross, cuts off a trailing edge without thickness of at most 1 % of the extent, closes
/// an open outline by a base edge with vertices spaced like its neighbours, reverses clockwise order. Coordinates stay
/// as they are; the first point stays first, unless it was cut off. Whether the outline is simple is for check_simple()
/// to say. Throws InputError for fewer than three points, points on one line, and an outline too open to be closed. The
/// element's name stays empty.
Element repair_outline(const RawOutline& outline, const std::string& file);

}  // namespace lamina::geometry
