// Rows of an airfoil file -> one raw outline per element. Runs of coordinates are recognised as surfaces of one element
// (as in Lednicer files), pieces of one loop, or separate elements, in all formats that XFOIL, MSES and the UIUC
// collection use.
#pragma once

#include <string>
#include <vector>

#include "geometry/coordinate_blocks.hpp"
#include "geometry/source_point.hpp"

namespace lamina::geometry {

/// One element in the order of the file, except that separate surfaces are joined at the leading edge into one run. It
/// may be open or closed, run in either direction and have duplicate points.
struct RawOutline {
    std::vector<SourcePoint> points;
    std::string title;
    std::string format;              ///< as in Element
    std::string unit;                ///< as in Element
    std::vector<std::string> notes;  ///< decisions of the reader that its user should know
    bool samples_of_curve = false;   ///< as in Element; the points that are corners are marked
};

/// Returns the outlines of a document. An open run is one only where it is the only one of its section, or `keep_open`.
/// Throws InputError, which names `file`, where there are no coordinates or they cannot be understood as outlines.
std::vector<RawOutline> assemble_outlines(CoordinateDocument document, const std::string& file, bool keep_open);

}  // namespace lamina::geometry
