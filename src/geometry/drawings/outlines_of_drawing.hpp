// The outlines of a drawing: its curves, joined end to end and sampled.
#pragma once

#include <string>
#include <vector>

#include "geometry/drawings/drawing.hpp"
#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// Returns the closed outlines of a drawing, and those whose ends are near each other against their length; with
/// `keep_open` the open ones, too, where none is closed. Left out, with notes, are outlines that are drawn twice,
/// frames round all others, what lies inside an outline, and what is much smaller than the largest. Throws InputError
/// where no outline is left. Of curves in several planes those of the first count that have an outline. Precondition:
/// the drawing has curves.
std::vector<RawOutline> outlines_of_drawing(const Drawing& drawing, const std::string& file, bool keep_open,
                                            std::vector<std::string>& notes);

}  // namespace lamina::geometry
