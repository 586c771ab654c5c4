// Warnings about sections that do not stand in the flow as sections usually do.
#pragma once

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Adds warnings to the elements of files: "swapped_columns" where the configuration stands upright, "reversed_flow"
/// where an element has its tail at the smaller x. Precondition: the outlines are simple.
void add_orientation_warnings(Geometry& geometry);

}  // namespace lamina::geometry
