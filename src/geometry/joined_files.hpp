// The upper and the lower surface of a section in two files.
#pragma once

#include <string>
#include <vector>

#include "geometry/outlines.hpp"

namespace lamina::geometry {

/// The outlines of one file.
struct OutlinesOfFile {
    std::string file;
    std::vector<RawOutline> outlines;
};

/// Joins two files in a row of which each holds one open surface, and which have both ends in common, to one: the first
/// keeps its name and gets the outline of both. Two plates, each of which begins and ends at corners, stay two.
void join_files(std::vector<OutlinesOfFile>& files);

}  // namespace lamina::geometry
