// Rows of an airfoil file -> one raw outline an element.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <lamina/geometry.hpp>

#include "geometry/coordinate_text.hpp"

namespace lamina::geometry {

/// A point and the line of the file that holds it.
struct SourcePoint {
    Point at;
    std::size_t line = 0;
};

/// One element as the file has it: in the order of the file but for Lednicer surfaces, which are joined at the leading
/// edge into one run. Open or closed, either direction, duplicates and all.
struct RawOutline {
    std::vector<SourcePoint> points;
    std::string title;
    std::string format;
    std::vector<std::string> notes;
};

/// "(0.5, 0.1)", digits enough to find the point in the file; -0 as 0.
std::string coordinates(Point p);

/// Throws InputError (naming `file`) where the rows cannot be understood as outlines.
std::vector<RawOutline> assemble_outlines(const std::vector<Row>& rows, const std::string& file);

}  // namespace lamina::geometry
