// Trailing edges that are opened to a gap, closed or continued to a sharp one.
#pragma once

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Changes the trailing edge of an element as GeometryOptions::sharpen_te and open_te ask, and notes it. Throws
/// InputError for an element whose rear has neither a corner nor a base, or whose sides do not meet behind it.
/// Precondition: the outline is counter-clockwise.
void shape_tail(Element& element, const GeometryOptions& options);

}  // namespace lamina::geometry
