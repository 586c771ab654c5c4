// Sheets of a mesh that was made on both of their sides, a tiny gap apart, lose their thickness.
#pragma once

#include <lamina/pipeline.hpp>

namespace lamina::pipeline {

/// Returns whether any element of a geometry is or has a sheet.
bool has_sheets(const Geometry& geometry);

/// Moves the vertices on the second side of each sheet to those on the first one, with new vertices where one side
/// alone has any. A sheet whose sides have no such pairs keeps its gap, and a note of its element says so.
void close_sheets(MeshResult& result);

}  // namespace lamina::pipeline
