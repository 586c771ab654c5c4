// Warnings about sections that do not stand in the flow as sections usually do.
#pragma once

#include <lamina/geometry.hpp>

namespace lamina::geometry {

/// Adds warnings to the elements of files: "swapped_columns" where the configuration stands upright, "reversed_flow"
/// where an element has its tail at the smaller x. `flip` says whether flipped() made the geometry, so that the flip is
/// what may be wrong. Precondition: the outlines are simple.
void add_orientation_warnings(Geometry& geometry, bool flip);

}  // namespace lamina::geometry
