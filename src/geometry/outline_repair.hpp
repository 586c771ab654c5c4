// Raw outline -> closed counter-clockwise element; every change is reported.
#pragma once

#include <string>

#include <lamina/geometry.hpp>

#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// Returns the element of an outline, without a name. The repairs:
/// - Neighbours nearer than 1e-12 of the extent, which differ by rounding alone, become one point.
/// - Neighbours within 1e-4 of the extent whose other edges cross become one point.
/// - A trailing edge without thickness, of at most 1 % of the extent, is cut off.
/// - A tail behind a crossing of the two surfaces, of at most 2 % of the extent, is cut off at the crossing.
/// - An open outline is closed by a base, which gets vertices spaced like its neighbours; by an edge of any length with
///   GeometryOptions::close.
/// - Clockwise order is reversed.
/// Coordinates are not changed, and the first point stays first unless it was cut off or a tail was cut at a crossing.
/// check_simple() tells whether the result is simple. Throws InputError for fewer than three points, for points on one
/// line, and for an outline too open to be closed.
Element repair_outline(const RawOutline& outline, const std::string& file, const GeometryOptions& options = {});

}  // namespace lamina::geometry
